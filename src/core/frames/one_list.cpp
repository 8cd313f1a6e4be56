// SPDX-License-Identifier: MIT
#include "core/frames/one_list.h"

#include <span>

#include "core/base/mesh_loops.h"

namespace tspace {
namespace {

/// Returns, for each new vertex, the index of its attribute entry: from the attribute's index list, at the vertex's
/// source corner, or, without a list, the source vertex.
std::vector<std::uint32_t> sourcesOf(const IndexView& list, const SplitResult& split) {
    if (list.type == IndexType::none) return split.source_vertices;
    std::vector<std::uint32_t> sources(split.vertexCount());
    for (std::size_t v = 0; v < sources.size(); ++v) {
        const std::uint32_t corner = split.source_corners[v];
        sources[v] = corner == kNoCorner ? kNoCorner : list[corner];
    }
    return sources;
}

template <class T>
std::vector<T> gathered(const StridedSpan<const T>& values, const std::vector<std::uint32_t>& sources) {
    std::vector<T> result(sources.size());
    gather<T>(values, sources, result.data());
    return result;
}

}  // namespace

Result<Done> useOneList(const MeshView& mesh, const Execution& execution, OneListMesh& made,
                        std::span<const std::uint32_t> welded, std::span<const CornerAttribute> further) {
    const std::size_t corner_count = mesh.cornerCount();
    // Attributes that distinguish corners: their values, or their indices viewed as floats. The split compares bits.
    std::vector<CornerAttribute> attributes(further.begin(), further.end());
    std::vector<std::uint32_t> numbers[2];
    const auto add = [&](const auto& values, const IndexView& list, std::vector<std::uint32_t>& memory) {
        if (values.empty()) return;
        if (list.type == IndexType::corners || (list.type == IndexType::none && !welded.empty())) {
            attributes.push_back({&values.data->x, values.stride_bytes, sizeof *values.data / sizeof(float)});
        } else if (list.type != IndexType::none) {
            if (list.type != IndexType::u32) memory.resize(corner_count);
            const std::uint32_t* const found = readIndices(list, 0, corner_count, memory.data());
            attributes.push_back({reinterpret_cast<const float*>(found), sizeof(float), 1});
        }
    };
    add(mesh.normals, mesh.normal_indices, numbers[0]);
    add(mesh.uvs, mesh.uv_indices, numbers[1]);
    Result<SplitResult> split = splitVertices(welded.empty() ? mesh.indices : IndexView(welded), mesh.vertexCount(),
                                              corner_count, attributes, execution);
    if (!split) return std::move(split).error();
    if (!welded.empty()) {
        // In a mesh without indices, each corner has its own vertex: a new vertex copies all attributes of the vertex
        // of its source corner.
        for (std::size_t v = 0; v < split->vertexCount(); ++v) {
            if (split->source_corners[v] != kNoCorner) split->source_vertices[v] = split->source_corners[v];
        }
    }

    made.own.positions = gathered(mesh.positions, split->source_vertices);
    if (!mesh.normals.empty()) {
        made.source_normals = sourcesOf(mesh.normal_indices, *split);
        made.own.normals = gathered(mesh.normals, made.source_normals);
    }
    if (!mesh.uvs.empty()) made.own.uvs = gathered(mesh.uvs, sourcesOf(mesh.uv_indices, *split));
    made.own.indices = std::move(split->indices);
    made.source_vertices = std::move(split->source_vertices);
    made.view = mesh;
    made.view.positions = made.own.positions;
    made.view.normals = made.own.normals;
    made.view.uvs = made.own.uvs;
    made.view.indices = std::span<const std::uint32_t>(made.own.indices);
    made.view.normal_indices = made.view.uv_indices = {};
    return Done{};
}

}  // namespace tspace
