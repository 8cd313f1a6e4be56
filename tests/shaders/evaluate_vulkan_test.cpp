// SPDX-License-Identifier: MIT
// Compares shaders/tspace_evaluate.* on a Vulkan device (lavapipe if installed) with the library.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "evaluate_expectations.h"
#include "read_spirv.h"
#include "vulkan_compute.h"

namespace tspace::shaders {

namespace {

Evaluate evaluateOn(VulkanCompute& vulkan, const std::vector<std::uint32_t>& spirv) {
    return [&vulkan, &spirv](EvaluateBuffers& in) {
        const auto groups = static_cast<std::uint32_t>((in.result_count + 63) / 64);
        return groups == 0 ? std::string() : vulkan.runBuffers(spirv, "main", groups, in.arrays);
    };
}

class EvaluateLanguage : public testing::TestWithParam<const char*> {};

TEST_P(EvaluateLanguage, GivesTheFramesOfTheLibrary) {
    std::string why;
    const std::unique_ptr<VulkanCompute> vulkan = VulkanCompute::open(why);
    if (vulkan == nullptr) GTEST_SKIP() << why << " (scripts/setup installs mesa-vulkan-drivers)";
    std::cout << vulkan->device() << '\n';
    const std::vector<std::uint32_t> spirv = readSpirv(GetParam());
    ASSERT_FALSE(spirv.empty()) << GetParam();
    expectTangents(generatedMeshes(), evaluateOn(*vulkan, spirv));
    expectFrames(generatedMeshes(), evaluateOn(*vulkan, spirv));
    const std::vector<PosedMesh> shared = sharedMeshes();
    for (const Method method : {Method::lengyel, Method::fast}) {
        if (!shared.empty())
            expectNear(evaluateAll(shared, {.method = method}, evaluateOn(*vulkan, spirv)).tangents,
                       std::string("shared meshes, ") + methodName(method));
    }

    // Two runs must give the same bits.
    const Evaluate once = evaluateOn(*vulkan, spirv);
    const Evaluate twice = [&](EvaluateBuffers& in) {
        EvaluateBuffers again = in;
        std::string failure = once(in);
        if (failure.empty()) failure = once(again);
        return failure.empty() && again.arrays != in.arrays ? "two runs differ" : failure;
    };
    EXPECT_EQ(evaluateAll(generatedMeshes(), {.makes_normals = true}, twice).tangents.failure, "");
}

INSTANTIATE_TEST_SUITE_P(Spirv, EvaluateLanguage, testing::Values(TSPACE_EVALUATE_NAMES),
                         [](const auto& language) { return std::string(language.param); });

/// Returns the compiled GLSL shader with `from` replaced by `to`. Returns no words if it does not compile.
std::vector<std::uint32_t> mutant(const std::string& from, const std::string& to) {
    std::ifstream file(TSPACE_SHADER_FOLDER "/tspace_evaluate.glsl");
    std::stringstream all;
    all << file.rdbuf();
    std::string text = all.str();
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return {};
    text.replace(at, from.size(), to);
    const std::string path = TSPACE_SPIRV_DIR "/mutant.glsl";
    std::ofstream(path) << text;
    const std::string command = TSPACE_GLSLANG " -V --quiet -S comp -o " TSPACE_SPIRV_DIR "/mutant.spv " + path;
    return std::system(command.c_str()) == 0 ? readSpirv("mutant") : std::vector<std::uint32_t>();
}

bool isNear(Differences& found) {
    return found.failure.empty() && found.wrong_signs + found.not_finite + found.not_zero == 0 &&
           found.percentile(0.9999) <= kMostUsual && found.worst_deg <= kMost;
}

TEST(EvaluateShader, IsWrongIfAPartIsReplaced) {
    std::string why;
    const std::unique_ptr<VulkanCompute> vulkan = VulkanCompute::open(why);
    if (vulkan == nullptr) GTEST_SKIP() << why;
    const std::vector<PosedMesh> generated = generatedMeshes(), shared = sharedMeshes();
    struct Mutation {
        const char *from, *to;
        Method method;
        const std::vector<PosedMesh>* meshes;
    };
    const Mutation mutations[] = {
        {"weight = tspace_arcCosine(dot(tspace_flatten(n, corner.previous)",
         "weight = 1.0 + 0.0 * (dot(tspace_flatten(n, corner.previous)", Method::mikktspace, &generated},
        {"sums.a += tspace_weightedTangent", "sums.a = tspace_weightedTangent", Method::uniform, &generated},
        {"float square = dot(across, across);", "float square = 0.0;", Method::fast, &generated},
        {"return tspace_wideDerivatives(corner);", "return made;", Method::lengyel, &generated},
        // Only on the shared meshes, the last bits of sums decide signs.
        {"is_mirrored = tspace_isMirrored(n, sums.a, sums.b);", "", Method::lengyel, &shared},
        {"if (last != 0u && ", "if (last > 1u && ", Method::lengyel, &shared},
    };
    for (const Mutation& mutation : mutations) {
        if (mutation.meshes->empty()) continue;
        const std::vector<std::uint32_t> spirv = mutant(mutation.from, mutation.to);
        ASSERT_FALSE(spirv.empty()) << mutation.from;
        Outcome outcome = evaluateAll(*mutation.meshes, {.method = mutation.method}, evaluateOn(*vulkan, spirv));
        EXPECT_FALSE(isNear(outcome.tangents)) << mutation.from << ": " << outcome.tangents.text();
    }
}

}  // namespace

}  // namespace tspace::shaders
