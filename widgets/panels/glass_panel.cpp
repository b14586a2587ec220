#include "widgets/panels/glass_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSplitter>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "widgets/document.h"
#include "widgets/glass_map_view.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

/// More than anybody reads; the map shows them all.
constexpr std::size_t most_listed = 300;

QString fixed(std::optional<double> value, int decimals) {
    return value ? QString::number(*value, 'f', decimals).replace('-', QChar(0x2212))
                 : QStringLiteral("–");
}

}  // namespace

GlassPanel::GlassPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      header_(new PanelHeader(tr("Glasses"))),
      search_(new QLineEdit),
      map_(new GlassMapView),
      model_(new QStandardItemModel(0, 6, this)),
      table_(plain_table(model_, new TableDelegate(-1, -1, this))),
      surface_(new QLabel),
      use_(quiet_button(tr("Use"), tr("Put the chosen glass behind the surface in hand"), false)),
      nearest_(
          quiet_button(tr("Replace by Nearest"),
                       tr("Put the catalogues' nearest glass, by nd and Vd, behind the surface "
                          "in hand"),
                       false)) {
    setObjectName("glass_panel");
    search_->setPlaceholderText(tr("Name, code 517642, or nd / Vd"));
    search_->setClearButtonEnabled(true);
    search_->setAccessibleName(tr("Search glasses"));
    search_->setToolTip(tr(
        "Part of a name (bk7), a six-digit code (517642), or a place (1.62 / 36.4), whose nearest\n"
        "glasses come first"));
    model_->setHorizontalHeaderLabels({tr("Glass"), "nd", "Vd", "PgF", "ΔPgF", tr("Catalogue")});
    model_->horizontalHeaderItem(1)->setToolTip(tr("Index at the d line, 587.56 nm"));
    model_->horizontalHeaderItem(2)->setToolTip(tr("Abbe number (nd − 1)/(nF − nC)"));
    model_->horizontalHeaderItem(3)->setToolTip(tr("Partial dispersion (ng − nF)/(nF − nC)"));
    model_->horizontalHeaderItem(4)->setToolTip(
        tr("PgF off the normal line 0.6438 − 0.001682 Vd: what apochromats are made with"));
    for (int column = 1; column < 5; ++column) {
        model_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    table_->setObjectName("glass_table");
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    surface_->setForegroundRole(QPalette::PlaceholderText);

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    auto* first = new QHBoxLayout;
    first->setContentsMargins(12, 8, 12, 6);
    first->addWidget(search_, 1);
    column->addLayout(first);
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(map_);
    split->addWidget(table_);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    column->addWidget(split, 1);
    auto* last = new QHBoxLayout;
    last->setContentsMargins(12, 4, 8, 6);
    last->addWidget(surface_, 1);
    last->addWidget(use_);
    last->addWidget(nearest_);
    column->addLayout(last);

    connect(search_, &QLineEdit::textEdited, this, &GlassPanel::find);
    connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
        if (text.isEmpty()) {
            find();  // by its clear button
        }
    });
    connect(search_, &QLineEdit::returnPressed, this, [this] {
        if (!found_.empty()) {
            choose(found_.front());
        }
    });
    connect(map_, &GlassMapView::glass_chosen, this, [this](std::size_t at) { choose(at); });
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& now) {
                if (!is_filling_ && now.isValid()) {
                    choose(found_[static_cast<std::size_t>(now.row())]);
                }
            });
    connect(table_, &QTableView::doubleClicked, this,
            [this](const QModelIndex& at) { put(found_[static_cast<std::size_t>(at.row())]); });
    connect(use_, &QToolButton::clicked, this, [this] {
        if (chosen_) {
            put(*chosen_);
        }
    });
    connect(nearest_, &QToolButton::clicked, this, &GlassPanel::put_nearest);
    update_.setSingleShot(true);
    update_.setInterval(0);
    connect(&update_, &QTimer::timeout, this, &GlassPanel::follow_document);
    connect(&document_, &Document::changed, &update_, qOverload<>(&QTimer::start));
    connect(&document_, &Document::opened, this, [this] { row_ = -1; });
    follow_document();
}

GlassPanel::~GlassPanel() = default;

void GlassPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    read_library();
}

void GlassPanel::read_library() {
    try {
        const auto library = glass_library();
        if (library == library_) {
            return;  // no other folders since
        }
        map_->show_glasses(nullptr, {});
        library_ = library;
        glasses_ = mapped_glasses(*library_);
    } catch (const Error& error) {
        header_->set_warning(true);
        header_->set_state(error.what());
        return;
    }
    chosen_.reset();
    find();
}

