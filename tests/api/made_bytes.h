// SPDX-License-Identifier: MIT
// Results of calls of the C file API.
#pragma once

#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "support/report_schema.h"
#include "tspace/tspace_files.h"

namespace tspace::test {

/// Owns bytes of the library, and frees them.
struct Made {
    tspace_Bytes bytes = {};
    Made() = default;
    Made(const Made&) = delete;
    Made& operator=(const Made&) = delete;
    ~Made() { tspace_destroyBytes(&bytes); }
    [[nodiscard]] std::string text() const {
        const std::string text(reinterpret_cast<const char*>(bytes.data), bytes.size);
        EXPECT_EQ(reportFaults(text), "");
        return text;
    }
    [[nodiscard]] bool isEmpty() const { return bytes.data == nullptr && bytes.size == 0; }
};

/// Returns the JSON without durations, which are the only difference between runs.
inline std::string withoutSeconds(const std::string& json) {
    return std::regex_replace(json, std::regex("\"seconds\": [0-9.e+-]+"), "\"seconds\": 0");
}

}  // namespace tspace::test
