// SPDX-License-Identifier: MIT
// shaders/tspace_evaluate.glsl and .hlsl, translated to Metal by spirv-cross and compiled as C++ with the types of
// metal_shim: a simple loop over the results of a plan.
#include <gtest/gtest.h>

#include "evaluate_expectations.h"

// Included last because it defines macros.
#include <metal_stdlib>

namespace tspace::shaders {

namespace {

namespace from_glsl {
#include "spirv/evaluate_glsl_as_metal.metal"
}
namespace from_hlsl {
#include "spirv/evaluate_hlsl_as_metal.metal"
}

/// Returns a loop that runs a kernel on all results. Its structs contain an array of one element, which is how
/// spirv-cross writes arrays of unknown size; it sorts buffers by their first use.
template <class Settings, class Plan, class Positions, class Deform, class Normals, class Tangents>
Evaluate evaluateBy(void (*run)(const Settings&, const Plan&, const Positions&, const Deform&, Normals&, Tangents&,
                                uint3)) {
    return [run](EvaluateBuffers& in) {
        auto& [plan, settings, positions, deform, normals, tangents] = in.arrays;
        for (uint i = 0; i < in.result_count; ++i) {
            run(reinterpret_cast<const Settings&>(*settings.data()), reinterpret_cast<const Plan&>(*plan.data()),
                reinterpret_cast<const Positions&>(*positions.data()), reinterpret_cast<const Deform&>(*deform.data()),
                reinterpret_cast<Normals&>(*normals.data()), reinterpret_cast<Tangents&>(*tangents.data()), {i, 0, 0});
        }
        return std::string();
    };
}

TEST(EvaluateMetal, MadeOfGlslGivesTheFramesOfTheLibrary) {
    expectTangents(generatedMeshes(), evaluateBy(from_glsl::main0));
    expectFrames(generatedMeshes(), evaluateBy(from_glsl::main0));
}
TEST(EvaluateMetal, MadeOfHlslGivesTheFramesOfTheLibrary) {
    expectTangents(generatedMeshes(), evaluateBy(from_hlsl::main0));
    expectFrames(generatedMeshes(), evaluateBy(from_hlsl::main0));
}

}  // namespace

}  // namespace tspace::shaders
