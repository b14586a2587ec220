#include "widgets/blocking_trace.h"

#include <QEvent>
#include <QMetaEnum>
#include <QThread>

#include <cstdio>
#include <ctime>
#include <utility>

namespace ghostlight {

namespace {

using Clock = std::chrono::steady_clock;

/// This thread's alone; 0 where the system does not say.
double processor_time_ms() {
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0) {
        return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
    }
#endif
    return 0.0;
}

QString name_of(const QObject& object) {
    QString name = object.metaObject()->className();
    if (const qsizetype scope = name.lastIndexOf("::"); scope >= 0) {
        name.remove(0, scope + 2);
    }
    if (!object.objectName().isEmpty()) {
        name += " '" + object.objectName() + "'";
    }
    return name;
}

/// Taken before the event is handled: its receiver may be gone afterwards.
QString description(const QObject& receiver, const QEvent& event) {
    const char* type = QMetaEnum::fromType<QEvent::Type>().valueToKey(event.type());
    QString text = type != nullptr ? QString(type) : QString::number(event.type());
    text += " to " + name_of(receiver);
    if (receiver.parent() != nullptr) {  // a timer alone says little
        text += " of " + name_of(*receiver.parent());
    }
    return text;
}

}  // namespace

TracedApplication::TracedApplication(int& argc, char** argv) : QApplication(argc, argv) {
    trace_as_asked();
}

void TracedApplication::trace_as_asked() {
    constexpr const char* variable = "GHOSTLIGHT_TRACE_BLOCKING";
    bool is_number = false;
    const double least_ms = qEnvironmentVariable(variable).toDouble(&is_number);
    trace(is_number && least_ms > 0.0 ? least_ms : default_least_ms,
          qEnvironmentVariableIsSet(variable) ? Report(print) : Report());
}

void TracedApplication::trace(double least_ms, Report report) {
    least_ms_ = least_ms;
    report_ = std::move(report);
}

void TracedApplication::print(const BlockedFor& blocked) {
    std::fprintf(stderr, "ghostlight: blocked for %.0f ms (%.0f ms of processor time): %s\n",
                 blocked.wall_ms, blocked.processor_ms, qPrintable(blocked.event));
}

bool TracedApplication::notify(QObject* receiver, QEvent* event) {
    if (!report_ || receiver == nullptr || QThread::currentThread() != thread()) {
        return QApplication::notify(receiver, event);
    }
    const int loop_level = thread()->loopLevel();
    if (!under_way_.empty() && under_way_.back().loop_level == loop_level) {
        return QApplication::notify(receiver, event);  // part of the event under way
    }
    if (!under_way_.empty()) {
        under_way_.back().waited = true;
    }
    const QString text = description(*receiver, *event);
    const double processor_begin_ms = processor_time_ms();
    const Clock::time_point begin = Clock::now();
    under_way_.push_back({loop_level, false});
    const bool handled = QApplication::notify(receiver, event);
    const bool waited = under_way_.back().waited;
    under_way_.pop_back();
    const double wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    if (!waited && wall_ms >= least_ms_) {
        report_({text, wall_ms, processor_time_ms() - processor_begin_ms});
    }
    return handled;
}

}  // namespace ghostlight
