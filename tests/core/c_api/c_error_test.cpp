// SPDX-License-Identifier: MIT
// Errors of the C API for invalid calls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "core/c_api/c_convert.h"
#include "core/c_api/random_mesh.h"
#include "tspace/tspace.h"

namespace tspace::test {
namespace {

class CErrors : public testing::Test {
  protected:
    CErrors() {
        TSPACE_INIT(out);
        out.tangents = {tangents.data(), mesh.cornerCount(), 0};
        TSPACE_INIT(pose);
        pose.positions = c_mesh.positions;
        pose.normals = c_mesh.normals;
    }

    tspace_ErrorCode generate(const tspace_TangentOptions* options) {
        return tspace_generateTangents(&c_mesh, options, &out, nullptr, nullptr, &error);
    }
    tspace_Span span(std::size_t floats) { return {tangents.data(), tangents.size() / floats, 0}; }

    RandomMesh mesh{1, 10};
    tspace_Mesh c_mesh = mesh.c();
    std::vector<float> tangents = std::vector<float>(4 * mesh.cornerCount());
    tspace_TangentOutput out;
    tspace_Pose pose;
    tspace_Error error;
};

TEST_F(CErrors, NameTheElementAndTheReason) {
    mesh.indices[7] = 1000;
    EXPECT_EQ(TSPACE_ERROR_INDEX_OUT_OF_RANGE, tspace_validate(&c_mesh, &error));
    EXPECT_EQ(TSPACE_ERROR_INDEX_OUT_OF_RANGE, error.code);
    EXPECT_EQ(7u, error.element);
    EXPECT_NE(nullptr, std::strstr(error.message, "1000")) << error.message;
    mesh.indices[7] = 0;
    EXPECT_EQ(TSPACE_OK, tspace_validate(&c_mesh, &error));
    EXPECT_EQ(TSPACE_OK, error.code);
    EXPECT_EQ(TSPACE_NO_ELEMENT, error.element);
    EXPECT_STREQ("", error.message);
}

TEST_F(CErrors, CutALongMessageBetweenCharacters) {
    const std::string name = [] {
        std::string text = "x";
        for (int i = 0; i < 500; ++i) text += "\xc3\xa4";
        return text;
    }();
    for (const char* shifted : {name.c_str(), name.c_str() + 1}) {
        tspace_Convention convention;
        ASSERT_EQ(TSPACE_ERROR_INVALID_OPTION, tspace_findConvention(shifted, &convention, &error));
        const std::size_t length = std::strlen(error.message);
        ASSERT_LT(length, sizeof(error.message));
        ASSERT_GE(length, sizeof(error.message) - 2);
        EXPECT_EQ('\xa4', error.message[length - 1]);
    }
}

/// Checks that every wrong struct size is rejected, whether smaller or larger. `earlier`: size of an earlier version,
/// which is accepted.
template <class Struct, class Call>
void expectSizeChecked(const char* what, Struct& sized, Call call, std::size_t earlier = 0) {
    const std::uint32_t right = sized.struct_size;
    for (const std::uint32_t wrong : {0u, 4u, right - 4, right - 2, right + 4, 0xffffffffu}) {
        if (wrong != 0 && wrong == earlier) continue;
        sized.struct_size = wrong;
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, call()) << what << " " << wrong;
    }
    sized.struct_size = right;
    EXPECT_EQ(TSPACE_OK, call()) << what;
}

TEST_F(CErrors, RejectSizesOfStructsThatThisVersionDoesNotKnow) {
    tspace_TangentOptions tangent_options = tangentOptions();
    tspace_TangentReport tangent_report;
    TSPACE_INIT(tangent_report);
    const auto generate_all = [&] {
        return tspace_generateTangents(&c_mesh, &tangent_options, &out, nullptr, &tangent_report, &error);
    };
    expectSizeChecked("mesh", c_mesh, generate_all);
    expectSizeChecked("options", tangent_options, generate_all, offsetof(tspace_TangentOptions, normalize_normals));
    expectSizeChecked("out", out, generate_all);
    expectSizeChecked("report", tangent_report, generate_all);
    expectSizeChecked("validate", c_mesh, [&] { return tspace_validate(&c_mesh, nullptr); });

    tspace_NormalOptions normal_options;
    TSPACE_INIT(normal_options);
    tspace_NormalReport normal_report;
    TSPACE_INIT(normal_report);
    std::vector<float> normals(3 * mesh.cornerCount());
    const auto normals_all = [&] {
        return tspace_generateNormals(&c_mesh, &normal_options, {normals.data(), mesh.cornerCount(), 0}, nullptr,
                                      &normal_report, nullptr);
    };
    expectSizeChecked("normal options", normal_options, normals_all);
    expectSizeChecked("normal report", normal_report, normals_all);

    tspace_SanitizeOptions sanitize_options;
    TSPACE_INIT(sanitize_options);
    tspace_SanitizeReport sanitize_report;
    TSPACE_INIT(sanitize_report);
    const auto sanitize_all = [&] {
        return tspace_sanitizeTangents(&c_mesh, &sanitize_options, span(4), nullptr, &sanitize_report, nullptr);
    };
    expectSizeChecked("sanitize options", sanitize_options, sanitize_all);
    expectSizeChecked("sanitize report", sanitize_report, sanitize_all);

    tspace_TangentPlan* plan = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_planTangents(&c_mesh, &tangent_options, nullptr, &plan, nullptr));
    expectSizeChecked("pose", pose,
                      [&] { return tspace_evaluateTangents(plan, &pose, &out, nullptr, &tangent_report, nullptr); });
    tspace_TangentPlanInfo info;
    TSPACE_INIT(info);
    expectSizeChecked("info", info, [&] { return tspace_describeTangentPlan(plan, &info, nullptr); });
    tspace_destroyTangentPlan(plan);
}

