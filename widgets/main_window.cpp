#include "widgets/main_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QOpenGLWidget>
#include <QStatusBar>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/autosave.h"
#include "widgets/certificate_job.h"
#include "widgets/file_actions.h"
#include "widgets/flare_view.h"
#include "widgets/glass_folders.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/note_table_model.h"
#include "widgets/panel_header.h"
#include "widgets/panels/accuracy_panel.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/first_order_panel.h"
#include "widgets/panels/fit_panel.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/import_report_panel.h"
#include "widgets/panels/layers_strip.h"
#include "widgets/panels/layout_panel.h"
#include "widgets/panels/light_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/scene_bar.h"
#include "widgets/panels/status_line.h"
#include "widgets/panels/stop_panel.h"
#include "widgets/settings.h"
#include "widgets/theme.h"
#include "widgets/understanding.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {

MainWindow::MainWindow(bool remembers, MakeGlEngine make_gl)
    : remembers_(remembers), actions_(this) {
    setObjectName("workbench");
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
    use_glass_folders();
    build_panels();
    jobs_ = std::make_unique<Jobs>(document_, selection_, std::move(make_gl));
    certificate_ = std::make_unique<CertificateJob>(document_, *jobs_);
    files_ = new FileActions(
        document_, actions_, *banner_, *status_,
        {[this] { return ghosts_->model().is_stale() ? nullptr : ghosts_->model().table(); },
         [this] { return picture_ && picture_->is_final ? picture_->image : nullptr; },
         [this] { return flare_->exposure_ev(); }, [this] { return selection_.ghosts(); },
         [this] { return picture_ ? picture_->layers : std::vector<ShownLayer>(); }},
        this);
    build_menus();
    connect_document();
    connect_jobs();
    connect_actions();
    connect_engines();
    connect_reports();
    connect_editing();
    connect_studies();
    connect_guidance();
    resize(1720, 1000);
    arrange_panels();
    if (remembers_) {
        restoreGeometry(settings::window_geometry());
        restoreState(settings::window_state());
        offer_recovery();
        autosave_ = std::make_unique<Autosave>(document_, Autosave::default_folder());
    }
    show_title();
}

MainWindow::~MainWindow() {
    // Children may still signal while they go, after the members that listen are gone.
    understanding_.reset();
    certificate_.reset();
    jobs_.reset();
    document_.disconnect(this);
    selection_.disconnect(this);
}

QDockWidget* MainWindow::add_dock(QWidget* panel, const char* name, const QString& title,
                                  Qt::DockWidgetArea area) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(name);
    dock->setWidget(panel);
    // The panel's own header is the handle by which it is moved.
    if (auto* header = panel->findChild<PanelHeader*>()) {
        dock->setTitleBarWidget(header);
        header->setToolTip(
            tr("Drag to move the panel, double-click to float it, right-click to close"));
    }
    // On a low screen a panel shows less; none may make the window taller than the screen.
    constexpr int least_height_px = 110;
    if (panel->minimumSizeHint().height() > least_height_px) {
        panel->setMinimumHeight(least_height_px);
    }
    addDockWidget(area, dock);
    return dock;
}

void MainWindow::build_panels() {
    scene_bar_ = new SceneBar(document_);
    addToolBar(Qt::TopToolBarArea, scene_bar_);
    prescription_ = new PrescriptionPanel(document_, actions_);
    layout_ = new LayoutPanel;
    flare_ = new FlarePanel;
    ghosts_ = new GhostPanel(selection_, actions_);
    report_ = new ImportReportPanel(document_, actions_);
    first_order_ = new FirstOrderPanel(document_, actions_);
    stop_ = new StopPanel(document_, actions_);
    light_ = new LightPanel(document_, selection_);
    layers_ = new LayersStrip(document_);
    flare_->set_strip(layers_);
    setCentralWidget(flare_);
    setCorner(Qt::TopLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::TopRightCorner, Qt::RightDockWidgetArea);
    setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);  // reports have long lines
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    prescription_dock_ =
        add_dock(prescription_, "prescription", tr("Prescription"), Qt::LeftDockWidgetArea);
    layout_dock_ = add_dock(layout_, "layout", tr("Layout"), Qt::TopDockWidgetArea);
    ghost_dock_ = add_dock(ghosts_, "ghosts", tr("Ghosts"), Qt::RightDockWidgetArea);
    first_order_dock_ =
        add_dock(first_order_, "first_order", tr("First order"), Qt::RightDockWidgetArea);
    stop_dock_ = add_dock(stop_, "stop", tr("Stop"), Qt::RightDockWidgetArea);
    light_dock_ = add_dock(light_, "light", tr("Light"), Qt::RightDockWidgetArea);
    build_editing();
    report_dock_ =
        add_dock(report_, "import_report", tr("Import report"), Qt::BottomDockWidgetArea);
    understanding_ = std::make_unique<Understanding>(Understanding::Parts{
        *this, document_, selection_, actions_, *prescription_, *layout_, *flare_, *ghosts_,
        remembers_, [this](QWidget* panel, const char* name, const QString& title) {
            return add_dock(panel, name, title, Qt::BottomDockWidgetArea);
        }});

    build_studies();

    status_ = new StatusLine(document_);
    statusBar()->setSizeGripEnabled(false);
    statusBar()->setContentsMargins(0, 0, 0, 0);
    statusBar()->setStyleSheet("QStatusBar::item { border: none; }");
    statusBar()->addPermanentWidget(status_, 1);
    banner_ = new Banner(this);
    flare_->installEventFilter(this);  // the banner follows its place
}

