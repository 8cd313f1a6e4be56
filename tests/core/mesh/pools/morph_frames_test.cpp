// SPDX-License-Identifier: MIT
// Morph targets with computeFrames: base + offset is the frame of the displaced shape.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "core/mesh/pools/pools.h"
#include "tspace/frame.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

using namespace test;
using Targets = std::vector<MorphOffsets>;

/// Returns a view of the mesh with morph targets. `mesh` and `targets` must outlive it.
PoolView withTargets(const OwnedMesh& mesh, const Targets& targets) {
    PoolView pool(mesh);
    pool.targets = {targets.size(), [&targets](std::size_t i) -> Result<MorphOffsets> { return targets[i]; }};
    return pool;
}

Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
double lengthOf(const Vec3& v) { return std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z); }
Vec3 unit(const Vec3& v) {
    const double r = 1 / lengthOf(v);
    return {static_cast<float>(r * v.x), static_cast<float>(r * v.y), static_cast<float>(r * v.z)};
}
double distance(const Vec3& a, const Vec3& b) { return lengthOf({a.x - b.x, a.y - b.y, a.z - b.z}); }

std::vector<Vec3> dense(const VertexOffsets& offsets, std::size_t count) {
    std::vector<Vec3> result(count);
    for (std::size_t i = 0; i < offsets.vertices.size(); ++i) {
        EXPECT_TRUE(i == 0 || offsets.vertices[i] > offsets.vertices[i - 1]);
        EXPECT_FALSE(isZero(offsets.offsets[i]));
        result[offsets.vertices[i]] = offsets.offsets[i];
    }
    return result;
}

/// Returns offsets like those of authored morph targets: most are zero, and all are finite.
std::vector<Vec3> anyOffsets(std::size_t count) {
    std::vector<Vec3> offsets(count);
    for (Vec3& offset : offsets) {
        if (*rc::gen::inRange(0, 3) != 0) continue;
        const auto number = [] { return 0.25f * static_cast<float>(*rc::gen::inRange(-3, 4)); };
        offset = {number(), number(), number()};
    }
    return offsets;
}

Targets anyTargets(const OwnedMesh& pool) {
    Targets targets(*rc::gen::inRange<std::size_t>(1, 4));
    for (MorphOffsets& target : targets) {
        if (*rc::gen::inRange(0, 4) != 0) target.positions = anyOffsets(pool.positions.size());
        if (!pool.normals.empty() && *rc::gen::arbitrary<bool>()) target.normals = anyOffsets(pool.positions.size());
    }
    return targets;
}

/// Returns the targets as they are stored in the written file.
Targets rebuiltTargets(const Targets& targets, const PoolFrames& frames) {
    Targets result;
    for (std::size_t t = 0; t < targets.size(); ++t) {
        MorphOffsets& written = result.emplace_back();
        if (frames.normals_generated) written.normals = dense(frames.morphs[t].normals, frames.source_vertices.size());
        for (const std::uint32_t source : frames.source_vertices) {
            if (!targets[t].positions.empty()) written.positions.push_back(targets[t].positions[source]);
            if (!frames.normals_generated && !targets[t].normals.empty()) {
                written.normals.push_back(targets[t].normals[source]);
            }
        }
    }
    return result;
}

/// Returns a pool that sometimes has vertices that are equal in the base shape.
OwnedMesh anyPoolWithTwins() {
    OwnedMesh pool = anyPool();
    const std::size_t count = pool.positions.size();
    for (std::size_t v = 0; v < count; ++v) {
        if (*rc::gen::inRange(0, 3) != 0) continue;
        pool.positions.push_back(pool.positions[v]);
        pool.uvs.push_back(pool.uvs[v]);
        if (!pool.normals.empty()) pool.normals.push_back(pool.normals[v]);
    }
    return pool;
}

