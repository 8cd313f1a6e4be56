// SPDX-License-Identifier: MIT
// The C API gives the same bits as the C++ API.
#include "tspace/tspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <random>
#include <vector>

#include "core/c_api/outputs.h"
#include "core/c_api/random_mesh.h"
#include "support/simple_mesh.h"
#include "tspace/tspace.hpp"

namespace tspace::test {
namespace {

void expectSame(const TangentReport& cpp, const tspace_TangentReport& c) {
    EXPECT_EQ(c.struct_size, sizeof(c));
    EXPECT_EQ(cpp.triangle_count, c.triangle_count);
    EXPECT_EQ(cpp.degenerate_triangle_count, c.degenerate_triangle_count);
    EXPECT_EQ(cpp.degenerate_uv_count, c.degenerate_uv_count);
    EXPECT_EQ(cpp.mirrored_count, c.mirrored_count);
    EXPECT_EQ(cpp.skipped_face_count, c.skipped_face_count);
    EXPECT_EQ(cpp.group_count, c.group_count);
    EXPECT_EQ(cpp.default_corner_count, c.default_corner_count);
    EXPECT_EQ(cpp.not_finite_count, c.not_finite_count);
    EXPECT_EQ(cpp.reference_order_abandoned ? 1u : 0u, c.reference_order_abandoned);
}

TEST(CApi, GivesTheTangentsOfTheCppApiForEveryMethod) {
    const RandomMesh mesh(1, 60);
    for (std::uint32_t method = TSPACE_METHOD_MIKKTSPACE; method <= TSPACE_METHOD_BASIS; ++method) {
        CApiOutputs cpp(mesh.cornerCount()), c(mesh.cornerCount());
        TangentOptions options{.convention = conventions::opengl};
        options.method = static_cast<Method>(method);
        options.angular_threshold_deg = 70.0f;
        options.pairing = Pairing::corrected;
        options.ngons = Ngons::skip;
        options.convention = conventions::gltf;
        const auto expected = generateTangents(mesh.view(), options, cpp.view());
        ASSERT_TRUE(expected);

        tspace_TangentOptions c_options = tangentOptions();
        c_options.method = method;
        c_options.angular_threshold_deg = 70.0f;
        c_options.pairing = TSPACE_PAIRING_CORRECTED;
        c_options.ngons = TSPACE_NGONS_SKIP;
        c_options.convention.v_axis = TSPACE_V_DOWN;
        const tspace_Mesh c_mesh = mesh.c();
        const tspace_TangentOutput out = c.c();
        tspace_TangentReport report;
        TSPACE_INIT(report);
        ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &c_options, &out, nullptr, &report, nullptr)) << method;
        expectSame(cpp, c);
        expectSame(*expected, report);
    }
}

TEST(CApi, GivesTangentsPerVertexAsTheCppApi) {
    const RandomMesh mesh(3, 60);
    const std::size_t vertex_count = mesh.view().vertexCount();
    ASSERT_NE(vertex_count, mesh.cornerCount());
    const tspace_Mesh c_mesh = mesh.c();
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = c_mesh.positions;
    pose.normals = c_mesh.normals;
    for (const Method method : {Method::lengyel, Method::basis}) {
        CApiOutputs cpp(vertex_count), c(vertex_count);
        ASSERT_TRUE(generateTangents(
            mesh.view(), {.method = method, .convention = conventions::opengl, .domain = OutputDomain::vertex},
            cpp.view()));
        tspace_TangentOptions options = tangentOptions();
        options.method = static_cast<tspace_Method>(method);
        options.domain = TSPACE_DOMAIN_VERTEX;
        tspace_TangentPlan* plan = nullptr;
        ASSERT_EQ(TSPACE_OK, tspace_planTangents(&c_mesh, &options, nullptr, &plan, nullptr));
        tspace_TangentPlanInfo info;
        TSPACE_INIT(info);
        ASSERT_EQ(TSPACE_OK, tspace_describeTangentPlan(plan, &info, nullptr));
        EXPECT_EQ(info.output_count, vertex_count);
        EXPECT_EQ(info.corner_count, mesh.cornerCount());
        const tspace_TangentOutput out = c.c();
        EXPECT_EQ(TSPACE_OK, tspace_evaluateTangents(plan, &pose, &out, nullptr, nullptr, nullptr));
        expectSame(cpp, c);
        tspace_destroyTangentPlan(plan);
    }
}

