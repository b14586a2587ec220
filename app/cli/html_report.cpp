#include "app/cli/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/exposure.h"
#include "app/cli/ghost_reports.h"
#include "app/cli/lens_data.h"
#include "core/flare/flare_image.h"
#include "core/io/chart_svg.h"
#include "core/io/html_page.h"
#include "core/io/image_file.h"
#include "core/io/layout_svg.h"
#include "core/io/lens_quantities.h"
#include "core/io/table_file.h"

namespace ghostlight::cli {
namespace {

constexpr int picture_width_px = 900;
constexpr std::size_t ghosts_in_layout = 2;

std::string key_values(const std::vector<LensQuantity>& quantities) {
    std::string html = "<div class=\"key\">";
    for (const LensQuantity& each : quantities)
        html += fmt::format("<div title=\"{}\"><span>{}</span><span>{}</span></div>",
                            xml_text(each.meaning), xml_text(each.name),
                            xml_text(readable_text(each.value)));
    return html + "</div>\n";
}

Table prescription_rows(const Prescription& lens, const OpticalSystem& system) {
    Table table;
    table.columns = {"row", "radius", "thickness", "medium", "n", "semi", "coating", "kind"};
    for (std::size_t k = 0; k < lens.surfaces.size(); ++k) {
        const Surface& surface = lens.surfaces[k];
        const double c = curvature_per_mm(surface.curve);
        const bool stop = k == lens.stop.surface;
        const bool asphere = surface.conic != 0.0 || !surface.aspheric.empty();
        const double to_next = k + 1 < lens.surfaces.size()
                                   ? surface.thickness_mm
                                   : system.sensor_z_mm - system.surfaces[k].vertex_z_mm;
        table.rows.push_back({std::to_string(k + 1), c == 0.0 ? Cell("plane") : Cell(1.0 / c),
                              to_next, describe(surface.medium_after), system.surfaces[k].n_after,
                              surface.semi_diameter_mm, describe(surface.coating),
                              std::string(stop      ? "stop"
                                          : asphere ? "asphere"
                                                    : "")});
    }
    return table;
}

/// R at normal incidence over the visible; surfaces with the same curve share one line.
Chart reflectance_chart(const Prescription& lens) {
    Chart chart{.x_title = "wavelength, nm", .y_title = "R at normal incidence, %", .curves = {}};
    std::vector<std::vector<double>> curves;
    std::vector<std::string> names;
    std::vector<double> wavelengths;
    for (double nm = 400.0; nm <= 700.0; nm += 5.0) wavelengths.push_back(nm);
    std::vector<OpticalSystem> systems;
    for (const double nm : wavelengths) systems.push_back(compile(lens, nm));
    for (std::size_t row = 0; row <= lens.surfaces.size(); ++row) {
        if (row == lens.surfaces.size() && !systems.front().sensor_face) break;
        std::vector<double> r;
        for (const OpticalSystem& system : systems) {
            if (row == lens.surfaces.size() && !system.sensor_face) break;
            const SurfaceAt& surface = surface_at(system, row);
            r.push_back(100.0 *
                        surface.uniform_reflectance.value_or(reflectances(surface.film, 1.0).r()));
        }
        if (r.size() != wavelengths.size() || *std::ranges::max_element(r) <= 0.0) continue;
        const std::string label = row == lens.surfaces.size() ? "sensor" : std::to_string(row + 1);
        const auto same = std::ranges::find_if(curves, [&](const std::vector<double>& other) {
            for (std::size_t i = 0; i < r.size(); ++i)
                if (std::abs(r[i] - other[i]) > 1e-6) return false;
            return true;
        });
        if (same != curves.end()) {
            names[static_cast<std::size_t>(same - curves.begin())] += ", " + label;
            continue;
        }
        curves.push_back(r);
        names.push_back(label);
    }
    for (std::size_t k = 0; k < curves.size(); ++k)
        chart.curves.push_back({(names[k] == "sensor" ? "" : "surface ") + names[k], chart_color(k),
                                wavelengths, curves[k]});
    return chart;
}

std::string layout_section(const HtmlReport& report, const OpticalSystem& system) {
    std::vector<DrawnPath> drawn = {{{}, "#777777", 7, 0.7}};
    std::string legend = "<span class=\"dot\" style=\"background:#777\"></span>image";
    for (std::size_t k = 0; k < std::min(ghosts_in_layout, report.ghosts->ghosts.size()); ++k) {
        const GhostRow& ghost = report.ghosts->ghosts[k];
        const std::string color = chart_color(k + 1);
        drawn.push_back({ghost.path, color, 5, 0.8});
        legend += fmt::format("<span class=\"dot\" style=\"background:{}\"></span>ghost {}", color,
                              name(ghost.path, report.ghosts->surface_count));
    }
    return layout_svg(system, report.state->light.field_deg, drawn) +
           fmt::format(
               "<p class=\"lead\">To scale; light from {} deg, drawn in the meridional "
               "plane.{}</p>\n",
               report.state->light.field_deg, legend);
}

std::string ghosts_section(const HtmlReport& report) {
    GhostTable shown = *report.ghosts;
    if (report.shown > 0 && report.shown < shown.ghosts.size()) shown.ghosts.resize(report.shown);
    std::vector<HtmlColumn> columns = {{"ghost", "ghost"},
                                       {"flux_mm2", "flux<br>mm²"},
                                       {"flux_error_mm2", "error<br>mm²"},
                                       {"relative_flux", "flux /<br>image"},
                                       {"peak_per_e0", "peak<br>/ E0"},
                                       {"peak_per_sun_image", "peak / sun's<br>image"},
                                       {"on_sensor", "on sensor<br>%", 100.0},
                                       {"centroid_x_mm", "x<br>mm"},
                                       {"centroid_y_mm", "y<br>mm"},
                                       {"rms_radius_mm", "RMS<br>mm"},
                                       {"reflectance_1", "R1<br>%", 100.0},
                                       {"incidence_1_deg", "angle 1<br>deg"},
                                       {"reflectance_2", "R2<br>%", 100.0},
                                       {"incidence_2_deg", "angle 2<br>deg"},
                                       {"focus_from_sensor_mm", "focus<br>mm"},
                                       {"paraxial_diameter_mm", "paraxial<br>diameter mm"},
                                       {"fresnel_number", "Fresnel<br>number"}};
    if (report.ghosts->direct.color) columns.push_back({"srgb", "colour"});
    return html_table(ghost_rows(shown, GhostColumns::all), columns) +
           fmt::format(
               "<p class=\"lead\">{} of {} ghosts, strongest first. Flux per irradiance E0 of "
               "the light across its beam, polarisation carried; peak over a cell of sensor "
               "width / 1280; angles are means in the medium the light comes from; the focus "
               "is counted from the sensor, negative in front of it.</p>\n",
               shown.ghosts.size(), report.ghosts->ghosts.size());
}

std::string picture_section(const HtmlReport& report) {
    FlareRequest request;
    request.light = report.state->light;
    request.spectrum = report.state->spectrum;
    request.width_px = picture_width_px;
    const FlareImage image = *render_flare(report.state->loaded.lens, request);
    const double exposure_ev = automatic_exposure_ev(image);
    return fmt::format(
        "<img alt=\"flare\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">\n"
        "<p class=\"lead\">All ghosts of two reflections on the sensor of {:.6g} × {:.6g} mm, "
        "upright, "
        "without the image itself; {:.1f} stops above the exposure that shows the light's own "
        "irradiance as white. Flux on the sensor {:.4g} mm².</p>\n",
        image.width_px, image.height_px, base64(png_bytes(image, exposure_ev)),
        image.sensor_width_mm, image.sensor_height_mm, exposure_ev, image.flux_on_sensor_mm2);
}

}  // namespace

std::string html_report(const HtmlReport& report) {
    const GhostState& state = *report.state;
    const Prescription& lens = state.loaded.lens;
    const OpticalSystem system = compile(lens, reference_wavelength_nm(state.spectrum));
    const std::string title = xml_text(lens_heading(state.loaded));
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<title>Ghosts of {0}</title><style>{1}</style></head><body>\n<h1>{0}</h1>\n"
        "<p class=\"lead\">{2}, field {3} deg, azimuth {4} deg, f/{5:.3g}. All ghosts on the "
        "sensor "
        "over the image: {6:.3g}.</p>\n",
        title, html_style, xml_text(name(state.spectrum)), state.light.field_deg,
        state.light.azimuth_deg, state.f_number, report.ghosts->veiling_fraction);
    html += "<h2>Flare</h2>\n" + picture_section(report);
    html += "<h2>Layout</h2>\n" + layout_section(report, system);
    html += "<h2>Ghosts</h2>\n" + ghosts_section(report);
    html +=
        "<h2>By surface</h2>\n" +
        html_table(rows_by_surface(*report.ghosts, lens),
                   {{"surface", "surface"},
                    {"element", "element"},
                    {"media", "media"},
                    {"coating", "coating"},
                    {"flux_mm2", "flux<br>mm²"},
                    {"share", "share of all<br>%", 100.0},
                    {"on_sensor_mm2", "on sensor<br>mm²"},
                    {"veiling_fraction", "on sensor /<br>image"},
                    {"ghosts", "ghosts"}}) +
        "<p class=\"lead\">The flux of all ghosts that turn at a surface: a ghost counts at each "
        "of its surfaces, so that the shares add up to more than 100 %.</p>\n";
    html += "<h2>Reflectances</h2>\n" + chart_svg(reflectance_chart(lens));
    html += "<h2>First-order data</h2>\n" + key_values(lens_quantities(system));
    html += "<h2>Prescription</h2>\n" +
            html_table(prescription_rows(lens, system), {{"row", "surface"},
                                                         {"radius", "radius<br>mm"},
                                                         {"thickness", "to next<br>mm"},
                                                         {"medium", "medium behind"},
                                                         {"n", "n"},
                                                         {"semi", "semi-diameter<br>mm"},
                                                         {"coating", "coating"},
                                                         {"kind", ""}});
    if (!lens.source.empty())
        html += fmt::format("<p class=\"lead\">Source: {}</p>\n", xml_text(lens.source));
    html += "<h2>Settings</h2>\n<pre>" + xml_text(report.command) + "\n";
    for (const auto& [name, value] : report.settings)
        html += fmt::format("\n{}: {}", xml_text(name), xml_text(value));
    html += "\nprogram: ghostlight-cli " GHOSTLIGHT_VERSION "</pre>\n";
    return html + "</body></html>\n";
}

}  // namespace ghostlight::cli
