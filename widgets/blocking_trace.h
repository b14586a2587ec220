#pragma once

#include <QApplication>
#include <QString>

#include <chrono>
#include <functional>
#include <vector>

namespace ghostlight {

/// What held up the event loop: one event, from its delivery until its handlers were done.
struct BlockedFor {
    QString event;              ///< "MouseButtonPress to FlareView 'flare'"
    double wall_ms = 0.0;       ///< what a person waited
    double processor_ms = 0.0;  ///< of this thread alone: what the wait is on an idle machine
};

/// The application, telling which events took longer to handle than a window may stand still
/// (tests and `ghostlight --trace-blocking`). Events handled in a loop of their own (a menu, a
/// dialog) count for themselves, not for the event that opened it.
class TracedApplication : public QApplication {
   public:
    using Report = std::function<void(const BlockedFor&)>;

    /// Longest time that a person does not notice, and the least that is reported.
    static constexpr double default_least_ms = 50.0;

    TracedApplication(int& argc, char** argv);

    /// As the variable GHOSTLIGHT_TRACE_BLOCKING asks: where it is set, to standard error, from the
    /// number of milliseconds that it holds, or from 50. So it is from the start.
    void trace_as_asked();

    /// From here on, or no longer where `report` is empty.
    void trace(double least_ms, Report report);
    /// As one line on standard error.
    static void print(const BlockedFor& blocked);

    bool notify(QObject* receiver, QEvent* event) override;

   private:
    struct Delivery {
        int loop_level = 0;
        bool waited = false;  ///< another loop ran within
    };

    double least_ms_ = default_least_ms;
    Report report_;
    std::vector<Delivery> under_way_;
};

}  // namespace ghostlight