TEST(CApi, DefaultsOfTangentsAreThoseOfCpp) {
    const RandomMesh mesh(2, 60);
    CApiOutputs cpp(mesh.cornerCount()), c(mesh.cornerCount());
    ASSERT_TRUE(generateTangents(mesh.view(), {.convention = conventions::opengl}, cpp.view()));
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_TangentOutput out = c.c();
    const tspace_TangentOptions options = tangentOptions();
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
    expectSame(cpp, c);
    EXPECT_EQ(TangentOptions{}.angular_threshold_deg, options.angular_threshold_deg);
    EXPECT_EQ(TangentOptions{}.refine, options.refine);
    tspace_Execution execution;
    TSPACE_INIT(execution);
    EXPECT_EQ(0u, execution.thread_count);  // equivalent to 1, the default in C++
    tspace_NormalOptions normals;
    TSPACE_INIT(normals);
    EXPECT_EQ(static_cast<std::uint32_t>(NormalOptions{}.weighting), normals.weighting);
    EXPECT_EQ(NormalOptions{}.crease_angle_deg, normals.crease_angle_deg);
    EXPECT_EQ(NormalOptions{}.weld_positions ? 1u : 0u, normals.weld_positions);
    EXPECT_EQ(NormalOptions{}.refine, normals.refine);
    tspace_IndexedFramesOptions frames;
    TSPACE_INIT(frames);
    EXPECT_EQ(IndexedFramesOptions{}.sanitize ? 1u : 0u, frames.sanitize);
    EXPECT_EQ(IndexedFramesOptions{}.make_normals ? 1u : 0u, frames.make_normals);
}

TEST(CApi, WindingIsMendedAsInCpp) {
    SimpleMesh cube = triangleCube(5);
    std::swap(cube.indices[4], cube.indices[5]);
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = {&cube.positions[0].x, cube.positions.size(), 0};
    mesh.indices = {cube.indices.data(), cube.indices.size(), TSPACE_INDEX_U32};
    std::vector<std::uint8_t> turned(12, 9);
    tspace_WindingOptions options;
    TSPACE_INIT(options);
    EXPECT_EQ(1u, options.use_normals);
    EXPECT_EQ(1u, options.weld_positions);
    tspace_WindingReport report;
    TSPACE_INIT(report);
    for (const tspace_WindingOptions* given :
         {&std::as_const(options), static_cast<const tspace_WindingOptions*>(nullptr)}) {
        ASSERT_EQ(TSPACE_OK, tspace_mendWinding(&mesh, given, turned.data(), turned.size(), nullptr, &report, nullptr));
        EXPECT_EQ((std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), turned);
        EXPECT_EQ(12u, report.face_count);
        EXPECT_EQ(1u, report.turned_count);
        EXPECT_EQ(3u, report.conflict_count_before);
        EXPECT_EQ(0u, report.conflict_count_after);
        EXPECT_EQ(1u, report.by_volume_count);
    }
    EXPECT_EQ(TSPACE_ERROR_COUNT_MISMATCH,
              tspace_mendWinding(&mesh, nullptr, turned.data(), 11, nullptr, nullptr, nullptr));
    options.use_normals = 2;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION,
              tspace_mendWinding(&mesh, &options, turned.data(), 12, nullptr, nullptr, nullptr));
}

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

/// Options that `init` prepares have the same bytes as those of TSPACE_INIT, up to each size that the struct has ever
/// had.
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

TEST(CApi, FunctionsPrepareOptionsAsTheMacroDoes) {
    expectInitLikeTheMacro<tspace_Execution>(tspace_initExecution);
    expectInitLikeTheMacro<tspace_TangentOptions>(tspace_initTangentOptions);
    expectInitLikeTheMacro<tspace_NormalOptions>(tspace_initNormalOptions, {offsetof(tspace_NormalOptions, denoise)});
    expectInitLikeTheMacro<tspace_WindingOptions>(tspace_initWindingOptions);
    expectInitLikeTheMacro<tspace_SanitizeOptions>(tspace_initSanitizeOptions);
    expectInitLikeTheMacro<tspace_IndexedFramesOptions>(tspace_initIndexedFramesOptions);
}

/// Initializes a struct like a language without the macro: zeros, and the size.
template <class Struct>
Struct zerosWithSize() {
    Struct zeros{};
    zeros.struct_size = sizeof(Struct);
    return zeros;
}