bool isOne(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool isOne(const Vec3& a, const Vec3& b) { return isOne(a.x, b.x) && isOne(a.y, b.y) && isOne(a.z, b.z); }
bool isOne(const Vec2& a, const Vec2& b) { return isOne(a.x, b.x) && isOne(a.y, b.y); }

/// Marks corners whose vertex equals that of another corner in the base shape, but not in the displaced shape. For each
/// refinement step of `best`, also marks the other corners of their triangles.
std::vector<bool> takenApart(const OwnedMesh& base, const OwnedMesh& moved, const Indices& corners,
                             const TangentOptions& options) {
    const auto areTwins = [&](std::uint32_t a, std::uint32_t b) {
        return isOne(base.positions[a], base.positions[b]) && isOne(base.normals[a], base.normals[b]) &&
               isOne(base.uvs[a], base.uvs[b]);
    };
    std::vector<bool> result;
    for (const std::uint32_t v : corners) {
        result.push_back(std::any_of(corners.begin(), corners.end(), [&](std::uint32_t other) {
            return areTwins(v, other) && std::any_of(corners.begin(), corners.end(), [&](std::uint32_t third) {
                       return areTwins(v, third) && !(isOne(moved.positions[other], moved.positions[third]) &&
                                                      isOne(moved.normals[other], moved.normals[third]));
                   });
        }));
    }
    const std::uint32_t steps = options.method == Method::best ? options.refine : 0;
    for (std::uint32_t step = 0; step < steps; ++step) {
        const std::vector<bool> before = result;
        const auto hasApart = [&](std::size_t first) {
            return std::any_of(corners.begin() + first, corners.begin() + first + 3, [&](std::uint32_t v) {
                for (std::size_t c = 0; c < corners.size(); ++c) {
                    if (before[c] && areTwins(v, corners[c])) return true;
                }
                return false;
            });
        };
        std::vector<std::uint32_t> reached;
        for (std::size_t first = 0; first < corners.size(); first += 3) {
            if (hasApart(first)) reached.insert(reached.end(), &corners[first], &corners[first] + 3);
        }
        for (std::size_t c = 0; c < corners.size(); ++c) {
            result[c] = std::any_of(reached.begin(), reached.end(), [&](auto v) { return areTwins(v, corners[c]); });
        }
    }
    return result;
}

/// Returns the sine of the angle between t and the plane with the normal n.
double sineOf(const Vec3& t, const Vec3& n) {
    return (double{n.x} * t.x + double{n.y} * t.y + double{n.z} * t.z) / lengthOf(n) / lengthOf(t);
}

constexpr float kAnyDirection = 1e9f;

/// Evaluates one primitive of a written pool, displaced by a target. Uses the tangent groups of the base shape, or
/// those of the displaced shape if it separates equal vertices. The result is kAnyDirection at corners that get no
/// tangent, or one that leaves the plane of the base tangent.
std::vector<Vec4> evaluated(OwnedMesh pool, const PrimitiveGeometry& primitive, const MorphOffsets& target,
                            const std::vector<Vec4>& base, const FramesOptions& options) {
    MeshView mesh;
    mesh.positions = pool.positions;
    mesh.normals = pool.normals;
    mesh.uvs = pool.uvs;
    mesh.indices = IndexView(std::span<const std::uint32_t>(primitive.indices));
    const Result<TangentPlan> plan = planTangents(mesh, options.tangents);
    RC_ASSERT(plan.ok());
    const OwnedMesh at_rest = pool;
    std::vector<Vec4> rest(primitive.indices.size()), tangents = rest;
    RC_ASSERT(evaluateTangents(*plan, {mesh.positions, mesh.normals}, {.tangents = rest}).ok());
    for (std::size_t v = 0; v < target.positions.size(); ++v) {
        if (!isZero(target.positions[v])) pool.positions[v] = sum(pool.positions[v], target.positions[v]);
    }
    for (std::size_t v = 0; v < target.normals.size(); ++v) {
        if (isZero(target.normals[v])) continue;
        const Vec3 moved = sum(pool.normals[v], target.normals[v]);
        const double length = lengthOf(moved);
        pool.normals[v] = length > 0 && std::isfinite(length) ? unit(moved) : moved;
    }
    RC_ASSERT(evaluateTangents(*plan, {mesh.positions, mesh.normals}, {.tangents = tangents}).ok());
    const auto hasDirection = [](const Vec4& t) { return lengthOf(xyz(t)) > 1e-30; };  // false for NaN too
    const std::vector<bool> apart = takenApart(at_rest, pool, primitive.indices, options.tangents);
    std::vector<Vec4> regrouped(tangents.size());
    RC_ASSERT(generateTangents(mesh, options.tangents, {.tangents = regrouped}).ok());
    const auto carried = [&](const Vec4& tangent, std::uint32_t v) {
        const Vec3& n = pool.normals[v];
        if (at_rest.normals[v] == n || isZero(n) || !std::isfinite(lengthOf(n))) return tangent;
        const Vec3 t = orthonormalize({.tangent = xyz(tangent), .bitangent = {}, .normal = n}).tangent;
        return Vec4{t.x, t.y, t.z, tangent.w};
    };
    for (std::size_t c = 0; c < tangents.size(); ++c) {
        if (!apart[c]) continue;
        const Vec3& n = pool.normals[primitive.indices[c]];
        const bool in_plane = std::fabs(sineOf(xyz(regrouped[c]), n)) <= std::sin(std::numbers::pi / 1800) || isZero(n);
        if (hasDirection(regrouped[c]) && in_plane && regrouped[c].w == tangents[c].w) {
            tangents[c] = regrouped[c];
        } else if (hasDirection(tangents[c])) {
            tangents[c] = carried(tangents[c], primitive.indices[c]);
        }
    }
    if (!options.sanitize) return tangents;
    std::vector<std::size_t> unmoved;
    for (std::size_t c = 0; c < tangents.size(); ++c) {
        const std::uint32_t v = primitive.indices[c];
        const bool same = std::memcmp(&tangents[c], &rest[c], sizeof(Vec4)) == 0;
        if (same && at_rest.normals[v] == pool.normals[v]) unmoved.push_back(c);
    }
    std::vector<std::size_t> collapsed;
    const auto isLost = [&](std::size_t c) {
        const std::uint32_t v = primitive.indices[c];
        const Vec3 &from = at_rest.normals[v], &to = pool.normals[v];
        const bool is_unit = std::fabs(lengthOf(to) * lengthOf(to) - 1) < 1e-3;
        const bool leans = is_unit && std::fabs(sineOf(xyz(tangents[c]), to)) > std::sin(std::numbers::pi / 36);
        const bool leant = std::fabs(sineOf(xyz(base[v]), from)) > std::sin(std::numbers::pi / 1800);
        return !hasDirection(tangents[c]) || (leans && !leant);
    };
    for (std::size_t c = 0; c < tangents.size(); ++c) {
        if (!hasDirection(rest[c]) || !isLost(c)) continue;
        collapsed.push_back(c);
        tangents[c] = carried(base[primitive.indices[c]], primitive.indices[c]);
    }
    RC_ASSERT(sanitizeTangents(mesh, {}, tangents).ok());
    for (const std::size_t c : unmoved) tangents[c] = base[primitive.indices[c]];
    for (const std::size_t c : collapsed) tangents[c] = {kAnyDirection, 0, 0, 1};
    return tangents;
}

RC_GTEST_PROP(MorphFrames, AreThoseOfTheMovedShapeWithTheGroupsOfTheBase, ()) {
    const OwnedMesh pool = anyPoolWithTwins();
    RC_PRE(isOrdinary(pool));  // with 1e20 next to 1, directions would depend on rounding
    const FramesOptions options = anyOptions();
    // Sanitizing may give an invalid corner the tangent of any other corner of its face, and the written file contains
    // only triangles.
    const std::vector<PrimitiveGeometry> primitives = options.sanitize ? anyTriangles(pool) : anyFaces(pool);
    const Targets targets = anyTargets(pool);
    const PoolOutcome result = compute(withTargets(pool, targets), primitives, options);
    const OwnedMesh written = rebuilt(pool, result.frames);
    const Targets moved = rebuiltTargets(targets, result.frames);
    RC_ASSERT(result.frames.morphs.size() == targets.size());
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const std::vector<Vec3> offsets = dense(result.frames.morphs[t].tangents, written.positions.size());
        for (const Indices& corners : result.frames.indices) {
            const std::vector<Vec4> wanted =
                evaluated(written, {.indices = corners}, moved[t], result.frames.tangents, options);
            for (std::size_t c = 0; c < corners.size(); ++c) {
                const Vec3 got = sum(xyz(result.frames.tangents[corners[c]]), offsets[corners[c]]);
                if (wanted[c].x == kAnyDirection) {
                    RC_ASSERT(std::fabs(lengthOf(got) - 1) <= 5e-4);
                    continue;
                }
                const bool finite = std::isfinite(lengthOf(got)) && std::isfinite(lengthOf(xyz(wanted[c])));
                RC_ASSERT(!finite || distance(got, xyz(wanted[c])) <= 3e-7);
                RC_ASSERT(finite || !options.sanitize);
            }
        }
    }
}

