// SPDX-License-Identifier: MIT
// The C API gives the same bits as the C++ API.
#include "tspace/tspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "core/c_api/outputs.h"
#include "core/c_api/random_mesh.h"
#include "support/simple_mesh.h"
#include "tspace/tspace.hpp"

namespace tspace::test {
namespace {

TEST(CApi, TheConventionHasNoDefault) {
    const RandomMesh mesh(2, 60);
    CApiOutputs c(mesh.cornerCount());
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_TangentOutput out = c.c();
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    for (const tspace_TangentOptions* given :
         {static_cast<const tspace_TangentOptions*>(nullptr), &std::as_const(options)}) {
        tspace_Error error;
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_generateTangents(&c_mesh, given, &out, nullptr, nullptr, &error));
        EXPECT_NE(nullptr, std::strstr(error.message, "convention")) << error.message;
        tspace_TangentPlan* plan = nullptr;
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_planTangents(&c_mesh, given, nullptr, &plan, nullptr));
    }
    EXPECT_EQ(ErrorCode::invalidOption, generateTangents(mesh.view(), {}, c.view()).error().code);
}

template <class Struct>
using Init = tspace_ErrorCode (*)(Struct*, uint32_t, tspace_Error*) noexcept;

/// Checks that options prepared by `init` have the same bytes as those prepared by TSPACE_INIT, for each size that the
/// struct has ever had.
template <class Struct>
void expectInitLikeTheMacro(Init<Struct> init, std::initializer_list<std::size_t> old_sizes = {}) {
    Struct by_macro;
    TSPACE_INIT(by_macro);
    std::vector<std::size_t> sizes(old_sizes);
    sizes.push_back(sizeof(Struct));
    for (const std::size_t size : sizes) {
        unsigned char bytes[sizeof(Struct)];
        std::memset(bytes, 0xab, sizeof bytes);
        Struct* options = reinterpret_cast<Struct*>(bytes);
        ASSERT_EQ(TSPACE_OK, init(options, static_cast<std::uint32_t>(size), nullptr));
        by_macro.struct_size = static_cast<std::uint32_t>(size);
        EXPECT_EQ(0, std::memcmp(bytes, &by_macro, size));
        for (std::size_t i = size; i < sizeof bytes; ++i) EXPECT_EQ(0xab, bytes[i]);
    }
    Struct untouched = by_macro;
    tspace_Error error;
    for (const std::uint32_t unknown : {0u, 4u, static_cast<std::uint32_t>(sizeof(Struct)) + 8}) {
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, init(&untouched, unknown, &error));
        EXPECT_NE(nullptr, std::strstr(error.message, "struct_size")) << error.message;
        EXPECT_EQ(nullptr, std::strstr(error.message, "TSPACE_")) << "bindings show it too: " << error.message;
        EXPECT_EQ(0, std::memcmp(&untouched, &by_macro, sizeof(Struct)));
    }
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, init(nullptr, sizeof(Struct), &error));
}

TEST(CApi, InitFunctionsSetTheValuesOfTheMacro) {
    expectInitLikeTheMacro<tspace_Execution>(tspace_initExecution);
    expectInitLikeTheMacro<tspace_TangentOptions>(tspace_initTangentOptions);
    expectInitLikeTheMacro<tspace_NormalOptions>(tspace_initNormalOptions, {offsetof(tspace_NormalOptions, denoise)});
    expectInitLikeTheMacro<tspace_WindingOptions>(tspace_initWindingOptions);
    expectInitLikeTheMacro<tspace_SanitizeOptions>(tspace_initSanitizeOptions);
    expectInitLikeTheMacro<tspace_IndexedFramesOptions>(tspace_initIndexedFramesOptions);
}

/// Initializes a struct as a language without the macro does: with zeros and the size.
template <class Struct>
Struct zerosWithSize() {
    Struct zeros{};
    zeros.struct_size = sizeof(Struct);
    return zeros;
}

