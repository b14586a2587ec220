#include "core/io/fit_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/flare/flare_image.h"
#include "core/io/chart_svg.h"
#include "core/io/html_page.h"
#include "core/io/image_file.h"

namespace ghostlight {
namespace {

/// Residuals beyond this many standard deviations are shown in full red or blue.
constexpr double shown_sigmas = 5.0;
constexpr int shown_width_px = 384;

FlareImage image_of(const FittedPhoto& photo, const std::vector<float>& rgb) {
    FlareImage image;
    image.width_px = photo.frame.width_px;
    image.height_px = photo.frame.height_px;
    image.rgb = rgb;
    image.irradiance.assign(rgb.size() / 3, 0.0F);
    return image;
}

std::string img(const FlareImage& image, double exposure_ev, const std::string& caption) {
    return fmt::format(
        "<figure><img alt=\"{0}\" width=\"{1}\" style=\"image-rendering:pixelated;width:{1}px\" "
        "src=\"data:image/png;base64,{2}\"><figcaption>{0}</figcaption></figure>\n",
        caption, shown_width_px, base64(png_bytes(image, exposure_ev)));
}

/// In the light's own white, what was masked dark.
std::string picture(const FittedPhoto& photo, const std::vector<double>& values, double exposure_ev,
                    const std::string& caption) {
    std::vector<float> rgb(values.size(), 0.0F);
    for (std::size_t s = 0; s < photo.used.size(); ++s)
        for (std::size_t c = 0; c < 3 && photo.used[s]; ++c)
            rgb[3 * s + c] = static_cast<float>(std::max(0.0, values[3 * s + c] / photo.gain[c]));
    return img(image_of(photo, rgb), exposure_ev, caption);
}

std::string residual_picture(const FittedPhoto& photo) {
    std::vector<float> rgb(photo.residuals.size(), 0.0F);
    for (std::size_t s = 0; s < photo.used.size(); ++s) {
        if (!photo.used[s]) continue;
        // The largest of the three channels, model above photograph red, below blue.
        double r = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(photo.residuals[3 * s + c]) > std::abs(r)) r = photo.residuals[3 * s + c];
        const auto share = static_cast<float>(std::min(1.0, std::abs(r) / shown_sigmas));
        rgb[3 * s] = r > 0.0 ? 0.8F : 0.8F * (1.0F - share);
        rgb[3 * s + 1] = 0.8F * (1.0F - share);
        rgb[3 * s + 2] = r < 0.0 ? 0.8F : 0.8F * (1.0F - share);
    }
    return img(image_of(photo, rgb), 0.0,
               fmt::format("residuals: white 0, red model too bright, blue too dark, full at {} "
                           "standard deviations",
                           shown_sigmas));
}

double exposure_for(const FittedPhoto& photo) {
    std::vector<double> levels;
    for (std::size_t s = 0; s < photo.used.size(); ++s)
        if (photo.used[s]) levels.push_back(photo.measured[3 * s + 1] / photo.gain[1]);
    if (levels.empty()) return 0.0;
    const auto place =
        levels.begin() + static_cast<std::ptrdiff_t>(levels.size() - 1 - levels.size() / 200);
    std::ranges::nth_element(levels, place);
    return *place > 0.0 ? -std::log2(*place) : 0.0;
}

std::string correlation_table(const FitReport& report) {
    const auto count =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(report.correlation.size())) + 0.5);
    if (count < 2) return {};
    std::string html = "<div class=\"scroll\"><table><tr><th></th>";
    for (std::size_t k = 0; k < count; ++k)
        html += fmt::format("<th>{}</th>", xml_text(name(report.numbers[k].parameter)));
    html += "</tr>\n";
    for (std::size_t i = 0; i < count; ++i) {
        html +=
            fmt::format("<tr><td class=\"t\">{}</td>", xml_text(name(report.numbers[i].parameter)));
        for (std::size_t k = 0; k < count; ++k) {
            const double r = report.correlation[i * count + k];
            const int fade = static_cast<int>(255.0 * (1.0 - std::min(1.0, std::abs(r))));
            html += fmt::format("<td style=\"background:rgb({},{},{})\">{:.2f}</td>",
                                r > 0 ? 255 : fade, fade, r < 0 ? 255 : fade, r);
        }
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string histogram_chart(const FitReport& report) {
    ChartCurve measured{"residuals", chart_color(0), {}, {}};
    ChartCurve normal{"normal distribution", chart_color(1), {}, {}};
    for (std::size_t k = 0; k < report.histogram.size(); ++k) {
        const double low = -5.0 + 0.5 * static_cast<double>(k);
        measured.x.push_back(low + 0.25);
        measured.y.push_back(report.histogram[k]);
        normal.x.push_back(low + 0.25);
        normal.y.push_back(
            0.5 * (std::erf((low + 0.5) / std::sqrt(2.0)) - std::erf(low / std::sqrt(2.0))));
    }
    return chart_svg({.x_title = "residual, standard deviations (ends: all beyond)",
                      .y_title = "share",
                      .curves = {measured, normal},
                      .y_from_zero = true});
}

std::string band_chart(const ReflectanceBand& band) {
    ChartCurve low{"95 % band", chart_color(5), band.wavelengths_nm, {}};
    ChartCurve high{"", chart_color(5), band.wavelengths_nm, {}};
    ChartCurve after{"fitted", chart_color(0), band.wavelengths_nm, {}};
    ChartCurve before{"start", chart_color(1), band.wavelengths_nm, {}};
    for (std::size_t k = 0; k < band.after.size(); ++k) {
        after.y.push_back(100.0 * band.after[k]);
        before.y.push_back(100.0 * band.before[k]);
        low.y.push_back(100.0 * std::max(0.0, band.after[k] - 1.96 * band.error[k]));
        high.y.push_back(100.0 * std::min(1.0, band.after[k] + 1.96 * band.error[k]));
    }
    return chart_svg({.x_title = fmt::format("wavelength, nm (surface {})", band.row + 1),
                      .y_title = "R at normal incidence, %",
                      .curves = {before, low, high, after},
                      .y_from_zero = true});
}

std::string profile_chart(const FitReport& report, const FittedProfile& profile) {
    const FitParameter& parameter = report.numbers[profile.number].parameter;
    ChartCurve found{"all others fitted", chart_color(0), profile.values, profile.chi2};
    ChartCurve expected{"by the standard error", chart_color(1), profile.values, {}};
    for (const double each : profile.values)
        expected.y.push_back(std::pow((each - report.numbers[profile.number].value) /
                                          report.numbers[profile.number].own_error,
                                      2));
    return chart_svg({.x_title = fmt::format("{}, {}", name(parameter), unit(parameter)),
                      .y_title = "χ² above the fit's (95 %: 3.84)",
                      .curves = {found, expected},
                      .y_from_zero = true});
}

}  // namespace