/// The struct of an older header, which ended before `first_new`. The callee must not access the bytes after its end.
template <class Struct>
struct AsOldCaller {
    AsOldCaller(const Struct& now, std::size_t first_new) : size(first_new) {
        bytes.fill(std::byte{0xee});
        std::memcpy(bytes.data(), &now, size);
        get().struct_size = static_cast<std::uint32_t>(size);
    }
    Struct& get() { return *reinterpret_cast<Struct*>(bytes.data()); }
    [[nodiscard]] bool isRestUntouched() const {
        return std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(size), bytes.end(),
                           [](std::byte b) { return b == std::byte{0xee}; });
    }

    std::size_t size;
    alignas(Struct) std::array<std::byte, sizeof(Struct)> bytes;
};

TEST_F(CErrors, SupportCallersCompiledWithAnOlderHeader) {
    const tspace_TangentOptions now = tangentOptions();
    ASSERT_EQ(TSPACE_OK, generate(&now));
    const std::vector<float> expected = tangents;
    AsOldCaller<tspace_Mesh> old_mesh(c_mesh, offsetof(tspace_Mesh, normal_indices));
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&old_mesh.get(), &now, &out, nullptr, nullptr, &error))
        << error.message;
    EXPECT_EQ(tangents, expected);
    EXPECT_EQ(tspace_cornerCount(&old_mesh.get()), mesh.cornerCount());
    AsOldCaller<tspace_TangentOutput> old_out(out, offsetof(tspace_TangentOutput, has_tangent));
    tangents[0] = NAN;
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &now, &old_out.get(), nullptr, nullptr, &error));
    EXPECT_EQ(tangents, expected);

    tspace_SanitizeReport report;
    TSPACE_INIT(report);
    AsOldCaller<tspace_SanitizeReport> old_report(report, offsetof(tspace_SanitizeReport, placeholder_count));
    tangents[0] = NAN;
    ASSERT_EQ(TSPACE_OK,
              tspace_sanitizeTangents(&old_mesh.get(), nullptr, out.tangents, nullptr, &old_report.get(), &error));
    EXPECT_EQ(old_report.get().not_finite_count, 1u);
    EXPECT_EQ(old_report.get().struct_size, offsetof(tspace_SanitizeReport, placeholder_count));
    EXPECT_TRUE(old_report.isRestUntouched());

    tspace_NormalOptions normals;
    TSPACE_INIT(normals);
    AsOldCaller<tspace_NormalOptions> old_options(normals, offsetof(tspace_NormalOptions, denoise));
    tspace_NormalReport made;
    TSPACE_INIT(made);
    AsOldCaller<tspace_NormalReport> old_made(made, offsetof(tspace_NormalReport, noise));
    std::vector<float> room(3 * mesh.cornerCount());
    ASSERT_EQ(TSPACE_OK, tspace_generateNormals(&old_mesh.get(), &old_options.get(), {room.data(), room.size() / 3, 0},
                                                nullptr, &old_made.get(), &error))
        << error.message;
    EXPECT_NE(old_made.get().face_count, 0u);
    EXPECT_TRUE(old_made.isRestUntouched());
}

