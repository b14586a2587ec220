#pragma once

#include <QWidget>

#include <cstdint>
#include <memory>
#include <optional>

#include "core/flare/veiling_index.h"
#include "widgets/newest_job.h"

class QPushButton;

namespace ghostlight {

class Document;
class TabularLabel;

/// The lens's veiling glare index, worked out on request on another thread; gone with any change
/// of the lens.
class VeilingStrip : public QWidget {
    Q_OBJECT
   public:
    explicit VeilingStrip(Document& document, QWidget* parent = nullptr);
    ~VeilingStrip() override;

    const std::optional<VeilingIndex>& index() const { return index_; }
    QString text() const;
    QPushButton& button() { return *button_; }
    bool is_busy() const { return busy_; }

   private:
    struct Request {
        Prescription lens;
        std::uint64_t serial = 0;
    };
    void toggle();
    void withdraw();
    void work_on(const Request& request, const std::stop_token& stop);
    void show_state();

    Document& document_;
    TabularLabel* label_;
    QPushButton* button_;
    std::optional<VeilingIndex> index_;
    QString reason_;
    Prescription asked_;
    std::uint64_t serial_ = 0;
    bool busy_ = false;
    int percent_ = 0;
    std::unique_ptr<NewestJob<Request>> job_;
};

}  // namespace ghostlight
