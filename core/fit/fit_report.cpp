#include "core/fit/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fit/fit_statistics.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double sigmas_of_95_percent = 1.96;
/// Another minimum with this share of the probability is inside of a 95 % interval; with this one
/// it is named.
constexpr double interval_share = 0.025, told_share = 0.01;
/// χ² a residual above which the model does not fit within its errors, and above which it does not
/// explain the photograph at all.
constexpr double well = 1.5, poor = 6.0;
/// Less of the light explained than this is no explanation, whatever χ² says of a noisy picture.
constexpr double explained_least = 0.8;

std::string list(const std::vector<std::string>& names, std::size_t most = 6) {
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < most; ++i)
        text += fmt::format("{}{}", i == 0 ? "" : ", ", names[i]);
    if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
    return text;
}

}  // namespace

std::string name(FitLoss loss) {
    switch (loss) {
        case FitLoss::none:
            return "none";
        case FitLoss::huber:
            return "huber";
        case FitLoss::cauchy:
            return "cauchy";
        case FitLoss::tukey:
            return "tukey";
    }
    return {};
}

std::string name(FitKnowledge knowledge) {
    switch (knowledge) {
        case FitKnowledge::determined:
            return "determined";
        case FitKnowledge::weak:
            return "weakly determined";
        case FitKnowledge::prior:
            return "not determined";
        case FitKnowledge::not_felt:
            return "not felt, held";
        case FitKnowledge::at_bound:
            return "at its bound";
    }
    return {};
}

double focal_length_mm(const OpticalSystem& system) { return first_order(system).efl_mm; }

void fill_misfit(const FitOutcome& outcome, FitReport& report) {
    constexpr int bins = 20;
    report.histogram.assign(bins, 0.0);
    std::size_t samples = 0, outside = 0;
    double core = 0.0;
    std::size_t core_count = 0;
    for (std::size_t i = 0; i < outcome.evaluator.views().size(); ++i) {
        const FitData& data = outcome.evaluator.views()[i].data;
        for (std::size_t s = 0; s < data.samples(); ++s) {
            if (!data.used[s]) continue;
            double squares = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double r = outcome.evaluator.residuals(i)[3 * s + c];
                squares += r * r;
                const int bin =
                    std::clamp(static_cast<int>(std::floor(2.0 * (r + 5.0))), 0, bins - 1);
                report.histogram[static_cast<std::size_t>(bin)] += 1.0;
            }
            report.chi2 += squares;
            report.residuals += 3;
            ++samples;
            if (squares > outcome.loss_scale * outcome.loss_scale) {
                ++outside;
            } else {
                core += squares;
                core_count += 3;
            }
        }
    }
    for (double& each : report.histogram) each /= static_cast<double>(report.residuals);
    report.outliers =
        static_cast<double>(outside) / static_cast<double>(std::max<std::size_t>(1, samples));
    // What the loss takes for data must scatter as the errors say; otherwise all errors are wider.
    const double scatter = core_count > 0 ? core / static_cast<double>(core_count) : 1.0;
    const double all = report.chi2 / static_cast<double>(report.residuals);
    report.error_scale = std::sqrt(std::max(1.0, report.outliers > 0.3 ? all : scatter));
}

namespace {

/// The minima that the photographs do not exclude, with their shares, and what to say of them.
void fill_other_minima(const FitOutcome& outcome, FitReport& report) {
    double all = 1.0;
    for (const FitMinimum& each : outcome.other_minima) {
        const double chi2 = std::max(0.0, each.cost) / (report.error_scale * report.error_scale);
        report.other_minima.push_back({.chi2_above = chi2, .share = std::exp(-0.5 * chi2)});
        all += report.other_minima.back().share;
    }
    for (std::size_t k = 0; k < report.other_minima.size(); ++k) {
        report.other_minima[k].share /= all;
        if (report.other_minima[k].share < told_share) continue;
        std::string text;
        for (std::size_t p = 0; p < outcome.layout.coatings.size(); ++p) {
            const FitParameter& each = outcome.layout.coatings[p];
            const double here = outcome.evaluator.x[p], there = outcome.other_minima[k].x[p];
            // What moves by less than its own error tells nothing of the other place.
            const auto at = static_cast<Eigen::Index>(p);
            if (std::abs(there - here) <
                2.0 * report.error_scale * std::sqrt(outcome.covariance(at, at)))
                continue;
            text += fmt::format("{}{} {:.4g} instead of {:.4g} {}", text.empty() ? "" : ", ",
                                name(each), each.start + each.prior * there,
                                each.start + each.prior * here, unit(each));
        }
        if (!text.empty())
            report.remarks.push_back(fmt::format(
                "Ambiguous: {} explains the photographs nearly as well (chi-squared higher by "
                "{:.2g}, {:.2g} % of the odds); the errors allow for it. Another light angle tells "
                "them apart.",
                text, report.other_minima[k].chi2_above, 100.0 * report.other_minima[k].share));
    }
}

}  // namespace

