#include "widgets/understanding.h"

#include <QActionGroup>
#include <QDockWidget>
#include <QFileDialog>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QTableView>
#include <QToolBar>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "widgets/actions.h"
#include "widgets/flare_view.h"
#include "widgets/ghost_colors.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/prescription_model.h"
#include "widgets/number_text.h"
#include "widgets/panels/check_panel.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/layout_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/sweep_panel.h"
#include "widgets/selection.h"
#include "widgets/settings.h"

namespace ghostlight {

namespace {

constexpr int blink_ms = 600;
constexpr std::size_t named_ghosts = 6;  // in the readout beside the cursor

/// The prescription's column of a cell; −1 for the lens as a whole.
int column_of(LensCell cell) {
    switch (cell) {
        case LensCell::curve:
            return PrescriptionModel::radius;
        case LensCell::asphere:
            return PrescriptionModel::aspheric;
        case LensCell::thickness:
            return PrescriptionModel::thickness;
        case LensCell::medium:
            return PrescriptionModel::medium;
        case LensCell::semi_diameter:
            return PrescriptionModel::semi_diameter;
        case LensCell::coating:
            return PrescriptionModel::coating;
        case LensCell::whole:
            break;
    }
    return -1;
}

void go_to_cell(PrescriptionPanel& panel, int row, LensCell cell) {
    panel.select_surface(row);
    auto* table = panel.findChild<QTableView*>();
    if (table == nullptr || table->model() == nullptr) {
        return;
    }
    const int column = column_of(cell);
    if (column >= 0 && !table->isColumnHidden(column)) {
        const QModelIndex index = table->model()->index(row, column);
        table->setCurrentIndex(index);
        table->scrollTo(index);
    }
    table->setFocus();
}

}  // namespace

Understanding::Understanding(Parts parts)
    : parts_(std::move(parts)),
      probe_(std::make_unique<ProbeJob>(parts_.document)),
      comparison_(std::make_unique<Comparison>(parts_.document)),
      check_(new CheckPanel(parts_.document, parts_.selection)),
      sweep_(new SweepPanel(parts_.document, parts_.selection)) {
    check_dock_ = parts_.add_dock(check_, "check", tr("Check"));
    sweep_dock_ = parts_.add_dock(sweep_, "sweep", tr("Sweep"));
    blink_.setInterval(blink_ms);
    connect_probe();
    connect_comparison();
    connect_looks();
    connect_panels();
}

Understanding::~Understanding() = default;

void Understanding::arrange(QDockWidget* beside) {
    parts_.window.tabifyDockWidget(beside, check_dock_);
    parts_.window.tabifyDockWidget(check_dock_, sweep_dock_);
    check_dock_->hide();
    sweep_dock_->hide();
}

bool Understanding::is_settled() const {
    return check_->is_settled() && !comparison_->is_busy() && !sweep_->is_running();
}

void Understanding::connect_probe() {
    FlareView* view = parts_.flare.view();
    connect(view, &FlareView::rested, this, [this](glm::dvec2 point_mm) {
        probe_->ask({point_mm, false, false});
    });
    connect(view, &FlareView::picked, this, [this](glm::dvec2 point_mm, bool adds) {
        probe_->ask({point_mm, true, adds});
    });
    connect(probe_.get(), &ProbeJob::answered, this, &Understanding::show_answer);
}

void Understanding::show_answer(const ProbeJob::Purpose& purpose, const ProbedPixel& pixel) {
    const std::size_t surface_count = parts_.document.lens().surfaces.size();
    std::vector<ReadoutLine> lines;
    for (const GhostInPixel& ghost : pixel.ghosts) {
        if (lines.size() == named_ghosts && pixel.ghosts.size() > named_ghosts + 1) {
            lines.push_back({tr("%1 more").arg(pixel.ghosts.size() - named_ghosts), {}, {}});
            break;
        }
        lines.push_back({QString::fromStdString(name(ghost.path, surface_count)),
                         significant(100.0 * ghost.share, 3) + " %", ghost_color(ghost.path)});
    }
    parts_.flare.view()->set_probe(purpose.point_mm, std::move(lines));
    if (purpose.picks) {
        pick(pixel, purpose.adds);
    }
}

void Understanding::pick(const ProbedPixel& pixel, bool adds) {
    std::vector<GhostPath> wanted;
    if (adds) {
        wanted = parts_.selection.ghosts();
    }
    if (!pixel.ghosts.empty()) {
        // A second click at the same place takes the next of the ghosts there.
        std::size_t next = 0;
        const auto& chosen = parts_.selection.ghosts();
        for (std::size_t k = 0; k < pixel.ghosts.size(); ++k) {
            if (chosen.size() == 1 && chosen.front() == pixel.ghosts[k].path) {
                next = adds ? k : (k + 1) % pixel.ghosts.size();
            }
        }
        const GhostPath& path = pixel.ghosts[next].path;
        if (std::ranges::find(wanted, path) == wanted.end()) {
            wanted.push_back(path);
        }
    }
    parts_.selection.set_ghosts(std::move(wanted));
}

void Understanding::connect_comparison() {
    Actions& actions = parts_.actions;
    FlareView* view = parts_.flare.view();
    actions.on("compare.pin", [this] { comparison_->pin(); });
    actions.on("compare.unpin", [this] { comparison_->unpin(); });
    actions.on("compare.restore", [this] {
        if (comparison_->pinned()) {
            parts_.document.edit_lens(comparison_->pinned()->lens, tr("take the pinned lens back"));
        }
    });
    actions["compare.split"].setChecked(true);
    const auto show = [this, view, &actions] {
        const bool blinks = actions["compare.blink"].isChecked() && view->compares();
        view->set_split(!blinks && actions["compare.split"].isChecked());
        blinks ? blink_.start() : blink_.stop();
        if (!blinks) {
            view->set_showing_a(false);
        }
    };
    connect(&blink_, &QTimer::timeout, this,
            [view] { view->set_showing_a(!view->is_showing_a()); });
    actions.on("compare.split", [show, &actions] {
        if (actions["compare.split"].isChecked()) {
            actions["compare.blink"].setChecked(false);
        }
        show();
    });
    actions.on("compare.blink", [show] { show(); });
    const auto follow = [this, &actions] {
        const bool pinned = comparison_->is_pinned();
        for (const char* id :
             {"compare.unpin", "compare.restore", "compare.split", "compare.blink"}) {
            actions[id].setEnabled(pinned);
        }
    };
    connect(comparison_.get(), &Comparison::pinned_changed, this, follow);
    follow();
    connect(comparison_.get(), &Comparison::picture_ready, this,
            [view, show](const std::shared_ptr<const FlareImage>& image) {
                view->set_compared(image);
                show();
            });
    connect(comparison_.get(), &Comparison::table_ready, this,
            [this](const std::shared_ptr<const GhostTable>& table) {
                parts_.ghosts.set_before(table);
            });
}

void Understanding::connect_looks() {
    Actions& actions = parts_.actions;
    FlareView* view = parts_.flare.view();
    // A switch keeps its place between runs.
    const auto connect_switch = [&](const char* id, bool otherwise, std::function<void(bool)> set) {
        QAction& action = actions[id];
        action.setChecked(parts_.remembers ? settings::is_on(id, otherwise) : otherwise);
        set(action.isChecked());
        connect(&action, &QAction::toggled, this, [this, id, set](bool on) {
            if (parts_.remembers) {
                settings::set_on(id, on);
            }
            set(on);
        });
    };
    connect_switch("flare.false_color", false, [view](bool on) { view->set_false_color(on); });
    connect_switch("flare.clipping", false, [view](bool on) { view->set_mark_clipping(on); });
    LayoutPanel* layout = &parts_.layout;
    connect_switch("layout.fields", false, [layout](bool on) { layout->set_several_fields(on); });
    connect_switch("layout.marks", false, [layout](bool on) { layout->set_marks(on); });
    connect_switch("layout.stopped", false, [layout](bool on) { layout->set_stopped_rays(on); });
    connect(&actions["layout.measure"], &QAction::toggled, layout, &LayoutPanel::set_measuring);
    actions.on("layout.export", [this, layout] {
        const QString file =
            QFileDialog::getSaveFileName(&parts_.window, tr("Export the Layout"), "layout.svg",
                                         tr("Drawings (*.svg *.pdf *.png)"));
        if (!file.isEmpty()) {
            layout->export_to(file);
        }
    });
    auto* tones = new QActionGroup(this);
    const std::array<std::pair<const char*, ToneCurve>, 3> curves = {
        {{"tone.soft", ToneCurve::soft},
         {"tone.linear", ToneCurve::linear},
         {"tone.log", ToneCurve::log}}};
    actions["tone.soft"].setChecked(true);
    for (const auto& [id, curve] : curves) {
        tones->addAction(&actions[id]);
        actions.on(id, [view, curve = curve] { view->set_tone(curve); });
    }
    connect(&actions["flare.full_screen"], &QAction::toggled, this,
            &Understanding::set_full_screen);
}

void Understanding::set_full_screen(bool on) {
    QMainWindow& window = parts_.window;
    const bool is_on = !before_full_screen_.isEmpty();
    if (on == is_on) {
        return;
    }
    if (on) {
        before_full_screen_ = window.saveState();
        for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
            dock->hide();
        }
        for (QToolBar* bar : window.findChildren<QToolBar*>()) {
            bar->hide();
        }
        window.menuBar()->hide();
        window.statusBar()->hide();
        window.showFullScreen();
        return;
    }
    window.showNormal();
    window.menuBar()->show();
    window.statusBar()->show();
    window.restoreState(before_full_screen_);
    before_full_screen_.clear();
}

