#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"
#include "widgets/newest_job.h"

class QGridLayout;
class QLabel;
class QLineEdit;
class QStackedWidget;
class QToolButton;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class PanelHeader;
struct StopPictures;

/// The stop: its blades, its image and its dirt, each with unit, range and reset; above them the
/// opening and the starburst that it makes, worked out on another thread.
class StopPanel : public QWidget {
    Q_OBJECT
   public:
    StopPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);
    ~StopPanel() override;

    /// "f_number", "blades", "curvature", "rotation", "image", "dust", "dust_smallest",
    /// "dust_largest", "scratches", "scratch_thinnest", "scratch_widest", "fingerprint", "seed".
    QLineEdit& editor(const QString& name) const;
    QToolButton& reset_button(const QString& name) const;
    /// Why the last entry was not taken, or why there is no starburst; empty otherwise.
    QString reason() const { return reason_; }
    /// What blades and dirt come to, a line each.
    QString statistics() const;
    const QImage& opening() const { return opening_; }
    const QImage& starburst() const { return starburst_; }
    /// The pictures are those of the document as it is.
    bool is_settled() const { return !delay_.isActive() && shown_serial_ == serial_; }
    /// Lays an image over the stop; false, with the reason shown, if it is none.
    bool take_image(const QString& file);

   protected:
    /// Arrow keys and, in the field in hand, the wheel.
    bool eventFilter(QObject* watched, QEvent* event) override;
    void showEvent(QShowEvent* event) override;

   private:
    /// How far a number goes at a time: by a ratio where there is one, else by a difference, which
    /// also takes it off 0.
    struct Stride {
        double by = 0.0;
        double ratio = 1.0;
    };
    struct Row {
        QString name;
        QLineEdit* editor;
        QToolButton* reset;
        Stride stride;
        std::function<QString(const Prescription&)> text;
        std::function<void(Prescription&, const QString&)> read;  ///< throws Error
        std::function<void(Prescription&)> clear;                 ///< back to the usual value
    };
    struct Request {
        Prescription lens;
        Spectrum spectrum;
        std::uint64_t serial = 0;
    };

    void add_rows(QGridLayout& grid);
    void add_row(QGridLayout& grid, const QString& name, const QString& label, const QString& unit,
                 const QString& tip, Stride stride, std::function<QString(const Stop&)> text,
                 std::function<void(Stop&, const QString&)> read, std::function<void(Stop&)> clear);
    void add_lens_row(QGridLayout& grid, const QString& label, const QString& unit,
                      const QString& tip, Row row);
    void add_f_number_row(QGridLayout& grid);
    /// So many strides up, while a hand drags, turns or presses; what is out of range stays.
    void step(const Row& row, int steps);
    void add_image_row(QGridLayout& grid);
    void enter(const Row& row, const QString& text);
    void take(const Row& row, const QString& text);
    void change(const QString& what, const QString& field,
                const std::function<void(Prescription&)>& edit);
    void follow_document();
    void request();
    void work_on(const Request& request, const std::stop_token& stop);
    void show_pictures(const StopPictures& shown, std::uint64_t serial);
    void show_reason(const QString& reason);

    Document& document_;
    PanelHeader* header_;
    EmptyState* empty_;
    QStackedWidget* pages_;
    QLabel* opening_label_;
    QLabel* starburst_label_;
    QLabel* reason_label_;
    QLabel* statistics_label_;
    std::vector<Row> rows_;
    QTimer delay_;  ///< many changes, one calculation
    Prescription asked_;
    Spectrum asked_spectrum_;
    QImage opening_, starburst_;
    QString reason_;
    std::uint64_t serial_ = 0;
    std::uint64_t shown_serial_ = 0;
    std::unique_ptr<NewestJob<Request>> job_;
};

}  // namespace ghostlight