void fill_numbers(const FitOutcome& outcome, FitReport& report) {
    fill_misfit(outcome, report);
    const FitLayout& layout = outcome.layout;
    const std::size_t count = layout.lens_count();
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd known = outcome.covariance.topLeftCorner(n, n);
    const Eigen::VectorXd narrow = known.diagonal().cwiseSqrt();
    fill_other_minima(outcome, report);
    for (std::size_t k = 0; k < report.other_minima.size(); ++k) {
        Eigen::VectorXd away(n);
        for (Eigen::Index p = 0; p < n; ++p)
            away(p) = outcome.other_minima[k].x[static_cast<std::size_t>(p)] -
                      outcome.evaluator.x[static_cast<std::size_t>(p)];
        // Errors are scaled by the misfit below; these distances are not.
        known += report.other_minima[k].share / (report.error_scale * report.error_scale) * away *
                 away.transpose();
    }
    for (std::size_t p = 0; p < count; ++p) {
        const bool coating = p < layout.coatings.size();
        FittedNumber number;
        number.parameter =
            coating ? layout.coatings[p] : layout.geometry[p - layout.coatings.size()];
        const FitParameter& parameter = number.parameter;
        const auto at = static_cast<Eigen::Index>(p);
        const double x = outcome.evaluator.x[p];
        number.value = parameter.start + parameter.prior * x;
        // The prior's own width is the most that is unknown.
        const double share =
            std::min(1.0, report.error_scale * std::sqrt(std::max(0.0, known(at, at))));
        number.standard_error = share * parameter.prior;
        number.own_error = std::min(1.0, report.error_scale * narrow(at)) * parameter.prior;
        number.low =
            std::max(parameter.lower, number.value - sigmas_of_95_percent * number.standard_error);
        number.high =
            std::min(parameter.upper, number.value + sigmas_of_95_percent * number.standard_error);
        for (std::size_t k = 0; k < report.other_minima.size(); ++k) {
            const double there = parameter.start + parameter.prior * outcome.other_minima[k].x[p];
            number.other_values.push_back(there);
            if (report.other_minima[k].share < interval_share) continue;
            const double reach =
                sigmas_of_95_percent * report.error_scale * narrow(at) * parameter.prior;
            number.low = std::max(parameter.lower, std::min(number.low, there - reach));
            number.high = std::min(parameter.upper, std::max(number.high, there + reach));
        }
        number.start_error =
            at < outcome.start_errors.size() ? outcome.start_errors(at) * parameter.prior : 0.0;
        const double margin = 1e-3 * (parameter.upper - parameter.lower);
        if (number.value <= parameter.lower + margin || number.value >= parameter.upper - margin)
            number.knowledge = FitKnowledge::at_bound;
        else if (share < 0.5)
            number.knowledge = FitKnowledge::determined;
        else if (share < 0.9)
            number.knowledge = FitKnowledge::weak;
        report.numbers.push_back(number);
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < n; ++k) {
            report.covariance.push_back(
                known(i, k) * report.numbers[static_cast<std::size_t>(i)].parameter.prior *
                report.numbers[static_cast<std::size_t>(k)].parameter.prior * report.error_scale *
                report.error_scale);
            report.correlation.push_back(known(i, k) /
                                         std::sqrt(std::max(1e-300, known(i, i) * known(k, k))));
        }
    const Directions found = directions(known, count);
    for (Eigen::Index k = 0; k < n; ++k) {
        const double narrowed = std::min(1.0, report.error_scale * found.narrowed(k));
        if (narrowed < 0.5) {
            ++report.rank;
            continue;
        }
        UnknownDirection direction{.narrowed = narrowed, .parts = {}};
        for (Eigen::Index p = 0; p < n; ++p)
            if (std::abs(found.vectors(p, k)) > 0.25)
                direction.parts.emplace_back(static_cast<std::size_t>(p), found.vectors(p, k));
        std::ranges::sort(direction.parts, [](const auto& a, const auto& b) {
            return std::abs(a.second) > std::abs(b.second);
        });
        report.unknown.push_back(direction);
    }
    for (const FitParameter& parameter : outcome.not_felt)
        report.numbers.push_back(
            {.parameter = parameter,
             .value = parameter.start,
             .standard_error = parameter.prior,
             .own_error = parameter.prior,
             .low = std::max(parameter.lower, parameter.start - 1.96 * parameter.prior),
             .high = std::min(parameter.upper, parameter.start + 1.96 * parameter.prior),
             .start_error = parameter.prior,
             .knowledge = FitKnowledge::not_felt});
}

