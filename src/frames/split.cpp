// SPDX-License-Identifier: MIT
// Duplicates vertices whose corners disagree. Corner after corner, by one thread: that takes most of the time, and several
// threads were slower.
#include "tspace/split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/border.h"
#include "core/mesh_loops.h"
#include "core/parallel.h"
#include "frames/variants.h"

namespace tspace {

namespace {

/// Corners that are compared before those that differ are looked at.
constexpr std::size_t kCompared = 64;

using AttributeSpan = std::span<const CornerAttribute>;

/// Corners one behind the other, and what is known of their vertices.
struct CornerBlock {
    std::uint32_t corner;  ///< the first one
    std::size_t count;
    const std::uint32_t* vertices;  ///< one per corner
    std::uint32_t* firsts;          ///< of all vertices: the first corner
};

/// Writes those corners that do not equal the first one of their vertex to `different`. Returns how many they are.
using ListDifferent = std::size_t (*)(AttributeSpan attributes, const CornerBlock& block, std::uint32_t* different);

/// Exact attributes with these numbers of components, in this order; any where there are none. The first corner of a vertex
/// is found on the way.
template <std::uint32_t... Counts>
std::size_t listDifferent(AttributeSpan attributes, const CornerBlock& block, std::uint32_t* different) {
    std::array<CornerAttribute, sizeof...(Counts)> exact;  // copies, which no store can change
    std::copy_n(attributes.begin(), exact.size(), exact.begin());
    const auto at = [&](std::size_t i, std::uint32_t corner) {
        return reinterpret_cast<const std::byte*>(exact[i].data) + corner * exact[i].stride_bytes;
    };
    const auto [corner, count, vertices, firsts] = block;
    std::size_t different_count = 0;
    for (std::size_t k = 0; k < count; ++k) {
        static_assert(kNoCorner == 0xffffffffu);  // above all corners
        const std::uint32_t here = corner + static_cast<std::uint32_t>(k);
        const std::uint32_t first = std::min(firsts[vertices[k]], here);
        firsts[vertices[k]] = first;
        std::uint32_t differs = 0;
        different[different_count] = here;
        if constexpr (sizeof...(Counts) == 0) {
            differs = equalCorners(attributes, here, first) ? 0u : 1u;
        } else {
            std::size_t i = 0;
            ((differs |= std::memcmp(at(i, here), at(i, first), 4 * Counts) == 0 ? 0u : 1u, ++i), ...);
        }
        different_count += differs;
    }
    return different_count;
}

template <std::uint32_t... Counts>
bool areExact(AttributeSpan attributes) {
    constexpr std::array<std::uint32_t, sizeof...(Counts)> counts{Counts...};
    return std::equal(attributes.begin(), attributes.end(), counts.begin(), counts.end(),
                      [](const CornerAttribute& attribute, std::uint32_t count) {
                          return attribute.component_count == count && attribute.tolerance == 0.0f;
                      });
}

ListDifferent listerFor([[maybe_unused]] AttributeSpan attributes) {
#ifndef TSPACE_SMALL
    if (areExact<4>(attributes)) return listDifferent<4>;
    if (areExact<3>(attributes)) return listDifferent<3>;
    if (areExact<3, 4>(attributes)) return listDifferent<3, 4>;
#endif
    return listDifferent<>;
}

SplitResult split(const IndexView& view, std::size_t vertex_count, std::size_t corner_count, AttributeSpan attributes) {
    SplitResult result;
    resizeAtOnce(result.indices, corner_count, corner_count, 0);
    // Room for some copies costs nothing until it is used.
    resizeAtOnce(result.source_corners, vertex_count, vertex_count + vertex_count / 8, kNoCorner);
    Variants variants(attributes, result);
    const ListDifferent list = listerFor(attributes);
    for (std::size_t begin = 0; begin < corner_count; begin += kCompared) {
        const std::size_t count = std::min(kCompared, corner_count - begin);
        std::array<std::uint32_t, kCompared> different, buffer;
        const std::uint32_t* const vertices = readIndices(view, begin, count, buffer.data());
        std::copy_n(vertices, count, result.indices.data() + begin);
        const std::size_t different_count =
            list(attributes, {static_cast<std::uint32_t>(begin), count, vertices, result.source_corners.data()},
                 different.data());
        for (std::size_t i = 0; i < different_count; ++i)
            result.indices[different[i]] = variants.variantOf(different[i], vertices[different[i] - begin]);
    }
    std::vector<std::uint32_t>& sources = result.source_vertices;
    if (sources.empty()) resizeAtOnce(sources, vertex_count, vertex_count, 0);
    std::iota(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(vertex_count), 0u);
    for (std::size_t v = vertex_count; v < sources.size(); ++v) sources[v] = view[result.source_corners[v]];
    return result;
}

Error checkAttributes(AttributeSpan attributes, std::size_t corner_count) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const CornerAttribute& attribute = attributes[i];
        if (attribute.component_count < 1 || attribute.component_count > 16) {
            return makeError(ErrorCode::invalidOption, i, "attribute %zu has %u components, not 1 to 16", i,
                             attribute.component_count);
        }
        if (!(attribute.tolerance >= 0.0f) || !std::isfinite(attribute.tolerance)) {
            return makeError(ErrorCode::invalidOption, i,
                             "attribute %zu has a tolerance that is negative or not finite", i);
        }
        const Error name = makeError(ErrorCode::ok, i, "attribute %zu", i);
        Error e = checkSpan(attribute.data, corner_count, attribute.stride_bytes,
                            attribute.component_count * sizeof(float), kAnyCount, name.message.c_str());
        if (e.code != ErrorCode::ok) return e;
    }
    return {ErrorCode::ok, {}};
}

Error check(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count, AttributeSpan attributes,
            const Execution& execution) {
    if (vertex_count > kMaxCorners || corner_count > kMaxCorners) {
        return {ErrorCode::tooLarge, "more than 2^31-1 vertices or corners"};
    }
    Parallel parallel(execution, corner_count);
    if (Error e = checkIndices(indices, vertex_count, &parallel); e.code != ErrorCode::ok) return e;
    if (indices.type == IndexType::none && corner_count > vertex_count) {
        return makeError(ErrorCode::indexOutOfRange, vertex_count,
                         "corner %zu has no vertex: there are %zu vertices and no indices", vertex_count, vertex_count);
    }
    if (indices.type != IndexType::none && corner_count != indices.count) {
        return makeError(ErrorCode::countMismatch, kNoElement, "%zu corners but %zu indices", corner_count,
                         indices.count);
    }
    return checkAttributes(attributes, corner_count);
}

}  // namespace

Result<SplitResult> splitVertices(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
                                  std::span<const CornerAttribute> attributes, const Execution& execution) {
    return atBorder([&]() -> Result<SplitResult> {
        if (Error e = check(indices, vertex_count, corner_count, attributes, execution); e.code != ErrorCode::ok)
            return e;
        return split(indices, vertex_count, corner_count, attributes);
    });
}

}  // namespace tspace
