#pragma once

#include <QTimer>
#include <QWidget>

#include <cstdint>
#include <memory>
#include <vector>

#include "core/io/lens_quantities.h"
#include "core/optics/prescription.h"
#include "widgets/newest_job.h"

class QStackedWidget;
class QTableView;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class PanelHeader;
class QuantityModel;

/// First-order data of the lens in its configuration, at the d line. A zoom's take a tenth of a
/// second, for the real rays to the sensor's edges: another thread works them out, and until then
/// the numbers that stand are dimmed.
class FirstOrderPanel : public QWidget {
    Q_OBJECT
   public:
    FirstOrderPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);
    ~FirstOrderPanel() override;

    QuantityModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    QString state() const;
    /// Why there are no numbers; empty while there are.
    QString reason() const { return reason_; }
    /// The numbers are those of the document as it is.
    bool is_settled() const { return !delay_.isActive() && shown_serial_ == serial_; }
    void copy_rows() const;

   private:
    struct Request {
        Prescription lens;
        std::uint64_t serial = 0;
    };
    void request();
    void work_on(const Request& request);
    void show_quantities(std::vector<LensQuantity> quantities, std::uint64_t serial);
    void show_reason(const QString& reason, std::uint64_t serial);

    Document& document_;
    QuantityModel* model_;
    PanelHeader* header_;
    QTableView* table_;
    EmptyState* empty_;
    EmptyState* cannot_;
    QStackedWidget* pages_;
    QTimer delay_;  ///< many changes, one calculation
    Prescription asked_;
    std::uint64_t serial_ = 0;
    std::uint64_t shown_serial_ = 0;
    QString reason_;
    std::unique_ptr<NewestJob<Request>> job_;
};

}  // namespace ghostlight
