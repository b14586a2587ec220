#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace ghostlight {

/// The Error that `work` throws; a failed test when it throws none.
template <typename Work>
Error::Parts error_of(Work work) {
    try {
        work();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "not one line";
        return error.parts();
    }
    ADD_FAILURE() << "no Error was thrown";
    return {};
}

}  // namespace ghostlight