void Understanding::connect_panels() {
    // A list needs less of the window than flares above curves.
    constexpr int percent_of_list = 22, percent_of_sweep = 34;
    const auto bring = [this](QDockWidget* dock, int percent) {
        const bool was_hidden = dock->isHidden();
        dock->show();
        dock->raise();
        if (was_hidden && !dock->isFloating()) {
            parts_.window.resizeDocks({dock}, {parts_.window.height() * percent / 100},
                                      Qt::Vertical);
        }
    };
    parts_.actions.on("sweep.run", [this, bring] {
        bring(sweep_dock_, percent_of_sweep);
        sweep_->start();
    });
    parts_.actions.on("check.show", [this, bring] { bring(check_dock_, percent_of_list); });
    connect(check_, &CheckPanel::cell_chosen, this,
            [this](int row, LensCell cell) { go_to_cell(parts_.prescription, row, cell); });
    connect(&parts_.ghosts, &GhostPanel::surface_chosen, this,
            [this](int row) { go_to_cell(parts_.prescription, row, LensCell::coating); });
    connect(check_, &CheckPanel::counted, this, [this](int grave) {
        check_dock_->setWindowTitle(grave > 0 ? tr("Check (%1)").arg(grave) : tr("Check"));
    });
}

}  // namespace ghostlight
