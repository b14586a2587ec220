#include "app/cli/fit_study_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/fit_study_photo.h"
#include "app/cli/options.h"
#include "core/flare/flare_image.h"
#include "core/io/photo_file.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

/// Rows of one fit for a table: number, truth, value, error, interval.
void add_rows(const FitReport& report, const std::vector<double>& truth, const std::string& which,
              Table& table) {
    for (std::size_t k = 0; k < report.numbers.size(); ++k) {
        const FittedNumber& number = report.numbers[k];
        table.rows.push_back({which, name(number.parameter), truth[k], number.value,
                              number.standard_error, number.low, number.high,
                              holds(number, truth[k]) ? "yes" : "no", name(number.knowledge),
                              report.chi2 / static_cast<double>(report.residuals)});
    }
}

std::vector<std::string> row_columns() {
    return {"case", "number", "truth",   "value",     "standard_error",
            "low",  "high",   "covered", "knowledge", "chi2_per_value"};
}

std::string remarks_of(const FitReport& report) {
    std::string text;
    for (const std::string& each : report.remarks) text += "\n- " + each;
    return text;
}

}  // namespace

StudySection study_radii(const StudyRequest& request) {
    StudySection section{.key = "radii",
                         .title = "Radii off by 0.3 %",
                         .text = {},
                         .table = {.columns = row_columns(), .rows = {}},
                         .pictures = {}};
    const Prescription listed = tessar_with(first_centers_nm);
    Prescription truth = tessar_with(true_centers_nm);
    std::vector<double> radii;
    int sign = 1;
    for (Surface& surface : truth.surfaces) {
        const double c = curvature_per_mm(surface.curve);
        if (c == 0.0) continue;
        const double radius_mm = (1.0 + 0.003 * sign) / c;
        surface.curve = Radius{radius_mm};
        radii.push_back(radius_mm);
        sign = -sign;
    }
    std::vector<FitPhoto> photos;
    for (const double field_deg : {5.0, 9.0}) {
        SyntheticPhotoRequest camera = study_camera(field_deg, request.quick);
        photos.push_back(fit_photo(*synthetic_photo(truth, camera), truth, camera.light));
    }
    const FitReport held =
        *fit_flare(listed, photos, usual_fit(listed, "center@all", request.quick));
    const FitReport freed =
        *fit_flare(listed, photos, usual_fit(listed, "center@all,radius@all~0.3%", request.quick));
    std::vector<double> known = true_centers_nm;
    add_rows(held, known, "radii as listed", section.table);
    section.pictures.push_back(write_pages(held, listed.name, request.folder, "radii_as_listed"));
    known.insert(known.end(), radii.begin(), radii.end());
    add_rows(freed, known, "radii freed", section.table);
    section.pictures.push_back(write_pages(freed, listed.name, request.folder, "radii_freed"));
    section.text = fmt::format(
        "Two photographs (5° and 9°) of a Tessar whose radii are 0.3 % longer and shorter in turn; "
        "the fit is told the listed ones. With radii held χ² per value is {:.3g}, {} of {} "
        "intervals hold the truth, and the verdict says: \"{}\" With radii freed (σ 0.3 %) it is "
        "{:.3g}, and {} of {} hold: \"{}\"",
        chi2_per_value(held), covered(held, true_centers_nm), true_centers_nm.size(), held.verdict,
        chi2_per_value(freed), covered(freed, known), known.size(), freed.verdict);
    return section;
}