void fill_photo(const FitOutcome& outcome, std::size_t i, FitReport& report) {
    const FitLayout& layout = outcome.layout;
    const FitEvaluator& evaluator = outcome.evaluator;
    const FitView& view = outcome.evaluator.views()[i];
    FittedPhoto photo;
    photo.frame = view.data.frame;
    photo.used = view.data.used;
    photo.measured = view.data.value;
    photo.after = evaluator.model(i);
    photo.residuals = evaluator.residuals(i);
    photo.samples = view.data.count;
    for (std::size_t s = 0; s < view.data.samples(); ++s)
        for (std::size_t c = 0; c < 3 && view.data.used[s]; ++c)
            photo.chi2 += std::pow(photo.residuals[3 * s + c], 2);
    for (std::size_t c = 0; c < 3; ++c) {
        photo.gain[c] = evaluator.gain(i, c);
        const auto exposure = static_cast<Eigen::Index>(layout.first_of(i) + 1),
                   own = static_cast<Eigen::Index>(layout.first_of(i) + c);
        const double by = c == 1 ? 0.0 : balance_prior;
        const double variance = gain_prior * gain_prior * outcome.covariance(exposure, exposure) +
                                2.0 * gain_prior * by * outcome.covariance(exposure, own) +
                                by * by * outcome.covariance(own, own);
        photo.gain_error[c] = report.error_scale * std::sqrt(std::max(0.0, variance));
    }
    if (layout.shading) photo.shading = shading_prior * evaluator.x[layout.shading_of(i)];
    if (layout.place) {
        const std::size_t at = layout.place_of(i);
        photo.shift_x_mm = shift_prior_mm * evaluator.x[at];
        photo.shift_y_mm = shift_prior_mm * evaluator.x[at + 1];
        photo.rotation_deg = deg_from_rad(rotation_prior_rad * evaluator.x[at + 2]);
    }
    report.photos.push_back(std::move(photo));
}

void fill_bands(const FitOutcome& outcome, const Prescription& before, const Prescription& listed,
                const Prescription& after, FitReport& report) {
    const FitLayout& layout = outcome.layout;
    const std::size_t count = layout.lens_count();
    std::vector<std::size_t> rows;
    for (const FitParameter& each : layout.coatings)
        for (const std::size_t row : each.rows)
            if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
    std::ranges::sort(rows);
    for (const std::size_t row : rows) {
        ReflectanceBand band;
        band.row = row;
        auto reflectance = [&](const Prescription& lens, const Coating& coating, double nm) {
            return reflectances(film_at(coating, medium_before(lens, row),
                                        lens.surfaces[row].medium_after, nm),
                                1.0)
                .r();
        };
        for (double nm = 400.0; nm <= 700.0; nm += 10.0) {
            band.wavelengths_nm.push_back(nm);
            band.before.push_back(reflectance(before, before.surfaces[row].coating, nm));
            band.after.push_back(reflectance(after, after.surfaces[row].coating, nm));
            std::vector<double> slopes(count, 0.0);
            for (std::size_t p = 0; p < layout.coatings.size(); ++p) {
                const FitParameter& each = layout.coatings[p];
                if (std::ranges::find(each.rows, row) == each.rows.end()) continue;
                // Over a third of the error, within bounds: what the band is to show.
                const double step =
                    std::max(1e-6 * each.prior, 0.3 * report.numbers[p].standard_error);
                const double value = report.numbers[p].value;
                auto at = [&](double moved) {
                    Coating coating = listed.surfaces[row].coating;
                    for (std::size_t k = 0; k < layout.coatings.size(); ++k)
                        if (std::ranges::find(layout.coatings[k].rows, row) !=
                            layout.coatings[k].rows.end())
                            set_coating(coating, layout.coatings[k],
                                        k == p ? moved : report.numbers[k].value);
                    return reflectance(after, coating, nm);
                };
                const double low = std::max(each.lower, value - step),
                             high = std::min(each.upper, value + step);
                slopes[p] = (at(high) - at(low)) / (high - low);
            }
            double variance = 0.0;
            for (std::size_t p = 0; p < count; ++p)
                for (std::size_t k = 0; k < count; ++k)
                    variance += slopes[p] * slopes[k] * report.covariance[p * count + k];
            band.error.push_back(std::sqrt(std::max(0.0, variance)));
        }
        report.bands.push_back(std::move(band));
    }
}

