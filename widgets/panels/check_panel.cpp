#include "widgets/panels/check_panel.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QTableView>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <ranges>
#include <utility>

#include "core/error.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/selection.h"

namespace ghostlight {

namespace {

constexpr int delay_ms = 150;  // typing and dragging have come to rest
constexpr std::array headers = {
    QT_TRANSLATE_NOOP("FindingsModel", "Surface"), QT_TRANSLATE_NOOP("FindingsModel", "Cell"),
    QT_TRANSLATE_NOOP("FindingsModel", "Finding"), QT_TRANSLATE_NOOP("FindingsModel", "Proposal")};

}  // namespace

int FindingsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(findings_.size());
}

int FindingsModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QVariant FindingsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) {
        return {};
    }
    const Finding& found = finding(index.row());
    switch (role) {
        case Qt::DisplayRole:
            switch (index.column()) {
                case surface:
                    return found.surface ? QString::number(*found.surface + 1) : tr("lens");
                case cell:
                    return QString::fromUtf8(name_of(found.cell));
                case text:
                    return QString::fromStdString(found.text);
                default:
                    return QString::fromStdString(found.proposal);
            }
        case Qt::ToolTipRole:
            return index.column() == text || index.column() == proposal
                       ? QVariant(index.data(Qt::DisplayRole).toString())
                       : QVariant();
        case Qt::ForegroundRole:
            return found.severity == Note::Severity::error     ? current_palette().red_orange
                   : found.severity == Note::Severity::warning ? current_palette().text
                                                               : current_palette().dim;
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter | Qt::AlignLeft);
        default:
            return {};
    }
}

QVariant FindingsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    if (role == Qt::DisplayRole) {
        return QCoreApplication::translate("FindingsModel",
                                           headers[static_cast<std::size_t>(section)]);
    }
    return role == Qt::TextAlignmentRole ? QVariant::fromValue(Qt::AlignVCenter | Qt::AlignLeft)
                                         : QVariant();
}

void FindingsModel::set_findings(std::vector<Finding> findings) {
    if (findings == findings_) {
        return;
    }
    beginResetModel();
    findings_ = std::move(findings);
    endResetModel();
}

CheckPanel::CheckPanel(Document& document, Selection& selection, QWidget* parent)
    : QWidget(parent),
      document_(document),
      selection_(selection),
      model_(new FindingsModel(this)),
      header_(new PanelHeader(tr("Check"))),
      table_(plain_table(model_, new TableDelegate(-1, -1, this))),
      fine_(new EmptyState(tr("What is suspicious in the lens is listed here."), QString())) {
    table_->setObjectName("findings");
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->horizontalHeader()->setStretchLastSection(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(table_, 1);
    column->addWidget(fine_, 1);
    table_->hide();
    delay_.setSingleShot(true);
    delay_.setInterval(delay_ms);
    connect(&delay_, &QTimer::timeout, this, &CheckPanel::follow_document);
    connect(&document_, &Document::changed, this, [this](bool lens_changed) {
        if (lens_changed || document_.revision() == document_.first_revision()) {
            open_ = true;
            delay_.start();
        }
    });
    connect(table_, &QTableView::clicked, this, &CheckPanel::go_to);
    connect(table_, &QTableView::activated, this, &CheckPanel::go_to);
    job_ = std::make_unique<NewestJob<Wanted>>([this](const Wanted& wanted, std::stop_token) {
        auto findings = check_lens(wanted.lens, wanted.request);
        QMetaObject::invokeMethod(
            this,
            [this, findings = std::move(findings), serial = wanted.serial]() mutable {
                if (serial == serial_) {
                    take(std::move(findings));
                }
            },
            Qt::QueuedConnection);
    });
}

CheckPanel::~CheckPanel() { job_.reset(); }

void CheckPanel::follow_document() {
    if (document_.is_empty()) {
        take({});
        return;
    }
    try {
        Wanted wanted;
        wanted.lens = document_.configured_lens();
        if (const auto* line = std::get_if<Monochromatic>(&document_.scene().light().spectrum)) {
            wanted.request.wavelength_nm = line->wavelength_nm;
            wanted.request.shortest_nm = wanted.request.longest_nm = line->wavelength_nm;
        }
        wanted.serial = ++serial_;
        job_->submit(std::move(wanted));
    } catch (const Error& error) {
        Finding finding;
        finding.severity = Note::Severity::error;
        finding.text = error.what();
        take({finding});
    }
}

void CheckPanel::take(std::vector<Finding> findings) {
    open_ = false;
    const auto grave = static_cast<int>(std::ranges::count_if(
        findings, [](const Finding& f) { return f.severity != Note::Severity::info; }));
    const int before = model_->rowCount();
    model_->set_findings(std::move(findings));
    const int count = model_->rowCount();
    if (count > 0 && before == 0) {
        fit_columns(*table_);
    }
    table_->setVisible(count > 0);
    fine_->setVisible(count == 0);
    fine_->set_what(document_.is_empty() ? tr("What is suspicious in the lens is listed here.")
                                         : tr("Nothing suspicious was found."));
    header_->set_state(count == 0   ? QString()
                       : grave == 0 ? tr("%1 worth knowing").arg(count)
                                    : tr("%1 suspicious, %2 worth knowing · click to go there")
                                          .arg(grave)
                                          .arg(count - grave));
    header_->set_warning(std::ranges::any_of(std::views::iota(0, count), [this](int row) {
        return model_->finding(row).severity == Note::Severity::error;
    }));
    Q_EMIT counted(grave);
}

void CheckPanel::go_to(const QModelIndex& index) {
    if (!index.isValid()) {
        return;
    }
    const Finding finding = model_->finding(index.row());
    if (finding.surface) {
        Q_EMIT cell_chosen(static_cast<int>(*finding.surface), finding.cell);
    }
    if (!finding.ghosts.empty()) {
        selection_.set_ghosts(finding.ghosts);
    }
}

}  // namespace ghostlight