StudySection study_undetermined(const StudyRequest& request) {
    StudySection section{.key = "undetermined",
                         .title = "What cannot be determined",
                         .text = {},
                         .table = {.columns = row_columns(), .rows = {}},
                         .pictures = {}};
    const Prescription truth = tessar_with(true_centers_nm);
    // One ghost alone, 8-7: only the product of two reflectances is seen.
    SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    FlareRequest alone;
    alone.light = camera.light;
    alone.spectrum = camera.spectrum;
    alone.method = FlareMethod::reference;
    alone.tolerance = camera.tolerance;
    alone.width_px = camera.width_px;
    const OpticalSystem system = compile(truth, d_line_nm);
    const GhostPath only = parse_ghost("8-7", system);
    alone.only = {only};
    std::vector<FitPhoto> photos = {
        fit_photo(exposed(*render_flare(truth, alone), truth, camera), truth, camera.light)};
    Prescription wrong = truth;
    std::get<QuarterWave>(wrong.surfaces[6].coating).center_nm = 560.0;
    std::get<QuarterWave>(wrong.surfaces[7].coating).center_nm = 500.0;
    FitRequest fit = usual_fit(wrong, "center@7,center@8", request.quick);
    for (const GhostPath& each : two_reflection_ghosts(system))
        if (!(each == only)) fit.left_out.push_back(name(each, truth.surfaces.size()));
    const FitReport pair = *fit_flare(wrong, photos, fit);
    const std::vector<double> pair_truth = {505.0, 560.0};
    add_rows(pair, pair_truth, "one shared ghost", section.table);
    section.pictures.push_back(write_pages(pair, truth.name, request.folder, "shared_ghost"));
    // The whole flare on top.
    photos.assign(1, fit_photo(*synthetic_photo(truth, camera), truth, camera.light));
    fit.left_out.clear();
    const FitReport whole = *fit_flare(wrong, photos, fit);
    add_rows(whole, pair_truth, "all ghosts", section.table);

    // A light on the axis, every λ0 unknown; then the photograph that the fit asks for.
    const Prescription first = tessar_with(first_centers_nm);
    camera = study_camera(0.0, request.quick);
    photos.assign(1, fit_photo(*synthetic_photo(truth, camera), truth, camera.light));
    fit = usual_fit(first, "center@all", request.quick);
    fit.suggestions = 5;
    const FitReport axis = *fit_flare(first, photos, fit);
    add_rows(axis, true_centers_nm, "on axis", section.table);
    section.pictures.push_back(write_pages(axis, truth.name, request.folder, "on_axis"));
    const Suggestion& best = axis.suggestions.front();
    camera = study_camera(best.light.field_deg, request.quick);
    camera.seed = 2;
    photos.push_back(fit_photo(*synthetic_photo(truth, camera), truth, camera.light));
    fit.suggestions = 0;
    const FitReport both = *fit_flare(first, photos, fit);
    add_rows(both, true_centers_nm, "with the suggested one", section.table);
    section.text = fmt::format(
        "**One shared ghost.** Surfaces 7 and 8 of the Tessar seen through ghost 8-7 alone: {} of "
        "2 "
        "directions are determined, errors {:.3g} and {:.3g} nm.{}\n\nAll ghosts of the same "
        "light: "
        "{} of 2, errors {:.3g} and {:.3g} nm.\n\n**A light on the axis.** {} of 6 directions are "
        "determined.{}\n\nThe fit asks for a light at {:.3g}° ({} from {:.3g} to {:.3g} nm). With "
        "that photograph {} of 6 are, and the errors are",
        pair.rank, pair.numbers[0].standard_error, pair.numbers[1].standard_error, remarks_of(pair),
        whole.rank, whole.numbers[0].standard_error, whole.numbers[1].standard_error, axis.rank,
        remarks_of(axis), best.light.field_deg, name(axis.numbers[best.number].parameter),
        best.error_now, best.error_then, both.rank);
    for (std::size_t k = 0; k < both.numbers.size(); ++k)
        section.text += fmt::format("{} {:.3g} (was {:.3g})", k == 0 ? "" : ",",
                                    both.numbers[k].standard_error, axis.numbers[k].standard_error);
    section.text += fmt::format(" nm; {} of 6 intervals hold the truth, on axis {} of 6.",
                                covered(both, true_centers_nm), covered(axis, true_centers_nm));
    return section;
}

StudySection study_clutter(const StudyRequest& request) {
    StudySection section{.key = "clutter",
                         .title = "Clutter, 8 bits, JPEG",
                         .text = {},
                         .table = {.columns = row_columns(), .rows = {}},
                         .pictures = {}};
    const Prescription truth = tessar_with(true_centers_nm), wrong = tessar_with(first_centers_nm);
    const SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    const FlareImage subject = *photo_subject(truth, camera);
    // A landscape: a dim sky that fades, a dark wavy ground; and a lamp out of focus.
    FlareImage scene = subject;
    float level = 0.0F;
    for (const float each : subject.rgb) level = std::max(level, each);
    for (int y = 0; y < scene.height_px; ++y)
        for (int x = 0; x < scene.width_px; ++x) {
            const double u = (x + 0.5) / scene.width_px, v = (y + 0.5) / scene.height_px;
            const double horizon = 0.62 + 0.03 * std::sin(9.0 * u) + 0.015 * std::sin(31.0 * u);
            const double sky = v < horizon ? 0.010 + 0.015 * v : 0.002;
            const double lamp = std::hypot((u - 0.8) * 1.5, v - 0.3) < 0.03 ? 0.15 : 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                scene.rgb[3 * static_cast<std::size_t>(y * scene.width_px + x) + c] +=
                    level * static_cast<float>(lamp + sky * (c == 2   ? 1.4
                                                             : c == 1 ? 1.0
                                                                      : 0.7));
        }
    auto fitted = [&](Photo photo, const std::string& which) {
        const std::vector<FitPhoto> photos = {fit_photo(std::move(photo), truth, camera.light)};
        const FitReport report =
            *fit_flare(wrong, photos, usual_fit(wrong, "center@all", request.quick));
        add_rows(report, true_centers_nm, which, section.table);
        section.pictures.push_back(
            write_pages(report, truth.name, request.folder, "clutter_" + which));
        section.text += fmt::format(
            "- **{}**: χ² per value {:.3g}, {} of 6 intervals hold the "
            "truth, {} of 6 determined, {}. \"{}\"\n",
            which, chi2_per_value(report), covered(report, true_centers_nm), report.rank,
            report.usable ? "usable" : "not usable", report.verdict);
    };
    fitted(exposed(subject, truth, camera), "plain");
    fitted(exposed(scene, truth, camera), "scene");
    for (const std::string ending : {"png", "jpg"}) {
        SyntheticPhotoRequest file = camera;
        file.bits = 8;
        file.srgb = true;
        const auto path = request.folder / ("clutter_photo." + ending);
        write_photo(exposed(subject, truth, file), 8, path);
        fitted(read_photo(path), ending);
    }
    return section;
}