TEST(CApi, RejectsTangentOptionsOfZeros) {
    const RandomMesh mesh(2, 60);
    CApiOutputs c(mesh.cornerCount());
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_TangentOutput out = c.c();
    auto options = zerosWithSize<tspace_TangentOptions>();
    tspace_Error error;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, &error));
    ASSERT_EQ(TSPACE_OK, tspace_findConvention("gltf", &options.convention, nullptr));
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, &error));
    EXPECT_NE(nullptr, std::strstr(error.message, "TangentOptions")) << error.message;
    EXPECT_EQ(nullptr, std::strstr(error.message, "TSPACE_")) << "bindings show it too: " << error.message;
    tspace_TangentPlan* plan = nullptr;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_planTangents(&c_mesh, &options, nullptr, &plan, nullptr));
    options.refine = 1;  // if refine is not 0, a threshold of 0 degrees is accepted
    EXPECT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
    options.refine = 0;
    options.angular_threshold_deg = 180;
    EXPECT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
}

TEST(CApi, RejectsNormalOptionsOfZeros) {
    const RandomMesh mesh(3, 60);
    const tspace_Mesh c_mesh = mesh.c();
    std::vector<Vec3> made(mesh.cornerCount()), flat(mesh.cornerCount());
    const tspace_Span out{&made[0].x, made.size(), 0};
    auto options = zerosWithSize<tspace_NormalOptions>();
    tspace_Error error;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_generateNormals(&c_mesh, &options, out, nullptr, nullptr, &error));
    EXPECT_NE(nullptr, std::strstr(error.message, "NormalOptions")) << error.message;
    ASSERT_EQ(TSPACE_OK, tspace_initNormalOptions(&options, sizeof options, nullptr));
    options.weighting = TSPACE_NORMAL_WEIGHTING_FLAT;
    EXPECT_EQ(TSPACE_OK, tspace_generateNormals(&c_mesh, &options, out, nullptr, nullptr, nullptr));
    // Rejecting zeros loses no result: `flat` gives the same normals if another option is not 0.
    ASSERT_TRUE(generateNormals(mesh.view(), {NormalWeighting::flat, {}, 0, {}, false, false, 0}, flat));
    EXPECT_TRUE(sameBits(flat, made));
}

TEST(CApi, RejectsWindingOptionsOfZeros) {
    SimpleMesh cube = triangleCube(5);
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = {&cube.positions[0].x, cube.positions.size(), 0};
    mesh.indices = {cube.indices.data(), cube.indices.size(), TSPACE_INDEX_U32};
    std::vector<std::uint8_t> turned(12);
    auto options = zerosWithSize<tspace_WindingOptions>();
    tspace_Error error;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION,
              tspace_mendWinding(&mesh, &options, turned.data(), turned.size(), nullptr, nullptr, &error));
    EXPECT_NE(nullptr, std::strstr(error.message, "WindingOptions")) << error.message;
    ASSERT_EQ(TSPACE_OK, tspace_findConvention("gltf", &options.convention, nullptr));
    EXPECT_EQ(TSPACE_OK, tspace_mendWinding(&mesh, &options, turned.data(), turned.size(), nullptr, nullptr, nullptr));
}

TEST(CApi, RejectsIndexedFramesOptionsOfZeros) {
    const RandomMesh mesh(2, 60);
    const tspace_Mesh c_mesh = mesh.c();
    const auto options = zerosWithSize<tspace_IndexedFramesOptions>();
    tspace_IndexedFrames* frames = nullptr;
    tspace_Error error;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_makeIndexedFrames(&c_mesh, &options, nullptr, &frames, &error));
    EXPECT_NE(nullptr, std::strstr(error.message, "convention")) << error.message;
}

TEST(CApi, ZerosAreTheDefaultsOfExecutionAndOfSanitizing) {
    tspace_Execution execution;
    TSPACE_INIT(execution);
    const auto no_execution = zerosWithSize<tspace_Execution>();
    EXPECT_EQ(0, std::memcmp(&execution, &no_execution, sizeof execution));
    tspace_SanitizeOptions sanitize;
    TSPACE_INIT(sanitize);
    const auto no_sanitize = zerosWithSize<tspace_SanitizeOptions>();
    EXPECT_EQ(0, std::memcmp(&sanitize, &no_sanitize, sizeof sanitize));
}

}  // namespace
}  // namespace tspace::test
