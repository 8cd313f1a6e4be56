// SPDX-License-Identifier: MIT
#include "tspace/tangents.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <vector>

#include "support/same_bits.h"
#include "support/thread_team.h"
#include "tspace/indexed_frames.h"

namespace tspace {
namespace {

using Indices = std::vector<std::uint32_t>;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

using test::sameBits;
bool sameBits(const Vec4& a, const Vec4& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Scene {
    std::vector<Vec3> positions, normals;
    Indices indices, face_sizes;
    std::vector<Vec4> tangents;

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
        mesh.face_sizes = face_sizes;
        return mesh;
    }
    SanitizeReport sanitize(const SanitizeOptions& options = {}, const Execution& execution = {}) {
        const Result<SanitizeReport> report = sanitizeTangents(view(), options, tangents, execution);
        EXPECT_TRUE(report.ok());
        return *report;
    }
};

/// Returns two triangles that share an edge. All of their frames are valid.
Scene twoTriangles() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
            .normals = {4, Vec3{0, 0, 1}},
            .indices = {0, 1, 2, 2, 1, 3},
            .face_sizes = {3, 3},
            .tangents = std::vector<Vec4>(6, Vec4{1, 0, 0, 1})};
}

double unitDot(const Vec3& n, const Vec4& t) {
    const double size = std::sqrt(double{n.x} * n.x + double{n.y} * n.y + double{n.z} * n.z);
    return (double{n.x} * t.x + double{n.y} * t.y + double{n.z} * t.z) / size;
}

double lengthOf(const Vec4& t) { return std::sqrt(double{t.x} * t.x + double{t.y} * t.y + double{t.z} * t.z); }

void expectMended(const Vec4& t, const Vec3& n) {
    EXPECT_NEAR(lengthOf(t), 1, 1e-6);
    EXPECT_NEAR(unitDot(n, t), 0, 1e-6);
    EXPECT_TRUE(t.w == 1.0f || t.w == -1.0f);
}

TEST(Sanitize, ChangesNoBitOfValidTangents) {
    Scene scene = twoTriangles();
    scene.tangents[0] = {1.0004f, 0, -0.0f, 1};  // of unit length within the validator's tolerance
    scene.tangents[1] = {0.8f, 0, 0.6f, 1};      // not orthogonal, which is not a fault of the frame
    scene.tangents[2] = {0.9f, std::sqrt(0.19f), 0, 1};
    const std::vector<Vec4> before = scene.tangents;
    EXPECT_EQ(scene.sanitize().mendedCount(), 0u);
    EXPECT_TRUE(sameBits(scene.tangents, before));
}

TEST(Sanitize, CountsEachCornerByItsFirstCauseAndItsRepair) {
    Scene scene = twoTriangles();
    scene.tangents = {{kNan, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 2, 0, 1}, {0, 0, 1, 1}, {1, 0, 0, 0}};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.not_finite_count, 1u);
    EXPECT_EQ(report.zero_count, 1u);
    EXPECT_EQ(report.not_unit_count, 1u);
    EXPECT_EQ(report.parallel_count, 1u);
    EXPECT_EQ(report.bad_sign_count, 1u);
    EXPECT_EQ(report.mendedCount(), 5u);
    EXPECT_EQ(report.normalized_count, 2u);     // the long one and the one without a sign
    EXPECT_EQ(report.from_neighbor_count, 2u);  // from the valid corner of their face
    EXPECT_EQ(report.from_basis_count, 1u);     // no valid corner in its face or at its position
    EXPECT_TRUE(sameBits(scene.tangents[0], {1, 0, 0, 1}));
    EXPECT_TRUE(sameBits(scene.tangents[1], {1, 0, 0, 1}));
    EXPECT_TRUE(sameBits(scene.tangents[3], {0, 1, 0, 1}));
    for (const Vec4& t : scene.tangents) expectMended(t, {0, 0, 1});
}

TEST(Sanitize, FindsAnInvalidCornerAtAnyPosition) {
    Scene scene = twoTriangles();
    scene.face_sizes = {};
    for (std::uint32_t face = 2; face < 130; ++face) scene.indices.insert(scene.indices.end(), {0, 1, 2});
    // Every fourth face has the sign -1.
    for (std::size_t c = scene.tangents.size(); c < scene.indices.size(); ++c)
        scene.tangents.push_back({1, 0, 0, c / 3 % 4 == 1 ? -1.0f : 1.0f});
    ASSERT_EQ(scene.sanitize().mendedCount(), 0u);
    for (std::size_t c = 0; c < scene.tangents.size(); ++c) {
        const Vec4 sound = scene.tangents[c];
        const Vec4 other_sign{1, 0, 0, -sound.w}, half_sign{1, 0, 0, 0.5f};
        for (const Vec4& broken : {other_sign, half_sign, Vec4{0, 0, 1, sound.w}, Vec4{0, 2, 0, sound.w},
                                   Vec4{kNan, 0, 0, sound.w}, Vec4{1, 0, 0, kNan}}) {
            scene.tangents[c] = broken;
            ASSERT_EQ(scene.sanitize().mendedCount(), 1u) << "corner " << c;
            ASSERT_EQ(scene.tangents[c].w, sound.w);
        }
        scene.tangents[c] = sound;
    }
}