Table fit_table(const FitReport& report) {
    Table table;
    table.columns = {"number", "unit",    "start",       "value",    "standard_error",
                     "low_95", "high_95", "prior_sigma", "knowledge"};
    for (const FittedNumber& each : report.numbers)
        table.rows.push_back({name(each.parameter), unit(each.parameter), each.parameter.start,
                              each.value, each.standard_error, each.low, each.high,
                              each.parameter.prior, name(each.knowledge)});
    return table;
}

Table fit_ghost_table(const FitReport& report) {
    Table table;
    table.columns = {"ghost",       "photo",      "signal_to_noise", "share_before", "share_after",
                     "gain_before", "gain_after", "gain_error",      "merged_with"};
    for (const FittedGhost& each : report.ghosts)
        table.rows.push_back({each.name, static_cast<std::int64_t>(each.photo + 1),
                              each.signal_to_noise, each.share_before, each.share_after,
                              each.gain_before, each.gain_after, each.gain_error,
                              each.merged_with.empty() ? Cell() : Cell(each.merged_with)});
    return table;
}

Table fit_interval_table(const FitReport& report) {
    Table table;
    table.columns = {"number", "by", "value", "scatter", "low_95", "high_95"};
    // What the others are to be compared with: all are about the minimum that was taken.
    std::vector<std::size_t> asked;
    for (const FittedProfile& each : report.profiles) asked.push_back(each.number);
    for (const BootstrappedNumber& each : report.bootstrap) asked.push_back(each.number);
    std::ranges::sort(asked);
    asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
    for (const std::size_t k : asked) {
        const FittedNumber& number = report.numbers[k];
        const double reach = 1.96 * number.own_error;
        table.rows.push_back({name(number.parameter), "covariance, this minimum", number.value,
                              number.own_error, number.value - reach, number.value + reach});
    }
    for (const FittedProfile& each : report.profiles) {
        const FittedNumber& number = report.numbers[each.number];
        table.rows.push_back({name(number.parameter), "profile likelihood", number.value, Cell(),
                              each.low, each.high});
    }
    for (const BootstrappedNumber& each : report.bootstrap)
        table.rows.push_back({name(report.numbers[each.number].parameter), "bootstrap", each.mean,
                              each.scatter, each.low, each.high});
    return table;
}

