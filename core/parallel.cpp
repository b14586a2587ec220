#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ghostlight {

unsigned default_thread_count() { return std::max(1U, std::thread::hardware_concurrency()); }

bool parallel_for(std::size_t count, unsigned threads, std::stop_token stop,
                  const std::function<void(std::size_t index)>& work) {
    if (threads == 0) threads = default_thread_count();
    threads = static_cast<unsigned>(std::min<std::size_t>(threads, count));
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr failure;
    std::mutex failure_guard;
    auto run = [&] {
        while (!stop.stop_requested() && !failed) {
            const std::size_t index = next++;
            if (index >= count) return;
            try {
                work(index);
            } catch (...) {
                const std::lock_guard lock(failure_guard);
                if (!failure) failure = std::current_exception();
                failed = true;
            }
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(run);
        run();
    }
    if (failure) std::rethrow_exception(failure);
    return next >= count;
}

}  // namespace ghostlight