TEST(CApi, TangentOptionsOfZerosAreRefused) {
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
    options.refine = 1;  // then a caller requests 0 degrees
    EXPECT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
    options.refine = 0;
    options.angular_threshold_deg = 180;
    EXPECT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
}

TEST(CApi, NormalOptionsOfZerosAreRefused) {
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
    // No combination is lost: with 0 for each of the other options alone, the result equals that of zeros.
    ASSERT_TRUE(generateNormals(mesh.view(), {NormalWeighting::flat, {}, 0, {}, false, false, 0}, flat));
    EXPECT_TRUE(sameBits(flat, made));
}

TEST(CApi, WindingOptionsOfZerosAreRefused) {
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

TEST(CApi, IndexedFramesOptionsOfZerosAreRefused) {
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

TEST(CApi, ZeroDegreesCanBeSaid) {
    const RandomMesh mesh(6, 60);
    const tspace_Mesh c_mesh = mesh.c();
    CApiOutputs cpp(mesh.cornerCount()), c(mesh.cornerCount());
    ASSERT_TRUE(
        generateTangents(mesh.view(), {.convention = conventions::opengl, .angular_threshold_deg = 0}, cpp.view()));
    tspace_TangentOptions options = tangentOptions();
    options.angular_threshold_deg = 0;
    const tspace_TangentOutput out = c.c();
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
    expectSame(cpp, c);
    std::vector<Vec3> hard(mesh.cornerCount()), hard_in_c(mesh.cornerCount()), smooth(mesh.cornerCount());
    ASSERT_TRUE(generateNormals(mesh.view(), {.crease_angle_deg = 0}, hard));
    ASSERT_TRUE(generateNormals(mesh.view(), {}, smooth));
    tspace_NormalOptions normals;
    TSPACE_INIT(normals);
    normals.crease_angle_deg = 0;
    ASSERT_EQ(TSPACE_OK, tspace_generateNormals(&c_mesh, &normals, {&hard_in_c[0].x, hard_in_c.size(), 0}, nullptr,
                                                nullptr, nullptr));
    EXPECT_TRUE(sameBits(hard, hard_in_c));
    EXPECT_FALSE(sameBits(smooth, hard_in_c));
}

TEST(CApi, GivesTheNormalsOfTheCppApi) {
    const RandomMesh mesh(3, 60);
    std::vector<std::uint32_t> groups(mesh.face_sizes.size());
    for (std::size_t f = 0; f < groups.size(); ++f) groups[f] = 1u << (f % 3);
    constexpr std::uint32_t kDefault = TSPACE_NORMAL_WEIGHTING_BEST + 1;
    for (std::uint32_t weighting = TSPACE_NORMAL_WEIGHTING_FLAT; weighting <= kDefault; ++weighting) {
        std::vector<Vec3> cpp(mesh.cornerCount()), c(mesh.cornerCount());
        NormalOptions options;
        tspace_NormalOptions c_options;
        TSPACE_INIT(c_options);
        if (weighting != kDefault) {
            options = {static_cast<NormalWeighting>(weighting), conventions::unity, 50.0f, groups, true, false};
            c_options.weighting = weighting;
            c_options.crease_angle_deg = 50.0f;
            c_options.smoothing_groups = groups.data();
            c_options.smoothing_group_count = groups.size();
            c_options.smoothing_groups_are_masks = 1;
            c_options.weld_positions = 0;
            ASSERT_EQ(TSPACE_OK, tspace_findConvention("unity", &c_options.convention, nullptr));
        }
        const auto expected = generateNormals(mesh.view(), options, cpp);
        ASSERT_TRUE(expected);
        const tspace_Mesh c_mesh = mesh.c();
        tspace_NormalReport report;
        TSPACE_INIT(report);
        ASSERT_EQ(TSPACE_OK,
                  tspace_generateNormals(&c_mesh, &c_options, {&c[0].x, c.size(), 0}, nullptr, &report, nullptr));
        EXPECT_TRUE(sameBits(cpp, c)) << weighting;
        EXPECT_EQ(expected->face_count, report.face_count);
        EXPECT_EQ(expected->degenerate_face_count, report.degenerate_face_count);
        EXPECT_EQ(expected->fallback_corner_count, report.fallback_corner_count);
    }
}

TEST(CApi, RefinesTangentsAsTheCppApi) {
    const RandomMesh mesh(5, 60);
    for (const std::uint32_t refine : {0u, 1u, 2u}) {
        CApiOutputs cpp(mesh.cornerCount()), c(mesh.cornerCount());
        ASSERT_TRUE(generateTangents(
            mesh.view(), {.method = Method::best, .convention = conventions::opengl, .refine = refine}, cpp.view()));
        tspace_TangentOptions options = tangentOptions();
        options.method = TSPACE_METHOD_BEST;
        options.refine = refine;
        const tspace_Mesh c_mesh = mesh.c();
        const tspace_TangentOutput out = c.c();
        ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, nullptr, nullptr, nullptr));
        expectSame(cpp, c);
    }
}