TEST(Sanitize, UsesTheFirstValidTangentAtThePositionIfTheFaceHasNone) {
    Scene scene = twoTriangles();
    scene.positions[2].x = -0.0f;
    scene.positions.push_back({0, 1, 0});  // the same position with a different index and a different zero
    scene.normals.push_back({0, 0, 1});
    scene.indices[3] = 4;
    scene.tangents = {{1, 0, 0, -1}, {1, 0, 0, -1}, {0, -1, 0, -1}, {0, 0, 0, kNan}, {0, 0, 0, 5}, {0, 0, 0, 0}};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.from_neighbor_count, 2u);
    EXPECT_EQ(report.from_basis_count, 1u);
    EXPECT_TRUE(sameBits(scene.tangents[3], {0, -1, 0, -1}));
    EXPECT_TRUE(sameBits(scene.tangents[4], {1, 0, 0, -1}));
    expectMended(scene.tangents[5], {0, 0, 1});
    EXPECT_EQ(scene.tangents[5].w, -1.0f);
}

TEST(Sanitize, KeepsTheSignOfAnInvalidFace) {
    Scene scene = twoTriangles();
    for (std::size_t c = 3; c < 6; ++c) scene.tangents[c] = {kNan, kNan, kNan, -1};
    scene.sanitize();
    for (std::size_t c = 3; c < 6; ++c) EXPECT_EQ(scene.tangents[c].w, -1.0f);
}

TEST(Sanitize, UsesTheMajoritySignOfValidCornersOfAFace) {
    Scene scene = twoTriangles();
    scene.tangents[0].w = -1;
    scene.tangents[3] = {0, 3, 0, -1};
    scene.tangents[4] = {0, 0, 0, -1};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.mixed_sign_count, 1u);
    for (const Vec4& t : scene.tangents) EXPECT_EQ(t.w, 1.0f);
}

TEST(Sanitize, TheFirstValidCornerDecidesATie) {
    Scene scene;
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    scene.normals = {4, Vec3{0, 0, 1}};
    scene.indices = {0, 1, 2, 3};
    scene.face_sizes = {4};
    scene.tangents = {{1, 0, 0, -1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, -1}};
    scene.sanitize();
    for (const Vec4& t : scene.tangents) EXPECT_EQ(t.w, -1.0f);
}

TEST(Sanitize, WritesAnOrthonormalTangentWhereItChangesTheSign) {
    Scene scene = twoTriangles();
    scene.tangents[0] = {0.8f, 0, 0.6f, -1};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.mixed_sign_count, 1u);
    EXPECT_EQ(report.normalized_count, 1u);
    EXPECT_TRUE(sameBits(scene.tangents[0], {1, 0, 0, 1}));
}

TEST(Sanitize, TreatsLessThanOneDegreeAsParallel) {
    const auto tilted = [](double degrees) {
        const double a = degrees * 3.14159265358979 / 180;
        return Vec4{static_cast<float>(std::sin(a)), 0, static_cast<float>(-std::cos(a)), 1};
    };
    Scene scene = twoTriangles();
    scene.tangents[0] = tilted(0.99);
    scene.tangents[1] = tilted(1.01);
    scene.tangents[4] = tilted(179.01);
    const Vec4 sound = scene.tangents[1];
    EXPECT_EQ(scene.sanitize().parallel_count, 2u);
    EXPECT_TRUE(sameBits(scene.tangents[1], sound));
}

TEST(Sanitize, ProjectsPlaceholdersOntoTheSurface) {
    Scene scene = twoTriangles();
    scene.normals[1] = {0.6f, 0, 0.8f};
    scene.normals[3] = {3, 0, 0.1f};  // 2 degrees from the placeholder's direction
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.placeholder_count, 3u);
    EXPECT_EQ(report.mendedCount(), 3u);
    EXPECT_EQ(report.normalized_count, 3u);
    for (const std::size_t c : {1u, 4u}) {
        expectMended(scene.tangents[c], scene.normals[1]);
        EXPECT_GT(scene.tangents[c].x, 0);
    }
    expectMended(scene.tangents[5], scene.normals[3]);
    for (const std::size_t c : {0u, 2u, 3u}) EXPECT_TRUE(sameBits(scene.tangents[c], {1, 0, 0, 1}));
}

