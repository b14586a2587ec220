#include "app/cli/stop_options.h"

#include "app/cli/options.h"
#include "core/io/stop_image_file.h"

namespace ghostlight::cli {
namespace {

/// "VALUE" or "VALUE:SMALLEST:LARGEST", the two in mm.
void read_sized(std::string_view option, std::string_view text, std::string_view expected,
                std::string_view& value, double& smallest_mm, double& largest_mm) {
    const auto parts = split(text, ':');
    if (parts.size() != 1 && parts.size() != 3) throw bad_value(option, text, expected);
    value = parts.front();
    if (parts.size() == 1) return;
    const auto smallest = parse_number(parts[1]), largest = parse_number(parts[2]);
    if (!smallest || !largest || !(*smallest > 0.0) || !(*largest >= *smallest))
        throw bad_value(option, text, expected);
    smallest_mm = *smallest;
    largest_mm = *largest;
}

void override_dirt(StopDirt& dirt, const StopOptions& options) {
    std::string_view value;
    if (!options.dust.empty()) {
        constexpr std::string_view expected =
            "the share of the stop that specks cover, 0 to 0.5, or with their diameters in mm: "
            "0.01:0.02:0.2";
        read_sized("--dust", options.dust, expected, value, dirt.dust_smallest_mm,
                   dirt.dust_largest_mm);
        dirt.dust_coverage = number_value(
            "--dust", value, expected, [](double share) { return share >= 0.0 && share <= 0.5; });
    }
    if (!options.scratches.empty()) {
        constexpr std::string_view expected =
            "how many, 0 to 10000, or with their widths in mm: 30:0.005:0.02";
        read_sized("--scratches", options.scratches, expected, value, dirt.scratch_thinnest_mm,
                   dirt.scratch_widest_mm);
        dirt.scratches = static_cast<int>(integer_value("--scratches", value, expected, 0, 10'000));
    }
    if (!options.fingerprint.empty())
        dirt.fingerprint = number_value("--fingerprint", options.fingerprint, "a share from 0 to 1",
                                        [](double share) { return share >= 0.0 && share <= 1.0; });
    if (!options.seed.empty())
        dirt.seed = static_cast<int>(integer_value(
            "--dirt-seed", options.seed, "a whole number from 0 to 1000000000", 0, 1'000'000'000));
}

}  // namespace

void add_stop(CLI::App& command, StopOptions& options, const std::string& group) {
    auto add = [&](const char* name, std::string& value, const char* type, const char* what) {
        add_text(command, name, value, type, what)->group(group);
    };
    add("--blades", options.blades, "N", "blades of the stop: 0 (round), or 3 to 1000");
    add("--blade-rotation", options.rotation, "DEG", "turns the stop and its image, degrees");
    add("--blade-curvature", options.curvature, "X", "0 straight blades, 1 the full circle");
    add("--stop-image", options.mask, "IMAGE|none",
        "an image over the stop's opening, white where it is open; none: without the\nlens file's");
    add("--dust", options.dust, "SHARE[:MM:MM]",
        "share of the stop that specks cover, and their least and largest diameter");
    add("--scratches", options.scratches, "N[:MM:MM]",
        "how many scratches, and their least and largest width");
    add("--fingerprint", options.fingerprint, "SHARE",
        "a fingerprint on the stop whose ridges take this share of the light");
    add("--dirt-seed", options.seed, "N", "another number scatters the same dirt otherwise");
}

void override_stop_shape(Stop& stop, const StopOptions& options) {
    if (!options.blades.empty()) {
        constexpr std::string_view expected = "0 (round), or a whole number from 3 to 1000";
        const long blades = integer_value("--blades", options.blades, expected, 0, 1000);
        if (blades == 1 || blades == 2) throw bad_value("--blades", options.blades, expected);
        stop.blades = static_cast<int>(blades);
    }
    if (!options.rotation.empty())
        stop.rotation_deg = number_value("--blade-rotation", options.rotation,
                                         "an angle in degrees", [](double) { return true; });
    if (!options.curvature.empty())
        stop.blade_curvature =
            number_value("--blade-curvature", options.curvature, "a number from 0 to 1",
                         [](double x) { return x >= 0.0 && x <= 1.0; });
    if (options.mask == "none")
        stop.image.reset();
    else if (!options.mask.empty())
        stop.image = read_option("--stop-image", [&] { return read_stop_image(options.mask); });
    override_dirt(stop.dirt, options);
}

}  // namespace ghostlight::cli
