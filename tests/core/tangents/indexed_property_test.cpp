// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/tangents/indexed_methods.h"
#include "support/random_values.h"
#include "support/simple_mesh.h"
#include "tspace/frame.h"

namespace tspace {
namespace {

using test::isUnit;
using test::randomGarbage;
using test::randomGarbageVec3;
using test::randomInt;
using test::randomUnit;
using test::randomVec2;
using test::randomVec3;
using test::SimpleMesh;

constexpr Method kMethods[] = {Method::lengyel, Method::flat, Method::basis};

struct Outputs {
    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
    std::vector<float> magnitudes_s, magnitudes_t;
};

Outputs tangentsOf(const MeshView& mesh, Method method, Convention convention = {}) {
    const std::size_t corners = mesh.cornerCount();
    Outputs out{std::vector<Vec4>(corners), std::vector<Vec3>(corners), std::vector<float>(corners),
                std::vector<float>(corners)};
    Parallel parallel(Execution{.thread_count = 1});
    const IndexedPlan plan = planIndexed(mesh, {{.method = method, .convention = convention}}, parallel);
    evaluateIndexed(plan, {mesh.positions, mesh.normals},
                    {out.tangents, out.bitangents, out.magnitudes_s, out.magnitudes_t}, {}, parallel);
    return out;
}

void addRandomFaces(SimpleMesh& mesh, int most_corners) {
    const int face_count = randomInt(1, 12);
    for (int f = 0; f < face_count; ++f) {
        const int size = randomInt(3, most_corners + 1);
        mesh.face_sizes.push_back(static_cast<std::uint32_t>(size));
        for (int i = 0; i < size; ++i) {
            mesh.indices.push_back(static_cast<std::uint32_t>(randomInt(0, static_cast<int>(mesh.positions.size()))));
        }
    }
}

SimpleMesh randomMesh(int most_corners) {
    SimpleMesh mesh;
    for (int v = 0; v < 10; ++v) {
        mesh.positions.push_back(randomVec3());
        mesh.normals.push_back(randomUnit());
        mesh.uvs.push_back(randomVec2());
    }
    addRandomFaces(mesh, most_corners);
    return mesh;
}

RC_GTEST_PROP(IndexedProperty, IsFiniteUnitAndSignedForGarbage, ()) {
    SimpleMesh mesh;
    for (int v = 0; v < 10; ++v) {
        mesh.positions.push_back(randomGarbageVec3());
        mesh.normals.push_back(randomGarbageVec3());
        const float u = randomGarbage();
        mesh.uvs.push_back({u, randomGarbage()});
    }
    addRandomFaces(mesh, 6);
    for (const Method method : kMethods) {
        const Outputs out = tangentsOf(mesh.view(), method);
        for (std::size_t c = 0; c < out.tangents.size(); ++c) {
            RC_ASSERT(isUnit(xyz(out.tangents[c]), 2e-7));
            RC_ASSERT(std::fabs(out.tangents[c].w) == 1);
            RC_ASSERT(isUnit(out.bitangents[c], 2e-7));
            RC_ASSERT(std::isfinite(out.magnitudes_s[c]) && std::isfinite(out.magnitudes_t[c]));
        }
    }
}

/// Compares the results with sums by the method's definition, in double precision.
RC_GTEST_PROP(IndexedProperty, LengyelIsItsDefinition, ()) {
    const SimpleMesh mesh = randomMesh(3);
    const Outputs out = tangentsOf(mesh.view(), Method::lengyel);
    for (std::size_t c = 0; c < out.tangents.size(); ++c) {
        double s[3] = {}, t[3] = {}, greatest = 0;
        for (std::size_t f = 0; f < mesh.face_sizes.size(); ++f) {
            Vec3 p[3];
            Vec2 uv[3];
            int visits = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = mesh.indices[3 * f + i];
                p[i] = mesh.positions[v];
                uv[i] = mesh.uvs[v];
                visits += v == mesh.indices[c] ? 1 : 0;
            }
            const FaceFrame frame = faceFrame(p, uv);
            const Vec3 &ft = frame.tangent, &fb = frame.bitangent;
            if (visits != 0) greatest = std::max({greatest, test::norm(ft), test::norm(fb)});
            const double add_s[3] = {ft.x, ft.y, ft.z}, add_t[3] = {fb.x, fb.y, fb.z};
            for (int k = 0; k < 3; ++k) {
                s[k] += visits * add_s[k];
                t[k] += visits * add_t[k];
            }
        }
        const Vec3& n = mesh.normals[mesh.indices[c]];
        const double along = n.x * s[0] + n.y * s[1] + n.z * s[2];
        const double rest[3] = {s[0] - along * n.x, s[1] - along * n.y, s[2] - along * n.z};
        const double l = std::sqrt(rest[0] * rest[0] + rest[1] * rest[1] + rest[2] * rest[2]);
        if (l < 1e-2 * greatest || l == 0) continue;  // terms cancel: a float result may differ arbitrarily
        const Vec3 wanted{static_cast<float>(rest[0] / l), static_cast<float>(rest[1] / l),
                          static_cast<float>(rest[2] / l)};
        RC_ASSERT(test::dot(wanted, xyz(out.tangents[c])) > 1 - 1e-6);
        const double volume = (n.y * wanted.z - n.z * wanted.y) * t[0] + (n.z * wanted.x - n.x * wanted.z) * t[1] +
                              (n.x * wanted.y - n.y * wanted.x) * t[2];
        if (std::fabs(volume) > 1e-3 * greatest) RC_ASSERT(out.tangents[c].w == (volume < 0 ? -1.0f : 1.0f));
    }
}

RC_GTEST_PROP(IndexedProperty, LengyelGivesAllCornersOfAVertexOneFrame, ()) {
    const SimpleMesh mesh = randomMesh(6);
    for (const Method method : {Method::lengyel, Method::basis}) {
        const Outputs out = tangentsOf(mesh.view(), method);
        for (std::size_t a = 0; a < out.tangents.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                if (mesh.indices[a] == mesh.indices[b]) RC_ASSERT(out.tangents[a] == out.tangents[b]);
            }
        }
    }
}

