#pragma once

#include <chrono>

namespace ghostlight {

using Clock = std::chrono::steady_clock;

/// Wall time since a moment, ms.
inline double ms_since(Clock::time_point began) {
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

}  // namespace ghostlight