void GlassPanel::find() {
    read_library();
    found_ = find_glasses(glasses_, search_->text().toStdString());
    is_filling_ = true;
    model_->setRowCount(0);
    for (std::size_t k = 0; k < std::min(found_.size(), most_listed); ++k) {
        const MappedGlass& glass = glasses_[found_[k]];
        QList<QStandardItem*> row;
        for (const QString& text :
             {QString::fromStdString(glass.glass.medium.name), fixed(glass.nd, 5),
              fixed(glass.vd, 2), fixed(glass.p_gf, 4), fixed(glass.delta_p_gf, 4),
              QString::fromStdString(glass.glass.catalog)}) {
            auto* item = new QStandardItem(text);
            const bool is_word = row.isEmpty() || row.size() == 5;
            item->setTextAlignment(Qt::AlignVCenter | (is_word ? Qt::AlignLeft : Qt::AlignRight));
            row << item;
        }
        model_->appendRow(row);
    }
    fit_columns(*table_);
    is_filling_ = false;
    map_->show_glasses(&glasses_, found_);
    header_->set_warning(found_.empty());
    header_->set_state(found_.empty() ? tr("nothing found")
                       : found_.size() == glasses_.size()
                           ? tr("%n glass(es)", nullptr, static_cast<int>(glasses_.size()))
                           : tr("%1 of %2").arg(found_.size()).arg(glasses_.size()));
    choose(chosen_ && std::ranges::find(found_, *chosen_) != found_.end() ? chosen_ : std::nullopt);
}

void GlassPanel::choose(std::optional<std::size_t> glass) {
    chosen_ = glass;
    map_->set_chosen(glass);
    is_filling_ = true;
    const auto listed = glass ? std::ranges::find(found_, *glass) : found_.end();
    const auto at = listed - found_.begin();
    if (listed != found_.end() && at < model_->rowCount()) {
        table_->setCurrentIndex(model_->index(static_cast<int>(at), 0));
        table_->scrollTo(table_->currentIndex());
    } else {
        table_->clearSelection();
    }
    is_filling_ = false;
    follow_document();
}

void GlassPanel::set_row(int row) {
    if (row >= 0 && row != row_) {
        row_ = row;
        update_.start();
    }
}

std::optional<ModelGlass> GlassPanel::present() const {
    const auto& surfaces = document_.lens().surfaces;
    if (row_ < 0 || static_cast<std::size_t>(row_) >= surfaces.size()) {
        return std::nullopt;
    }
    const Medium& medium = surfaces[static_cast<std::size_t>(row_)].medium_after;
    if (is_air(medium)) {
        return std::nullopt;
    }
    try {
        const ModelGlass glass{refractive_index(medium, d_line_nm), abbe_number(medium)};
        return std::isfinite(glass.vd) ? std::optional(glass) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void GlassPanel::follow_document() {
    const auto& surfaces = document_.lens().surfaces;
    const bool has_row = row_ >= 0 && static_cast<std::size_t>(row_) < surfaces.size();
    const auto glass = present();
    map_->set_ring(glass);
    surface_->setText(has_row
                          ? tr("Behind surface %1: %2")
                                .arg(QString::number(row_ + 1),
                                     QString::fromStdString(describe(
                                         surfaces[static_cast<std::size_t>(row_)].medium_after)))
                          : tr("Choose a surface in the prescription"));
    use_->setEnabled(has_row && chosen_.has_value());
    nearest_->setEnabled(glass.has_value());
}

void GlassPanel::put(std::size_t glass) {
    const auto& surfaces = document_.lens().surfaces;
    if (row_ < 0 || static_cast<std::size_t>(row_) >= surfaces.size()) {
        Q_EMIT refused(tr("Choose the surface in the prescription first."));
        return;
    }
    Prescription lens = document_.lens();
    const Medium& medium = glasses_[glass].glass.medium;
    lens.surfaces[static_cast<std::size_t>(row_)].medium_after = medium;
    Q_EMIT refused({});
    document_.edit_lens(
        std::move(lens),
        tr("put %1 behind surface %2").arg(QString::fromStdString(medium.name)).arg(row_ + 1));
}

void GlassPanel::put_nearest() {
    read_library();
    const auto now = present();
    if (!now || glasses_.empty()) {
        return;
    }
    const std::string place =
        shortest(now->nd).toStdString() + " / " + shortest(now->vd).toStdString();
    const std::size_t nearest = find_glasses(glasses_, place).front();
    put(nearest);
    choose(nearest);
}

}  // namespace ghostlight