TEST_F(CErrors, KnowEverySizeThatAStructHad) {
    // Sizes of a struct that grew twice.
    constexpr std::size_t kGrown[] = {24, 32, 48};
    for (const std::uint32_t size : {24U, 32U, 48U})
        EXPECT_EQ(c_api::checkStructSize(size, kGrown, "options").code, ErrorCode::ok) << size;
    for (const std::uint32_t size : {0U, 28U, 40U, 52U, 0xffffffffU})
        EXPECT_EQ(c_api::checkStructSize(size, kGrown, "options").code, ErrorCode::invalidOption) << size;
    // Sizes in published headers on 64-bit machines, which must never change.
    const auto expectKnown = [](std::span<const std::size_t> known, std::initializer_list<std::size_t> sizes) {
        for (const std::size_t size : sizes)
            EXPECT_NE(std::find(known.begin(), known.end(), size), known.end()) << size;
    };
    if (sizeof(void*) != 8) return;
    expectKnown(c_api::kSizes<tspace_Mesh>, {120, 168});
    expectKnown(c_api::kSizes<tspace_Execution>, {32});
    expectKnown(c_api::kSizes<tspace_TangentOptions>, {52});
    expectKnown(c_api::kSizes<tspace_TangentReport>, {72});
    expectKnown(c_api::kSizes<tspace_TangentOutput>, {104, 128});
    expectKnown(c_api::kSizes<tspace_TangentPlanInfo>, {40});
    expectKnown(c_api::kSizes<tspace_Pose>, {56});
    expectKnown(c_api::kSizes<tspace_NormalOptions>, {64});
    expectKnown(c_api::kSizes<tspace_NormalReport>, {32});
    expectKnown(c_api::kSizes<tspace_SanitizeOptions>, {8});
    expectKnown(c_api::kSizes<tspace_SanitizeReport>, {104, 112});
    expectKnown(c_api::kSizes<tspace_IndexedFramesOptions>, {48});
    expectKnown(c_api::kSizes<tspace_PackReport>, {72});
}

TEST_F(CErrors, ReportRequiredPointersThatAreNull) {
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_validate(nullptr, &error));
    EXPECT_STREQ("mesh is null", error.message);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_generateNormals(nullptr, nullptr, span(3), nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_generateTangents(nullptr, nullptr, &out, nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_generateTangents(&c_mesh, nullptr, nullptr, nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_sanitizeTangents(nullptr, nullptr, span(4), nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_planTangents(&c_mesh, nullptr, nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_evaluateTangents(nullptr, &pose, &out, nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_splitVertices(nullptr, 3, 3, nullptr, 1, nullptr, nullptr, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_triangulate(&c_mesh, nullptr, nullptr));
    tspace_Convention convention;
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_findConvention(nullptr, &convention, nullptr));
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_findConvention("gltf", nullptr, nullptr));
    tspace_TangentPlanInfo info;
    TSPACE_INIT(info);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_describeTangentPlan(nullptr, &info, nullptr));

    c_mesh.face_sizes = nullptr;
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_validate(&c_mesh, nullptr));
    c_mesh = mesh.c();
    c_mesh.positions.data = nullptr;
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_validate(&c_mesh, nullptr));
}

TEST_F(CErrors, SetResultsToNull) {
    const tspace_TangentOptions options = tangentOptions();
    c_mesh.positions.data = nullptr;
    auto* plan = reinterpret_cast<tspace_TangentPlan*>(&c_mesh);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_planTangents(&c_mesh, &options, nullptr, &plan, nullptr));
    EXPECT_EQ(nullptr, plan);
    auto* cut = reinterpret_cast<tspace_Triangulation*>(&c_mesh);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_triangulate(&c_mesh, &cut, nullptr));
    EXPECT_EQ(nullptr, cut);
    auto* split = reinterpret_cast<tspace_SplitResult*>(&c_mesh);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_splitVertices(nullptr, 3, 3, nullptr, 1, nullptr, &split, nullptr));
    EXPECT_EQ(nullptr, split);
}