TEST(CApi, RefinesNormalsAsTheCppApi) {
    const RandomMesh mesh(3, 60);
    const auto normalsWith = [&](std::uint32_t refine) {
        std::vector<Vec3> out(mesh.cornerCount());
        tspace_NormalOptions options;
        TSPACE_INIT(options);
        options.weighting = TSPACE_NORMAL_WEIGHTING_BEST;
        options.refine = refine;
        const tspace_Mesh c_mesh = mesh.c();
        EXPECT_EQ(TSPACE_OK,
                  tspace_generateNormals(&c_mesh, &options, {&out[0].x, out.size(), 0}, nullptr, nullptr, nullptr));
        return out;
    };
    for (const std::uint32_t refine : {0u, 1u, 2u}) {
        std::vector<Vec3> cpp(mesh.cornerCount());
        ASSERT_TRUE(generateNormals(mesh.view(), {.weighting = NormalWeighting::best, .refine = refine}, cpp));
        EXPECT_TRUE(sameBits(cpp, normalsWith(refine))) << refine;
    }
    EXPECT_FALSE(sameBits(normalsWith(0), normalsWith(1)));
}

/// Returns a bent sheet of 60 x 60 squares with noisy positions.
SimpleMesh noisySheet() {
    constexpr std::uint32_t kSide = 60;
    SimpleMesh sheet;
    std::mt19937 random(3);
    for (std::uint32_t i = 0; i <= kSide * kSide + 2 * kSide; ++i) {
        const auto x = static_cast<float>(i % (kSide + 1)), y = static_cast<float>(i / (kSide + 1));
        const float noise = 0.3f * (static_cast<float>(random()) / 4294967296.0f - 0.5f);
        sheet.positions.push_back({x, y, 0.01f * (x * x + y * y) + noise});
    }
    for (std::uint32_t j = 0; j < kSide; ++j) {
        for (std::uint32_t i = 0; i < kSide; ++i) {
            const std::uint32_t a = j * (kSide + 1) + i, b = a + kSide + 1;
            sheet.addTriangle(a, a + 1, b + 1);
            sheet.addTriangle(a, b + 1, b);
        }
    }
    return sheet;
}

TEST(CApi, TakesNoiseOutOfNormalsAsTheCppApi) {
    const SimpleMesh sheet = noisySheet();
    tspace_Mesh c_mesh;
    TSPACE_INIT(c_mesh);
    c_mesh.positions = {&sheet.positions[0].x, sheet.positions.size(), 0};
    c_mesh.indices.data = sheet.indices.data();
    c_mesh.indices.count = sheet.indices.size();
    c_mesh.indices.type = TSPACE_INDEX_U32;
    std::vector<Vec3> cpp(sheet.indices.size()), c(sheet.indices.size());
    const auto expected = generateNormals(sheet.view(),
                                          {.weighting = NormalWeighting::best,
                                           .crease_angle_deg = NormalOptions::crease_auto,
                                           .denoise = NormalOptions::denoise_auto},
                                          cpp);
    ASSERT_TRUE(expected);
    tspace_NormalOptions options;
    TSPACE_INIT(options);
    options.weighting = TSPACE_NORMAL_WEIGHTING_BEST;
    options.crease_angle_deg = -1;
    options.denoise = -1;
    tspace_NormalReport report;
    TSPACE_INIT(report);
    ASSERT_EQ(TSPACE_OK, tspace_generateNormals(&c_mesh, &options, {&c[0].x, c.size(), 0}, nullptr, &report, nullptr));
    EXPECT_TRUE(sameBits(cpp, c));
    EXPECT_EQ(report.noise, expected->noise);
    EXPECT_GT(report.noise, 0.03f);
    EXPECT_EQ(report.crease_angle_deg, expected->crease_angle_deg);

    tspace_PositionNoise noise;
    TSPACE_INIT(noise);
    ASSERT_EQ(TSPACE_OK, tspace_measurePositionNoise(&c_mesh, nullptr, &noise, nullptr));
    const auto measured = measurePositionNoise(sheet.view());
    ASSERT_TRUE(measured);
    EXPECT_EQ(noise.sigma, measured->sigma);
    EXPECT_EQ(noise.kink_share, measured->kink_share);
    EXPECT_EQ(noise.noise, report.noise);
    EXPECT_EQ(noise.mean_edge, measured->mean_edge);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_measurePositionNoise(&c_mesh, nullptr, nullptr, nullptr));
}