void judge(const FitOutcome& outcome, FitReport& report) {
    const double reduced = report.chi2 / static_cast<double>(report.residuals);
    std::vector<std::string> unknown, bounded, unfelt, weak;
    std::size_t determined = 0;
    for (const FittedNumber& number : report.numbers) switch (number.knowledge) {
            case FitKnowledge::determined:
                ++determined;
                break;
            case FitKnowledge::weak:
                weak.push_back(name(number.parameter));
                break;
            case FitKnowledge::prior:
                unknown.push_back(name(number.parameter));
                break;
            case FitKnowledge::not_felt:
                unfelt.push_back(name(number.parameter));
                break;
            case FitKnowledge::at_bound:
                bounded.push_back(name(number.parameter));
                break;
        }
    report.usable =
        report.explained_after >= explained_least && report.outliers < 0.4 && reduced < poor * poor;
    if (!report.usable) {
        report.verdict = fmt::format(
            "This prescription does not explain the photograph: {:.0f} % of the samples are "
            "further off than {:.3g} standard deviations after the fit (chi-squared per value "
            "{:.3g}). The numbers below are the best of a wrong model: do not use them. Check "
            "lens, "
            "focal length, light position, sensor size and orientation.",
            100.0 * report.outliers, outcome.loss_scale, reduced);
        return;
    } else if (reduced > well) {
        report.verdict = fmt::format(
            "The lens explains {:.1f} % of the flare, but not within the noise: chi-squared per "
            "value "
            "is {:.3g}, and {:.1f} % of the samples lie beyond {:.3g} standard deviations. "
            "Something "
            "is missing from the model (geometry that is off, light from elsewhere, a tone curve); "
            "all errors are widened by {:.2f}, which may not cover a systematic error.",
            100.0 * report.explained_after, reduced, 100.0 * report.outliers, outcome.loss_scale,
            report.error_scale);
    } else {
        report.verdict = fmt::format(
            "The lens explains the photograph within its noise: chi-squared per value {:.3g}, "
            "{:.1f} "
            "% of the samples beyond {:.3g} standard deviations.",
            reduced, 100.0 * report.outliers, outcome.loss_scale);
    }
    report.verdict +=
        fmt::format(" {} of {} numbers are determined", determined, report.numbers.size());
    if (!weak.empty()) report.verdict += fmt::format("; weakly: {}", list(weak));
    if (!unknown.empty())
        report.verdict += fmt::format("; not determined, held by their priors: {}", list(unknown));
    if (!unfelt.empty())
        report.verdict += fmt::format("; felt by no visible ghost: {}", list(unfelt));
    if (!bounded.empty()) report.verdict += fmt::format("; at a bound: {}", list(bounded));
    report.verdict += ".";
    for (const UnknownDirection& each : report.unknown) {
        if (each.parts.size() < 2) continue;
        std::string text;
        for (const auto& [number, share] : each.parts)
            text += fmt::format("{}{:.2f} ({})",
                                text.empty() ? ""
                                : share < 0  ? " - "
                                             : " + ",
                                std::abs(share), name(report.numbers[number].parameter));
        report.remarks.push_back(fmt::format(
            "Not determined together (in units of their priors, {:.0f} % of the prior left): {}",
            100.0 * each.narrowed, text));
    }
}

}  // namespace ghostlight
