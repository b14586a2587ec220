#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace ghostlight {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
    for (const unsigned threads : {0U, 1U, 2U, 7U, 64U})
        for (const std::size_t count :
             {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{1000}}) {
            std::vector<std::atomic<int>> visits(count);
            EXPECT_TRUE(parallel_for(count, threads, {}, [&](std::size_t i) { ++visits[i]; }));
            for (const auto& v : visits) EXPECT_EQ(v, 1);
        }
}

TEST(Parallel, ThereIsAlwaysAThread) { EXPECT_GE(default_thread_count(), 1U); }

TEST(Parallel, StopEndsItAfterTheWorkBegun) {
    std::stop_source source;
    std::atomic<int> done{0};
    EXPECT_FALSE(parallel_for(1000, 3, source.get_token(), [&](std::size_t) {
        if (++done == 10) source.request_stop();
    }));
    EXPECT_LE(done, 13);
    EXPECT_FALSE(parallel_for(5, 2, source.get_token(), [&](std::size_t) { ADD_FAILURE(); }));
}

TEST(Parallel, StopAfterTheLastIsTooLate) {
    std::stop_source source;
    EXPECT_TRUE(
        parallel_for(1, 1, source.get_token(), [&](std::size_t) { source.request_stop(); }));
}

TEST(Parallel, ExceptionsComeBackToTheCaller) {
    for (const unsigned threads : {1U, 4U}) {
        std::atomic<int> done{0};
        EXPECT_THROW(parallel_for(1000, threads, {},
                                  [&](std::size_t i) {
                                      ++done;
                                      if (i == 3) throw std::runtime_error("three");
                                  }),
                     std::runtime_error);
        EXPECT_LT(done, 1000);
    }
}

}  // namespace
}  // namespace ghostlight