TEST(CApi, MendsAsTheCppApi) {
    const RandomMesh mesh(4, 60);
    for (const std::uint32_t all : {0u, 1u}) {
        std::vector<Vec4> cpp(mesh.cornerCount());
        std::mt19937 random(9);
        std::uniform_real_distribution<float> value(-2.0f, 2.0f);
        for (Vec4& t : cpp) t = {value(random), value(random), value(random), value(random) < 0 ? -1.0f : 1.0f};
        std::vector<Vec4> c = cpp;
        SanitizeOptions options;
        options.orthogonalize_all = all != 0;
        const auto expected = sanitizeTangents(mesh.view(), options, cpp);
        ASSERT_TRUE(expected);
        tspace_SanitizeOptions c_options;
        TSPACE_INIT(c_options);
        c_options.orthogonalize_all = all;
        const tspace_Mesh c_mesh = mesh.c();
        tspace_SanitizeReport report;
        TSPACE_INIT(report);
        ASSERT_EQ(TSPACE_OK,
                  tspace_sanitizeTangents(&c_mesh, &c_options, {&c[0].x, c.size(), 0}, nullptr, &report, nullptr));
        EXPECT_TRUE(sameBits(cpp, c));
        EXPECT_EQ(expected->mendedCount(), report.mended_count);
        EXPECT_EQ(expected->not_unit_count, report.not_unit_count);
        EXPECT_EQ(expected->mixed_sign_count, report.mixed_sign_count);
        EXPECT_EQ(expected->normalized_count, report.normalized_count);
        EXPECT_EQ(expected->from_neighbor_count, report.from_neighbor_count);
        EXPECT_EQ(expected->from_basis_count, report.from_basis_count);
        EXPECT_GT(report.mended_count, 0u);
    }
}

TEST(CApi, SplitsAndTriangulatesAsTheCppApi) {
    const RandomMesh mesh(5, 60);
    CApiOutputs outputs(mesh.cornerCount());
    ASSERT_TRUE(generateTangents(mesh.view(), {.convention = conventions::opengl}, outputs.view()));
    const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec4>(outputs.tangents), 1e-5f);
    const auto expected =
        splitVertices(mesh.view().indices, mesh.positions.size(), mesh.cornerCount(), {&attribute, 1});
    ASSERT_TRUE(expected);
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_CornerAttribute c_attribute = {attribute.data, 0, 4, 1e-5f};
    tspace_SplitResult* split = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_splitVertices(&c_mesh.indices, mesh.positions.size(), mesh.cornerCount(), &c_attribute,
                                              1, nullptr, &split, nullptr));
    EXPECT_EQ(expected->indices, std::vector(split->indices, split->indices + split->corner_count));
    EXPECT_EQ(expected->source_vertices,
              std::vector(split->source_vertices, split->source_vertices + split->vertex_count));
    EXPECT_EQ(expected->source_corners,
              std::vector(split->source_corners, split->source_corners + split->vertex_count));
    EXPECT_GT(split->vertex_count, mesh.positions.size());
    tspace_destroySplitResult(split);

    const auto triangles = triangulate(mesh.view());
    ASSERT_TRUE(triangles);
    tspace_Triangulation* cut = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_triangulate(&c_mesh, &cut, nullptr));
    EXPECT_EQ(triangles->corners, std::vector(cut->corners, cut->corners + 3 * cut->triangle_count));
    EXPECT_EQ(triangles->faces, std::vector(cut->faces, cut->faces + cut->triangle_count));
    tspace_destroyTriangulation(cut);
}

