#pragma once

#include <QByteArray>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

#include "widgets/comparison.h"
#include "widgets/probe_job.h"

class QDockWidget;
class QMainWindow;

namespace ghostlight {

class Actions;
class CheckPanel;
class FlarePanel;
class GhostPanel;
class LayoutPanel;
class PrescriptionPanel;
class Selection;
class SweepPanel;

/// What helps to understand a lens's flare, tied to the window's parts: ghosts under the cursor,
/// the pinned lens, looks of the flare and the layout, sweeps and findings.
class Understanding : public QObject {
    Q_OBJECT
   public:
    struct Parts {
        QMainWindow& window;
        Document& document;
        Selection& selection;
        Actions& actions;
        PrescriptionPanel& prescription;
        LayoutPanel& layout;
        FlarePanel& flare;
        GhostPanel& ghosts;
        bool remembers;  ///< switches are kept between runs
        /// Makes a dock at the bottom: panel, object's name, title.
        std::function<QDockWidget*(QWidget*, const char*, const QString&)> add_dock;
    };
    explicit Understanding(Parts parts);
    ~Understanding() override;

    /// The two panels behind another one at the bottom, hidden.
    void arrange(QDockWidget* beside);
    bool is_settled() const;
    Comparison& comparison() { return *comparison_; }
    CheckPanel& check_panel() { return *check_; }
    SweepPanel& sweep_panel() { return *sweep_; }
    QDockWidget* check_dock() const { return check_dock_; }
    QDockWidget* sweep_dock() const { return sweep_dock_; }

   private:
    void connect_probe();
    void connect_comparison();
    void connect_looks();
    void connect_panels();
    void show_answer(const ProbeJob::Purpose& purpose, const ProbedPixel& pixel);
    void pick(const ProbedPixel& pixel, bool adds);
    void set_full_screen(bool on);

    Parts parts_;
    std::unique_ptr<ProbeJob> probe_;
    std::unique_ptr<Comparison> comparison_;
    CheckPanel* check_ = nullptr;
    SweepPanel* sweep_ = nullptr;
    QDockWidget* check_dock_ = nullptr;
    QDockWidget* sweep_dock_ = nullptr;
    QTimer blink_;
    QByteArray before_full_screen_;
};

}  // namespace ghostlight