/// Tests a plan with permanent data, and a plan that exists only within a call, for both domains.
RC_GTEST_PROP(IndexedProperty, VertexDomainAndPlanGiveTheBitsOfTheOneCallPerCorner, ()) {
    SimpleMesh mesh = randomMesh(randomInt(3, 7));
    if (randomInt(0, 2) == 0) {
        mesh.face_sizes.clear();
        mesh.indices.resize(mesh.indices.size() / 3 * 3);
    }
    const MeshView view = mesh.view();
    const std::size_t corners = view.cornerCount(), vertices = view.vertexCount();
    for (const Method method : {Method::lengyel, Method::basis}) {
        for (const bool all_fields : {false, true}) {
            const auto outputs = [&](std::size_t count) {
                return Outputs{std::vector<Vec4>(count), std::vector<Vec3>(count), std::vector<float>(count),
                               std::vector<float>(count)};
            };
            const auto spans = [&](Outputs& o) {
                return all_fields ? TangentOutput{o.tangents, o.bitangents, o.magnitudes_s, o.magnitudes_t}
                                  : TangentOutput{.tangents = o.tangents};
            };
            Outputs one_call = outputs(corners), per_vertex = outputs(vertices), planned = outputs(corners),
                    planned_per_vertex = outputs(vertices);
            TangentOptions options{.method = method, .convention = conventions::opengl};
            const auto corner_report = generateTangents(view, options, spans(one_call));
            const auto corner_plan = planTangents(view, options);
            options.domain = OutputDomain::vertex;
            const auto vertex_report = generateTangents(view, options, spans(per_vertex));
            const auto vertex_plan = planTangents(view, options);
            RC_ASSERT(corner_report && vertex_report && corner_plan && vertex_plan);
            RC_ASSERT(vertex_plan->outputCount() == vertices && corner_plan->outputCount() == corners);
            const Pose pose{view.positions, view.normals};
            RC_ASSERT(evaluateTangents(*corner_plan, pose, spans(planned)).ok());
            RC_ASSERT(evaluateTangents(*vertex_plan, pose, spans(planned_per_vertex)).ok());
            RC_ASSERT(one_call.tangents == planned.tangents && one_call.bitangents == planned.bitangents);
            RC_ASSERT(one_call.magnitudes_s == planned.magnitudes_s);
            RC_ASSERT(per_vertex.tangents == planned_per_vertex.tangents);
            RC_ASSERT(corner_report->group_count == vertex_report->group_count);
            RC_ASSERT(corner_report->mirrored_count == vertex_report->mirrored_count);
            for (std::size_t c = 0; c < corners; ++c) {
                const std::uint32_t v = mesh.indices[c];
                RC_ASSERT(one_call.tangents[c] == per_vertex.tangents[v]);
                RC_ASSERT(one_call.bitangents[c] == per_vertex.bitangents[v]);
                RC_ASSERT(one_call.magnitudes_s[c] == per_vertex.magnitudes_s[v]);
                RC_ASSERT(one_call.magnitudes_t[c] == per_vertex.magnitudes_t[v]);
            }
        }
    }
}