TEST(CApi, MakesIndexedFramesAsTheCppApi) {
    const RandomMesh mesh(8, 60);
    std::vector<std::uint16_t> uv_indices(mesh.cornerCount());
    for (std::size_t c = 0; c < uv_indices.size(); ++c)
        uv_indices[c] = static_cast<std::uint16_t>((mesh.indices[c] + c % 2) % mesh.uvs.size());
    MeshView view = mesh.view();
    view.uv_indices = std::span<const std::uint16_t>(uv_indices);
    tspace_Mesh c_mesh = mesh.c();
    c_mesh.uv_indices = {uv_indices.data(), uv_indices.size(), TSPACE_INDEX_U16};
    for (const std::uint32_t make_normals : {0u, 1u}) {
        const auto expected = makeIndexedFrames(
            view, {.tangents = {.convention = conventions::opengl}, .make_normals = make_normals != 0});
        ASSERT_TRUE(expected) << expected.error().message;
        const tspace_TangentOptions tangents = tangentOptions();
        tspace_IndexedFramesOptions options;
        TSPACE_INIT(options);
        options.tangents = &tangents;
        options.make_normals = make_normals;
        tspace_IndexedFrames* frames = nullptr;
        tspace_Error error;
        ASSERT_EQ(TSPACE_OK, tspace_makeIndexedFrames(&c_mesh, &options, nullptr, &frames, &error)) << error.message;
        ASSERT_EQ(frames->vertex_count, expected->vertexCount());
        ASSERT_EQ(frames->corner_count, expected->indices.size());
        EXPECT_TRUE(std::equal(expected->indices.begin(), expected->indices.end(), frames->indices));
        EXPECT_TRUE(
            std::equal(expected->source_vertices.begin(), expected->source_vertices.end(), frames->source_vertices));
        EXPECT_TRUE(
            std::equal(expected->source_corners.begin(), expected->source_corners.end(), frames->source_corners));
        EXPECT_EQ(0, std::memcmp(expected->normals.data(), frames->normals, sizeof(Vec3) * frames->vertex_count));
        EXPECT_EQ(0, std::memcmp(expected->tangents.data(), frames->tangents, sizeof(Vec4) * frames->vertex_count));
        EXPECT_EQ(make_normals != 0, frames->normal_report != nullptr);
        expectSame(expected->report.tangents, *frames->tangent_report);
        EXPECT_EQ(expected->report.sanitize.mendedCount(), frames->sanitize_report->mended_count);
        tspace_destroyIndexedFrames(frames);
        EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_makeIndexedFrames(&c_mesh, nullptr, nullptr, &frames, nullptr));
        EXPECT_EQ(frames, nullptr);
        options.tangents = nullptr;  // no convention
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_makeIndexedFrames(&c_mesh, &options, nullptr, &frames, nullptr));
    }
    tspace_destroyIndexedFrames(nullptr);
}

TEST(CApi, SplitsWithoutIndices) {
    const float values[3] = {1, 2, 3};
    const tspace_CornerAttribute attribute = {values, 0, 1, 0};
    tspace_SplitResult* split = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_splitVertices(nullptr, 3, 3, &attribute, 1, nullptr, &split, nullptr));
    EXPECT_EQ(split->vertex_count, 3u);
    EXPECT_EQ(split->indices[2], 2u);
    tspace_destroySplitResult(split);
}

TEST(CApi, KnowsEveryPreset) {
    for (const char* name : {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot"}) {
        const Convention* expected = findConvention(name);
        ASSERT_NE(expected, nullptr) << name;
        tspace_Convention convention;
        ASSERT_EQ(TSPACE_OK, tspace_findConvention(name, &convention, nullptr)) << name;
        EXPECT_EQ(static_cast<std::uint32_t>(expected->v_axis), convention.v_axis);
        EXPECT_EQ(static_cast<std::uint32_t>(expected->green), convention.green);
        EXPECT_EQ(static_cast<std::uint32_t>(expected->stored_sign), convention.stored_sign);
        EXPECT_EQ(static_cast<std::uint32_t>(expected->handedness), convention.handedness);
        EXPECT_EQ(static_cast<std::uint32_t>(expected->winding), convention.winding);
        EXPECT_EQ(signFactor(*expected), tspace_signFactor(convention));
        EXPECT_EQ(normalFactor(*expected), tspace_normalFactor(convention));
    }
}

}  // namespace
}  // namespace tspace::test