void MainWindow::build_menus() {
    QMenuBar& bar = *menuBar();
    QMenu* file = bar.addMenu(tr("&File"));
    actions_.fill(*file, {"file.open", "file.gallery"});
    QMenu* bundled = file->addMenu(tr("Open &Bundled"));
    connect(bundled, &QMenu::aboutToShow, this,
            [this, bundled] { files_->fill_bundled(*bundled); });
    QMenu* recent = file->addMenu(tr("Open &Recent"));
    connect(recent, &QMenu::aboutToShow, this, [this, recent] { files_->fill_recent(*recent); });
    actions_.fill(*file, {"-", "file.save", "file.save_as", "-", "file.export_lens",
                          "file.export_ghost", "file.export_table", "file.export_exr",
                          "file.export_png", "-", "file.glass_folders", "-", "file.quit"});
    actions_.add_menu(bar, tr("&Edit"), {"edit.undo",       "edit.redo",          "-",
                                         "edit.insert",     "edit.delete",        "edit.move_up",
                                         "edit.move_down",  "edit.make_stop",     "-",
                                         "edit.copy_cells", "edit.paste_cells",   "edit.vary",
                                         "edit.auto_size",  "edit.own_thickness", "-",
                                         "edit.scale",      "edit.reverse",       "-",
                                         "edit.mend_glass", "edit.absorption"});
    actions_.add_menu(bar, tr("&Ghosts"),
                      {"ghosts.filter", "ghosts.as_table", "ghosts.as_matrix", "ghosts.as_surfaces",
                       "-", "ghosts.copy", "ghosts.clear", "-", "ghosts.all", "ghosts.above_3",
                       "ghosts.above_2", "-", "sweep.run", "check.show"});
    actions_.add_menu(
        bar, tr("&Compare"),
        {"compare.pin", "compare.restore", "compare.unpin", "-", "compare.split", "compare.blink"});
    QMenu* view = actions_.add_menu(bar, tr("&View"), {"view.fit", "view.expose", "-"});
    actions_.fill(*view->addMenu(tr("&Flare")),
                  {"flare.false_color", "flare.clipping", "-", "tone.soft", "tone.linear",
                   "tone.log", "-", "flare.full_screen"});
    actions_.fill(*view->addMenu(tr("La&yout")), {"layout.fields", "layout.marks", "layout.stopped",
                                                  "-", "layout.measure", "layout.export"});
    view->addSeparator();
    for (QDockWidget* dock :
         {prescription_dock_, layout_dock_, ghost_dock_, first_order_dock_, stop_dock_, light_dock_,
          report_dock_, coating_dock_, configuration_dock_, glass_dock_, fit_dock_, accuracy_dock_,
          understanding_->check_dock(), understanding_->sweep_dock()}) {
        view->addAction(dock->toggleViewAction());
    }
    actions_.fill(*view,
                  {"view.next_panel", "view.previous_panel", "view.reset", "-", "report.all",
                   "report.matters", "report.copy", "first_order.copy", "-", "view.curvatures",
                   "view.aspheres", "view.comments", "-", "view.light_theme", "view.safe_colors",
                   "view.larger_text", "view.smaller_text"});
    actions_.fill(*view->addMenu(tr("&Draw Flares With")),
                  {"engine.automatic", "engine.cpu", "engine.opengl"});
    actions_.add_menu(
        bar, tr("&Help"),
        {"help.guide", "help.commands", "help.shortcuts", "help.tour", "-", "help.about"});
}