RC_GTEST_PROP(MorphFrames, ReproduceThemselvesOnTheirOwnOutput, ()) {
    const OwnedMesh pool = anyPoolWithTwins();
    RC_PRE(isOrdinary(pool));  // a NaN does not equal itself, so copies of its vertex are not merged
    const std::vector<PrimitiveGeometry> primitives = anyFaces(pool);
    const FramesOptions options = anyOptions();
    const Targets targets = anyTargets(pool);
    const PoolOutcome first = compute(withTargets(pool, targets), primitives, options);
    const OwnedMesh written = rebuilt(pool, first.frames);
    const Targets moved = rebuiltTargets(targets, first.frames);
    const PoolOutcome second = compute(withTargets(written, moved), rebuilt(first.frames), options);
    RC_ASSERT(!second.frames.wasSplit(written.positions.size()));
    RC_ASSERT(second.frames.indices == first.frames.indices);
    RC_ASSERT(sameBits(second.frames.tangents, first.frames.tangents));
    for (std::size_t t = 0; t < targets.size(); ++t) {
        RC_ASSERT(second.frames.morphs[t].tangents.vertices == first.frames.morphs[t].tangents.vertices);
        RC_ASSERT(sameBits(second.frames.morphs[t].tangents.offsets, first.frames.morphs[t].tangents.offsets));
    }
}

