#include "widgets/panels/fit_results.h"

#include <QComboBox>
#include <QTextBrowser>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panels/correlation_view.h"
#include "widgets/panels/fit_profile_page.h"
#include "widgets/panels/line_plot.h"

namespace ghostlight {

namespace {

/// Parts of a combination smaller than this are left out of its words.
constexpr double least_share = 0.2;

QString escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

QString named(const FitReport& report, std::size_t number) {
    return escaped(name(report.numbers[number].parameter));
}

/// "λ0 of 3 + 0.4 · λ0 of 5".
QString combination(const FitReport& report, const UnknownDirection& unknown) {
    QString text;
    for (const auto& [number, share] : unknown.parts) {
        if (std::abs(share) < least_share || number >= report.numbers.size()) {
            continue;
        }
        text += text.isEmpty() ? (share < 0.0 ? QStringLiteral("−") : QString())
                               : (share < 0.0 ? QStringLiteral(" − ") : QStringLiteral(" + "));
        text +=
            QStringLiteral("%1 · %2").arg(significant(std::abs(share), 2), named(report, number));
    }
    return text;
}

QString list_of(const FitReport& report, FitKnowledge knowledge) {
    QStringList names;
    for (const FittedNumber& each : report.numbers) {
        if (each.knowledge == knowledge) {
            names << escaped(name(each.parameter));
        }
    }
    return names.join(QStringLiteral(", "));
}

QString html_of(const FitReport& report) {
    const Palette& colors = current_palette();
    QString html = QStringLiteral("<p style=\"color:%1\"><b>%2</b></p>")
                       .arg(report.usable ? colors.text.name() : colors.red_orange.name(),
                            escaped(report.verdict));
    const auto say = [&](const QString& title, const QString& text) {
        if (!text.isEmpty()) {
            html += QStringLiteral("<p><span style=\"color:%1\">%2</span> %3</p>")
                        .arg(colors.dim.name(), title, text);
        }
    };
    for (const std::string& remark : report.remarks) {
        html += QStringLiteral("<p>%1</p>").arg(escaped(remark));
    }
    say(FitResults::tr("Determined:"), list_of(report, FitKnowledge::determined));
    say(FitResults::tr("Weakly known:"), list_of(report, FitKnowledge::weak));
    say(FitResults::tr("Known by their priors alone:"), list_of(report, FitKnowledge::prior));
    say(FitResults::tr("Held, as no visible ghost feels them:"),
        list_of(report, FitKnowledge::not_felt));
    say(FitResults::tr("At a bound:"), list_of(report, FitKnowledge::at_bound));
    for (const SurfaceKinds& surface : report.kinds) {
        QStringList tried;
        for (const KindTried& each : surface.tried) {
            tried << FitResults::tr("%1 (%2 %)")
                         .arg(escaped(each.name), significant(100.0 * each.share, 2));
        }
        say(FitResults::tr("Kinds of coating on surface %1, by their odds:").arg(surface.row + 1),
            tried.join(QStringLiteral(", ")));
    }
    if (!report.unknown.empty()) {
        html += FitResults::tr(
                    "<p><span style=\"color:%1\">Combinations that the photographs do "
                    "not determine, and their width over the prior's:</span></p><ul>")
                    .arg(colors.dim.name());
        for (const UnknownDirection& each : report.unknown) {
            const QString text = combination(report, each);
            if (!text.isEmpty()) {
                html += QStringLiteral("<li>%1 (%2)</li>").arg(text, significant(each.narrowed, 2));
            }
        }
        html += "</ul>";
    }
    say("χ²",
        FitResults::tr("%1 for %2 residuals; %3 % of the photograph explained (%4 % at the "
                       "start), %5 % outliers, errors widened × %6")
            .arg(significant(report.chi2), grouped(report.residuals),
                 significant(100.0 * report.explained_after, 3),
                 significant(100.0 * report.explained_before, 3),
                 significant(100.0 * report.outliers, 2), significant(report.error_scale, 3)));
    if (!report.suggestions.empty()) {
        const Suggestion& best = report.suggestions.front();
        say(FitResults::tr("The photograph that would help most:"),
            FitResults::tr("light at %1°: %2 from ± %3 to ± %4 %5")
                .arg(significant(best.light.field_deg, 3), named(report, best.number),
                     significant(best.error_now, 2), significant(best.error_then, 2),
                     escaped(unit(report.numbers[best.number].parameter))));
    }
    say(FitResults::tr("Time"), FitResults::tr("%1 s, %2 iterations")
                                    .arg(significant(report.seconds, 3))
                                    .arg(report.iterations));
    return html;
}

}  // namespace

FitResults::FitResults(QWidget* parent)
    : QTabWidget(parent),
      costs_(new LinePlot),
      words_(new QTextBrowser),
      correlations_(new CorrelationView),
      surfaces_(new QComboBox),
      band_(new LinePlot),
      profiles_(new FitProfilePage) {
    setObjectName("fit_results");
    setDocumentMode(true);
    costs_->set_axes(tr("iteration"), tr("cost"), true);
    words_->setFrameShape(QFrame::NoFrame);
    words_->setPlaceholderText(tr("The verdict, and what is not determined; after a fit."));
    band_->set_axes(tr("wavelength, nm"), tr("R, %"), false);
    surfaces_->setObjectName("fit_surface");
    auto* reflectances = new QWidget;
    auto* column = new QVBoxLayout(reflectances);
    column->setContentsMargins(0, 4, 0, 0);
    column->setSpacing(0);
    column->addWidget(surfaces_, 0, Qt::AlignLeft);
    column->addWidget(band_, 1);
    addTab(costs_, tr("Cost"));
    addTab(words_, tr("Verdict"));
    addTab(reflectances, tr("Reflectances"));
    addTab(correlations_, tr("Correlations"));
    addTab(profiles_, tr("Profiles"));
    setTabToolTip(indexOf(profiles_), tr("Intervals by profile likelihood and bootstrap"));
    connect(surfaces_, &QComboBox::currentIndexChanged, this, &FitResults::show_band);
    clear();
}

void FitResults::clear() {
    costs_->set_curves({});
    words_->clear();
    correlations_->set_correlations({}, {});
    profiles_->clear();
    bands_.clear();
    surfaces_->clear();
    surfaces_->hide();
    band_->set_curves({});
}

void FitResults::show_costs(const std::vector<double>& costs) {
    const Palette& colors = current_palette();
    QPolygonF each, best;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < costs.size(); ++k) {
        lowest = std::min(lowest, costs[k]);
        each << QPointF(static_cast<double>(k + 1), costs[k]);
        best << QPointF(static_cast<double>(k + 1), lowest);
    }
    costs_->set_curves({{tr("each"), colors.dim, each, {}, false},
                        {tr("best so far"), colors.teal, best, {}, false}});
}

