// SPDX-License-Identifier: MIT
// Exports of all modules that compute frames: the mesh of the next call, and the three functions of `mikktspace`.
#include "common.h"

namespace tspace::js {

namespace {
MeshView current_mesh;
}  // namespace

const MeshView& mesh() { return current_mesh; }

Convention conventionOf(std::uint32_t bits) {
    return {.v_axis = static_cast<VAxis>(bits & 3),
            .green = static_cast<Green>(bits >> 2 & 1),
            .stored_sign = static_cast<StoredSign>(bits >> 3 & 1),
            .handedness = static_cast<Handedness>(bits >> 4 & 1),
            .winding = static_cast<Winding>(bits >> 5 & 1)};
}

}  // namespace tspace::js

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// Sets arrays in this module's memory (null if absent) and the counts of vertices, corners and faces.
TSPACE_JS_EXPORT(setMesh)
void setMesh(const float* positions, std::size_t position_count, const float* normals, std::size_t normal_count,
             const float* uvs, std::size_t uv_count, const std::uint32_t* indices, std::size_t index_count,
             const std::uint32_t* face_sizes, std::size_t face_count, const std::uint32_t* normal_indices,
             std::size_t normal_index_count, const std::uint32_t* uv_indices, std::size_t uv_index_count) {
    current_mesh = {};
    current_mesh.positions = vec3Span(positions, position_count);
    current_mesh.normals = vec3Span(normals, normal_count);
    current_mesh.uvs = vec2Span(uvs, uv_count);
    if (indices != nullptr) current_mesh.indices = {indices, index_count, IndexType::u32};
    if (normal_indices != nullptr) current_mesh.normal_indices = {normal_indices, normal_index_count, IndexType::u32};
    if (uv_indices != nullptr) current_mesh.uv_indices = {uv_indices, uv_index_count, IndexType::u32};
    if (face_sizes != nullptr) current_mesh.face_sizes = {face_sizes, face_count};
}

TSPACE_JS_EXPORT(sanitizeTangents) std::uint32_t sanitize(float* tangents, std::size_t count, bool orthogonalize_all) {
    SanitizeOptions options;
    options.orthogonalize_all = orthogonalize_all;
    auto result = sanitizeTangents(mesh(), options, vec4Span(tangents, count));
    if (result) keep(*result);
    return codeOf(result);
}

/// `attributes`: for each attribute a pointer, a number of components and a tolerance. `result`: receives six words, a
/// pointer and a count for indices, source vertices and source corners, to be freed individually.
TSPACE_JS_EXPORT(splitVertices)
std::uint32_t split(const std::uint32_t* indices, std::size_t vertex_count, std::size_t corner_count,
                    const AttributeWords* attributes, std::size_t attribute_count, std::uint32_t* result) {
    constexpr std::size_t kMost = 64;
    CornerAttribute list[kMost];
    if (attribute_count > kMost) {
        error = {ErrorCode::tooLarge, "more than 64 attributes"};
        return static_cast<std::uint32_t>(error.code);
    }
    for (std::size_t i = 0; i < attribute_count; ++i) {
        const AttributeWords& from = attributes[i];
        list[i] = {from.data, from.component_count * sizeof(float), from.component_count, from.tolerance};
    }
    const IndexView view = indices == nullptr ? IndexView() : IndexView(indices, corner_count, IndexType::u32);
    auto made = splitVertices(view, vertex_count, corner_count, {list, attribute_count});
    if (!made) return codeOf(made);
    const std::vector<std::uint32_t>* const lists[] = {&made->indices, &made->source_vertices, &made->source_corners};
    for (std::size_t i = 0; i < 3; ++i) giveArray(*lists[i], result + 2 * i);
    return 0;
}

}  // extern "C"
