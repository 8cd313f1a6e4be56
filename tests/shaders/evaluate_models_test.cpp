// SPDX-License-Identifier: MIT
// Compares the buffers of a plan with the library on all shared models and their poses.
#include <gtest/gtest.h>

#include "evaluate_by_loop.h"
#include "evaluate_expectations.h"
#include "evaluate_models.h"

namespace tspace::shaders {

namespace {

std::vector<PosedMesh> meshesOfSharedModels() {
    std::vector<PosedMesh> meshes;
    std::size_t models = 0;
    for (const std::string& path : sharedModels()) {
        std::vector<PosedMesh> more = meshesOfModel(path);
        models += more.empty() ? 0 : 1;
        for (PosedMesh& mesh : more) meshes.push_back(std::move(mesh));
    }
    std::cout << meshes.size() << " meshes of " << models << " models\n";
    return meshes;
}

TEST(PlanBuffers, GiveTheTangentsOfSharedModels) {
    const std::vector<PosedMesh> meshes = meshesOfSharedModels();
    if (meshes.empty()) GTEST_SKIP() << "the shared test data are missing";
    for (const Method method : kMethods) {
        expectNear(evaluateAll(meshes, {.method = method}, evaluateByLoop).tangents, methodName(method));
    }
}

TEST(PlanBuffers, GiveTheNormalsOfSharedModels) {
    const std::vector<PosedMesh> meshes = meshesOfSharedModels();
    if (meshes.empty()) GTEST_SKIP() << "the shared test data are missing";
    Outcome outcome = evaluateAll(meshes, {.makes_normals = true}, evaluateByLoop);
    expectNear(outcome.normals, "normals");
    expectNear(outcome.tangents, "tangents with these normals");
}

}  // namespace

}  // namespace tspace::shaders
