// SPDX-License-Identifier: MIT
// The MikkTSpace reference's interface: reads all corners through the callbacks, then calls generateTangents.
#include "tspace/compat/mikktspace.h"

#include <numeric>
#include <vector>

#include "core/base/border.h"
#include "tspace/tangents.h"

namespace {

/// The caller's faces as far as results depend on them.
struct Corners {
    std::vector<tspace::Vec3> positions;
    std::vector<tspace::Vec3> normals;
    std::vector<tspace::Vec2> uvs;
    std::vector<std::uint32_t> face_sizes;
    std::vector<int> face_numbers;  ///< the caller's number of each face
};

bool isSupported(int vertex_count) { return vertex_count == 3 || vertex_count == 4; }

bool hasGetters(const SMikkTSpaceInterface& calls) {
    return calls.m_getNumVerticesOfFace != nullptr && calls.m_getPosition != nullptr && calls.m_getNormal != nullptr &&
           calls.m_getTexCoord != nullptr;
}

/// Calls body(face, corners) for every face that results depend on. Those are the supported ones, with all
/// their corners. The first corner of the whole mesh counts even when its face is not supported, as a face of
/// one corner: the reference starts the bounding box of its welding grid there, which can show in the result.
/// Stops when the body returns false.
template <class Body>
void forUsedFaces(const SMikkTSpaceContext* context, int face_count, Body&& body) {
    bool first = true;
    for (int face = 0; face < face_count; ++face) {
        const int size = context->m_pInterface->m_getNumVerticesOfFace(context, face);
        const bool supported = isSupported(size);
        if (!supported && (size < 1 || !first)) continue;
        first = false;
        if (!body(face, supported ? static_cast<std::uint32_t>(size) : 1u)) return;
    }
}

/// Lists the faces; false when there is nothing to compute or too much. Counts first, so that absurd answers
/// cost no memory.
bool listFaces(const SMikkTSpaceContext* context, int face_count, Corners& corners) {
    std::size_t corner_count = 0;
    std::size_t used_count = 0;
    bool any_supported = false;
    forUsedFaces(context, face_count, [&](int, std::uint32_t size) {
        any_supported = any_supported || size > 1;
        corner_count += size;
        ++used_count;
        return corner_count <= tspace::kMaxCorners;
    });
    if (!any_supported || corner_count > tspace::kMaxCorners) return false;
    corners.face_sizes.reserve(used_count);
    corners.face_numbers.reserve(used_count);
    forUsedFaces(context, face_count, [&](int face, std::uint32_t size) {
        corners.face_sizes.push_back(size);
        corners.face_numbers.push_back(face);
        return true;
    });
    return true;
}

void readCorners(const SMikkTSpaceContext* context, Corners& corners) {
    const SMikkTSpaceInterface& calls = *context->m_pInterface;
    const auto corner_count = std::accumulate(corners.face_sizes.begin(), corners.face_sizes.end(), std::size_t{0});
    corners.positions.resize(corner_count);
    corners.normals.resize(corner_count);
    corners.uvs.resize(corner_count);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < corners.face_sizes.size(); ++i) {
        const int face = corners.face_numbers[i];
        const int size = static_cast<int>(corners.face_sizes[i]);
        for (int local = 0; local < size; ++local, ++corner) {
            calls.m_getPosition(context, &corners.positions[corner].x, face, local);
            if (!isSupported(size)) continue;
            calls.m_getNormal(context, &corners.normals[corner].x, face, local);
            calls.m_getTexCoord(context, &corners.uvs[corner].x, face, local);
        }
    }
}

void writeCorners(const SMikkTSpaceContext* context, const Corners& corners, const tspace::TangentOutput& out) {
    const SMikkTSpaceInterface& calls = *context->m_pInterface;
    std::size_t corner = 0;
    for (std::size_t i = 0; i < corners.face_sizes.size(); ++i) {
        const int size = static_cast<int>(corners.face_sizes[i]);
        for (int local = 0; local < size; ++local, ++corner) {
            if (!isSupported(size)) continue;
            const tspace::Vec4& tangent = out.tangents[corner];
            if (calls.m_setTSpace != nullptr) {
                calls.m_setTSpace(context, &tangent.x, &out.bitangents[corner].x, out.magnitudes_s[corner],
                                  out.magnitudes_t[corner], tangent.w > 0.0f ? 1 : 0, corners.face_numbers[i], local);
            }
            if (calls.m_setTSpaceBasic != nullptr) {
                calls.m_setTSpaceBasic(context, &tangent.x, tangent.w, corners.face_numbers[i], local);
            }
        }
    }
}

/// Reads, computes, then writes: no setter is called unless everything is there.
bool generate(const SMikkTSpaceContext* context, float angular_threshold_deg) {
    const SMikkTSpaceInterface& calls = *context->m_pInterface;
    const int face_count = calls.m_getNumFaces(context);
    if (!hasGetters(calls)) return false;

    Corners corners;
    if (!listFaces(context, face_count, corners)) return false;
    readCorners(context, corners);
    const std::size_t corner_count = corners.positions.size();

    std::vector<tspace::Vec4> tangents(corner_count);
    std::vector<tspace::Vec3> bitangents;
    std::vector<float> magnitudes_s;
    std::vector<float> magnitudes_t;
    if (calls.m_setTSpace != nullptr) {
        bitangents.resize(corner_count);
        magnitudes_s.resize(corner_count);
        magnitudes_t.resize(corner_count);
    }
    tspace::MeshView mesh;
    mesh.positions = corners.positions;
    mesh.normals = corners.normals;
    mesh.uvs = corners.uvs;
    mesh.face_sizes = corners.face_sizes;
    tspace::TangentOptions options{.convention = tspace::conventions::opengl};
    options.angular_threshold_deg = angular_threshold_deg;
    options.ngons = tspace::Ngons::skip;
    const tspace::TangentOutput out{tangents, bitangents, magnitudes_s, magnitudes_t};
    if (!tspace::generateTangents(mesh, options, out)) return false;
    writeCorners(context, corners, out);
    return true;
}

}  // namespace

// Exceptions of the caller's own callbacks, if it is C++, pass through; only running out of memory ends here.
tbool genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold) {
    if (pContext == nullptr || pContext->m_pInterface == nullptr || pContext->m_pInterface->m_getNumFaces == nullptr) {
        return 0;
    }
    return tspace::withMemory([&]() -> tbool { return generate(pContext, fAngularThreshold) ? 1 : 0; });
}

tbool genTangSpaceDefault(const SMikkTSpaceContext* pContext) { return genTangSpace(pContext, 180.0f); }