TEST(Sanitize, KeepsTheTiltOfOtherTangents) {
    Scene scene = twoTriangles();
    scene.normals[1] = {0.6f, 0, 0.8f};
    for (const std::size_t c : {1u, 4u}) scene.tangents[c] = {0.99999994f, 1e-8f, 0, 1};
    const std::vector<Vec4> before = scene.tangents;
    EXPECT_EQ(scene.sanitize().mendedCount(), 0u);
    EXPECT_TRUE(sameBits(scene.tangents, before));
}

TEST(Sanitize, IgnoresPlaceholdersForTheSignOfAFace) {
    Scene scene = twoTriangles();
    scene.normals[0] = scene.normals[1] = {0.6f, 0, 0.8f};
    scene.tangents[0].w = scene.tangents[1].w = -1;
    const Vec4 real{0, 1, 0, 1};
    scene.tangents[2] = real;
    scene.sanitize();
    EXPECT_TRUE(sameBits(scene.tangents[2], real));
    EXPECT_EQ(scene.tangents[0].w, 1);
    EXPECT_EQ(scene.tangents[1].w, 1);
}

TEST(Sanitize, MakesAllFramesOrthogonalOnlyOnRequest) {
    Scene scene = twoTriangles();
    scene.normals[0] = {0, 0, 0.98f};
    scene.tangents[0] = {0.8f, 0, 0.6f, 1};
    scene.tangents[1] = {1.0002f, 0, 0, 1};
    const SanitizeReport report = scene.sanitize({.orthogonalize_all = true});
    EXPECT_EQ(report.orthogonalized_count, 2u);
    EXPECT_EQ(report.mendedCount(), report.normalized_count);
    for (const Vec4& t : scene.tangents) {
        expectMended(t, {0, 0, 1});
        EXPECT_GT(t.x, 0.999999f);
    }
}

TEST(Sanitize, GivesAUnitTangentIfTheNormalIsInvalid) {
    Scene scene = twoTriangles();
    scene.normals = {{0, 0, 0}, {kNan, 0, 0}, {0, -kInf, 0}, {0, 0, 1e-42f}};
    for (Vec4& t : scene.tangents) t = {kNan, 0, 0, kNan};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.bad_normal_count, 5u);
    for (const Vec4& t : scene.tangents) EXPECT_NEAR(lengthOf(t), 1, 1e-6);
    expectMended(scene.tangents[5], scene.normals[3]);
}

/// A vertex whose N has no direction needs only one tangent, so it need not be split.
TEST(Sanitize, GivesOneTangentToAVertexWithAnInvalidNormal) {
    for (const Vec3& normal : {Vec3{}, Vec3{kNan, kNan, kNan}}) {
        Scene scene = twoTriangles();
        scene.normals[1] = normal;
        scene.tangents = {{1, 0, 0, 1}, {kNan, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {kNan, 0, 0, 1}, {0, 1, 0, 1}};
        EXPECT_EQ(scene.sanitize().from_neighbor_count, 2u);
        EXPECT_TRUE(sameBits(scene.tangents[1], {1, 0, 0, 1}));
        EXPECT_TRUE(sameBits(scene.tangents[4], {1, 0, 0, 1}));
        // Each face keeps its sign if the signs of the faces differ.
        scene.tangents = {{1, 0, 0, 1}, {kNan, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, -1}, {kNan, 0, 0, 1}, {0, 1, 0, -1}};
        scene.sanitize();
        EXPECT_TRUE(sameBits(scene.tangents[1], {1, 0, 0, 1}));
        EXPECT_TRUE(sameBits(scene.tangents[4], {0, 1, 0, -1}));
    }
}

TEST(Sanitize, IgnoresCornersWithoutANormalForTheSignOfAFace) {
    Scene scene = twoTriangles();
    scene.normals[1] = scene.normals[2] = {};
    scene.tangents[0].w = scene.tangents[5].w = -1;
    scene.sanitize();
    for (const Vec4& tangent : scene.tangents) EXPECT_EQ(tangent.w, -1);
}

TEST(Sanitize, IgnoresFacesWithFewerThanThreeCorners) {
    Scene scene = twoTriangles();
    scene.face_sizes = {2, 1, 3};
    scene.tangents.assign(6, Vec4{});
    EXPECT_EQ(scene.sanitize().mendedCount(), 3u);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(sameBits(scene.tangents[c], Vec4{}));
}

TEST(Sanitize, RejectsInvalidArguments) {
    Scene scene = twoTriangles();
    MeshView mesh = scene.view();
    mesh.normals = {};
    EXPECT_EQ(sanitizeTangents(mesh, {}, scene.tangents).error().code, ErrorCode::missingAttribute);
    scene.tangents.pop_back();
    EXPECT_EQ(sanitizeTangents(scene.view(), {}, scene.tangents).error().code, ErrorCode::countMismatch);
    EXPECT_EQ(sanitizeTangents(scene.view(), {}, {nullptr, 6}).error().code, ErrorCode::nullData);
    EXPECT_TRUE(sanitizeTangents(MeshView{}, {}, {}).ok());
}

float anyValue() {
    return *rc::gen::weightedOneOf<float>(
        {{6, rc::gen::map(rc::gen::inRange(-4, 5), [](int k) { return 0.25f * static_cast<float>(k); })},
         {1, rc::gen::element(kNan, kInf, -kInf, 3e38f, 1e-45f, -0.0f, 1e-39f)},
         {2, rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                          [](std::uint32_t bits) { return std::bit_cast<float>(bits); })}});
}

