// SPDX-License-Identifier: MIT
// Test data stored outside the repository. Tests that need it are reported as skipped if it is absent.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace tspace::test {

/// Returns the path of a file or folder in the shared test data.
inline std::filesystem::path shared(const std::string& relative) {
    return std::filesystem::path(TSPACE_SHARED_DIR) / relative;
}

}  // namespace tspace::test

/// Skips the current test if the shared data does not contain `relative`.
#define TSPACE_NEEDS_SHARED(relative)                                                    \
    if (!std::filesystem::exists(tspace::test::shared(relative))) {                      \
        GTEST_SKIP() << "test data " << tspace::test::shared(relative) << " is missing"; \
    }                                                                                    \
    static_assert(true)