RC_GTEST_PROP(MorphFrames, LeaveTheBaseUnchangedExceptForSplits, ()) {
    const OwnedMesh pool = anyPoolWithTwins();
    const std::vector<PrimitiveGeometry> primitives = anyFaces(pool);
    const FramesOptions options = anyOptions();
    const PoolOutcome plain = compute(pool, primitives, options);
    const Targets targets = anyTargets(pool);
    const PoolOutcome morphed = compute(withTargets(pool, targets), primitives, options);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        RC_ASSERT(plain.frames.indices[p].size() == morphed.frames.indices[p].size());
        for (std::size_t c = 0; c < plain.frames.indices[p].size(); ++c) {
            const std::uint32_t a = plain.frames.indices[p][c], b = morphed.frames.indices[p][c];
            RC_ASSERT(plain.frames.source_vertices[a] == morphed.frames.source_vertices[b]);
            RC_ASSERT(std::memcmp(&plain.frames.tangents[a], &morphed.frames.tangents[b], sizeof(Vec4)) == 0);
        }
    }
}

/// Two separate bumpy sheets; the UV map of each is mirrored at its middle column.
struct Sheets {
    static constexpr std::uint32_t kSize = 8, kPerSheet = (kSize + 1) * (kSize + 1);
    OwnedMesh pool;
    PrimitiveGeometry primitive;

