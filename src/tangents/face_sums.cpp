// SPDX-License-Identifier: MIT
// Sums of dP/du and dP/dv: blocks of triangles in single precision, and in double precision those that
// rounding, overflow or degeneracy could spoil. Based on: Lengyel, "Computing Tangent Space Basis Vectors for
// an Arbitrary Mesh", 2001.
#include "tangents/face_sums.h"

#include <algorithm>

#include "core/typed_indices.h"
#include "core/uv_frame.h"

namespace tspace {

using derivatives::DerivativeTerms;

/// Some triangles of one block: three vertices for each, of the mesh or in the buffer.
struct FaceSums::Block {
    static constexpr std::size_t kMost = VertexRanges::kBlock;
    static_assert(kMost == derivatives::kTermTriangles && kMost % derivatives::kTermGroup == 0);

    const std::uint32_t* vertices = nullptr;
    std::size_t count = 0;
    std::uint32_t buffer[3 * kMost];
    DerivativeTerms terms;

    /// Keeps those that have a vertex in the range.
    void select(VertexRange range) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < 3 * count; i += 3) {
            bool any = false;
            for (std::size_t k = 0; k < 3; ++k) {
                any |= range.has(vertices[i + k]);
                buffer[3 * kept + k] = vertices[i + k];
            }
            kept += any ? 1 : 0;
        }
        vertices = buffer;
        count = kept;
    }
};

FaceSums::FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions,
                   const derivatives::DerivativeKernel& kernel, VertexSums sums, float* visits)
    : plan_(plan),
      positions_(positions),
      kernel_(kernel),
      sums_(sums),
      visits_(visits),
      ranges_(plan.triangle_vertices, plan.triangleCount(), plan.vertex_count) {}

void FaceSums::cutIntoRanges(unsigned wanted, const Allocator* allocator, Parallel& parallel) {
    static_cast<void>(ranges_.cut(wanted, allocator, parallel));  // vertices have been checked
}

TriangleCounts FaceSums::sum(unsigned index) const {
    const VertexRange range = ranges_.range(index);
    sums_.clear(range);
    if (visits_ != nullptr) std::fill(visits_ + range.begin, visits_ + range.end, 0.0f);

    const derivatives::TriangleSource source{
        reinterpret_cast<const std::byte*>(positions_.data), reinterpret_cast<const std::byte*>(plan_.uvs.data),
        positions_.stride_bytes, plan_.uvs.stride_bytes, static_cast<std::uint32_t>(positions_.count - 1)};
    TriangleCounts counts;
    Block block;
    ranges_.forBlocks(index, [&](std::size_t b) {
        const std::size_t first = b * Block::kMost;
        block.count = std::min(Block::kMost, plan_.triangleCount() - first);
        block.vertices = readIndices(plan_.triangle_vertices, 3 * first, 3 * block.count, block.buffer);
        prefetchLines(block.vertices, 3 * Block::kMost * sizeof(std::uint32_t));
        const bool is_whole = ranges_.isWithinOne(b);
        if (!is_whole) block.select(range);
        block.vertices = fillGroup(block.vertices, block.count, derivatives::kTermGroup, block.buffer);
        kernel_.compute(source, block.vertices, block.count, block.terms);
        addBlock(block, range, is_whole, counts);
    });
    return counts;
}

/// In the order of the triangles, which decides how sums are rounded.
void FaceSums::addBlock(const Block& block, VertexRange range, bool is_whole, TriangleCounts& counts) const {
    const std::uint32_t* const v = block.vertices;
    std::uint64_t unsafe = ~block.terms.safe & lowBits(block.count);
    for (std::size_t begin = 0; begin < block.count;) {
        const auto end = unsafe == 0 ? block.count : static_cast<std::size_t>(std::countr_zero(unsafe));
        if (is_whole)
            kernel_.add(block.terms, v, begin, end, {sums_.heads, sums_.tails});
        else
            kernel_.add_some(block.terms, v, begin, end, {sums_.heads, sums_.tails}, range.begin, range.end);
        if (end != block.count) addUnsafe(v + 3 * end, range, counts);
        unsafe &= unsafe - 1;
        begin = end + 1;
    }
    if (is_whole) {
        counts.mirrored += static_cast<unsigned>(std::popcount(block.terms.mirrored));
    } else {
        for (std::size_t i = 0; i < block.count; ++i)
            counts.mirrored += (block.terms.mirrored >> i & 1) != 0 && range.has(v[3 * i]) ? 1 : 0;
    }
    if (visits_ == nullptr) return;
    for (std::size_t i = 0; i < 3 * block.count; ++i) {
        if ((block.terms.safe >> (i / 3) & 1) != 0 && range.has(v[i])) visits_[v[i]] += 1;
    }
}

/// In double. A triangle that has no derivatives adds nothing, but its vertices have been named.
void FaceSums::addUnsafe(const std::uint32_t* v, VertexRange range, TriangleCounts& counts) const {
    const Vec3 &p0 = positions_[v[0]], &p1 = positions_[v[1]], &p2 = positions_[v[2]];
    const UvFrame frame = uvFrame(p0, p1, p2, plan_.uvs[v[0]], plan_.uvs[v[1]], plan_.uvs[v[2]]);
    const bool has_area = hasUvArea(frame.determinant);
    if (range.has(v[0])) {
        counts.degenerate += p0 == p1 || p1 == p2 || p2 == p0 ? 1 : 0;
        counts.degenerate_uv += has_area ? 0 : 1;
        counts.mirrored += has_area && frame.determinant < 0 ? 1 : 0;
    }
    const double r = has_area ? 1 / frame.determinant : 0;
    const Vec3 s = toFloat(r * frame.tangent), t = toFloat(r * frame.bitangent);
    const bool adds = has_area && isFinite(s) && isFinite(t);
    const float row[6] = {s.x + 0.0f, s.y, s.z, t.x, t.y, t.z};
    for (unsigned k = 0; k < 3; ++k) {
        if (!range.has(v[k])) continue;
        float *const head = sums_.head(v[k]), *const tail = sums_.tail(v[k]);
        if (!adds) {
            *head += 0.0f;
            continue;
        }
        for (unsigned i = 0; i < 4; ++i) head[i] += row[i];
        for (unsigned i = 0; i < 2; ++i) tail[i] += row[4 + i];
        if (visits_ != nullptr) visits_[v[k]] += 1;
    }
}

}  // namespace tspace
