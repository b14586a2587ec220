#include "widgets/panels/fit_panel.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/io/fit_page.h"
#include "core/io/fit_setup_json.h"
#include "core/io/lens_file.h"
#include "core/io/varied_cells.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/fit_apply.h"
#include "widgets/fit_pictures.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/fit_results.h"
#include "widgets/panels/line_plot.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

constexpr const char* what_is_here =
    "Finds the coatings and elements that explain photographs of the lens's flare, and says how "
    "well each is known.";
constexpr const char* photo_filter =
    "Photographs (*.exr *.tif *.tiff *.png *.jpg *.jpeg *.cr2 *.cr3 *.nef *.arw *.raf *.rw2 *.orf "
    "*.dng *.pef);;All files (*)";
constexpr int suggested_angles = 4;

std::string joined(const std::vector<FitParameterModel::Row>& rows, bool varies) {
    std::string text;
    for (const FitParameterModel::Row& row : rows) {
        if (row.varies == varies) {
            text += (text.empty() ? "" : ",") + vary_item(row.parameter);
        }
    }
    return text;
}

std::vector<FitParameterModel::Row> rows_of(const FitSetup& setup, const Prescription& lens) {
    std::vector<FitParameterModel::Row> rows;
    for (const bool varies : {true, false}) {
        const std::string& text = varies ? setup.vary : setup.held;
        if (text.empty()) {
            continue;  // which parse_vary() refuses
        }
        for (const FitParameter& each : parse_vary(text, lens)) {
            rows.push_back({each, varies});
        }
    }
    std::ranges::stable_sort(rows, [](const auto& a, const auto& b) {
        return std::pair(a.parameter.kind, a.parameter.rows) <
               std::pair(b.parameter.kind, b.parameter.rows);
    });
    return rows;
}

/// The command line that makes the same fit.
std::string command_of(const FitSetup& setup, const std::string& lens) {
    std::string photos, lights;
    for (const FitPhotoSetup& each : setup.photos) {
        photos += (photos.empty() ? "" : ",") + each.file;
        lights += (lights.empty() ? "" : ";") + each.light;
    }
    return "fit " + lens + " --photo " + photos + " --light \"" + lights + "\" --vary " +
           setup.vary + " --spectrum \"" + setup.spectrum + "\"" + (setup.merge ? " --merge" : "") +
           " --seed " + std::to_string(setup.seed);
}

}  // namespace

FitPanel::FitPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      header_(new PanelHeader("Fit")),
      empty_(new EmptyState(what_is_here, "Open a lens…")),
      pages_(new QStackedWidget),
      results_(new FitResults),
      job_(std::make_unique<FitJob>()) {
    setObjectName("fit_panel");
    auto* parts = new QSplitter(Qt::Horizontal);
    parts->setChildrenCollapsible(false);
    parts->addWidget(make_photographs());
    parts->addWidget(make_parameters());
    parts->addWidget(results_);
    parts->setStretchFactor(0, 3);
    parts->setStretchFactor(1, 4);
    parts->setStretchFactor(2, 3);
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(parts, 1);
    column->addWidget(make_controls());
    pages_->addWidget(empty_);
    pages_->addWidget(content);
    auto* all = new QVBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addWidget(header_);
    all->addWidget(pages_, 1);

    delay_.setSingleShot(true);
    delay_.setInterval(0);
    connect(&delay_, &QTimer::timeout, this, &FitPanel::load);
    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&document_, &Document::changed, this, &FitPanel::follow_document);
    connect(&document_, &Document::fit_changed, this, &FitPanel::follow_document);
    connect(&document_, &Document::opened, this, [this] {
        cancel();
        drop_result();
        show_reason({});
    });
    connect(job_.get(), &FitJob::photos_loaded, this, &FitPanel::take_photos);
    connect(job_.get(), &FitJob::glanced, this,
            [this](const auto& glance) { take_glance(*glance); });
    connect(job_.get(), &FitJob::finished, this,
            [this](const auto& report) { take_report(*report); });
    connect(job_.get(), &FitJob::failed, this, [this](const QString& reason) {
        show_reason(reason);
        header_->set_state(tr("failed"));
        show_buttons();
    });
    connect(job_.get(), &FitJob::progressed, this, [this](double share) {
        share_ = std::max(share_, share);
        progress_->setValue(static_cast<int>(1000.0 * share_));
    });
    connect(picture_, &FitPictureView::clicked, this, [this](const QPointF& share) {
        const std::size_t at = shown_photo();
        if (loaded_ && at < loaded_->size() && !(*loaded_)[at].size_px.isEmpty()) {
            const QSize size = (*loaded_)[at].size_px;
            set_light_of_shown(QStringLiteral("%1,%2")
                                   .arg(share.x() * size.width(), 0, 'f', 1)
                                   .arg(share.y() * size.height(), 0, 'f', 1));
        }
    });
    connect(model_, &FitParameterModel::refused, this, &FitPanel::show_reason);
    connect(
        model_, &FitParameterModel::edited, this,
        [this](const auto& rows) { set_parameters(rows, tr("change what a fit varies")); },
        Qt::QueuedConnection);  // after the table's editor is done with the row
    show_buttons();
}

