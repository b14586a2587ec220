#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace ghostlight {

/// A thread that works on the newest request: one that waits is replaced by a newer one, and the
/// one in work is asked to stop. The work decides what of it cannot be interrupted.
template <class Request>
class NewestJob {
   public:
    /// Runs on the job's own thread and must not throw.
    using Work = std::function<void(const Request& request, std::stop_token stop)>;

    /// `at_end` is called last on that thread: for what has to go where it was made.
    explicit NewestJob(Work work, std::function<void()> at_end = {})
        : work_(std::move(work)),
          at_end_(std::move(at_end)),
          thread_([this](std::stop_token end) { run(end); }) {}
    ~NewestJob() {
        cancel();
        thread_.request_stop();
    }
    NewestJob(const NewestJob&) = delete;
    NewestJob& operator=(const NewestJob&) = delete;

    void submit(Request request) {
        const std::lock_guard lock(mutex_);
        waiting_ = std::move(request);
        current_.request_stop();
        wake_.notify_one();
    }
    void cancel() {
        const std::lock_guard lock(mutex_);
        waiting_.reset();
        current_.request_stop();
    }

   private:
    void run(const std::stop_token& end) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, end, [this] { return waiting_.has_value(); })) {
            const Request request = *std::exchange(waiting_, std::nullopt);
            current_ = std::stop_source();
            const std::stop_token stop = current_.get_token();
            lock.unlock();
            work_(request, stop);
            lock.lock();
        }
        if (at_end_) at_end_();
    }

    Work work_;
    std::function<void()> at_end_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<Request> waiting_;
    std::stop_source current_;
    std::jthread thread_;  // last: it uses all the others
};

}  // namespace ghostlight
