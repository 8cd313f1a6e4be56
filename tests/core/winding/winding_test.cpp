// SPDX-License-Identifier: MIT
// mendWinding: damage to bodies of every kind, damage that cannot be repaired, and faces that must not change.
#include "tspace/winding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bodies.h"
#include "core/normals/normals_outcome.h"
#include "scans.h"

namespace tspace {
namespace {

using namespace test;

struct Mended {
    WindingReport report = {};
    std::vector<std::uint8_t> turned = {};
};

Mended mend(const MeshView& mesh, const WindingOptions& options = {}, const Execution& execution = {}) {
    Mended mended{{}, std::vector<std::uint8_t>(mesh.faceCount(), 7)};
    const auto result = mendWinding(mesh, options, mended.turned, execution);
    EXPECT_TRUE(result.ok());
    if (result) mended.report = *result;
    const WindingReport& r = mended.report;
    EXPECT_EQ(r.component_count, r.by_normals_count + r.by_volume_count + r.by_nesting_count +
                                     r.by_winding_number_count + r.by_majority_count + r.small_count +
                                     r.one_sided_count);
    EXPECT_EQ(r.turned_count, static_cast<std::uint64_t>(std::count(mended.turned.begin(), mended.turned.end(), 1)));
    return mended;
}

/// Returns the share of the area that has the winding of `sound` after `damaged` is repaired.
double shareRight(const Bodies& sound, const Bodies& damaged, const Mended& mended) {
    double right = 0, all = 0;
    for (std::size_t f = 0; f < sound.faceCount(); ++f) {
        const double area = sound.areaOf(f);
        const bool is_damaged = sound.mesh.indices[3 * f + 1] != damaged.mesh.indices[3 * f + 1];
        all += area;
        if ((mended.turned[f] != 0) == is_damaged) right += area;
    }
    return right / all;
}

struct NamedBodies {
    std::string name;
    Bodies bodies;
};

std::vector<NamedBodies> closedBodies() {
    std::vector<NamedBodies> all(6);
    all[0].name = "torus";
    addTorus(all[0].bodies, {}, 1, 0.4);
    all[1].name = "sphere";
    addSphere(all[1].bodies, {1, 2, 3}, 1);
    all[2].name = "box";
    addBox(all[2].bodies, {0, 0, 0}, {1, 2, 3});
    all[3].name = "thin plate";
    addBox(all[3].bodies, {0, 0, 0}, {1, 1, 0.0001f});
    all[4].name = "three through each other";
    addTorus(all[4].bodies, {}, 1, 0.4);
    addSphere(all[4].bodies, {1, 0, 0}, 0.7);
    addBox(all[4].bodies, {-1, -1, -0.2f}, {0.5f, 0.5f, 0.2f});
    all[5].name = "six apart";
    for (int i = 0; i < 6; ++i) addSphere(all[5].bodies, {3.0f * static_cast<float>(i), 0, 0}, 1, 1, 12);
    return all;
}

std::vector<NamedBodies> openBodies() {
    std::vector<NamedBodies> all(4);
    all[0].name = "without its top";
    addSphere(all[0].bodies, {}, 1, 0.8);
    all[1].name = "half";
    addSphere(all[1].bodies, {}, 1, 0.5);
    all[2].name = "with holes";
    addSphere(all[2].bodies, {}, 1, 1, 32, [](std::uint32_t i, std::uint32_t j) { return (i * 7 + j * 5) % 11 != 0; });
    all[3].name = "tube";
    addSheet(all[3].bodies, 24, 12, [](double u, double v) { return vec3(cosineOfTurn(u), sineOfTurn(u), 4 * v); });
    return all;
}

/// Returns boxes in a three-dimensional checkerboard. Each inner edge has four faces, and no two boxes share a face.
Bodies boxesThatShareEdges(bool shared) {
    Bodies boxes;
    for (int i = 0; i < 27; ++i) {
        const int x = i % 3, y = i / 3 % 3, z = i / 9;
        if ((x + y + z) % 2 != 0) continue;
        const Vec3 least{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        addBox(boxes, least, {least.x + 1, least.y + 1, least.z + 1});
    }
    if (shared) shareVertices(boxes);
    return boxes;
}

std::vector<NamedBodies> nonManifoldBodies() {
    std::vector<NamedBodies> all(4);
    all[0] = {"boxes that share edges, by indices", boxesThatShareEdges(true)};
    all[1] = {"boxes that share edges, by positions", boxesThatShareEdges(false)};
    all[2].name = "two boxes that share a face";
    addBox(all[2].bodies, {0, 0, 0}, {1, 1, 1});
    addBox(all[2].bodies, {1, 0, 0}, {2, 1, 1});
    all[3].name = "a box without indices";
    addBox(all[3].bodies, {0, 0, 0}, {1, 2, 3});
    separateVertices(all[3].bodies);
    return all;
}

std::vector<NamedBodies> allBodies() {
    std::vector<NamedBodies> all = closedBodies();
    for (auto* more : {&openBodies, &nonManifoldBodies}) {
        for (NamedBodies& one : more()) all.push_back(std::move(one));
    }
    return all;
}

void expectMended(const NamedBodies& sound, const Bodies& damaged, const char* damage) {
    const Mended mended = mend(damaged.view());
    EXPECT_EQ(0u, mended.report.conflict_count_after) << sound.name << ", " << damage;
    EXPECT_GE(shareRight(sound.bodies, damaged, mended), 0.99) << sound.name << ", " << damage;
    // Repairing the result again must change nothing.
    Bodies result = damaged;
    for (std::size_t f = 0; f < result.faceCount(); ++f) {
        if (mended.turned[f] != 0) result.turn(f);
    }
    EXPECT_EQ(0u, mend(result.view()).report.turned_count) << sound.name << ", " << damage;
}

TEST(FixWinding, FlipsNothingOfACorrectMesh) {
    for (const NamedBodies& sound : allBodies()) {
        const Mended mended = mend(sound.bodies.view());
        EXPECT_EQ(0u, mended.report.turned_count) << sound.name;
        EXPECT_EQ(0u, mended.report.conflict_count_before) << sound.name;
        EXPECT_EQ(0u, mended.report.turned_component_count) << sound.name;
    }
}

TEST(FixWinding, FixesRandomlyFlippedFaces) {
    for (const NamedBodies& sound : allBodies()) {
        for (const double share : {0.01, 0.17, 0.3})
            expectMended(sound, turnedByChance(sound.bodies, share, 5), "by chance");
    }
}

TEST(FixWinding, FixesFlippedPatches) {
    for (const NamedBodies& sound : allBodies()) {
        for (const double share : {0.17, 0.3}) expectMended(sound, turnedInPatches(sound.bodies, share, 5), "patches");
    }
}

TEST(FixWinding, FixesBodiesThatAreInsideOut) {
    for (const NamedBodies& sound : allBodies()) {
        for (const bool all : {false, true}) expectMended(sound, turnedWhole(sound.bodies, all), "whole");
    }
    Bodies torus;
    addTorus(torus, {}, 1, 0.4);
    const WindingReport report = mend(turnedWhole(torus, true).view()).report;
    EXPECT_EQ(1u, report.turned_component_count);
    EXPECT_EQ(1u, report.by_volume_count);
    EXPECT_EQ(report.face_count, report.turned_count);
    EXPECT_EQ(0u, report.conflict_count_before);
}

TEST(FixWinding, CountsConflictsBeforeTheFix) {
    Bodies torus;
    addTorus(torus, {}, 1, 0.4);
    torus.turn(100);
    const WindingReport report = mend(torus.view()).report;
    EXPECT_EQ(3u, report.conflict_count_before);
    EXPECT_EQ(1u, report.turned_count);
    EXPECT_EQ(0u, report.turned_component_count);
}

TEST(FixWinding, KeepsTheMajorityWindingOfNestedBodies) {
    for (const bool is_cavity : {false, true}) {
        NamedBodies sound{is_cavity ? "cavity" : "body in a body", {}};
        addSphere(sound.bodies, {}, 1);
        addSphere(sound.bodies, {}, 0.5);
        if (is_cavity) {
            for (std::size_t f = 0; f < sound.bodies.faceCount(); ++f) {
                if (sound.bodies.body_of[f] == 1) sound.bodies.turn(f);
            }
        }
        EXPECT_EQ(0u, mend(sound.bodies.view()).report.turned_count) << sound.name;
        EXPECT_EQ(1u, mend(sound.bodies.view()).report.by_nesting_count) << sound.name;
        for (const double share : {0.01, 0.17, 0.3})
            expectMended(sound, turnedByChance(sound.bodies, share, 5), sound.name.c_str());
        // Every second body is inside out.
        expectMended(sound, turnedWhole(sound.bodies, false), sound.name.c_str());
    }
}

TEST(FixWinding, TreatsANestedBodyAsACavityIfUndecided) {
    Bodies bodies;
    addTorus(bodies, {}, 1, 0.4);
    addTorus(bodies, {}, 1, 0.1);
    Bodies damaged = bodies;
    for (std::size_t f = 1; f < damaged.faceCount(); f += 2) damaged.turn(f);
    const Mended mended = mend(damaged.view());
    EXPECT_EQ(0u, mended.report.conflict_count_after);
    for (std::size_t f = 0; f < bodies.faceCount(); ++f)
        EXPECT_EQ((f % 2 != 0) != (bodies.body_of[f] == 1), mended.turned[f] != 0);
}

TEST(FixWinding, UsesTheMajorityIfNoSideIsInside) {
    Bodies terrain;
    addSheet(terrain, 40, 40, [](double u, double v) { return vec3(u, v, 0.1 * sineOfTurn(2 * u) * sineOfTurn(v)); });
    const Bodies damaged = turnedByChance(terrain, 0.3, 1);
    const Mended mended = mend(damaged.view());
    EXPECT_EQ(1u, mended.report.by_majority_count);
    EXPECT_EQ(0u, mended.report.conflict_count_after);
    EXPECT_EQ(1, shareRight(terrain, damaged, mended));
    // There is no information from which the library could tell that this terrain is inside out.
    EXPECT_EQ(0u, mend(turnedWhole(terrain, true).view()).report.turned_count);
}

TEST(FixWinding, FlipsNoLeavesAndCards) {
    Bodies leaves;
    for (int i = 0; i < 50; ++i) {
        const auto x = static_cast<float>(i);
        addSheet(leaves, 1, 1, [x](double u, double v) { return vec3(x + 0.5 * u, v, 0); });
    }
    const Mended mended = mend(turnedByChance(leaves, 0.4, 3).view());
    EXPECT_EQ(0u, mended.report.turned_count);
    EXPECT_EQ(50u, mended.report.small_count);
    EXPECT_EQ(mended.report.conflict_count_before, mended.report.conflict_count_after);
    EXPECT_LT(0u, mended.report.conflict_count_after);
}

TEST(FixWinding, FlipsEachLeafTowardItsOwnNormals) {
    Bodies leaves;
    for (int i = 0; i < 50; ++i) {
        const auto x = static_cast<float>(i);
        addSheet(leaves, 1, 1, [x](double u, double v) { return vec3(x + 0.5 * u, v, 0); });
    }
    Bodies damaged = leaves;
    for (std::size_t f = 0; f < damaged.faceCount(); ++f) {
        if (f / 2 % 2 == 0) damaged.turn(f);
    }
    // Normals that vary around +z, like those of a tree crown around its leaves. They are on the side of the original
    // winding.
    std::vector<Vec3> normals;
    for (std::size_t v = 0; v < damaged.mesh.positions.size(); ++v)
        normals.push_back(v % 3 == 0 ? Vec3{0.6F, 0, 0.8F} : Vec3{0, -0.6F, 0.8F});
    MeshView with_normals = damaged.view();
    with_normals.normals = normals;
    const Mended mended = mend(with_normals);
    EXPECT_EQ(50u, mended.report.by_normals_count);
    EXPECT_EQ(50u, mended.report.turned_count);
    for (std::size_t f = 0; f < damaged.faceCount(); ++f) EXPECT_EQ(f / 2 % 2 == 0, mended.turned[f] != 0) << f;
    // Alternating normals have no majority, so they do not determine a side.
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v].z *= v % 2 == 0 ? 1.0F : -1.0F;
    EXPECT_EQ(50u, mend(with_normals).report.small_count);
    EXPECT_EQ(50u, mend(with_normals, {.use_normals = false}).report.small_count);
}

TEST(FixWinding, KeepsAMoebiusBandAndFixesDamageInIt) {
    const Bodies band = moebiusBand(40);
    const Mended mended = mend(band.view());
    EXPECT_EQ(0u, mended.report.turned_count);
    EXPECT_EQ(1u, mended.report.one_sided_count);
    EXPECT_EQ(1u, mended.report.conflict_count_before);
    EXPECT_EQ(1u, mended.report.conflict_count_after);
    const WindingReport damaged = mend(turnedByChance(band, 0.3, 2).view()).report;
    EXPECT_LT(10u, damaged.conflict_count_before);
    EXPECT_EQ(1u, damaged.conflict_count_after);
}

TEST(FixWinding, KeepsBothSidesOfASheet) {
    Bodies sheet;
    addSheet(sheet, 8, 8, [](double u, double v) { return vec3(u, v, 0); });
    const std::size_t one_side = sheet.faceCount();
    addSheet(sheet, 8, 8, [](double u, double v) { return vec3(u, v, 0); });
    for (std::size_t f = one_side; f < sheet.faceCount(); ++f) sheet.turn(f);
    for (const bool shared : {false, true}) {
        if (shared) shareVertices(sheet);
        const WindingReport report = mend(sheet.view()).report;
        EXPECT_EQ(0u, report.turned_count) << shared;
        EXPECT_EQ(0u, report.conflict_count_after) << shared;
    }
    // Copies of a double-sided surface are not flipped relative to each other either.
    Bodies twice;
    addTorus(twice, {}, 1, 0.4);
    addTorus(twice, {}, 1, 0.4);
    EXPECT_EQ(0u, mend(twice.view()).report.turned_count);
    shareVertices(twice);
    EXPECT_EQ(0u, mend(twice.view()).report.turned_count);
}

TEST(FixWinding, FixesBothSidesOfATJunctionSeparately) {
    // The right half has twice as many cells along the seam, so only every second of its vertices there is a vertex of
    // the left half.
    Bodies sheet;
    addSheet(sheet, 4, 4, [](double u, double v) { return vec3(u, v, 0); });
    addSheet(sheet, 4, 8, [](double u, double v) { return vec3(1 + u, v, 0); });
    EXPECT_EQ(0u, mend(sheet.view()).report.turned_count);
    const Bodies damaged = turnedByChance(sheet, 0.2, 4);
    const Mended mended = mend(damaged.view());
    EXPECT_EQ(0u, mended.report.conflict_count_after);
    EXPECT_EQ(1, shareRight(sheet, damaged, mended));
}

TEST(FixWinding, ContinuesStraightAcrossAFin) {
    Bodies sheet;
    addSheet(sheet, 8, 8, [](double u, double v) { return vec3(u, v, 0); });
    addSheet(sheet, 2, 8, [](double u, double v) { return vec3(0.5, v, u); });
    const Bodies damaged = turnedByChance(sheet, 0.2, 4);
    const Mended mended = mend(damaged.view());
    EXPECT_EQ(2u, mended.report.component_count);
    EXPECT_EQ(1, shareRight(sheet, damaged, mended));
}

/// Returns the surface net of a shape on a noisy field, without every tenth face. Of an edge with four faces, three
/// faces may remain, or two that are not neighbors.
NamedBodies netWithHoles(const accuracy::Shape& shape, int cells, unsigned seed) {
    const accuracy::Scan net = accuracy::surfaceNets(shape, cells, 0.1, accuracy::Random{seed});
    NamedBodies net_with_holes{shape.name, {}};
    Bodies& body = net_with_holes.bodies;
    std::mt19937 random(seed + 2);
    body.mesh.positions = net.positions;
    for (std::size_t c = 0; c < net.indices.size(); c += 3) {
        const std::uint32_t* const v = net.indices.data() + c;
        if (random() % 10 != 0) body.mesh.addTriangle(v[0], v[1], v[2]);
    }
    body.closeBody();
    return net_with_holes;
}

TEST(FixWinding, FixesGridsWithEdgesOfFourFacesAndHoles) {
    for (const char* name : {"part", "gear"}) {
        const NamedBodies body = netWithHoles(shape(name), 32, 1);
        for (const double share : {0.0, 0.3, 1.0}) {
            const Bodies damaged = turnedByChance(body.bodies, share, 1);
            const Mended mended = mend(damaged.view());
            // Conflicts may remain at islands of two and three faces, and at an edge that had four faces before two
            // were removed.
            EXPECT_LE(mended.report.conflict_count_after, 4u) << name << ' ' << share;
            EXPECT_GE(shareRight(body.bodies, damaged, mended), 0.99) << name << ' ' << share;
        }
    }
}

/// A face that is reached only over an edge that lost two of four faces would get the opposite winding to all faces
/// around it.
TEST(FixWinding, ReachesFacesByOtherEdgesThanThoseThatLostTwoOfFour) {
    std::vector<NamedBodies> bodies{netWithHoles(shape("gear"), 48, 4)};
    for (const accuracy::Shape& shape : accuracy::heldOutShapes()) bodies.push_back(netWithHoles(shape, 48, 4));
    for (const NamedBodies& body : bodies) {
        for (const double share : {0.17, 0.3, 0.5}) {
            const Bodies damaged = turnedByChance(body.bodies, share, 4);
            EXPECT_GE(shareRight(body.bodies, damaged, mend(damaged.view())), 0.99) << body.name << ' ' << share;
        }
    }
}

TEST(FixWinding, FollowsNormalsThatAgreeAmongThemselves) {
    Bodies ball;
    addSphere(ball, {}, 1);
    for (const Vec3& p : ball.mesh.positions) ball.mesh.normals.push_back({-p.x, -p.y, -p.z});
    // Like a sky dome, the ball is seen from inside, as its normals indicate.
    const Mended mended = mend(ball.view());
    EXPECT_EQ(1u, mended.report.by_normals_count);
    EXPECT_EQ(1, shareRight(turnedWhole(ball, true), ball, mended));
    EXPECT_EQ(0u, mend(ball.view(), {.use_normals = false}).report.turned_count);
    const Bodies dome = turnedWhole(ball, true);
    EXPECT_EQ(0u, mend(dome.view()).report.turned_count);
    EXPECT_EQ(1, shareRight(dome, turnedByChance(dome, 0.3, 3), mend(turnedByChance(dome, 0.3, 3).view())));
    // Random normals must not determine the winding.
    std::mt19937 random(1);
    for (Vec3& n : ball.mesh.normals) {
        if (random() % 2 != 0) n = {-n.x, -n.y, -n.z};
    }
    EXPECT_EQ(1u, mend(ball.view()).report.by_volume_count);
    EXPECT_EQ(0u, mend(ball.view()).report.turned_count);
}

TEST(FixWinding, FollowsTheWindingOfTheConvention) {
    Bodies torus;
    addTorus(torus, {}, 1, 0.4);
    WindingOptions clockwise;
    clockwise.convention.winding = Winding::clockwise;
    EXPECT_EQ(torus.faceCount(), mend(torus.view(), clockwise).report.turned_count);
    EXPECT_EQ(0u, mend(turnedWhole(torus, true).view(), clockwise).report.turned_count);
}

TEST(FixWinding, FlipsPolygonsToo) {
    SimpleMesh cube;
    cube.positions = cubePositions();
    for (const auto& face : kCubeFaces) cube.addFace(face);
    EXPECT_EQ(0u, mend(cube.view()).report.turned_count);
    std::reverse(cube.indices.begin() + 4, cube.indices.begin() + 8);
    const Mended mended = mend(cube.view());
    EXPECT_EQ(1u, mended.report.turned_count);
    EXPECT_EQ(1, mended.turned[1]);
    EXPECT_EQ(4u, mended.report.conflict_count_before);
    EXPECT_EQ(0u, mended.report.conflict_count_after);
}

TEST(FixWinding, SurvivesFacesWithoutAreaAndNan) {
    Bodies torus;
    addTorus(torus, {}, 1, 0.4);
    torus.mesh.addTriangle(0, 0, 1);
    torus.mesh.addTriangle(3, 3, 3);
    torus.mesh.positions.push_back({std::nanf(""), 0, 0});
    torus.mesh.positions.push_back({INFINITY, 0, 0});
    const auto last = static_cast<std::uint32_t>(torus.mesh.positions.size() - 1);
    torus.mesh.addTriangle(0, 1, last - 1);
    torus.mesh.addTriangle(0, 1, last);
    torus.mesh.addTriangle(0, last, last);
    torus.closeBody();
    const Bodies damaged = turnedByChance(torus, 0.1, 1);
    const Mended mended = mend(damaged.view());
    for (std::size_t f = 0; f < 24 * 48 * 2; ++f) {
        EXPECT_EQ(torus.mesh.indices[3 * f + 1] != damaged.mesh.indices[3 * f + 1], mended.turned[f] != 0) << f;
    }
    // An open part, whose winding must be determined by the winding number.
    Bodies open;
    addSphere(open, {}, 1, 0.7);
    open.mesh.positions[30] = {std::nanf(""), INFINITY, 0};
    EXPECT_EQ(0u, mend(open.view()).report.turned_count);
    SimpleMesh nothing;
    EXPECT_EQ(0u, mend(nothing.view()).report.face_count);
    SimpleMesh lines;
    lines.positions = {{0, 0, 0}, {1, 0, 0}};
    const std::uint32_t line[] = {0, 1};
    lines.addFace(line);
    EXPECT_EQ(0u, mend(lines.view()).report.face_count);
}

TEST(FixWinding, IsTheSameForAnyNumberOfThreads) {
    for (const NamedBodies& sound : allBodies()) {
        const Bodies damaged = turnedByChance(sound.bodies, 0.3, 9);
        const Mended one = mend(damaged.view());
        EXPECT_EQ(one.turned, mend(damaged.view(), {}, {.thread_count = 7}).turned) << sound.name;
    }
}

TEST(FixWinding, RejectsAResultOfWrongLength) {
    Bodies torus;
    addTorus(torus, {}, 1, 0.4);
    std::vector<std::uint8_t> turned(torus.faceCount() - 1);
    const auto result = mendWinding(torus.view(), {}, turned);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(ErrorCode::countMismatch, result.error().code);
}

}  // namespace
}  // namespace tspace
