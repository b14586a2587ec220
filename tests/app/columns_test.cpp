// Names and order of what scripts read: a contract, written out in docs/command-line.md.

#include <nlohmann/json.hpp>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

using Names = std::vector<std::string>;

const Names info_names = {"efl_mm",
                          "bfd_mm",
                          "ffd_mm",
                          "f_number",
                          "entrance_pupil_z_mm",
                          "entrance_pupil_radius_mm",
                          "exit_pupil_z_mm",
                          "exit_pupil_radius_mm",
                          "sensor_distance_mm",
                          "paraxial_defocus_mm",
                          "ghosts",
                          "front_principal_z_mm",
                          "rear_principal_z_mm",
                          "front_nodal_z_mm",
                          "rear_nodal_z_mm",
                          "pupil_magnification",
                          "working_f_number",
                          "numerical_aperture",
                          "image_height_mm",
                          "half_field_deg",
                          "paraxial_half_field_deg",
                          "half_field_x_deg",
                          "half_field_y_deg",
                          "total_track_mm",
                          "petzval_per_mm",
                          "higher_order_share"};
const Names ray_names = {"surface",    "z_mm",       "n_after", "marginal_y_mm", "marginal_u",
                         "marginal_i", "chief_y_mm", "chief_u", "chief_i",       "lagrange_mm"};
const Names curve_names = {"field_deg",     "image_height_mm",      "paraxial_height_mm",
                           "distortion",    "pupil_area_mm2",       "vignetting",
                           "transmittance", "relative_illumination"};
const Names trace_names = {
    "px_mm",     "py_mm",     "status", "x_mm",   "y_mm",          "dx", "dy", "dz",
    "stop_u_mm", "stop_v_mm", "r_rel",  "weight", "weight_average"};
const Names coating_names = {"wavelength_nm", "angle_deg", "r_s", "r_p", "r", "t_s", "t_p", "t"};
const Names ghost_names = {"ghost",          "surface_1",     "surface_2",   "flux_mm2",
                           "flux_error_mm2", "relative_flux", "peak_per_e0", "centroid_x_mm",
                           "centroid_y_mm",  "rms_radius_mm", "on_sensor",   "reflectance_1",
                           "reflectance_2",  "rays"};
const Names paraxial_names = {"a",
                              "b",
                              "c",
                              "d",
                              "focus_from_sensor_mm",
                              "magnification",
                              "paraxial_diameter_mm",
                              "fresnel_number",
                              "stop_crossings"};

const Names detail_names = {"reflections",
                            "media_1",
                            "media_2",
                            "incidence_1_deg",
                            "incidence_2_deg",
                            "largest_incidence_1_deg",
                            "largest_incidence_2_deg",
                            "area_mm2",
                            "pupil_area_mm2",
                            "x_min_mm",
                            "x_max_mm",
                            "y_min_mm",
                            "y_max_mm",
                            "peak_per_sun_image",
                            "vignetting",
                            "cie_x",
                            "cie_y",
                            "srgb",
                            "converged",
                            "ghost_pupil_from_sensor_mm",
                            "ghost_pupil_radius_mm"};

const std::string two_rays = "px_mm,py_mm\n0,0\n17,17\n";

struct Case {
    Names arguments;
    std::string input;
    Names names;
};

std::vector<Case> cases() {
    Names with_paraxial = ghost_names;
    with_paraxial.insert(with_paraxial.end(), paraxial_names.begin(), paraxial_names.end());
    const Names ghosts = {"ghosts", tessar(), "--field", "0", "--top", "2"};
    Names paraxial = ghosts;
    paraxial.emplace_back("--paraxial");
    Names all = ghosts;
    all.insert(all.end(), {"--columns", "all"});
    Names all_names = ghost_names;
    all_names.insert(all_names.end(), detail_names.begin(), detail_names.end());
    all_names.insert(all_names.end(), paraxial_names.begin(), paraxial_names.end());
    return {
        {{"info", tessar()}, "", info_names},
        {{"info", tessar(), "--rays"}, "", ray_names},
        {{"info", tessar(), "--curves", "--points", "3"}, "", curve_names},
        {{"trace", tessar(), "--ghost", "5-3", "--field", "15", "--rays", "-"},
         two_rays,
         trace_names},
        {{"coating", "--stack", "1 | 1.5", "--wavelengths", "550", "--angles", "0,30"},
         "",
         coating_names},
        {ghosts, "", ghost_names},
        {paraxial, "", with_paraxial},
        {all, "", all_names},
    };
}

TEST(CommandLineColumns, CsvHasTheDocumentedNamesInOrder) {
    for (const Case& each : cases())
        EXPECT_EQ(cli_csv(each.arguments, each.input).columns, each.names) << each.arguments[0];
}