void MainWindow::arrange_panels() {
    const struct {
        QDockWidget* dock;
        Qt::DockWidgetArea area;
    } places[] = {
        {prescription_dock_, Qt::LeftDockWidgetArea}, {layout_dock_, Qt::TopDockWidgetArea},
        {ghost_dock_, Qt::RightDockWidgetArea},       {first_order_dock_, Qt::RightDockWidgetArea},
        {stop_dock_, Qt::RightDockWidgetArea},        {light_dock_, Qt::RightDockWidgetArea},
        {report_dock_, Qt::BottomDockWidgetArea}};
    for (const auto& place : places) {
        place.dock->setFloating(false);
        addDockWidget(place.area, place.dock);
        place.dock->show();
    }
    understanding_->arrange(report_dock_);
    // Those that are seldom wanted together share a place.
    tabifyDockWidget(first_order_dock_, stop_dock_);
    tabifyDockWidget(stop_dock_, light_dock_);
    first_order_dock_->raise();
    arrange_editing();
    // First-order data take a third of the right side; the report comes when it has something
    // to say.
    report_dock_->setVisible(report_->model().rowCount() > 0);
    resizeDocks({ghost_dock_, first_order_dock_}, {height() * 60 / 100, height() * 40 / 100},
                Qt::Vertical);
    resizeDocks({report_dock_}, {height() * 22 / 100}, Qt::Vertical);
    arrange_studies();
    // Tables need a certain width and no more; pictures take what is left.
    const int left = std::clamp(width() * 32 / 100, 380, 640);
    const int right = std::clamp(width() * 24 / 100, 300, 620);
    resizeDocks({prescription_dock_, ghost_dock_}, {left, right}, Qt::Horizontal);
    resizeDocks({layout_dock_}, {height() * 36 / 100}, Qt::Vertical);
}

void MainWindow::connect_document() {
    scene_update_.setSingleShot(true);
    scene_update_.setInterval(0);
    connect(&scene_update_, &QTimer::timeout, this, &MainWindow::show_scene);
    connect(&document_, &Document::opened, this, [this] {
        selection_.set_ghosts({});
        picture_.reset();
        begins_lens_ = true;
        ghosts_->clear();
        flare_->show_image(nullptr);
        banner_->clear("trace");
    });
    connect(&document_, &Document::changed, this, [this](bool lens_changed) {
        // Ghosts are named by their surfaces: with other rows they would be others.
        const auto& surfaces = document_.lens().surfaces;
        const auto& selected = selection_.ghosts();
        if (lens_changed && std::ranges::any_of(selected, [&](const GhostPath& path) {
                return std::ranges::any_of(path.reflections,
                                           [&](std::size_t k) { return k >= surfaces.size(); });
            })) {
            selection_.set_ghosts({});
        }
        flare_->set_dimmed(true);
        if (jobs_->awaits_table()) {
            ghosts_->set_refining(0.0);
        }
        scene_update_.start();
    });
    connect(&document_, &Document::file_changed, this, &MainWindow::show_title);
    connect(&selection_, &Selection::ghosts_changed, &scene_update_, qOverload<>(&QTimer::start));
    connect(flare_, &FlarePanel::light_dragged, this, [this](const LightDirection& light) {
        Scene scene = document_.scene();
        scene.light().direction = light;
        document_.edit_scene(scene, tr("move the light"), "light");
    });
    connect(layout_, &LayoutPanel::surface_hovered, prescription_,
            &PrescriptionPanel::set_hovered_row);
    const auto say = [this](const QString& reason) {
        reason.isEmpty() ? banner_->clear("scene") : banner_->show_text("scene", reason);
    };
    connect(scene_bar_, &SceneBar::refused, this, say);
    connect(light_, &LightPanel::refused, this, say);
    connect(layers_, &LayersStrip::refused, this, say);
}

void MainWindow::connect_jobs() {
    connect(jobs_.get(), &Jobs::flare_ready, this, &MainWindow::show_picture);
    connect(jobs_.get(), &Jobs::table_ready, this, [this](const auto& table) {
        ghosts_->set_stop_is_dirty(!document_.lens().stop.dirt.is_clean());
        ghosts_->set_table(table);
        status_->show_table(*table);
    });
    connect(jobs_.get(), &Jobs::table_progress, this, [this](double share) {
        ghosts_->set_refining(share);
        status_->show_progress(share);
    });
    connect(jobs_.get(), &Jobs::failed, this, &MainWindow::show_failure);
    connect(jobs_.get(), &Jobs::settled, this, &MainWindow::settled);
    // The picture is on screen when its frame has been swapped, and only then is it timed.
    if (auto* view = flare_->findChild<QOpenGLWidget*>()) {
        connect(view, &QOpenGLWidget::frameSwapped, this, [this] {
            if (picture_is_on_its_way_ && picture_) {
                picture_is_on_its_way_ = false;
                status_->show_picture(*picture_, flare_->last_upload_ms());
            }
        });
    }
}