void FitResults::show_report(const FitReport& report) {
    show_costs(report.cost_curve);
    words_->setHtml(html_of(report));
    std::vector<QString> names;
    for (const FittedNumber& each : report.numbers) {
        if (each.knowledge != FitKnowledge::not_felt) {
            names.push_back(QString::fromStdString(name(each.parameter)));
        }
    }
    correlations_->set_correlations(std::move(names), report.correlation);
    profiles_->show_report(report);
    bands_ = report.bands;
    surfaces_->clear();
    for (const ReflectanceBand& band : bands_) {
        surfaces_->addItem(tr("Surface %1").arg(band.row + 1));
    }
    surfaces_->setVisible(bands_.size() > 1);
    setCurrentWidget(words_);
}

void FitResults::show_band(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= bands_.size()) {
        return;
    }
    constexpr double percent = 100.0, interval = 1.96;
    const ReflectanceBand& band = bands_[static_cast<std::size_t>(index)];
    const Palette& colors = current_palette();
    QPolygonF before, after, area, under;
    for (std::size_t k = 0; k < band.wavelengths_nm.size(); ++k) {
        const double nm = band.wavelengths_nm[k];
        before << QPointF(nm, percent * band.before[k]);
        after << QPointF(nm, percent * band.after[k]);
        area << QPointF(nm, percent * (band.after[k] + interval * band.error[k]));
        under.prepend(
            QPointF(nm, percent * std::max(0.0, band.after[k] - interval * band.error[k])));
    }
    area << under;
    band_->set_title(tr("Surface %1, normal incidence").arg(band.row + 1));
    band_->set_curves({{tr("start"), colors.dim, before, {}, true},
                       {tr("fitted, 95 %"), colors.amber, after, area, false}});
}

QString FitResults::words() const { return words_->toPlainText(); }

}  // namespace ghostlight
