#include "widgets/panels/fit_profile_page.h"

#include <QComboBox>
#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>

#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panels/line_plot.h"

namespace ghostlight {

namespace {

/// χ² of one number beyond which 5 % of the cases lie.
constexpr double limit_95 = 3.84;

template <class Of>
const Of* of_number(const std::vector<Of>& all, std::size_t number) {
    const auto at = std::ranges::find(all, number, &Of::number);
    return at == all.end() ? nullptr : &*at;
}

}  // namespace

FitProfilePage::FitProfilePage(QWidget* parent)
    : QWidget(parent), numbers_(new QComboBox), plot_(new LinePlot), words_(new QLabel) {
    numbers_->setObjectName("fit_profiled");
    words_->setWordWrap(true);
    words_->setContentsMargins(8, 4, 8, 4);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 4, 0, 0);
    column->setSpacing(0);
    column->addWidget(numbers_, 0, Qt::AlignLeft);
    column->addWidget(plot_, 1);
    column->addWidget(words_);
    connect(numbers_, &QComboBox::currentIndexChanged, this, &FitProfilePage::show_number);
    clear();
}

void FitProfilePage::clear() {
    report_.reset();
    numbers_->clear();
    numbers_->hide();
    plot_->set_curves({});
    words_->setText(
        tr("Choose numbers and press Profile, or ask for a bootstrap, before the fit starts."));
}

void FitProfilePage::show_report(const FitReport& report) {
    clear();
    report_ = report;
    for (std::size_t k = 0; k < report.numbers.size(); ++k) {
        if (of_number(report.profiles, k) != nullptr || of_number(report.bootstrap, k) != nullptr) {
            numbers_->addItem(QString::fromStdString(name(report.numbers[k].parameter)),
                              static_cast<int>(k));
        }
    }
    numbers_->setVisible(numbers_->count() > 0);
}

void FitProfilePage::show_number(int index) {
    if (index < 0 || !report_) {
        return;
    }
    const Palette& colors = current_palette();
    const auto at = static_cast<std::size_t>(numbers_->itemData(index).toInt());
    const FittedNumber& number = report_->numbers[at];
    const QString unit_text = QString::fromStdString(unit(number.parameter));
    const auto from_to = [&](double low, double high) {
        return tr("%1 to %2 %3").arg(significant(low, 4), significant(high, 4), unit_text);
    };
    QStringList sentences{tr("By its standard error: %1.").arg(from_to(number.low, number.high))};
    plot_->set_curves({});
    if (const FittedProfile* profile = of_number(report_->profiles, at);
        profile != nullptr && !profile->values.empty()) {
        QPolygonF found, expected, limit;
        for (std::size_t k = 0; k < profile->values.size(); ++k) {
            const double value = profile->values[k];
            const double off = (value - number.value) / std::max(number.standard_error, 1e-30);
            found << QPointF(value, profile->chi2[k]);
            expected << QPointF(value, off * off);
        }
        limit << QPointF(profile->values.front(), limit_95)
              << QPointF(profile->values.back(), limit_95);
        plot_->set_axes(unit_text.isEmpty() ? tr("value") : tr("value, %1").arg(unit_text),
                        tr("χ² above the fit's"), false);
        plot_->set_curves({{tr("by its standard error"), colors.dim, expected, {}, true},
                           {tr("95 %"), colors.red_orange, limit, {}, true},
                           {tr("profile"), colors.amber, found, {}, false}});
        sentences << tr("By its profile: %1.").arg(from_to(profile->low, profile->high));
    }
    if (const BootstrappedNumber* drawn = of_number(report_->bootstrap, at)) {
        sentences << tr("By the bootstrap: %1, mean %2 ± %3.")
                         .arg(from_to(drawn->low, drawn->high), significant(drawn->mean, 4),
                              significant(drawn->scatter, 2));
    }
    words_->setText(tr("95 % interval. %1").arg(sentences.join(' ')));
}

QString FitProfilePage::words() const { return words_->text(); }

}  // namespace ghostlight