    Sheets() {
        for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
            for (std::uint32_t i = 0; i < kPerSheet; ++i) addVertex(sheet, i % (kSize + 1), i / (kSize + 1));
            for (std::uint32_t y = 0; y < kSize; ++y) {
                for (std::uint32_t x = 0; x < kSize; ++x) {
                    const std::uint32_t a = sheet * kPerSheet + y * (kSize + 1) + x, b = a + kSize + 1;
                    for (const std::uint32_t v : {a, a + 1, b + 1, a, b + 1, b}) primitive.indices.push_back(v);
                }
            }
        }
    }
    void addVertex(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) {
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        const float u = x > kSize / 2 ? static_cast<float>(kSize) - fx : fx;
        pool.positions.push_back({fx + 20 * static_cast<float>(sheet), fy, std::sin(fx) * std::cos(0.7f * fy)});
        pool.normals.push_back(unit({-std::cos(fx), 0.7f * std::sin(0.7f * fy), 1}));
        pool.uvs.push_back({u / 8, fy / 8});
    }
};

/// Rotates a vector by 1 radian about (1, 2, 2) / 3.
Vec3 turned(const Vec3& v) {
    const double k[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3}, c = std::cos(1.0), s = std::sin(1.0);
    const double along = k[0] * v.x + k[1] * v.y + k[2] * v.z;
    return {static_cast<float>(v.x * c + (k[1] * v.z - k[2] * v.y) * s + k[0] * along * (1 - c)),
            static_cast<float>(v.y * c + (k[2] * v.x - k[0] * v.z) * s + k[1] * along * (1 - c)),
            static_cast<float>(v.z * c + (k[0] * v.y - k[1] * v.x) * s + k[2] * along * (1 - c))};
}

template <class Move>
std::vector<Vec3> movedBy(const std::vector<Vec3>& values, Move&& move) {
    std::vector<Vec3> offsets;
    for (const Vec3& v : values) {
        const Vec3 to = move(v);
        offsets.push_back({to.x - v.x, to.y - v.y, to.z - v.z});
    }
    return offsets;
}

TEST(MorphFrames, TurnWithTheShape) {
    for (const bool has_normals : {true, false}) {
        for (const Method method : {Method::mikktspace, Method::lengyel, Method::angle, Method::flat}) {
            Sheets sheets;
            Targets targets(1);
            targets[0].positions = movedBy(sheets.pool.positions, turned);
            if (has_normals) targets[0].normals = movedBy(sheets.pool.normals, turned);
            if (!has_normals) sheets.pool.normals.clear();
            const PoolOutcome result =
                compute(withTargets(sheets.pool, targets), {sheets.primitive}, withMethod(method));
            const std::size_t count = result.frames.source_vertices.size();
            const std::vector<Vec3> offsets = dense(result.frames.morphs[0].tangents, count);
            const std::vector<Vec3> normals = dense(result.frames.morphs[0].normals, count);
            for (std::size_t v = 0; v < count; ++v) {
                const Vec3 t = xyz(result.frames.tangents[v]);
                EXPECT_LT(distance(sum(t, offsets[v]), turned(t)), 2e-5) << v;
                if (has_normals) continue;
                const Vec3 n = result.frames.normals[v];
                EXPECT_LT(distance(sum(n, normals[v]), turned(n)), 2e-5) << v;
            }
            EXPECT_EQ(result.reports[0].morph_sign_flip_count, 0u);
        }
    }
}

TEST(MorphFrames, AddNothingWhereNothingMoves) {
    for (const bool has_normals : {true, false}) {
        Sheets sheets;
        if (!has_normals) sheets.pool.normals.clear();
        Targets targets(2);
        targets[0].positions.resize(2 * Sheets::kPerSheet);
        targets[1].positions.resize(2 * Sheets::kPerSheet);
        for (std::uint32_t v = 0; v < Sheets::kPerSheet; ++v)
            targets[1].positions[v] = {0, 0, 0.1f * static_cast<float>(v)};
        const PoolOutcome result = compute(withTargets(sheets.pool, targets), {sheets.primitive}, {});
        EXPECT_TRUE(result.frames.morphs[0].tangents.vertices.empty());
        EXPECT_TRUE(result.frames.morphs[0].normals.vertices.empty());
        EXPECT_EQ(result.frames.morphs[1].normals.vertices.empty(), has_normals);
        EXPECT_FALSE(result.frames.morphs[1].tangents.vertices.empty());
        for (const std::uint32_t v : result.frames.morphs[1].tangents.vertices) {
            EXPECT_LT(result.frames.source_vertices[v], Sheets::kPerSheet) << "the second sheet stays where it is";
        }
    }
}