/// Returns a scene of random values, many of which are valid frames.
Scene anyScene() {
    Scene scene;
    const auto vertices = *rc::gen::inRange<std::size_t>(1, 12);
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto coordinate = [] { return *rc::gen::element(0.0f, -0.0f, 1.0f, kNan); };
        scene.positions.push_back({coordinate(), coordinate(), coordinate()});
        scene.normals.push_back(*rc::gen::inRange(0, 3) == 0 ? Vec3{anyValue(), anyValue(), anyValue()}
                                                             : Vec3{0, 0, 1});
    }
    scene.face_sizes = *rc::gen::container<Indices>(rc::gen::inRange<std::uint32_t>(0, 6));
    for (const std::uint32_t size : scene.face_sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            scene.indices.push_back(*rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(vertices)));
            const float sign = *rc::gen::element(1.0f, 1.0f, -1.0f, 0.0f, kNan);
            scene.tangents.push_back(*rc::gen::inRange(0, 2) == 0
                                         ? Vec4{anyValue(), anyValue(), anyValue(), sign}
                                         : *rc::gen::element(Vec4{0.6f, 0.8f, 0, sign}, Vec4{1, 0, 0, sign}));
        }
    }
    return scene;
}

RC_GTEST_PROP(Sanitize, KeepsItsPromisesOnGarbage, ()) {
    Scene scene = anyScene();
    const std::vector<Vec4> before = scene.tangents;
    const SanitizeReport report = scene.sanitize();
    std::uint64_t changed = 0;
    std::size_t first = 0;
    for (const std::uint32_t size : scene.face_sizes) {
        for (std::size_t c = first; c < first + size; ++c) {
            const bool is_same = sameBits(before[c], scene.tangents[c]);
            if (size < 3) RC_ASSERT(is_same);
            if (size < 3) continue;
            const Vec4& t = scene.tangents[c];
            RC_ASSERT(t.w == 1.0f || t.w == -1.0f);
            RC_ASSERT(t.w == scene.tangents[first].w);
            RC_ASSERT(std::abs(lengthOf(t) - 1) <= (is_same ? 5e-4 : 1e-6));
            const Vec3& n = scene.normals[scene.indices[c]];
            const double size2 = double{n.x} * n.x + double{n.y} * n.y + double{n.z} * n.z;
            if (size2 > 0 && size2 < std::numeric_limits<double>::infinity()) {
                RC_ASSERT(std::abs(unitDot(n, t)) <=
                          (is_same ? lengthOf(t) * std::cos(0.99 * 3.14159265358979 / 180) : 1e-6));
                if (t.x == 1 && t.y == 0 && t.z == 0) RC_ASSERT(std::abs(unitDot(n, t)) <= 1e-6);
            }
            if (!is_same) ++changed;
        }
        first += size;
    }
    RC_ASSERT(changed <= report.mendedCount());
    RC_ASSERT(report.mendedCount() == report.normalized_count + report.from_neighbor_count + report.from_basis_count);
}

RC_GTEST_PROP(Sanitize, ChangesNothingTheSecondTime, ()) {
    Scene scene = anyScene();
    const SanitizeOptions options{.orthogonalize_all = *rc::gen::arbitrary<bool>()};
    scene.sanitize(options);
    const std::vector<Vec4> once = scene.tangents;
    RC_ASSERT(scene.sanitize(options).mendedCount() == 0);
    RC_ASSERT(sameBits(once, scene.tangents));
}