TEST(CommandLineColumns, JsonHasTheSameNamesInOrderAndTheSameValues) {
    for (const Case& each : cases()) {
        SCOPED_TRACE(each.arguments[0]);
        Names arguments = each.arguments;
        arguments.emplace_back("--json");
        const auto json = nlohmann::ordered_json::parse(cli_output(arguments, each.input));
        ASSERT_TRUE(json.contains("lens") && json.contains("request") && json.contains("rows"));
        EXPECT_EQ(json["request"]["command"], each.arguments[0]);
        const Csv csv = cli_csv(each.arguments, each.input);
        ASSERT_EQ(json["rows"].size(), csv.rows.size());
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            Names names;
            for (const auto& item : json["rows"][row].items()) {
                names.push_back(item.key());
                const std::string& text = csv.text(row, item.key());
                if (item.value().is_string())
                    EXPECT_EQ(item.value(), text);
                else if (item.value().is_null())
                    EXPECT_TRUE(text.empty() || text == "inf" || text == "-inf") << text;
                else
                    EXPECT_EQ(item.value().get<double>(), csv.number(row, item.key()));
            }
            EXPECT_EQ(names, each.names);
        }
    }
}

TEST(CommandLineColumns, ReadableTableIsAlignedUnderTheSameNames) {
    for (const Case& each : cases()) {
        const std::string text = cli_output(each.arguments, each.input);
        std::size_t at = 0;
        for (const std::string& name : each.names) {
            at = text.find(name, at);
            ASSERT_NE(at, std::string::npos) << each.arguments[0] << ": " << name;
        }
    }
}

TEST(CommandLineColumns, DocumentationNamesThemAll) {
    const std::string text = read_file(test_data_folder() / "../../docs/command-line.md");
    for (const Case& each : cases())
        for (const std::string& name : each.names)
            EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << name;
}

TEST(CommandLineColumns, LostRaysLeaveTheirFieldsEmpty) {
    const Csv csv =
        cli_csv({"trace", tessar(), "--ghost", "5-3", "--field", "15", "--rays", "-"}, two_rays);
    EXPECT_EQ(csv.text(0, "status"), "ok");
    EXPECT_EQ(csv.text(1, "status"), "tir:6");
    EXPECT_EQ(csv.text(1, "px_mm"), "17");
    for (std::size_t column = 3; column < trace_names.size(); ++column) {
        EXPECT_NE(csv.text(0, trace_names[column]), "");
        EXPECT_EQ(csv.text(1, trace_names[column]), "");
    }
}

TEST(CommandLineColumns, DirectPathIsTheFirstRowAndHasNoReflections) {
    const Csv csv = cli_csv({"ghosts", tessar(), "--field", "0", "--top", "3"});
    ASSERT_EQ(csv.rows.size(), 4U);
    EXPECT_EQ(csv.text(0, "ghost"), "direct");
    EXPECT_EQ(csv.text(0, "surface_1"), "");
    EXPECT_EQ(csv.text(0, "reflectance_2"), "");
    EXPECT_EQ(csv.number(0, "relative_flux"), 1.0);
    EXPECT_EQ(csv.text(1, "ghost"), csv.text(1, "surface_1") + "-" + csv.text(1, "surface_2"));
    EXPECT_GE(csv.number(1, "flux_mm2"), csv.number(2, "flux_mm2"));
    EXPECT_GE(csv.number(2, "flux_mm2"), csv.number(3, "flux_mm2"));
}

TEST(CommandLineColumns, AnAfocalSystemHasNoFocalLength) {
    // A plane plate: everything is infinite, and says so in each form.
    const std::string plate = R"({"name": "plate", "units": "mm", "stop_index": 0, "surfaces": [
        {"radius": null, "thickness": 5, "nd": 1, "vd": null, "semi_diameter": 10, "stop": true},
        {"radius": null, "thickness": 5, "nd": 1.5, "vd": 60, "semi_diameter": 10},
        {"radius": null, "thickness": 50, "nd": 1, "vd": null, "semi_diameter": 10}]})";
    const auto file = std::filesystem::path(::testing::TempDir()) / "ghostlight-plate.json";
    write_file(file, plate);
    const std::string csv = cli_output({"info", file.string(), "--csv"});
    EXPECT_NE(csv.find("inf"), std::string::npos) << csv;
    const auto json = nlohmann::json::parse(cli_output({"info", file.string(), "--json"}));
    EXPECT_TRUE(json["rows"][0]["efl_mm"].is_null());
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace ghostlight::test