/// glTF requires flat normals if there are none, so a plane that a target bends gets hard edges.
TEST(MorphFrames, SplitAPlaneThatATargetBends) {
    OwnedMesh plane = square();
    plane.normals.clear();
    Targets targets(2);
    targets[1].positions = {{}, {}, {}, {0, 0, 1}};
    const PoolView pool = withTargets(plane, targets);
    const PoolOutcome flat = compute(pool, {{.indices = {0, 1, 2, 2, 1, 3}}}, {});
    EXPECT_EQ(flat.frames.source_vertices, (Indices{0, 1, 2, 3, 2, 1}));
    EXPECT_EQ(flat.frames.indices[0], (Indices{0, 1, 2, 4, 5, 3}));
    EXPECT_EQ(flat.frames.normals, std::vector<Vec3>(6, Vec3{0, 0, 1}));
    const std::vector<Vec3> offsets = dense(flat.frames.morphs[1].normals, 6);
    const Vec3 bent = unit({-1, -1, 1});
    for (const std::uint32_t v : {0u, 1u, 2u}) EXPECT_EQ(offsets[v], Vec3{});
    for (const std::uint32_t v : {3u, 4u, 5u}) EXPECT_LT(distance(sum({0, 0, 1}, offsets[v]), bent), 1e-6);

    FramesOptions smooth;
    smooth.normals.weighting = NormalWeighting::angle;
    smooth.normals.crease_angle_deg = 30;
    const PoolOutcome whole = compute(pool, {{.indices = {0, 1, 2, 2, 1, 3}}}, smooth);
    EXPECT_FALSE(whole.frames.wasSplit(4)) << "smooth on the base is smooth in every target";
}

TEST(MorphFrames, LieInTheirFacesWhereATargetBendsAFlatShadedPlane) {
    OwnedMesh plane = square();
    plane.normals.clear();
    Targets targets(1);
    targets[0].positions = {{}, {}, {}, {0, 0, 1}};
    const PoolView pool = withTargets(plane, targets);
    for (const Method method : {Method::mikktspace, Method::angle, Method::best}) {
        const PoolFrames frames = compute(pool, {{.indices = {0, 1, 2, 2, 1, 3}}}, withMethod(method)).frames;
        const std::vector<Vec3> normals = dense(frames.morphs[0].normals, 6),
                                tangents = dense(frames.morphs[0].tangents, 6);
        for (std::size_t v = 0; v < 6; ++v) {
            const Vec3 n = sum(frames.normals[v], normals[v]), t = sum(xyz(frames.tangents[v]), tangents[v]);
            EXPECT_NEAR(n.x * t.x + n.y * t.y + n.z * t.z, 0, 1e-6) << "vertex " << v;
        }
        EXPECT_LT(lengthOf(tangents[0]), 1e-7) << "the first face does not move";
    }
}