FitPanel::~FitPanel() { job_.reset(); }

QToolButton* FitPanel::quiet(const QString& name, const QString& text, const QString& tip,
                             bool checkable) {
    auto* button = new QToolButton;
    button->setProperty("quiet", true);
    button->setObjectName("fit_" + name);
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(checkable);
    button->setAccessibleName(text);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

QWidget* FitPanel::make_photographs() {
    auto* part = new QWidget;
    auto* column = new QVBoxLayout(part);
    column->setContentsMargins(8, 6, 8, 6);
    column->setSpacing(6);
    auto* files = new QHBoxLayout;
    photos_ = new QComboBox;
    photos_->setObjectName("fit_photos");
    photos_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    photos_->setMinimumContentsLength(12);
    auto* add = quiet("add", tr("Add…"), tr("Add photographs: EXR, TIFF, PNG, JPEG or camera RAW"));
    auto* remove = quiet("remove", tr("Remove"), tr("Take this photograph out of the fit"));
    files->addWidget(photos_, 1);
    files->addWidget(add);
    files->addWidget(remove);
    column->addLayout(files);

    auto* modes = new QHBoxLayout;
    modes->setSpacing(2);
    const struct {
        const char *name, *text, *tip;
        FitPictureView::Mode mode;
    } all[] = {
        {"mode_photograph", "Photograph", "The file", FitPictureView::Mode::photograph},
        {"mode_model", "Model", "What the lens makes, as far as the fit has come",
         FitPictureView::Mode::model},
        {"mode_overlay", "Overlay", "Half the photograph, half the model",
         FitPictureView::Mode::overlay},
        {"mode_difference", "Difference",
         "Residuals: red where the model is too bright, blue where it is too dark; full at 5 σ",
         FitPictureView::Mode::difference},
        {"mode_blink", "Blink", "Photograph and model in turn", FitPictureView::Mode::blink}};
    picture_ = new FitPictureView;
    for (const auto& each : all) {
        auto* button = quiet(each.name, tr(each.text), tr(each.tip), true);
        button->setAutoExclusive(true);
        button->setChecked(each.mode == FitPictureView::Mode::photograph);
        modes->addWidget(button);
        connect(button, &QToolButton::toggled, this, [this, mode = each.mode](bool on) {
            if (on) {
                picture_->set_mode(mode);
            }
        });
    }
    modes->addStretch(1);
    column->addLayout(modes);
    column->addWidget(picture_, 1);

    auto* light = new QHBoxLayout;
    light_ = new QLineEdit;
    light_->setObjectName("fit_light");
    light_->setToolTip(
        tr("Where the light is: auto, X,Y in pixels from the upper left corner, or "
           "deg:FIELD:AZIMUTH; or click it in the photograph"));
    auto* find = quiet("find", tr("Find"), tr("The middle of the largest bright patch"));
    light->addWidget(new QLabel(tr("Light")));
    light->addWidget(light_, 1);
    light->addWidget(find);
    column->addLayout(light);
    about_ = new QLabel;
    about_->setForegroundRole(QPalette::PlaceholderText);
    about_->setWordWrap(true);
    column->addWidget(about_);

    connect(add, &QToolButton::clicked, this, [this] {
        add_photographs(QFileDialog::getOpenFileNames(this, tr("Photographs"), QString(),
                                                      QString::fromUtf8(photo_filter)));
    });
    connect(remove, &QToolButton::clicked, this, [this] {
        FitSetup setup = setup_;
        const std::size_t at = shown_photo();
        if (at < setup.photos.size()) {
            setup.photos.erase(setup.photos.begin() + static_cast<std::ptrdiff_t>(at));
            edit_setup(setup, tr("remove a photograph"));
        }
    });
    connect(photos_, &QComboBox::currentIndexChanged, this, &FitPanel::show_photograph);
    connect(find, &QToolButton::clicked, this, [this] { set_light_of_shown("auto"); });
    connect(light_, &QLineEdit::editingFinished, this, [this] {
        if (light_->isModified()) {
            light_->setModified(false);
            set_light_of_shown(light_->text().trimmed());
        }
    });
    return part;
}

QWidget* FitPanel::make_parameters() {
    auto* part = new QWidget;
    auto* column = new QVBoxLayout(part);
    column->setContentsMargins(8, 6, 8, 6);
    column->setSpacing(6);
    auto* add_row = new QHBoxLayout;
    auto* coatings = quiet("all_coatings", tr("All coatings"),
                           tr("Vary the centre wavelength, or the constant reflectance, of every "
                              "coated surface"));
    auto* marked = quiet("vary_marked", tr("Marked"),
                         tr("Vary what is marked V in the prescription (Ctrl+M there)"));
    spec_ = new QLineEdit;
    spec_->setObjectName("fit_spec");
    spec_->setPlaceholderText(QStringLiteral("center@3  radius@4~0.2%  gap@2=1..3"));
    spec_->setToolTip(
        tr("KIND@ROWS[=LOWER..UPPER][~PRIOR]; KIND: center, thickness, layer.N, layer-index.N, "
           "reflectance, radius, gap, index, semi-diameter, and stop-size, stop-x, stop-y, "
           "stop-rotation without rows; ROWS: 3, 2+5 (one common value), all"));
    auto* add = quiet("vary_add", tr("Add"), tr("Vary this too"));
    auto* remove = quiet("vary_remove", tr("Remove"), tr("Take the chosen rows out"));
    add_row->addWidget(coatings);
    add_row->addWidget(marked);
    add_row->addWidget(spec_, 1);
    add_row->addWidget(add);
    add_row->addWidget(remove);
    column->addLayout(add_row);
    model_ = new FitParameterModel(this);
    table_ = plain_table(model_, new TableDelegate(-1, FitParameterModel::stale_role, this));
    table_->setItemDelegateForColumn(FitParameterModel::what, new QStyledItemDelegate(this));
    table_->setObjectName("fit_table");
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setContextMenuPolicy(Qt::NoContextMenu);
    column->addWidget(table_, 1);
    auto* more = new QHBoxLayout;
    spectrum_ = new QLineEdit;
    spectrum_->setObjectName("fit_spectrum");
    spectrum_->setMaximumWidth(110);
    spectrum_->setToolTip(tr("Of the light: D65, A, E, LED, sodium, 3200 K, 550 nm …"));
    merge_ = new QCheckBox(tr("Exposures of one scene"));
    merge_->setToolTip(tr("Merge the photographs by their exposure times before the fit"));
    suggest_ = new QCheckBox(tr("Suggest the next photograph"));
    suggest_->setToolTip(tr("Tries other angles of the light in the model; takes longer"));
    more->addWidget(new QLabel(tr("Spectrum")));
    more->addWidget(spectrum_);
    more->addSpacing(10);
    more->addWidget(merge_);
    more->addWidget(suggest_);
    more->addStretch(1);
    column->addLayout(more);

    connect(coatings, &QToolButton::clicked, this, [this] {
        std::string wanted;
        const Prescription lens = document_.configured_lens();
        for (const char* item : {"center@all", "reflectance@all"}) {
            try {
                parse_vary(item, lens);
                wanted += (wanted.empty() ? "" : ",") + std::string(item);
            } catch (const Error&) {
                // None of that kind in this lens.
            }
        }
        if (wanted.empty()) {
            show_reason(
                tr("no surface of this lens has a quarter-wave layer or a constant "
                   "reflectance; vary thickness@all of layer stacks, or coat it first"));
            return;
        }
        add_spec(QString::fromStdString(wanted), tr("vary all coatings"));
    });
    connect(marked, &QToolButton::clicked, this, [this] {
        const std::string wanted = vary_text(document_.configured_lens());
        if (wanted.empty()) {
            show_reason(
                tr("nothing is marked; choose a cell of the prescription and press Ctrl+M"));
            return;
        }
        add_spec(QString::fromStdString(wanted), tr("vary what is marked"));
    });
    const auto add_typed = [this] {
        if (!spec_->text().trimmed().isEmpty()) {
            add_spec(spec_->text().trimmed().replace(' ', ','), tr("vary %1").arg(spec_->text()));
        }
    };
    connect(spec_, &QLineEdit::returnPressed, this, add_typed);
    connect(add, &QToolButton::clicked, this, add_typed);
    connect(remove, &QToolButton::clicked, this, [this] {
        std::vector<FitParameterModel::Row> rows;
        for (int k = 0; k < model_->rowCount(); ++k) {
            if (!table_->selectionModel()->isRowSelected(k)) {
                rows.push_back(model_->rows()[static_cast<std::size_t>(k)]);
            }
        }
        set_parameters(rows, tr("vary less"));
    });
    connect(spectrum_, &QLineEdit::editingFinished, this, [this] {
        FitSetup setup = setup_;
        setup.spectrum = spectrum_->text().trimmed().toStdString();
        if (setup == setup_) {
            return;
        }
        try {
            parse_spectrum(setup.spectrum);
            edit_setup(setup, tr("change the fit's spectrum"));
        } catch (const Error& error) {
            show_reason(QString::fromUtf8(error.what()));
        }
    });
    connect(merge_, &QCheckBox::clicked, this, [this](bool on) {
        FitSetup setup = setup_;
        setup.merge = on;
        edit_setup(setup, on ? tr("merge exposures") : tr("keep exposures apart"));
    });
    connect(suggest_, &QCheckBox::clicked, this, [this](bool on) {
        FitSetup setup = setup_;
        setup.suggestions = on ? suggested_angles : 0;
        edit_setup(setup, on ? tr("suggest photographs") : tr("suggest no photographs"));
    });
    return part;
}

QWidget* FitPanel::make_controls() {
    auto* part = new QWidget;
    auto* column = new QVBoxLayout(part);
    column->setContentsMargins(8, 2, 8, 8);
    column->setSpacing(4);
    reason_label_ = new QLabel;
    reason_label_->setObjectName("refusal");
    reason_label_->setWordWrap(true);
    reason_label_->hide();
    column->addWidget(reason_label_);
    auto* row = new QHBoxLayout;
    const auto button = [&](const char* name, const QString& text, const QString& tip) {
        auto* made = new QPushButton(text);
        made->setObjectName(QStringLiteral("fit_") + name);
        made->setToolTip(tip);
        row->addWidget(made);
        return made;
    };
    start_ = button("start", tr("Start"), tr("Fit what is marked to the photographs"));
    pause_ = button("pause", tr("Pause"), tr("Wait after the iteration in work"));
    cancel_ = button("cancel", tr("Cancel"), tr("Stop, and keep the best so far"));
    progress_ = new QProgressBar;
    progress_->setRange(0, 1000);
    progress_->setTextVisible(false);
    progress_->setFixedHeight(6);
    row->addWidget(progress_, 1);
    apply_ = button("apply", tr("Apply"),
                    tr("Put the fitted numbers into the lens, as one step that can be undone"));
    save_ = button("report", tr("Save Report…"), tr("One HTML page with everything"));
    column->addLayout(row);
    connect(start_, &QPushButton::clicked, this, &FitPanel::start);
    connect(pause_, &QPushButton::clicked, this, [this] {
        job_->set_paused(!job_->is_paused());
        show_buttons();
    });
    connect(cancel_, &QPushButton::clicked, this, &FitPanel::cancel);
    connect(apply_, &QPushButton::clicked, this, &FitPanel::apply);
    connect(save_, &QPushButton::clicked, this, [this] {
        const QString file =
            QFileDialog::getSaveFileName(this, tr("Save Report"), "fit.html", tr("HTML (*.html)"));
        if (!file.isEmpty()) {
            save_report(file);
        }
    });
    return part;
}

QAbstractButton& FitPanel::button(const QString& name) const {
    auto* found = findChild<QAbstractButton*>("fit_" + name);
    Q_ASSERT_X(found != nullptr, "FitPanel::button", qPrintable(name));
    return *found;
}

QString FitPanel::reason() const {
    return reason_label_->isHidden() ? QString() : reason_label_->text();
}
QString FitPanel::state() const { return header_->state(); }

std::size_t FitPanel::shown_photo() const {
    return static_cast<std::size_t>(std::max(0, photos_->currentIndex()));
}

void FitPanel::edit_setup(const FitSetup& setup, const QString& step) {
    show_reason({});
    document_.edit_fit(fit_setup_to_json(setup), step);
}

void FitPanel::add_photographs(const QStringList& files) {
    FitSetup setup = setup_;
    for (const QString& file : files) {
        const std::string name = QFileInfo(file).absoluteFilePath().toStdString();
        if (std::ranges::find(setup.photos, name, &FitPhotoSetup::file) == setup.photos.end()) {
            setup.photos.push_back({name, "auto"});
        }
    }
    if (setup == setup_) {
        return;
    }
    const int last = static_cast<int>(setup.photos.size()) - 1;
    edit_setup(setup, setup.photos.size() - setup_.photos.size() == 1 ? tr("add a photograph")
                                                                      : tr("add photographs"));
    photos_->setCurrentIndex(last);
}

void FitPanel::set_light_of_shown(const QString& text) {
    FitSetup setup = setup_;
    const std::size_t at = shown_photo();
    if (at < setup.photos.size()) {
        setup.photos[at].light = text.toStdString();
        edit_setup(setup, tr("place the photograph's light"));
    }
}

void FitPanel::set_parameters(const std::vector<FitParameterModel::Row>& rows,
                              const QString& step) {
    FitSetup setup = setup_;
    setup.vary = joined(rows, true);
    setup.held = joined(rows, false);
    edit_setup(setup, step);
}

void FitPanel::add_spec(const QString& text, const QString& step) {
    try {
        std::vector<FitParameterModel::Row> rows = model_->rows();
        const auto added = parse_vary(text.toStdString(), document_.configured_lens());
        for (const FitParameter& each : added) {
            // What is there already is marked and keeps its bounds, unless it is asked for alone.
            const auto at = std::ranges::find_if(rows, [&](const FitParameterModel::Row& row) {
                return row.parameter.kind == each.kind && row.parameter.layer == each.layer &&
                       row.parameter.rows == each.rows;
            });
            if (at == rows.end()) {
                rows.push_back({each, true});
            } else {
                *at = {added.size() == 1 ? each : at->parameter, true};
            }
        }
        parse_vary(joined(rows, true), document_.configured_lens());  // nothing twice
        set_parameters(rows, step);
        spec_->clear();
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
}

void FitPanel::follow_document() {
    if (document_.is_empty()) {
        pages_->setCurrentIndex(0);
        return;
    }
    pages_->setCurrentIndex(1);
    const FitSetup before = setup_;
    setup_ = fit_setup_from_json(document_.fit());
    try {
        const Prescription lens = document_.configured_lens();
        model_->set_rows(rows_of(setup_, lens));
        setup_is_wrong_ = false;
        if (lens != fitted_lens_ && !job_->is_running()) {
            drop_result();
        }
    } catch (const Error& error) {
        setup_is_wrong_ = true;
        model_->set_rows({});
        show_reason(QString::fromUtf8(error.what()));
    }
    if (report_) {
        model_->set_numbers(report_->numbers, true);
    }
    fit_columns(*table_);
    table_->setColumnWidth(FitParameterModel::what,
                           table_->columnWidth(FitParameterModel::what) + 26);  // the mark
    if (before.photos.size() != setup_.photos.size() || photos_->count() == 0 ||
        !std::ranges::equal(before.photos, setup_.photos, {}, &FitPhotoSetup::file,
                            &FitPhotoSetup::file)) {
        const int at = photos_->currentIndex();
        const QSignalBlocker quiet(photos_);
        photos_->clear();
        for (const FitPhotoSetup& each : setup_.photos) {
            photos_->addItem(QFileInfo(QString::fromStdString(each.file)).fileName());
        }
        photos_->setCurrentIndex(std::clamp(at, 0, std::max(0, photos_->count() - 1)));
    }
    spectrum_->setText(QString::fromStdString(setup_.spectrum));
    merge_->setChecked(setup_.merge);
    suggest_->setChecked(setup_.suggestions > 0);
    delay_.start();
    show_photograph();
    show_buttons();
}

void FitPanel::load() {
    if (setup_.photos.empty()) {
        loaded_ = nullptr;
        show_photograph();
        return;
    }
    try {
        job_->load(document_.configured_lens(), setup_);
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
}

void FitPanel::take_photos(const LoadedPhotos& photos) {
    loaded_ = photos;
    show_photograph();
    show_buttons();
    if (std::exchange(wants_start_, false) && start_->isEnabled()) {
        start();
    }
}

void FitPanel::start_when_read() {
    if (is_settled()) {
        start_->click();
    } else {
        wants_start_ = true;
    }
}

void FitPanel::show_photograph() {
    const std::size_t at = shown_photo();
    const bool is_there = at < setup_.photos.size();
    light_->setEnabled(is_there);
    button("find").setEnabled(is_there);
    button("remove").setEnabled(is_there);
    merge_->setEnabled(setup_.photos.size() > 1);
    if (!light_->hasFocus() || !light_->isModified()) {
        light_->setText(is_there ? QString::fromStdString(setup_.photos[at].light) : QString());
    }
    FitPictureView::Pictures pictures;
    if (!is_there || !loaded_ || at >= loaded_->size() ||
        (*loaded_)[at].file != setup_.photos[at].file) {
        picture_->set_text(is_there ? tr("reading…")
                                    : tr("Add a photograph with a bright light in or near the "
                                         "frame."));
        picture_->set_light({});
        picture_->set_pictures({});
        about_->clear();
        return;
    }
    const LoadedPhoto& photo = (*loaded_)[at];
    pictures.photograph = photo.preview;
    picture_->set_text(photo.preview.isNull() ? photo.reason : QString());
    picture_->set_light(photo.light
                            ? std::optional(QPointF(photo.light->x() / photo.size_px.width(),
                                                    photo.light->y() / photo.size_px.height()))
                            : std::nullopt);
    QStringList about{photo.about};
    if (photo.reason.isEmpty()) {
        about << tr("light at %1°").arg(significant(photo.field_deg, 3));
    }
    about += photo.notes;
    about.removeAll(QString());
    about_->setText(about.join(QStringLiteral(" · ")));
    if (at < fitted_photos_.size()) {
        const FittedPhoto& fitted = fitted_photos_[at];
        const double ev = fit_exposure_ev(fitted);
        pictures.measured = fit_picture(fitted, fitted.measured, ev);
        pictures.model = fit_picture(fitted, fitted.after, ev);
        pictures.difference = residual_picture(fitted);
    }
    picture_->set_pictures(std::move(pictures));
    for (const LoadedPhoto& each : *loaded_) {
        if (!each.reason.isEmpty()) {
            show_reason(QFileInfo(QString::fromStdString(each.file)).fileName() + ": " +
                        each.reason);
        }
    }
}

void FitPanel::show_reason(const QString& reason) {
    reason_label_->setText(reason);
    reason_label_->setVisible(!reason.isEmpty());
}

void FitPanel::show_buttons() {
    const bool runs = job_->is_running();
    const bool photos_are_fine =
        loaded_ && !loaded_->empty() && loaded_->size() == setup_.photos.size() &&
        std::ranges::all_of(*loaded_, [](const LoadedPhoto& p) { return p.reason.isEmpty(); });
    start_->setEnabled(!runs && photos_are_fine && !setup_is_wrong_ && !setup_.vary.empty());
    pause_->setEnabled(runs);
    pause_->setText(job_->is_paused() ? tr("Resume") : tr("Pause"));
    cancel_->setEnabled(runs);
    apply_->setEnabled(!runs && (report_ || kept_));
    save_->setEnabled(!runs && report_);
    progress_->setVisible(runs);
    if (runs) {
        header_->set_state(job_->is_paused() ? tr("paused") : tr("fitting"));
    } else if (setup_.photos.empty()) {
        header_->set_state(tr("no photograph"));
    } else if (setup_.vary.empty()) {
        header_->set_state(tr("nothing varies"));
    } else if (!report_ && !kept_ && reason().isEmpty()) {
        header_->set_state(tr("ready"));
    }
}

void FitPanel::drop_result() {
    report_.reset();
    kept_.reset();
    fitted_photos_.clear();
    fitted_lens_ = {};
    model_->set_numbers({}, false);
    results_->clear();
}

void FitPanel::start() {
    try {
        const Prescription lens = document_.configured_lens();
        drop_result();
        show_reason({});
        share_ = 0.0;
        progress_->setValue(0);
        fitted_lens_ = lens;
        fitted_setup_ = setup_;
        results_->setCurrentWidget(&results_->costs());
        job_->start(lens, setup_);
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
    show_buttons();
}

void FitPanel::cancel() {
    if (!job_->is_running()) {
        return;
    }
    job_->cancel();
    kept_ = job_->best();
    if (kept_) {
        fitted_photos_ = kept_->photos;
        model_->set_numbers(kept_->numbers, false);
        show_photograph();
        header_->set_state(tr("stopped; best so far kept, errors unknown"));
    } else {
        header_->set_state(tr("stopped before the first step"));
    }
    show_buttons();
}

void FitPanel::take_glance(const FitGlance& glance) {
    results_->show_costs(glance.costs);
    fitted_photos_ = glance.look.photos;
    model_->set_numbers(glance.look.numbers, false);
    show_photograph();
}

void FitPanel::take_report(const FitReport& report) {
    report_ = report;
    fitted_photos_ = report.photos;
    model_->set_numbers(report.numbers, true);
    results_->show_report(report);
    show_photograph();
    fit_columns(*table_);
    table_->setColumnWidth(FitParameterModel::what,
                           table_->columnWidth(FitParameterModel::what) + 26);
    header_->set_state(report.usable ? tr("done in %1 s").arg(significant(report.seconds, 3))
                                     : tr("the lens does not explain the photographs"));
    show_buttons();
}

void FitPanel::apply() {
    const auto& numbers = report_ ? report_->numbers : kept_->numbers;
    try {
        if (document_.configured_lens() != fitted_lens_) {
            show_reason(tr("the lens was edited since the fit began; fit again"));
            return;
        }
        const Prescription fitted =
            with_fitted(document_.lens(), document_.scene().configuration, numbers);
        // What stands in the table begins from the fitted lens now; the result is still its own.
        fitted_lens_ = configured(fitted, document_.scene().configuration);
        document_.edit_lens(fitted, tr("apply the fit"));
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
    show_buttons();
}

bool FitPanel::save_report(const QString& file) {
    if (!report_) {
        return false;
    }
    try {
        const std::string& configuration = document_.scene().configuration;
        write_file_safely(
            file.toStdString(),
            fit_page(*report_,
                     document_.lens().name + (configuration.empty() ? "" : ", " + configuration),
                     command_of(fitted_setup_, document_.file().string())));
        return true;
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
        return false;
    }
}

}  // namespace ghostlight
