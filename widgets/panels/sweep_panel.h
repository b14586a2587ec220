#pragma once

#include <QWidget>

#include <memory>
#include <vector>

#include "core/flare/ghost_sweep.h"
#include "widgets/document.h"
#include "widgets/newest_job.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QToolButton;

namespace ghostlight {

class PanelHeader;
class Selection;
class SweepView;

/// Runs one number of the lens or the light through a range, off the GUI thread, point by point.
class SweepPanel : public QWidget {
    Q_OBJECT
   public:
    SweepPanel(Document& document, Selection& selection, QWidget* parent = nullptr);
    ~SweepPanel() override;

    SweepView& view() { return *view_; }
    bool is_running() const { return running_; }
    /// What is wrong with what was asked for; empty if nothing is.
    QString problem() const;
    void start();
    void stop();
    /// The sweep's rows as CSV.
    QString csv() const;

   private:
    struct Wanted {
        Prescription lens;
        SweepRequest request;
        std::uint64_t serial = 0;
    };
    void suggest_range();
    void work(const Wanted& wanted, const std::stop_token& stop);
    void take(SweepPoint point, std::uint64_t serial);
    void finish(std::uint64_t serial);
    void show_state();
    void show_problem(const QString& problem);
    void go_to(double value);
    void export_csv();

    Document& document_;
    Selection& selection_;
    PanelHeader* header_;
    QComboBox* parameter_;
    QLineEdit* from_;
    QLineEdit* to_;
    QLineEdit* count_;
    QComboBox* quantity_;
    QToolButton* run_;
    QToolButton* export_;
    QLabel* problem_;
    SweepView* view_;
    SweepParameter swept_;
    std::vector<SweepPoint> points_;
    std::size_t wanted_ = 0;
    std::size_t surface_count_ = 0;
    std::uint64_t serial_ = 0;
    std::uint64_t revision_ = 0;  ///< of the document, that the points belong to
    bool running_ = false;
    std::unique_ptr<NewestJob<Wanted>> job_;
};

}  // namespace ghostlight