Table fit_kind_table(const FitReport& report) {
    Table table;
    table.columns = {"surface", "kind", "numbers", "chi2_above", "bic_above", "share"};
    for (const SurfaceKinds& surface : report.kinds)
        for (const KindTried& each : surface.tried)
            table.rows.push_back({static_cast<std::int64_t>(surface.row + 1), each.name,
                                  static_cast<std::int64_t>(each.numbers), each.chi2_above,
                                  each.bic_above, each.share});
    return table;
}

std::string fit_page(const FitReport& report, const std::string& lens, const std::string& command) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Fit of {0}</title>"
        "<style>{1}figure{{display:inline-block;margin:0 14px 10px 0;vertical-align:top;max-width:"
        "384px}}figcaption{{color:#555;font-size:12.5px}}.verdict{{border-left:4px solid {2};"
        "padding:4px 14px;background:#f6f6f6}}</style></head><body>\n<h1>Fit of {0}</h1>\n"
        "<p class=\"verdict\">{3}</p>\n",
        xml_text(lens), html_style, report.usable ? "#009e73" : "#d55e00",
        xml_text(report.verdict));
    for (const std::string& remark : report.remarks)
        html += fmt::format("<p>{}</p>\n", xml_text(remark));
    html += "<h2>Numbers</h2>\n" +
            html_table(fit_table(report), {{"number", "number"},
                                           {"unit", "unit"},
                                           {"start", "start"},
                                           {"value", "fitted"},
                                           {"standard_error", "standard<br>error"},
                                           {"low_95", "95 % from"},
                                           {"high_95", "to"},
                                           {"prior_sigma", "prior<br>σ"},
                                           {"knowledge", "from these photographs"}});
    html += fmt::format(
        "<p class=\"lead\">{} of {} directions are determined. Errors allow for the noise that "
        "neighbouring samples share{}.</p>\n",
        report.rank, report.rank + report.unknown.size(),
        report.error_scale > 1.0
            ? fmt::format(" and are widened by {:.2f} for the misfit", report.error_scale)
            : "");
    if (!report.profiles.empty() || !report.bootstrap.empty())
        html += "<h2>Other intervals</h2>\n" +
                html_table(fit_interval_table(report), {{"number", "number"},
                                                        {"by", "by"},
                                                        {"value", "value,<br>mean"},
                                                        {"scatter", "scatter"},
                                                        {"low_95", "95 % from"},
                                                        {"high_95", "to"}});
    for (const FittedProfile& each : report.profiles) html += profile_chart(report, each);
    if (!report.kinds.empty())
        html += "<h2>Kinds of coating</h2>\n" +
                html_table(fit_kind_table(report), {{"surface", "surface"},
                                                    {"kind", "kind"},
                                                    {"numbers", "fitted<br>numbers"},
                                                    {"chi2_above", "χ² above<br>the lowest"},
                                                    {"bic_above", "BIC above<br>the best"},
                                                    {"share", "odds<br>%", 100.0}});
    if (!report.suggestions.empty()) {
        const Suggestion& best = report.suggestions.front();
        html += fmt::format(
            "<p>The next photograph that would help most: light at a field angle of {:.2g}°. The "
            "standard error of {} would go from {:.3g} to {:.3g} {}.</p>\n",
            best.light.field_deg, xml_text(name(report.numbers[best.number].parameter)),
            best.error_now, best.error_then, unit(report.numbers[best.number].parameter));
    }
    for (const FittedPhoto& photo : report.photos) {
        const double ev = exposure_for(photo);
        html +=
            fmt::format("<h2>{}</h2>\n", xml_text(photo.file.empty() ? "photograph" : photo.file));
        html += picture(photo, photo.measured, ev, "photograph, on the fit's scale") +
                picture(photo, photo.before, ev, "model at the start") +
                picture(photo, photo.after, ev, "model after the fit") + residual_picture(photo);
        html += fmt::format(
            "<p class=\"lead\">{} samples of sensor width / {}; chi-squared per value {:.3g}. "
            "Light at "
            "a field of {:.4g}° (given {:.4g}°), azimuth {:.4g}°; gains {:.4g}, {:.4g}, {:.4g} (± "
            "{:.2g} %); shading {:.2g} in the corners; picture shifted by {:.3g}, {:.3g} mm and "
            "turned by {:.3g}°.</p>\n",
            photo.samples, photo.frame.width_px,
            photo.chi2 / (3.0 * static_cast<double>(std::max<std::size_t>(1, photo.samples))),
            photo.field_deg, photo.light.field_deg, photo.light.azimuth_deg, photo.gain[0],
            photo.gain[1], photo.gain[2], 100.0 * photo.gain_error[1], photo.shading,
            photo.shift_x_mm, photo.shift_y_mm, photo.rotation_deg);
    }
    html += "<h2>Residuals</h2>\n" + histogram_chart(report);
    if (!report.bands.empty()) {
        html += "<h2>Reflectances</h2>\n";
        for (const ReflectanceBand& band : report.bands) html += band_chart(band);
    }
    html += "<h2>Ghosts</h2>\n" +
            html_table(fit_ghost_table(report), {{"ghost", "ghost"},
                                                 {"photo", "photo"},
                                                 {"signal_to_noise", "signal /<br>noise"},
                                                 {"share_before", "share before<br>%", 100.0},
                                                 {"share_after", "share after<br>%", 100.0},
                                                 {"gain_before", "photograph /<br>start"},
                                                 {"gain_after", "photograph /<br>fitted"},
                                                 {"gain_error", "±"},
                                                 {"merged_with", "not told<br>from"}});
    html += fmt::format(
        "<p class=\"lead\">Each ghost's light in the photograph over the model's, all of them "
        "unmixed together, none negative. {} weaker ghosts were left out; at the start all of them "
        "together had {:.2g} standard deviations of signal.</p>\n",
        report.ghosts_left_out, report.left_out_signal_to_noise);
    html += "<h2>Correlations</h2>\n" + correlation_table(report);
    html += fmt::format(
        "<h2>Settings</h2>\n<pre>{}\n\nloss {}, from {:.3g} standard deviations of a sample\n{} "
        "iterations, {} rays, {:.3g} s; cost {:.6g} at the start, "
        "{:.6g} after\nprogram: ghostlight-cli " GHOSTLIGHT_VERSION "</pre>\n",
        xml_text(command), name(report.loss), report.loss_scale, report.iterations, report.rays,
        report.seconds, report.cost_before, report.cost_after);
    return html + "</body></html>\n";
}

}  // namespace ghostlight
