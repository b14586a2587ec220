#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace ghostlight {

/// Number of threads used when a caller asks for 0: all that the machine offers.
unsigned default_thread_count();

/// Calls work(index) for every index in [0, count) on `threads` threads (0 = all cores), in no
/// particular order, each index once. Results must go to places of their own, so that nothing
/// depends on the number of threads. Returns false if `stop` was requested before all were done
/// (work already begun is finished). The first exception thrown by `work` is rethrown here.
bool parallel_for(std::size_t count, unsigned threads, std::stop_token stop,
                  const std::function<void(std::size_t index)>& work);

}  // namespace ghostlight
