// SPDX-License-Identifier: MIT
// Tolerances of the results of shaders/tspace_evaluate.* relative to the library.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "evaluate_cases.h"

namespace tspace::shaders {

inline constexpr Method kMethods[] = {Method::mikktspace, Method::uniform, Method::angle,
                                      Method::area,       Method::lengyel, Method::fast};
/// Maximum differences in degrees. kMostUsual: for 9,999 of 10,000 results (999 of 1,000 if there are few). kMost: for
/// all results.
inline constexpr float kMostUsual = 0.0005f, kMost = 0.01f;

inline void expectNear(Differences found, const std::string& what) {
    std::cout << what << ": " << found.text() << '\n';
    EXPECT_EQ(found.failure, "") << what;
    EXPECT_GT(found.count, 0u) << what;
    EXPECT_EQ(found.wrong_signs, 0u) << what;
    EXPECT_EQ(found.not_finite, 0u) << what;
    EXPECT_EQ(found.not_zero, 0u) << what;
    EXPECT_LE(found.percentile(found.degrees.size() < 20'000 ? 0.999 : 0.9999), kMostUsual) << what;
    EXPECT_LE(found.worst_deg, kMost) << what << " at " << found.where;
}

inline void expectTangents(const std::vector<PosedMesh>& meshes, const Evaluate& evaluate) {
    for (const Method method : kMethods) {
        Outcome outcome = evaluateAll(meshes, {.method = method}, evaluate);
        expectNear(outcome.tangents, methodName(method));
    }
}

inline void expectFrames(const std::vector<PosedMesh>& meshes, const Evaluate& evaluate) {
    constexpr NormalWeighting kWeightings[] = {NormalWeighting::flat,      NormalWeighting::uniform,
                                               NormalWeighting::area,      NormalWeighting::angle,
                                               NormalWeighting::angleArea, NormalWeighting::max};
    for (const NormalWeighting weighting : kWeightings) {
        for (const float crease : {180.0f, 40.0f}) {
            const std::string what =
                "normals " + std::to_string(static_cast<int>(weighting)) + ", crease " + std::to_string(crease);
            Outcome outcome = evaluateAll(
                meshes, {.makes_normals = true, .weighting = weighting, .crease_angle_deg = crease}, evaluate);
            expectNear(outcome.normals, what);
            expectNear(outcome.tangents, what + ", tangents");
        }
    }
}

}  // namespace tspace::shaders
