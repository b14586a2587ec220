#pragma once

#include <QMainWindow>
#include <QTimer>

#include <filesystem>
#include <memory>
#include <optional>

#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/jobs.h"
#include "widgets/selection.h"

namespace ghostlight {

class AccuracyPanel;
class Autosave;
class Banner;
class CertificateJob;
class CoatingPanel;
class ConfigurationPanel;
class FileActions;
class FirstOrderPanel;
class FitPanel;
class FlarePanel;
class GhostPanel;
class GlassPanel;
class ImportReportPanel;
class LayersStrip;
class LayoutPanel;
class LightPanel;
class PrescriptionPanel;
class SceneBar;
class StatusLine;
class StopPanel;
class Understanding;

/// The workbench: panels around one document. It only puts together; what each part does is in
/// its own file.
class MainWindow : public QMainWindow {
    Q_OBJECT
   public:
    /// `remembers` off: neither settings of the window nor copies of unsaved edits are kept.
    explicit MainWindow(bool remembers = true, MakeGlEngine make_gl = offscreen_gl_engine);
    ~MainWindow() override;

    bool open(const std::filesystem::path& file);
    /// For a start without a lens: the first time a bundled one is opened, and the tour begins.
    void welcome();
    /// What flares are drawn with, until it is chosen anew; not kept.
    void set_engine(FlareEngine engine);
    /// All panels where they were at first, in proportion to the window.
    void arrange_panels();
    /// Shows the panel of a study and begins it: "fit" (as the lens has it set up), "accuracy" or
    /// "plan"; false for another name.
    bool begin_study(const QString& name);
    /// True when the views show the document as it is, and no study is under way.
    bool is_settled() const;

    Document& document() { return document_; }
    Selection& selection() { return selection_; }
    Actions& actions() { return actions_; }
    Jobs& jobs() { return *jobs_; }
    FileActions& files() { return *files_; }
    Banner& banner() { return *banner_; }
    SceneBar& scene_bar() { return *scene_bar_; }
    StatusLine& status_line() { return *status_; }
    PrescriptionPanel& prescription_panel() { return *prescription_; }
    LayoutPanel& layout_panel() { return *layout_; }
    FlarePanel& flare_panel() { return *flare_; }
    GhostPanel& ghost_panel() { return *ghosts_; }
    ImportReportPanel& import_report_panel() { return *report_; }
    FirstOrderPanel& first_order_panel() { return *first_order_; }
    StopPanel& stop_panel() { return *stop_; }
    LightPanel& light_panel() { return *light_; }
    LayersStrip& layers_strip() { return *layers_; }
    Understanding& understanding() { return *understanding_; }
    CoatingPanel& coating_panel() { return *coating_; }
    ConfigurationPanel& configuration_panel() { return *configurations_; }
    GlassPanel& glass_panel() { return *glasses_; }
    FitPanel& fit_panel() { return *fit_; }
    AccuracyPanel& accuracy_panel() { return *accuracy_; }
    const std::optional<FlarePicture>& picture() const { return picture_; }

   Q_SIGNALS:
    void settled();

   protected:
    void closeEvent(QCloseEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

   private:
    void build_panels();
    void build_menus();
    void build_studies();
    void connect_studies();
    void arrange_studies();
    void connect_document();
    void connect_jobs();
    void connect_actions();
    void connect_engines();
    void connect_absorption();
    void connect_reports();
    /// Coatings, configurations and glasses: main_window_editing.cpp.
    void build_editing();
    void arrange_editing();
    void connect_editing();
    void offer_recovery();
    /// Help, commands, tour, gallery, keyboard and looks: main_window_guidance.cpp.
    void connect_guidance();
    void connect_looks();
    void show_guide();
    void show_commands();
    void show_gallery();
    void go_to_panel(int step);
    void show_scene();
    void show_picture(const FlarePicture& picture);
    void show_failure(const QString& reason);
    /// Says which glass is not known, with the way to mend it; false if all are.
    bool show_unknown_glass();
    void show_title();
    void place_banner();
    QDockWidget* add_dock(QWidget* panel, const char* name, const QString& title,
                          Qt::DockWidgetArea area);

    bool remembers_;
    Document document_;
    Selection selection_;
    Actions actions_;
    std::unique_ptr<Jobs> jobs_;
    std::unique_ptr<CertificateJob> certificate_;
    std::unique_ptr<Autosave> autosave_;

    SceneBar* scene_bar_ = nullptr;
    PrescriptionPanel* prescription_ = nullptr;
    LayoutPanel* layout_ = nullptr;
    FlarePanel* flare_ = nullptr;
    GhostPanel* ghosts_ = nullptr;
    ImportReportPanel* report_ = nullptr;
    FirstOrderPanel* first_order_ = nullptr;
    StopPanel* stop_ = nullptr;
    LightPanel* light_ = nullptr;
    LayersStrip* layers_ = nullptr;
    CoatingPanel* coating_ = nullptr;
    ConfigurationPanel* configurations_ = nullptr;
    GlassPanel* glasses_ = nullptr;
    StatusLine* status_ = nullptr;
    Banner* banner_ = nullptr;
    FileActions* files_ = nullptr;
    QDockWidget* prescription_dock_ = nullptr;
    QDockWidget* layout_dock_ = nullptr;
    QDockWidget* ghost_dock_ = nullptr;
    QDockWidget* report_dock_ = nullptr;
    QDockWidget* first_order_dock_ = nullptr;
    QDockWidget* stop_dock_ = nullptr;
    QDockWidget* light_dock_ = nullptr;
    QDockWidget* coating_dock_ = nullptr;
    QDockWidget* configuration_dock_ = nullptr;
    QDockWidget* glass_dock_ = nullptr;

    std::unique_ptr<Understanding> understanding_;

    FitPanel* fit_ = nullptr;
    AccuracyPanel* accuracy_ = nullptr;
    QDockWidget* fit_dock_ = nullptr;
    QDockWidget* accuracy_dock_ = nullptr;

    QTimer scene_update_;  ///< many changes, one drawing
    std::optional<FlarePicture> picture_;
    bool picture_is_on_its_way_ = false;
    bool begins_lens_ = false;
};

}  // namespace ghostlight