/// Four triangles are computed at a time, so the other three could affect a result.
RC_GTEST_PROP(IndexedProperty, LengyelGivesATriangleItsOwnBits, ()) {
    SimpleMesh mesh;
    const int count = randomInt(1, 12);
    const auto vertex = [&](bool garbage) {
        mesh.positions.push_back(garbage ? randomGarbageVec3() : randomVec3());
        mesh.normals.push_back(garbage ? randomGarbageVec3() : randomUnit());
        const float u = garbage ? randomGarbage() : randomVec2().x;
        mesh.uvs.push_back({u, garbage ? randomGarbage() : randomVec2().y});
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    for (int f = 0; f < count; ++f) {
        const bool garbage = randomInt(0, 3) == 0;
        const std::uint32_t a = vertex(garbage), b = vertex(garbage);
        mesh.addFace({a, b, vertex(garbage)});
    }
    const Outputs all = tangentsOf(mesh.view(), Method::lengyel);
    for (std::size_t f = 0; f < static_cast<std::size_t>(count); ++f) {
        SimpleMesh one = mesh;
        one.face_sizes = {3};
        one.indices.assign(mesh.indices.begin() + 3 * static_cast<std::ptrdiff_t>(f),
                           mesh.indices.begin() + 3 * static_cast<std::ptrdiff_t>(f + 1));
        const Outputs alone = tangentsOf(one.view(), Method::lengyel);
        for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(alone.tangents[k] == all.tangents[3 * f + k]);
    }
}

RC_GTEST_PROP(IndexedProperty, FlatTriangleIsItsFaceFrameMadeOrthogonal, ()) {
    const SimpleMesh mesh = randomMesh(3);
    const Outputs out = tangentsOf(mesh.view(), Method::flat);
    for (std::size_t c = 0; c < out.tangents.size(); ++c) {
        const std::size_t first = c - c % 3;
        Vec3 p[3];
        Vec2 uv[3];
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = mesh.positions[mesh.indices[first + i]];
            uv[i] = mesh.uvs[mesh.indices[first + i]];
        }
        const FaceFrame face = faceFrame(p, uv);
        const Vec3& n = mesh.normals[mesh.indices[c]];
        const Frame frame{face.tangent, face.bitangent, n};
        const double sine = test::norm(orthonormalize(frame).tangent);
        if (std::fabs(face.determinant) < 1e-2f || sine < 1e-2) continue;
        RC_ASSERT(test::dot(packTangent(frame).w == 0 ? Vec3{} : xyz(packTangent(frame)), xyz(out.tangents[c])) >
                  1 - 1e-5);
        if (std::fabs(determinant(frame)) > 1e-3f) RC_ASSERT(out.tangents[c].w == frameSign(frame));
        RC_ASSERT(std::fabs(out.magnitudes_s[c] - test::norm(face.tangent)) <= 1e-5 * test::norm(face.tangent));
    }
}

RC_GTEST_PROP(IndexedProperty, DoesNotDependOnVertexOrderIndexWidthOrStrides, ()) {
    const SimpleMesh mesh = randomMesh(6);
    struct Vertex {
        Vec2 uv;
        float padding;
        Vec3 normal, position;
    };
    // The vertices are in reverse order, and their attributes are interleaved.
    const std::size_t count = mesh.positions.size();
    std::vector<Vertex> vertices(count);
    for (std::size_t v = 0; v < count; ++v) {
        vertices[count - 1 - v] = {mesh.uvs[v], 0, mesh.normals[v], mesh.positions[v]};
    }
    std::vector<std::uint8_t> narrow;
    for (const std::uint32_t v : mesh.indices) narrow.push_back(static_cast<std::uint8_t>(count - 1 - v));
    MeshView view;
    view.positions = {&vertices[0].position, count, sizeof(Vertex)};
    view.normals = {&vertices[0].normal, count, sizeof(Vertex)};
    view.uvs = {&vertices[0].uv, count, sizeof(Vertex)};
    view.indices = IndexView(std::span<const std::uint8_t>(narrow));
    view.face_sizes = mesh.face_sizes;
    for (const Method method : kMethods) {
        const Outputs a = tangentsOf(mesh.view(), method), b = tangentsOf(view, method);
        RC_ASSERT(a.tangents == b.tangents);
        RC_ASSERT(a.bitangents == b.bitangents);
        RC_ASSERT(a.magnitudes_s == b.magnitudes_s);
        RC_ASSERT(a.magnitudes_t == b.magnitudes_t);
    }
}

RC_GTEST_PROP(IndexedProperty, BasisIsOrthonormalWithSignFactor, ()) {
    const SimpleMesh mesh = randomMesh(4);
    for (const Convention& convention : {conventions::opengl, conventions::gltf}) {
        const Outputs out = tangentsOf(mesh.view(), Method::basis, convention);
        for (std::size_t c = 0; c < out.tangents.size(); ++c) {
            const Vec3& n = mesh.normals[mesh.indices[c]];
            RC_ASSERT(std::fabs(test::dot(n, xyz(out.tangents[c]))) < 3e-7);
            RC_ASSERT(out.tangents[c].w == signFactor(convention));
            RC_ASSERT(test::dot(rebuildBitangent(n, out.tangents[c]), out.bitangents[c]) > 1 - 1e-6);
        }
    }
}

}  // namespace
}  // namespace tspace