StudySection study_wrong_lens(const StudyRequest& request) {
    StudySection section{
        .key = "wrong-lens",
        .title = "The wrong lens",
        .text = {},
        .table = {.columns = {"lens", "usable", "explained", "outliers", "chi2_per_value"},
                  .rows = {}},
        .pictures = {}};
    const Prescription truth = tessar_with(true_centers_nm);
    const SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    const std::vector<FitPhoto> photos = {
        fit_photo(*synthetic_photo(truth, camera), truth, camera.light)};
    for (const char* each :
         {"tessar_brendel_100_f2.8", "heliar_tronnier_100", "double_gauss_tronnier_100_f2"}) {
        LensOptions which;
        which.lens = each;
        Prescription lens = load_lens(which).lens;
        lens.sensor = truth.sensor;
        FitRequest fit = usual_fit(lens, "center@all", request.quick);
        fit.starts = 1;
        const FitReport report = *fit_flare(lens, photos, fit);
        section.table.rows.push_back({std::string(each), report.usable ? "yes" : "no",
                                      report.explained_after, report.outliers,
                                      chi2_per_value(report)});
        section.text += fmt::format("- `{}`: {}\n", each, report.verdict);
        section.pictures.push_back(
            write_pages(report, lens.name, request.folder, fmt::format("wrong_{}", each)));
    }
    section.text = "A Tessar's photograph, fitted with three lenses:\n\n" + section.text;
    return section;
}

StudySection study_kinds(const StudyRequest& request) {
    StudySection section{.key = "kinds",
                         .title = "Kinds of coating",
                         .text = {},
                         .table = {.columns = {"surface", "truth", "kind", "numbers", "chi2_above",
                                               "bic_above", "share"},
                                   .rows = {}},
                         .pictures = {}};
    // Two of six surfaces have other kinds than the fit is told.
    Prescription truth = tessar_with(true_centers_nm);
    truth.surfaces[0].coating = parse_coating("v-coat");
    truth.surfaces[5].coating = Uncoated{};
    const Prescription wrong = tessar_with(first_centers_nm);
    const SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    const std::vector<FitPhoto> photos = {
        fit_photo(*synthetic_photo(truth, camera), truth, camera.light)};
    FitRequest fit = usual_fit(wrong, "center@all", request.quick);
    for (const char* each : {"none", "qw:550", "v-coat", "two-layer-quarter-half"})
        fit.kinds.push_back({each, parse_coating(each)});
    const FitReport report = *fit_flare(wrong, photos, fit);
    std::size_t right = 0;
    for (const SurfaceKinds& surface : report.kinds) {
        const std::string expected = surface.row == 0   ? "v-coat"
                                     : surface.row == 5 ? "none"
                                                        : "qw:550";
        right += surface.tried.front().name == expected;
        for (const KindTried& each : surface.tried)
            section.table.rows.push_back({static_cast<std::int64_t>(surface.row + 1), expected,
                                          each.name, static_cast<std::int64_t>(each.numbers),
                                          each.chi2_above, each.bic_above, each.share});
        section.text += fmt::format(
            "- surface {} (truth: {}): {}, {:.3g} % of the odds; next {}, "
            "BIC {:.3g} higher\n",
            surface.row + 1, expected, surface.tried.front().name,
            100.0 * surface.tried.front().share, surface.tried[1].name, surface.tried[1].bic_above);
    }
    section.text = fmt::format(
                       "A Tessar with a V-coat on surface 1 and none on surface 6; the fit is told "
                       "quarter waves "
                       "everywhere and chooses from four kinds. {} of {} are right. \"{}\"\n\n",
                       right, report.kinds.size(), report.verdict) +
                   section.text;
    section.pictures.push_back(write_pages(report, truth.name, request.folder, "kinds"));
    return section;
}

}  // namespace ghostlight::cli
