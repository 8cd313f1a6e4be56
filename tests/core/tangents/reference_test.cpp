// SPDX-License-Identifier: MIT
// Compares `mikktspace` with the compiled MikkTSpace reference, on small random meshes. This test is built only if
// TSPACE_MIKKTSPACE_DIR is the path of its source; tests/core/tangents/CMakeLists.txt renames its function.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/random_shapes.h"
#include "tspace/compat/mikktspace.h"

extern "C" tbool reference_genTangSpace(const SMikkTSpaceContext* context, float angular_threshold);

namespace tspace::test {
namespace {

/// Data for the callbacks of the reference.
struct Call {
    const SimpleMesh& shape;
    Outputs& outputs;
    std::vector<std::uint32_t> first_corners;

    Call(const SimpleMesh& s, Outputs& o) : shape(s), outputs(o) {
        for (std::uint32_t corner = 0; const std::uint32_t size : s.face_sizes) {
            first_corners.push_back(corner);
            corner += size;
        }
    }
    static Call& of(const SMikkTSpaceContext* context) { return *static_cast<Call*>(context->m_pUserData); }
    [[nodiscard]] std::uint32_t corner(int face, int k) const { return first_corners[face] + k; }
    [[nodiscard]] std::uint32_t vertex(int face, int k) const { return shape.indices[corner(face, k)]; }
};

void runReference(const SimpleMesh& shape, float threshold, Outputs& outputs) {
    using Context = const SMikkTSpaceContext*;
    SMikkTSpaceInterface callbacks{};
    callbacks.m_getNumFaces = [](Context c) { return static_cast<int>(Call::of(c).first_corners.size()); };
    callbacks.m_getNumVerticesOfFace = [](Context c, const int face) {
        return static_cast<int>(Call::of(c).shape.face_sizes[face]);
    };
    callbacks.m_getPosition = [](Context c, float out[], const int face, const int k) {
        std::memcpy(out, &Call::of(c).shape.positions[Call::of(c).vertex(face, k)], sizeof(Vec3));
    };
    callbacks.m_getNormal = [](Context c, float out[], const int face, const int k) {
        std::memcpy(out, &Call::of(c).shape.normals[Call::of(c).vertex(face, k)], sizeof(Vec3));
    };
    callbacks.m_getTexCoord = [](Context c, float out[], const int face, const int k) {
        std::memcpy(out, &Call::of(c).shape.uvs[Call::of(c).vertex(face, k)], sizeof(Vec2));
    };
    callbacks.m_setTSpace = [](Context c, const float tangent[], const float bitangent[], const float magnitude_s,
                               const float magnitude_t, const tbool preserving, const int face, const int k) {
        Outputs& out = Call::of(c).outputs;
        const std::uint32_t corner = Call::of(c).corner(face, k);
        out.tangents[corner] = {tangent[0], tangent[1], tangent[2], preserving != 0 ? 1.0f : -1.0f};
        out.bitangents[corner] = {bitangent[0], bitangent[1], bitangent[2]};
        out.magnitudes_s[corner] = magnitude_s;
        out.magnitudes_t[corner] = magnitude_t;
    };
    Call call(shape, outputs);
    const SMikkTSpaceContext context{&callbacks, &call};
    ASSERT_NE(reference_genTangSpace(&context, threshold), 0);
}

/// Returns a number from an environment variable, or `otherwise` if it is not set.
long setting(const char* name, long otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::atol(text) : otherwise;
}

/// Returns how many of the `count` meshes have bits that differ from the reference.
long countDifferent(long first, long count, Pairing pairing) {
    long different = 0;
    for (long mesh = first; mesh < first + count; ++mesh) {
        const auto [shape, threshold] = randomCase(mesh);
        Outputs want(shape.cornerCount()), got(shape.cornerCount());
        runReference(shape, threshold, want);
        const auto report = generateTangents(
            shape.view(), {.convention = conventions::opengl, .angular_threshold_deg = threshold, .pairing = pairing},
            got.view(), {.thread_count = 1});
        if (report && (sameBits(want, got) || !hasPromisedBits(shape))) continue;
        ++different;
        if (pairing == Pairing::reference) ADD_FAILURE() << "mesh " << mesh << ", threshold " << threshold;
    }
    return different;
}

TEST(MikktspaceReference, HasTheSameBitsOnRandomMeshes) {
    EXPECT_EQ(countDifferent(setting("TSPACE_FIRST_MESH", 0), setting("TSPACE_MESHES", 20'000), Pairing::reference), 0);
}

/// The triangles are in natural order, in which the last bucket sometimes affects the result.
TEST(MikktspaceReference, HasTheSameBitsOnTori) {
    for (std::uint32_t columns = 4; columns <= 60; ++columns) {
        for (std::uint32_t rows = 4; rows <= 60; ++rows) {
            SimpleMesh shape = torus(columns, rows, (columns + rows) % 2 != 0);
            shape.face_sizes.assign(shape.indices.size() / 3, 3);
            Outputs want(shape.cornerCount()), got(shape.cornerCount());
            runReference(shape, 180, want);
            ASSERT_TRUE(
                generateTangents(shape.view(), {.convention = conventions::opengl}, got.view(), {.thread_count = 1}));
            EXPECT_TRUE(sameBits(want, got)) << columns << " " << rows;
        }
    }
}

TEST(MikktspaceReference, DiffersOnSomeOfThemWhereItsLastBucketIsSorted) {
    EXPECT_GT(countDifferent(0, 2'000, Pairing::corrected), 0);
}

}  // namespace
}  // namespace tspace::test