TEST_F(CErrors, RejectChoicesThatDoNotExist) {
    const auto expectRefused = [&](auto change) {
        tspace_TangentOptions options = tangentOptions();
        change(options);
        EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, generate(&options)) << error.message;
    };
    expectRefused([](auto& o) { o.method = 9; });
    expectRefused([](auto& o) { o.pairing = 2; });
    expectRefused([](auto& o) { o.ngons = 2; });
    expectRefused([](auto& o) { o.domain = 2; });
    expectRefused([](auto& o) { o.frame = 2; });
    expectRefused([](auto& o) { o.domain = TSPACE_DOMAIN_VERTEX; });  // mikktspace has no results per vertex
    expectRefused([](auto& o) { o.convention.v_axis = 3; });
    expectRefused([](auto& o) { o.convention.green = 2; });
    expectRefused([](auto& o) { o.convention.stored_sign = 2; });
    expectRefused([](auto& o) { o.convention.handedness = 2; });
    expectRefused([](auto& o) { o.convention.winding = 2; });
    c_mesh.indices.type = 3;
    const tspace_TangentOptions sound = tangentOptions();
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, generate(&sound));
    EXPECT_NE(nullptr, std::strstr(error.message, "index type")) << error.message;

    tspace_NormalOptions options;
    TSPACE_INIT(options);
    c_mesh = mesh.c();
    options.weighting = TSPACE_NORMAL_WEIGHTING_BEST + 1;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION,
              tspace_generateNormals(&c_mesh, &options, span(3), nullptr, nullptr, &error));
    EXPECT_NE(nullptr, std::strstr(error.message, "weighting")) << error.message;
}

TEST_F(CErrors, RejectHooksWithoutFunctions) {
    const tspace_Executor executor = {nullptr, nullptr, 1};
    const tspace_Allocator allocator = {nullptr, nullptr, nullptr};
    const tspace_TangentOptions options = tangentOptions();
    tspace_Execution execution;
    TSPACE_INIT(execution);
    const auto codeOf = [&] { return tspace_generateTangents(&c_mesh, &options, &out, &execution, nullptr, &error); };
    EXPECT_EQ(TSPACE_OK, codeOf());
    execution.executor = &executor;
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, codeOf());
    execution.executor = nullptr;
    execution.allocator = &allocator;
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, codeOf());
    execution.struct_size = 3;
    EXPECT_EQ(TSPACE_ERROR_INVALID_OPTION, codeOf());
}

TEST_F(CErrors, PassOnErrorsOfTheLibrary) {
    const tspace_TangentOptions options = tangentOptions();
    tspace_Mesh bad = c_mesh;
    bad.positions.stride_bytes = 8;
    EXPECT_EQ(TSPACE_ERROR_STRIDE_TOO_SMALL, tspace_validate(&bad, nullptr));
    bad.positions.stride_bytes = 14;
    EXPECT_EQ(TSPACE_ERROR_MISALIGNED, tspace_validate(&bad, nullptr));
    out.tangents.count -= 1;
    EXPECT_EQ(TSPACE_ERROR_COUNT_MISMATCH, generate(&options));
}

TEST_F(CErrors, HaveANameForEveryCode) {
    EXPECT_STREQ("ok", tspace_errorName(TSPACE_OK));
    for (tspace_ErrorCode code = TSPACE_ERROR_NULL_DATA; code <= TSPACE_ERROR_CANCELLED; ++code) {
        EXPECT_STRNE("unknown", tspace_errorName(code)) << code;
    }
    for (tspace_ErrorCode code = TSPACE_ERROR_INVALID_FILE; code <= TSPACE_ERROR_CANNOT_WRITE; ++code) {
        EXPECT_STRNE("unknown", tspace_errorName(code)) << code;
    }
}

}  // namespace
}  // namespace tspace::test