void MainWindow::connect_actions() {
    actions_.on("file.quit", [this] { close(); });
    QUndoStack& history = document_.history();
    actions_.on("edit.undo", [&history] { history.undo(); });
    actions_.on("edit.redo", [&history] { history.redo(); });
    const auto name_steps = [this, &history] {
        actions_["edit.undo"].setEnabled(history.canUndo());
        actions_["edit.redo"].setEnabled(history.canRedo());
        actions_["edit.undo"].setText(tr("&Undo %1").arg(history.undoText()));
        actions_["edit.redo"].setText(tr("&Redo %1").arg(history.redoText()));
    };
    connect(&history, &QUndoStack::indexChanged, this, name_steps);
    name_steps();
    actions_.on("view.fit", [this] { layout_->fit(); });
    actions_.on("view.expose", [this] { flare_->auto_expose(); });
    actions_.on("view.reset", [this] { arrange_panels(); });
    QAction& light = actions_["view.light_theme"];
    light.setChecked(current_theme() == Theme::light);
    actions_.on("view.light_theme", [this, &light] {
        const Theme theme = light.isChecked() ? Theme::light : Theme::dark;
        if (remembers_) {
            settings::set_theme(theme);
        }
        apply_theme(*qApp, theme, current_look());
        scene_update_.start();
    });
    connect_absorption();
}

void MainWindow::set_engine(FlareEngine engine) {
    actions_[QStringLiteral("engine.") + engine_name(engine)].setChecked(true);
    jobs_->set_engine(engine);
}

void MainWindow::connect_engines() {
    auto* one_of = new QActionGroup(this);
    for (const FlareEngine engine : {FlareEngine::automatic, FlareEngine::cpu, FlareEngine::gl}) {
        const QString id = QStringLiteral("engine.") + engine_name(engine);
        one_of->addAction(&actions_[id]);
        actions_.on(id, [this, engine] {
            settings::set_flare_engine(engine);
            set_engine(engine);
        });
    }
    connect(jobs_.get(), &Jobs::engine_changed, status_, &StatusLine::show_engine);
    connect(certificate_.get(), &CertificateJob::progressed, status_, &StatusLine::show_proving);
    connect(certificate_.get(), &CertificateJob::certified, status_, &StatusLine::show_proof);
    connect(certificate_.get(), &CertificateJob::withdrawn, status_, &StatusLine::clear_proof);
    set_engine(settings::flare_engine());
}

void MainWindow::connect_absorption() {
    QAction& absorb = actions_["edit.absorption"];
    actions_.on("edit.absorption", [this, &absorb] {
        Prescription lens = document_.lens();
        lens.internal_transmittance = absorb.isChecked();
        document_.edit_lens(
            lens, absorb.isChecked() ? tr("let glasses absorb") : tr("make glass lossless"));
    });
    const auto follow = [this, &absorb] {
        const Prescription& lens = document_.lens();
        const bool is_known = std::ranges::any_of(lens.surfaces, [](const Surface& surface) {
            return !surface.medium_after.transmittance.empty();
        });
        absorb.setChecked(lens.internal_transmittance);
        absorb.setEnabled(is_known || lens.internal_transmittance);
        absorb.setToolTip(is_known
                              ? absorb.statusTip()
                              : tr("No glass of this lens has a table of internal transmittance: "
                                   "open it with a catalogue (AGF) that has one"));
    };
    connect(&document_, &Document::changed, this, follow);
    follow();
}

void MainWindow::connect_reports() {
    connect(report_, &ImportReportPanel::surface_chosen, this, [this](int row) {
        prescription_dock_->show();
        prescription_dock_->raise();
        prescription_->select_surface(row);
    });
    connect(report_, &ImportReportPanel::wants_attention, this, [this] {
        const bool was_hidden = report_dock_->isHidden();
        report_dock_->show();
        report_dock_->raise();
        if (was_hidden && !report_dock_->isFloating()) {
            resizeDocks({report_dock_}, {height() * 22 / 100}, Qt::Vertical);
        }
    });
    connect(files_, &FileActions::exported, report_, &ImportReportPanel::show_export);
    connect(banner_, &Banner::offer_taken, this, [this](const QString& topic) {
        if (topic == "trace") {
            actions_["edit.mend_glass"].trigger();
        }
    });
    const auto offer_mending = [this] {
        actions_["edit.mend_glass"].setEnabled(first_unknown_glass(document_.lens()).has_value());
    };
    connect(&document_, &Document::changed, this, offer_mending);
    offer_mending();
}