/// Two coplanar triangles that touch in one vertex: one tangent in the base shape, two if one triangle rotates.
TEST(MorphFrames, SplitGroupsThatOnlyLookAlikeOnTheBase) {
    const OwnedMesh pool{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                         .normals = {5, Vec3{0, 0, 1}},
                         .uvs = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const std::vector<PrimitiveGeometry> primitives{{.indices = {0, 1, 2, 0, 3, 4}}};
    EXPECT_FALSE(compute(pool, primitives, {}).frames.wasSplit(5));
    Targets targets(2);
    targets[0].positions.resize(5);
    targets[0].positions[3] = {1, -1, 0};
    targets[0].positions[4] = {1, 1, 0};
    targets[1].positions.assign(5, Vec3{0, 0, 3});
    const PoolOutcome result = compute(withTargets(pool, targets), primitives, {});
    EXPECT_EQ(result.frames.source_vertices, (Indices{0, 1, 2, 3, 4, 0}));
    EXPECT_EQ(result.frames.morphs[0].tangents.vertices, (Indices{3, 4, 5}));
    for (const Vec3& offset : result.frames.morphs[0].tangents.offsets) {
        EXPECT_LT(distance(sum({1, 0, 0}, offset), {0, 1, 0}), 1e-6);
    }
    EXPECT_TRUE(result.frames.morphs[1].tangents.vertices.empty()) << "all of it is shifted";
}

TEST(MorphFrames, KeepTheTangentWhereFacesCollapse) {
    const OwnedMesh pool = square();
    Targets targets(2);
    targets[0].positions = {{1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}};  // moves all vertices to one point
    targets[1] = targets[0];
    targets[1].normals.assign(4, {1, 0, 0});  // leaning toward the tangent
    const PoolOutcome result = compute(withTargets(pool, targets), {{.indices = {0, 1, 2, 2, 1, 3}}}, {});
    EXPECT_TRUE(result.frames.morphs[0].tangents.vertices.empty());
    ASSERT_EQ(result.frames.morphs[1].tangents.vertices.size(), 4u);
    for (const Vec3& offset : result.frames.morphs[1].tangents.offsets) {
        EXPECT_LT(distance(sum({1, 0, 0}, offset), unit({1, 0, -1})), 1e-6);
    }
}

TEST(MorphFrames, CountCornersWhoseSignCannotBeMorphed) {
    Sheets sheets;
    Targets targets(1);
    targets[0].positions = movedBy(sheets.pool.positions, [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; });
    const PoolView pool = withTargets(sheets.pool, targets);
    EXPECT_EQ(compute(pool, {sheets.primitive}, withMethod(Method::flat)).reports[0].morph_sign_flip_count,
              sheets.primitive.indices.size());
    EXPECT_EQ(compute(pool, {sheets.primitive}, {}).reports[0].morph_sign_flip_count, 0u) << "by UVs alone";
}

TEST(MorphFrames, AreAddedToKeptTangentsThatAgree) {
    Sheets sheets;
    Targets targets(1);
    targets[0].positions = movedBy(sheets.pool.positions, turned);
    const PoolOutcome computed = compute(withTargets(sheets.pool, targets), {sheets.primitive}, {});
    const OwnedMesh mesh = rebuilt(sheets.pool, computed.frames);
    const Targets moved = rebuiltTargets(targets, computed.frames);
    std::vector<Vec4> tangents = computed.frames.tangents;
    PoolView written = withTargets(mesh, moved);
    written.kept_tangents = tangents;
    const PoolOutcome kept = compute(written, rebuilt(computed.frames), {});
    EXPECT_EQ(kept.frames.differing_count, 0u);
    EXPECT_TRUE(sameBits(kept.frames.morphs[0].tangents.offsets, computed.frames.morphs[0].tangents.offsets));

    tangents[3].w *= -1;
    const PoolOutcome other = compute(written, rebuilt(computed.frames), {});
    const Indices& corners = computed.frames.indices[0];
    EXPECT_EQ(other.frames.differing_count, static_cast<std::uint64_t>(std::count(corners.begin(), corners.end(), 3u)));
    EXPECT_TRUE(other.frames.morphs.empty());
}

TEST(MorphFrames, ReportWhyATargetCannotBeRead) {
    for (const bool has_normals : {true, false}) {
        OwnedMesh mesh = square();
        if (!has_normals) mesh.normals.clear();
        std::vector<FramesReport> reports(1);
        const std::vector<PrimitiveGeometry> primitives{{.indices = {0, 1, 2}}};
        PoolView pool(mesh);
        pool.targets = {1, [](std::size_t) -> Result<MorphOffsets> { return Error{ErrorCode::invalidFile, "no"}; }};
        EXPECT_EQ(computeFrames(pool, primitives, {}, reports).error().code, ErrorCode::invalidFile);
        const Targets few{{.positions = {{1, 0, 0}}}};
        EXPECT_EQ(computeFrames(withTargets(mesh, few), primitives, {}, reports).error().code,
                  ErrorCode::countMismatch);
    }
}

}  // namespace
}  // namespace tspace
