// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/vec_math.h"
#include "core/estimate/pose_normals.h"
#include "support/random_values.h"
#include "support/same_bits.h"
#include "support/simple_mesh.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using test::isUnit;
using test::randomFloat;
using test::randomInt;
using test::randomUnit;
using test::randomVec3;
using test::sameBits;
using test::SimpleMesh;

std::vector<Vec3> normalsOf(const MeshView& mesh, const NormalOptions& options) {
    std::vector<Vec3> out(mesh.cornerCount());
    RC_ASSERT(generateNormals(mesh, options, out).ok());
    return out;
}

struct D3 {
    double x = 0, y = 0, z = 0;
};
D3 minus(const Vec3& a, const Vec3& b) { return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}; }
D3 crossOf(const D3& a, const D3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dotOf(const D3& a, const D3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double angleOf(const D3& a, const D3& b) {
    const D3 c = crossOf(a, b);
    return std::atan2(std::sqrt(dotOf(c, c)), dotOf(a, b));
}

/// Computes the result that generateNormals must give except for rounding: compares all pairs of triangles, and uses
/// the C library's functions.
class BruteForce {
  public:
    BruteForce(const SimpleMesh& mesh, const NormalOptions& options) : mesh_(mesh), options_(options) {
        for (std::size_t f = 0; f < mesh.indices.size() / 3; ++f) {
            D3 n = crossOf(minus(at(3 * f + 1), at(3 * f)), minus(at(3 * f + 2), at(3 * f)));
            const double l = std::sqrt(dotOf(n, n));
            areas_.push_back(l);
            if (l > 0) n = {n.x / l, n.y / l, n.z / l};
            normals_.push_back(n);
        }
    }

    std::vector<Vec3> run() {
        std::vector<Vec3> out;
        for (std::size_t c = 0; c < mesh_.indices.size(); ++c) out.push_back(normal(c));
        return out;
    }

  private:
    const Vec3& at(std::size_t c) const { return mesh_.positions[mesh_.indices[c]]; }
    bool samePoint(std::size_t a, std::size_t b) const {
        return options_.weld_positions ? at(a) == at(b) : mesh_.indices[a] == mesh_.indices[b];
    }
    static std::size_t next(std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
    static std::size_t previous(std::size_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

    bool groupsAllow(std::size_t f, std::size_t g) const {
        if (options_.smoothing_groups.empty()) return true;
        const std::uint32_t a = options_.smoothing_groups[f], b = options_.smoothing_groups[g];
        return options_.smoothing_groups_are_masks ? (a & b) != 0 : a == b && a != 0;
    }
    bool connected(std::size_t a, std::size_t b) const {
        if (!groupsAllow(a / 3, b / 3)) return false;
        if (options_.crease_angle_deg == 180) return true;
        if (areas_[a / 3] == 0 || areas_[b / 3] == 0) return false;
        const bool share_edge = samePoint(next(a), next(b)) || samePoint(next(a), previous(b)) ||
                                samePoint(previous(a), next(b)) || samePoint(previous(a), previous(b));
        return share_edge && angleOf(normals_[a / 3], normals_[b / 3]) <= options_.crease_angle_deg * kPi / 180;
    }
    double weight(std::size_t c) const {
        if (samePoint(c, previous(c))) return 0;
        const D3 e1 = minus(at(next(c)), at(c)), e2 = minus(at(previous(c)), at(c));
        switch (options_.weighting) {
            case NormalWeighting::area: return areas_[c / 3];
            case NormalWeighting::angle: return angleOf(e1, e2);
            case NormalWeighting::angleArea: return angleOf(e1, e2) * areas_[c / 3];
            case NormalWeighting::max: return areas_[c / 3] / (dotOf(e1, e1) * dotOf(e2, e2));
            default: return 1;
        }
    }
    bool mean(const std::vector<std::size_t>& corners, Vec3& out) const {
        D3 sum;
        double weights = 0;
        for (const std::size_t c : corners) {
            if (areas_[c / 3] == 0) continue;
            const double w = weight(c);
            const D3& n = normals_[c / 3];
            sum = {sum.x + w * n.x, sum.y + w * n.y, sum.z + w * n.z};
            weights += w;
        }
        const double l = std::sqrt(dotOf(sum, sum));
        if (l <= 1e-10 * weights || l == 0) return false;
        out = {static_cast<float>(sum.x / l), static_cast<float>(sum.y / l), static_cast<float>(sum.z / l)};
        return true;
    }
    Vec3 normal(std::size_t corner) const {
        std::vector<std::size_t> here;
        for (std::size_t c = 0; c < mesh_.indices.size(); ++c) {
            if (samePoint(c, corner)) here.push_back(c);
        }
        std::vector<std::size_t> component{corner};
        for (std::size_t i = 0; i < component.size(); ++i) {
            for (const std::size_t c : here) {
                const bool same_face = c / 3 == component[i] / 3;
                if (std::find(component.begin(), component.end(), c) == component.end() &&
                    (same_face || connected(component[i], c))) {
                    component.push_back(c);
                }
            }
        }
        std::sort(component.begin(), component.end());
        Vec3 out{0, 0, 1};
        if (mean(component, out)) return out;
        const D3& own = normals_[corner / 3];
        if (areas_[corner / 3] > 0) {
            return {static_cast<float>(own.x), static_cast<float>(own.y), static_cast<float>(own.z)};
        }
        mean(here, out);
        return out;
    }

    const SimpleMesh& mesh_;
    const NormalOptions& options_;
    std::vector<D3> normals_;
    std::vector<double> areas_;
};

/// Returns triangles between points of a small grid, so that there are shared and duplicated edges, edges with many
/// faces, collapsed faces, and copies of vertices.
SimpleMesh randomGridMesh() {
    SimpleMesh mesh;
    const int vertex_count = randomInt(4, 16);
    for (int v = 0; v < vertex_count; ++v) {
        const auto coordinate = [] { return static_cast<float>(randomInt(0, 3)); };
        const float x = coordinate(), y = coordinate();
        mesh.positions.push_back({x, y, coordinate()});
    }
    const int face_count = randomInt(1, 30);
    for (int i = 0; i < 3 * face_count; ++i) {
        mesh.indices.push_back(static_cast<std::uint32_t>(randomInt(0, vertex_count)));
    }
    return mesh;
}

struct RandomOptions {
    NormalOptions options;
    std::vector<std::uint32_t> groups;

    explicit RandomOptions(std::size_t face_count) {
        options.weighting = static_cast<NormalWeighting>(randomInt(0, 7));
        // No angle between faces of the grid is near these values.
        constexpr float kCreases[] = {180, 180, 3, 37.3f, 63.1f, 91.7f, 122.9f, 171.3f};
        options.crease_angle_deg = kCreases[randomInt(0, 8)];
        options.weld_positions = randomInt(0, 3) != 0;
        options.smoothing_groups_are_masks = randomInt(0, 2) == 0;
        if (randomInt(0, 2) == 0) {
            for (std::size_t f = 0; f < face_count; ++f) groups.push_back(static_cast<std::uint32_t>(randomInt(0, 4)));
        }
        options.refine = static_cast<std::uint32_t>(randomInt(0, 3));
    }
    NormalOptions& get() {
        options.smoothing_groups = groups;
        return options;
    }
};

RC_GTEST_PROP(NormalsProperty, AreThoseOfBruteForce, ()) {
    const SimpleMesh mesh = randomGridMesh();
    RandomOptions random(mesh.indices.size() / 3);
    NormalOptions& options = random.get();
    const bool is_mean = options.weighting != NormalWeighting::flat && options.weighting != NormalWeighting::best;
    if (!is_mean) options.weighting = NormalWeighting::angle;
    const std::vector<Vec3> normals = normalsOf(mesh.view(), options);
    const std::vector<Vec3> wanted = BruteForce(mesh, options).run();
    for (std::size_t c = 0; c < normals.size(); ++c) {
        RC_ASSERT(std::fabs(normals[c].x - wanted[c].x) < 1e-6);
        RC_ASSERT(std::fabs(normals[c].y - wanted[c].y) < 1e-6);
        RC_ASSERT(std::fabs(normals[c].z - wanted[c].z) < 1e-6);
    }
}

RC_GTEST_PROP(NormalsProperty, AreUnitAndFiniteForGarbage, ()) {
    SimpleMesh mesh;
    for (int v = 0; v < 12; ++v) mesh.positions.push_back(test::randomGarbageVec3());
    std::size_t corner_count = 0;
    for (int f = 0; f < 10; ++f) {
        mesh.face_sizes.push_back(static_cast<std::uint32_t>(randomInt(3, 8)));
        corner_count += mesh.face_sizes.back();
    }
    for (std::size_t c = 0; c < corner_count; ++c) mesh.indices.push_back(static_cast<std::uint32_t>(randomInt(0, 12)));
    RandomOptions random(10);
    for (const Vec3& n : normalsOf(mesh.view(), random.get())) RC_ASSERT(isUnit(n, 2e-7));
}

RC_GTEST_PROP(NormalsProperty, DoNotDependOnVertexOrderIndexWidthOrStrides, ()) {
    const SimpleMesh mesh = randomGridMesh();
    RandomOptions random(mesh.indices.size() / 3);
    const std::vector<Vec3> wanted = normalsOf(mesh.view(), random.get());

    std::vector<std::uint32_t> place(mesh.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    for (std::size_t i = place.size(); i > 1; --i)
        std::swap(place[i - 1], place[static_cast<std::size_t>(randomInt(0, static_cast<int>(i)))]);
    struct Interleaved {
        float padding[2];
        Vec3 position;
    };
    std::vector<Interleaved> vertices(mesh.positions.size());
    std::vector<std::uint8_t> narrow;
    std::vector<std::uint16_t> middle;
    for (std::size_t v = 0; v < place.size(); ++v) vertices[place[v]].position = mesh.positions[v];
    for (const std::uint32_t v : mesh.indices) {
        narrow.push_back(static_cast<std::uint8_t>(place[v]));
        middle.push_back(static_cast<std::uint16_t>(place[v]));
    }
    MeshView view;
    view.positions = {&vertices[0].position, vertices.size(), sizeof(Interleaved)};
    view.indices = IndexView(std::span<const std::uint8_t>(narrow));
    RC_ASSERT(sameBits(normalsOf(view, random.get()), wanted));
    view.indices = IndexView(std::span<const std::uint16_t>(middle));
    RC_ASSERT(sameBits(normalsOf(view, random.get()), wanted));

    std::vector<Interleaved> out(wanted.size());
    RC_ASSERT(generateNormals(view, random.get(), {&out[0].position, out.size(), sizeof(Interleaved)}).ok());
    for (std::size_t c = 0; c < out.size(); ++c) RC_ASSERT(out[c].position == wanted[c]);

    if (random.options.weld_positions) {
        std::vector<Vec3> soup;
        for (const std::uint32_t v : mesh.indices) soup.push_back(mesh.positions[v]);
        MeshView unindexed;
        unindexed.positions = soup;
        RC_ASSERT(sameBits(normalsOf(unindexed, random.get()), wanted));
    }
}

RC_GTEST_PROP(MaxWeights, AreExactOnASphere, ()) {
    const Vec3 center = randomVec3();
    const float radius = randomFloat(0.5f, 2);
    const Vec3 up = randomUnit();
    const Vec3 side = std::fabs(up.x) < 0.5f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const auto onSphere = [&](double tilt, double turn) {
        const double k = up.x * side.x + up.y * side.y + up.z * side.z;
        D3 t{side.x - k * up.x, side.y - k * up.y, side.z - k * up.z};
        const double l = std::sqrt(dotOf(t, t));
        t = {t.x / l, t.y / l, t.z / l};
        const D3 b = crossOf({up.x, up.y, up.z}, t);
        const double c = std::cos(tilt), s = std::sin(tilt), x = s * std::cos(turn), y = s * std::sin(turn);
        return Vec3{static_cast<float>(center.x + radius * (c * up.x + x * t.x + y * b.x)),
                    static_cast<float>(center.y + radius * (c * up.y + x * t.y + y * b.y)),
                    static_cast<float>(center.z + radius * (c * up.z + x * t.z + y * b.z))};
    };
    SimpleMesh fan;
    fan.positions.push_back(onSphere(0, 0));
    const int rim = randomInt(3, 9);
    for (int i = 0; i < rim; ++i) {
        fan.positions.push_back(onSphere(randomFloat(0.3f, 1.2f), (i + randomFloat(0, 0.5f)) * 2 * kPi / rim));
    }
    for (int i = 0; i < rim; ++i) {
        fan.addFace({0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % rim)});
    }
    const Vec3 n = normalsOf(fan.view(), {.weighting = NormalWeighting::max})[0];
    RC_ASSERT(std::fabs(n.x - up.x) < 1e-5);
    RC_ASSERT(std::fabs(n.y - up.y) < 1e-5);
    RC_ASSERT(std::fabs(n.z - up.z) < 1e-5);
}

std::vector<Vec3> poseNormalsOf(const SimpleMesh& mesh, const std::vector<Vec3>& positions,
                                const NormalOptions& options) {
    std::vector<Vec3> out(mesh.indices.size());
    RC_ASSERT(generatePoseNormals(mesh.view(), StridedSpan<const Vec3>(positions), options, out).ok());
    return out;
}

RC_GTEST_PROP(PoseNormals, OfTheMeshItselfAreTheNormalsOfTheMesh, ()) {
    const SimpleMesh mesh = randomGridMesh();
    RandomOptions random(mesh.indices.size() / 3);
    RC_ASSERT(sameBits(poseNormalsOf(mesh, mesh.positions, random.get()), normalsOf(mesh.view(), random.get())));
}

RC_GTEST_PROP(PoseNormals, WithoutHardEdgesAreThoseOfTheMovedMesh, ()) {
    const SimpleMesh mesh = randomGridMesh();
    RandomOptions random(mesh.indices.size() / 3);
    NormalOptions& options = random.get();
    options.crease_angle_deg = 180;
    options.weld_positions = false;
    SimpleMesh moved = mesh;
    for (Vec3& p : moved.positions) p = randomVec3();
    RC_ASSERT(sameBits(poseNormalsOf(mesh, moved.positions, options), normalsOf(moved.view(), options)));
}

/// Returns two squares that share an edge. `angle_deg`: angle between their normals; 0 means that they are coplanar.
SimpleMesh book(double angle_deg) {
    const double angle = angle_deg * kPi / 180;
    const auto x = static_cast<float>(std::cos(angle)), z = static_cast<float>(std::sin(angle));
    SimpleMesh mesh;
    mesh.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {x, 0, z}, {x, 1, z}};
    mesh.addFace({0, 1, 2, 3});
    mesh.addFace({1, 4, 5, 2});
    return mesh;
}

TEST(PoseNormals, KeepTheHardEdgesOfTheMesh) {
    const SimpleMesh flat = book(10), bent = book(80);
    const NormalOptions options{.crease_angle_deg = 45};
    const std::vector<Vec3> softly = poseNormalsOf(flat, bent.positions, options);
    EXPECT_EQ(softly[1], softly[4]) << "smooth on the mesh";
    const std::vector<Vec3> hard = poseNormalsOf(bent, flat.positions, options);
    EXPECT_EQ(hard[1], (Vec3{0, 0, 1}));
    EXPECT_NEAR(hard[4].x, -std::sin(10 * kPi / 180), 1e-6) << "hard on the mesh";
}

TEST(PoseNormals, RejectAWrongNumberOfPositions) {
    const SimpleMesh mesh = book(10);
    std::vector<Vec3> out(8), positions(5);
    EXPECT_EQ(generatePoseNormals(mesh.view(), StridedSpan<const Vec3>(positions), {}, out).error().code,
              ErrorCode::countMismatch);
}

}  // namespace
}  // namespace tspace
