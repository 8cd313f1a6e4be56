// SPDX-License-Identifier: MIT
// Normals with their report, and the shapes of the accuracy benchmark, for tests of single options.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "scans.h"
#include "support/same_bits.h"
#include "tspace/normals.h"

namespace tspace::test {

struct Outcome {
    std::vector<Vec3> normals;
    NormalReport report;
};

inline Outcome normalsOf(const MeshView& mesh, const NormalOptions& options, const Execution& execution = {}) {
    Outcome outcome{std::vector<Vec3>(mesh.cornerCount()), {}};
    const Result<NormalReport> report = generateNormals(mesh, options, outcome.normals, execution);
    EXPECT_TRUE(report.ok());
    if (report) outcome.report = *report;
    return outcome;
}

inline const accuracy::Shape& shape(const char* name) {
    const auto all = accuracy::shapes();
    return *std::find_if(all.begin(), all.end(),
                         [&](const accuracy::Shape& s) { return std::strcmp(s.name, name) == 0; });
}

}  // namespace tspace::test