void MainWindow::offer_recovery() {
    const auto leftover = Autosave::find_leftover(Autosave::default_folder());
    if (!leftover) {
        return;
    }
    const QString topic = leftover->autosave;
    connect(banner_, &Banner::offer_taken, this, [this, topic, leftover](const QString& taken) {
        if (taken == topic && files_->may_leave()) {
            document_.adopt(leftover->state, leftover->file);
            QFile::remove(topic);
        }
    });
    connect(banner_, &Banner::offer_declined, this, [topic](const QString& declined) {
        if (declined == topic) {
            QFile::remove(topic);
        }
    });
    banner_->show_offer(topic,
                        tr("Unsaved edits of %1 from %2 were found.")
                            .arg(QString::fromStdString(leftover->state.lens.name),
                                 leftover->time.toString("yyyy-MM-dd HH:mm")),
                        tr("Recover"));
}

bool MainWindow::open(const std::filesystem::path& file) { return files_->open(file); }

bool MainWindow::is_settled() const {
    return !jobs_->is_busy() && !scene_update_.isActive() && first_order_->is_settled() &&
           stop_->is_settled() && understanding_->is_settled() && fit_->is_settled() &&
           accuracy_->is_settled();
}

void MainWindow::show_scene() {
    if (document_.is_empty()) {
        layout_->clear();
        return;
    }
    try {
        const Prescription lens = document_.configured_lens();
        layout_->show_lens(lens, document_.scene().light().direction,
                           drawing_wavelength_nm(document_.scene()), selection_.ghosts());
        const double efl_mm = first_order(compile(lens, d_line_nm)).efl_mm;
        flare_->set_light(document_.scene().light().direction, efl_mm);
        flare_->set_other_lights(other_lights(document_.scene()));
    } catch (const Error& error) {
        show_failure(error.what());
    }
}

void MainWindow::show_picture(const FlarePicture& picture) {
    banner_->clear("trace");
    if (begins_lens_) {
        begins_lens_ = picture.is_first_look;  // a better one sets the exposure again
        flare_->begin_lens();
    }
    picture_ = picture;
    picture_is_on_its_way_ = true;
    flare_->show_image(picture.image);
    flare_->set_dimmed(picture.revision != document_.revision());
    if (!flare_->view()->has_gl()) {  // no frame is swapped
        picture_is_on_its_way_ = false;
        status_->show_picture(picture, 0.0);
    }
}

bool MainWindow::show_unknown_glass() {
    const auto row = first_unknown_glass(document_.lens());
    if (!row) {
        return false;
    }
    banner_->show_offer(
        "trace",
        why_unknown(document_.lens(), *row) + tr(" Flare and ghosts follow once it is mended."),
        tr("Choose a glass…"));
    return true;
}

void MainWindow::show_failure(const QString& reason) {
    if (!show_unknown_glass()) {
        banner_->show_text("trace", reason);
    }
    flare_->set_failed();
    ghosts_->set_failed();
}

void MainWindow::show_title() {
    const QString title = document_.title();
    setWindowTitle(title.isEmpty() ? QStringLiteral("Ghostlight") : title + "[*] – Ghostlight");
    setWindowModified(!document_.is_empty() && document_.is_modified());
    setWindowFilePath(QString::fromStdString(document_.file().string()));
}

void MainWindow::place_banner() {
    const QRect around(flare_->mapTo(this, QPoint(0, 0)), flare_->size());
    banner_->set_place(around.adjusted(16, 44, -16, 0));
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!files_->may_leave()) {
        event->ignore();
        return;
    }
    if (remembers_) {
        settings::set_window(saveGeometry(), saveState());
    }
    event->accept();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
    QMainWindow::resizeEvent(event);
    place_banner();
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
    if (watched == flare_ && (event->type() == QEvent::Resize || event->type() == QEvent::Move)) {
        place_banner();
    }
    return QMainWindow::eventFilter(watched, event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    const auto urls = event->mimeData()->urls();
    if (urls.size() == 1 && urls.front().isLocalFile()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event) {
    open(event->mimeData()->urls().front().toLocalFile().toStdString());
}

}  // namespace ghostlight
