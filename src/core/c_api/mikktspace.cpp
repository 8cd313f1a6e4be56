// SPDX-License-Identifier: MIT
// Interface of the MikkTSpace reference: reads all corners through the callbacks, then calls generateTangents.
#include "tspace/compat/mikktspace.h"

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/c_api/c_convert.h"
#include "tspace/tangents.h"

namespace {

/// Corners of the caller's faces that affect results.
struct Corners {
    tspace::Buffer<tspace::Vec3> positions;
    tspace::Buffer<tspace::Vec3> normals;
    tspace::Buffer<tspace::Vec2> uvs;
    tspace::Buffer<std::uint32_t> face_sizes;
    tspace::Buffer<int> face_numbers;  ///< the caller's index of each face
};

/// Returns a view of a buffer of results or inputs.
template <class T>
tspace::StridedSpan<T> spanOf(tspace::Buffer<T>& buffer) {
    return {buffer.data(), buffer.size()};
}

bool isSupported(int vertex_count) { return vertex_count == 3 || vertex_count == 4; }

bool hasGetters(const SMikkTSpaceInterface& calls) {
    return calls.m_getNumVerticesOfFace != nullptr && calls.m_getPosition != nullptr && calls.m_getNormal != nullptr &&
           calls.m_getTexCoord != nullptr;
}

/// Calls body(face, corners) for every face that affects results: faces with 3 or 4 corners, with all their corners.
/// The first corner of the mesh is always included, as a face of one corner if its face is not supported: the reference
/// starts the bounding box of its welding grid there, which can affect the result. Stops if the body returns false.
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

/// Lists the faces, and allocates memory for their corners; returns false if there is nothing to compute or too much.
/// Counts first, so that invalid counts returned by callbacks cause no allocation.
bool listFaces(const SMikkTSpaceContext* context, int face_count, const tspace::Allocator* allocator,
               Corners& corners) {
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
    corners.face_sizes = tspace::Buffer<std::uint32_t>(allocator, used_count);
    corners.face_numbers = tspace::Buffer<int>(allocator, used_count);
    std::size_t listed = 0, listed_corners = 0;
    forUsedFaces(context, face_count, [&](int face, std::uint32_t size) {
        listed_corners += size;
        // the callbacks returned other counts than before
        if (listed == used_count || listed_corners > corner_count) return false;
        corners.face_sizes[listed] = size;
        corners.face_numbers[listed++] = face;
        return true;
    });
    if (listed != used_count || listed_corners != corner_count) return false;
    corners.positions = tspace::Buffer<tspace::Vec3>(allocator, corner_count, tspace::Vec3{});
    corners.normals = tspace::Buffer<tspace::Vec3>(allocator, corner_count, tspace::Vec3{});
    corners.uvs = tspace::Buffer<tspace::Vec2>(allocator, corner_count, tspace::Vec2{});
    return true;
}

void readCorners(const SMikkTSpaceContext* context, Corners& corners) {
    const SMikkTSpaceInterface& calls = *context->m_pInterface;
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
            if (calls.m_setTSpaceBasic != nullptr)
                calls.m_setTSpaceBasic(context, &tangent.x, tangent.w, corners.face_numbers[i], local);
        }
    }
}

/// Reads all corners, computes, and then writes all results: no setter is called if any step fails.
bool generate(const SMikkTSpaceContext* context, float angular_threshold_deg, const tspace::Execution& execution) {
    const SMikkTSpaceInterface& calls = *context->m_pInterface;
    const int face_count = calls.m_getNumFaces(context);
    if (!hasGetters(calls)) return false;

    Corners corners;
    if (!listFaces(context, face_count, execution.allocator, corners)) return false;
    readCorners(context, corners);

    const std::size_t corner_count = corners.positions.size(), full = calls.m_setTSpace != nullptr ? corner_count : 0;
    tspace::Buffer<tspace::Vec4> tangents(execution.allocator, corner_count);
    tspace::Buffer<tspace::Vec3> bitangents(execution.allocator, full);
    tspace::Buffer<float> magnitudes_s(execution.allocator, full), magnitudes_t(execution.allocator, full);
    tspace::MeshView mesh;
    mesh.positions = spanOf(corners.positions);
    mesh.normals = spanOf(corners.normals);
    mesh.uvs = spanOf(corners.uvs);
    mesh.face_sizes = {corners.face_sizes.data(), corners.face_sizes.size()};
    tspace::TangentOptions options{.convention = tspace::conventions::opengl};
    options.angular_threshold_deg = angular_threshold_deg;
    options.ngons = tspace::Ngons::skip;
    const tspace::TangentOutput out{
        spanOf(tangents), spanOf(bitangents), spanOf(magnitudes_s), spanOf(magnitudes_t), {}};
    if (!tspace::generateTangents(mesh, options, out, execution)) return false;
    writeCorners(context, corners, out);
    return true;
}

}  // namespace

// Exceptions of the caller's C++ callbacks propagate; only a lack of memory is handled here.
tbool tspace_genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold,
                          const tspace_Execution* execution) {
    if (pContext == nullptr || pContext->m_pInterface == nullptr || pContext->m_pInterface->m_getNumFaces == nullptr ||
        tspace::c_api::checkExecution(execution).code != tspace::ErrorCode::ok) {
        return 0;
    }
    const tspace::c_api::Hooks hooks(execution);
    return tspace::withMemory(
        [&]() -> tbool { return generate(pContext, fAngularThreshold, hooks.execution()) ? 1 : 0; });
}

tbool genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold) {
    return tspace_genTangSpace(pContext, fAngularThreshold, nullptr);
}

tbool genTangSpaceDefault(const SMikkTSpaceContext* pContext) { return genTangSpace(pContext, 180.0f); }