RC_GTEST_PROP(Sanitize, DoesNotDependOnHowVerticesAreIndexed, ()) {
    Scene scene = anyScene();
    Scene loose = scene;
    loose.positions.clear();
    loose.normals.clear();
    for (std::size_t c = 0; c < scene.indices.size(); ++c) {
        loose.positions.push_back(scene.positions[scene.indices[c]]);
        loose.normals.push_back(scene.normals[scene.indices[c]]);
        loose.indices[c] = static_cast<std::uint32_t>(c);
    }
    scene.sanitize();
    loose.sanitize();
    RC_ASSERT(sameBits(scene.tangents, loose.tangents));
}

TEST(Sanitize, GivesTheSameBitsForAnyThreadCount) {
    Scene scene;
    std::uint32_t state = 1;
    const auto random = [&] { return state = state * 1664525u + 1013904223u; };
    for (std::uint32_t v = 0; v < 5000; ++v) {
        scene.positions.push_back({static_cast<float>(v % 700), 0, 0});
        scene.normals.push_back({static_cast<float>(random() >> 24) - 128, 1, 2});
    }
    for (std::uint32_t f = 0; f < 30000; ++f) {
        scene.face_sizes.push_back(2 + (random() >> 16) % 4);
        for (std::uint32_t k = 0; k < scene.face_sizes.back(); ++k) {
            scene.indices.push_back((random() >> 8) % 5000);
            const auto value = [&] { return static_cast<float>((random() >> 20) % 3) - 1; };
            scene.tangents.push_back({value(), value(), value(), value()});
        }
    }
    Scene serial = scene;
    const SanitizeReport expected = serial.sanitize();
    for (const unsigned threads : {2u, 3u, 8u}) {
        Scene parallel = scene;
        const SanitizeReport report = parallel.sanitize({}, {.executor = test::threadTeam(threads)});
        EXPECT_TRUE(sameBits(parallel.tangents, serial.tangents));
        EXPECT_EQ(report.mendedCount(), expected.mendedCount());
        EXPECT_EQ(report.from_neighbor_count, expected.from_neighbor_count);
    }
}

TEST(Sanitize, ReportsThatMemoryRanOutAndFreesAllOfIt) {
    struct Memory {
        int left = 0;
        int held = 0;
    };
    Scene scene = twoTriangles();
    scene.tangents[0] = scene.tangents[1] = scene.tangents[2] = {};
    for (int allowed = 0;; ++allowed) {
        Memory memory{.left = allowed};
        const Allocator allocator{.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                                      auto* m = static_cast<Memory*>(user);
                                      if (m->left-- == 0) return nullptr;
                                      ++m->held;
                                      return ::operator new(bytes, std::align_val_t(alignment));
                                  },
                                  .release =
                                      [](void* user, void* data, std::size_t, std::size_t alignment) {
                                          --static_cast<Memory*>(user)->held;
                                          ::operator delete(data, std::align_val_t(alignment));
                                      },
                                  .user = &memory};
        std::vector<Vec4> tangents = scene.tangents;
        const auto result = sanitizeTangents(scene.view(), {}, tangents, {.allocator = &allocator});
        EXPECT_EQ(memory.held, 0);
        if (result.ok()) {
            EXPECT_GT(allowed, 2);
            break;
        }
        EXPECT_EQ(result.error().code, ErrorCode::outOfMemory);
        EXPECT_TRUE(sameBits(tangents, scene.tangents));
    }
}

/// An algorithm that takes quadratic time would exceed the test's time limit.
TEST(SanitizeTime, StaysLinearWhenEveryCornerLooksForANeighborAtOnePosition) {
    Scene scene;
    const std::uint32_t faces = 300000;
    for (std::uint32_t c = 0; c < 3 * faces; ++c) {
        scene.positions.push_back({c % 3 == 0 ? 0.0f : static_cast<float>(c), 0, 0});
        scene.indices.push_back(c);
    }
    scene.normals.assign(3 * faces, {0, 0, 1});
    scene.face_sizes.assign(faces, 3);
    scene.tangents.assign(3 * faces, {});
    scene.tangents[3 * faces - 3] = {0, 1, 0, -1};
    const SanitizeReport report = scene.sanitize();
    EXPECT_EQ(report.from_neighbor_count, faces - 1 + 2);
    EXPECT_TRUE(sameBits(scene.tangents[0], {0, 1, 0, -1}));
}

}  // namespace
}  // namespace tspace
