// SPDX-License-Identifier: MIT
// Targets come one after the other. Each may split the vertices that there are; a vertex that a later target splits
// passes on what it has from earlier ones.
#include "core/mesh/pools/morph_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/unit.h"

namespace tspace {

namespace {

bool areClose(const Vec3& a, const Vec3& b, float tolerance) {
    return std::fabs(a.x - b.x) <= tolerance && std::fabs(a.y - b.y) <= tolerance && std::fabs(a.z - b.z) <= tolerance;
}

}  // namespace

MorphSplit::MorphSplit(SplitResult&& split, bool may_split)
    : split_(std::move(split)), may_split_(may_split), parents_(split_.vertexCount()) {
    std::iota(parents_.begin(), parents_.end(), 0u);
}

Result<Done> MorphSplit::add(std::span<const Vec3> offsets, float tolerance, const Execution& execution) {
    Target& target = targets_.emplace_back();
    if (std::all_of(offsets.begin(), offsets.end(), isZero)) {
        target.vertex_count = split_.vertexCount();
        return Done{};
    }
    if (may_split_ && !agree(offsets, tolerance)) {
        if (Result<Done> done = refine(offsets, tolerance, execution); !done) return done;
    }
    target.vertex_count = split_.vertexCount();
    for (std::size_t v = 0; v < target.vertex_count; ++v) {
        const std::uint32_t corner = split_.source_corners[v];
        if (corner == kNoCorner || isZero(offsets[corner])) continue;
        target.offsets.vertices.push_back(static_cast<std::uint32_t>(v));
        target.offsets.offsets.push_back(offsets[corner]);
    }
    return Done{};
}

bool MorphSplit::agree(std::span<const Vec3> offsets, float tolerance) const {
    for (std::size_t c = 0; c < offsets.size(); ++c) {
        const Vec3& first = offsets[split_.source_corners[split_.indices[c]]];
        if (!areClose(offsets[c], first, tolerance)) return false;
    }
    return true;
}

Result<Done> MorphSplit::refine(std::span<const Vec3> offsets, float tolerance, const Execution& execution) {
    const std::size_t count = split_.vertexCount();
    const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(offsets), tolerance);
    Result<SplitResult> refined = splitVertices(IndexView(std::span<const std::uint32_t>(split_.indices)), count,
                                                offsets.size(), {&attribute, 1}, execution);
    if (!refined) return std::move(refined).error();
    for (std::size_t v = count; v < refined->vertexCount(); ++v) {
        const std::uint32_t parent = refined->source_vertices[v];
        parents_.push_back(parent);
        split_.source_vertices.push_back(split_.source_vertices[parent]);
        split_.source_corners.push_back(refined->source_corners[v]);
    }
    split_.indices = std::move(refined->indices);
    return Done{};
}

std::vector<VertexOffsets> MorphSplit::finish() {
    std::vector<VertexOffsets> result;
    for (Target& target : targets_) {
        result.push_back(spread(target.offsets, parents_, target.vertex_count));
        target.offsets = {};
    }
    targets_.clear();
    return result;
}

VertexOffsets spread(const VertexOffsets& offsets, std::span<const std::uint32_t> sources, std::size_t old_count) {
    VertexOffsets result = offsets;
    if (offsets.vertices.empty() || old_count == sources.size()) return result;
    std::vector<std::uint32_t> places(sources.size(), 0);  // by vertex; 1 is the first place, 0 none
    for (std::size_t i = 0; i < offsets.vertices.size(); ++i) {
        places[offsets.vertices[i]] = static_cast<std::uint32_t>(i + 1);
    }
    for (std::size_t v = old_count; v < sources.size(); ++v) {
        places[v] = places[sources[v]];
        if (places[v] == 0) continue;
        result.vertices.push_back(static_cast<std::uint32_t>(v));
        result.offsets.push_back(offsets.offsets[places[v] - 1]);
    }
    return result;
}

}  // namespace tspace
