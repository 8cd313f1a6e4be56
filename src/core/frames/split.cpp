// SPDX-License-Identifier: MIT
// Duplication of vertices whose corners differ. Processes corners sequentially on one thread: comparing takes most of
// the time, and several threads were slower.
#include "tspace/indexed_frames.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "core/base/unique_index.h"

namespace tspace {
namespace {

using AttributeSpan = std::span<const CornerAttribute>;

/// Number of corners that are compared before those that differ are processed.
constexpr std::size_t kCompared = 64;

const float* cornerValues(const CornerAttribute& attribute, std::uint32_t corner) {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(attribute.data) +
                                          corner * attribute.stride_bytes);
}

/// Compares corners by the rule of CornerAttribute::tolerance, for all attributes.
[[gnu::noinline]] bool equalCorners(AttributeSpan attributes, std::uint32_t corner, std::uint32_t other) {
    for (const CornerAttribute& attribute : attributes) {
        const float *a = cornerValues(attribute, corner), *b = cornerValues(attribute, other);
        if (std::memcmp(a, b, attribute.component_count * sizeof(float)) == 0) continue;
        if (attribute.tolerance == 0.0f) return false;
        for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
            if (std::bit_cast<std::uint32_t>(a[k]) == std::bit_cast<std::uint32_t>(b[k])) continue;
            if (!(std::abs(double{a[k]} - double{b[k]}) <= double{attribute.tolerance})) return false;
        }
    }
    return true;
}

/// Number of variants of a vertex that are compared one by one; an index is built only for more.
constexpr std::uint32_t kScannedVariants = 8;

/// Width of a cell relative to the tolerance. It exceeds 1 by more than the rounding of x / width, so that two values
/// that are equal within the tolerance are never two cells apart.
constexpr double kCellMargin = 1.0 + 1.0 / (1 << 20);

constexpr std::uint32_t kNoVariant = 0xffffffffu;  ///< larger than any node number

/// Maximum distance from 0, in cells: beyond it, adjacent floats are more than 100 tolerances apart, so only equal
/// values match.
constexpr double kMostCells = 4294967296.0;

/// Returns the cell of a component; components that are equal within the tolerance are in the same or in adjacent
/// cells.
std::uint64_t cellOf(float value, float tolerance) {
    const double cells = double{value} / (double{tolerance} * kCellMargin);
    if (!(std::abs(cells) < kMostCells)) return 0x7ff8000000000000u | std::bit_cast<std::uint32_t>(value);
    const auto towards_zero = static_cast<std::int64_t>(cells);
    return static_cast<std::uint64_t>(towards_zero - (static_cast<double>(towards_zero) > cells ? 1 : 0));
}

[[gnu::noinline]] void resizeAtOnce(std::vector<std::uint32_t>& values, std::size_t count, std::size_t capacity,
                                    std::uint32_t value) {
    values.reserve(capacity);
    populatePages(values.data(), count * sizeof(std::uint32_t));
    values.resize(count, value);
}

/// Variants of vertices. The first variant of a vertex has the attributes of its first corner; later variants are
/// copies for corners that differ.
class Variants {
  public:
    /// result.source_corners must hold the first corner of each vertex; copies are appended. Until all corners are
    /// done, result.source_vertices holds linked lists of the variants of each vertex.
    Variants(AttributeSpan attributes, SplitResult& result)
        : attributes_(attributes), corners_(result.source_corners), next_(result.source_vertices) {}

    /// Returns the new vertex for a corner that differs from the first corner of `vertex`: the earliest variant of
    /// `vertex` that equals the corner, or a new variant.
    std::uint32_t variantOf(std::uint32_t corner, std::uint32_t vertex) {
        if (next_.empty()) resizeAtOnce(next_, corners_.size(), corners_.capacity(), kNoVariant);
        std::uint32_t variant = vertex;
        for (std::uint32_t scanned = 1; scanned < kScannedVariants; ++scanned) {
            if (next_[variant] == kNoVariant) {
                const std::uint32_t added = append(corner);
                next_[variant] = added;
                return added;
            }
            variant = next_[variant];
            if (equalCorners(attributes_, corner, corners_[variant])) return variant;
        }
        findCells(corner, vertex);
        if (const std::uint32_t found = findIndexed(corner); found != kNoVariant) return found;
        const std::uint32_t added = append(corner);
        addToIndex(added);
        return added;
    }

  private:
    std::uint32_t append(std::uint32_t corner) {
        corners_.push_back(corner);
        next_.push_back(kNoVariant);
        return static_cast<std::uint32_t>(corners_.size() - 1);
    }

    // Finds the cells of a corner in the index of variants, a tree whose nodes are identified by hashes. The first
    // level is the old vertex with the bits of all exact attributes; then one level for each component of the other
    // attributes, which contains the cells of a line that is divided into cells as wide as the tolerance. A leaf is a
    // list of variants, linked by next_, that nearly always has one entry. A lookup follows the three adjacent cells on
    // each level, if they exist; the number of variants around a point is bounded, and therefore also the cost per
    // corner.

    [[gnu::cold]] void findCells(std::uint32_t corner, std::uint32_t vertex) {
        root_ = mixBits(vertex);
        cells_.clear();
        for (const CornerAttribute& attribute : attributes_) {
            const float* a = cornerValues(attribute, corner);
            for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
                if (attribute.tolerance != 0.0f) {
                    cells_.push_back(cellOf(a[k], attribute.tolerance));
                } else {
                    root_ = foldHash(root_, std::bit_cast<std::uint32_t>(a[k]));
                }
            }
        }
    }

    [[gnu::cold]] void addToIndex(std::uint32_t variant) {
        std::uint64_t node = root_;
        for (const std::uint64_t cell : cells_) {
            node = foldHash(node, cell);
            nodes_.indexOf(node);
        }
        const std::uint32_t leaf = nodes_.indexOf(node);
        firsts_.resize(nodes_.size(), kNoVariant);
        next_[variant] = std::exchange(firsts_[leaf], variant);
    }

    [[gnu::cold]] std::uint32_t findIndexed(std::uint32_t corner) {
        reached_.clear();
        reached_.push_back(root_);
        for (const std::uint64_t cell : cells_) {
            further_.clear();
            for (const std::uint64_t node : reached_) {
                for (const std::uint64_t key : {cell - 1, cell, cell + 1}) {
                    const std::uint64_t next = foldHash(node, key);
                    if (nodes_.find(next) != kNoVariant) further_.push_back(next);
                }
            }
            reached_.swap(further_);
        }
        std::uint32_t earliest = kNoVariant;
        for (const std::uint64_t node : reached_) {
            const std::uint32_t leaf = nodes_.find(node);
            for (std::uint32_t v = leaf == kNoVariant ? leaf : firsts_[leaf]; v != kNoVariant; v = next_[v]) {
                if (v < earliest && equalCorners(attributes_, corner, corners_[v])) earliest = v;
            }
        }
        return earliest;
    }

    AttributeSpan attributes_;
    std::vector<std::uint32_t>& corners_;  ///< corners of each variant
    /// Next variant of the vertex, for variants that are compared one by one; next variant in the leaf, for indexed
    /// variants.
    std::vector<std::uint32_t>& next_;
    UniqueIndex<std::uint64_t> nodes_;
    std::vector<std::uint32_t> firsts_;  ///< first variant in the list of each leaf node
    std::uint64_t root_ = 0;             ///< root for the corner being looked up
    std::vector<std::uint64_t> cells_, reached_, further_;
};

/// Writes the corners of a range that differ from the first corner of their vertex to `different`, and returns their
/// number. Also sets first corners (`firsts`, for all vertices). `Counts`: component counts of the attributes, in this
/// order, which are compared exactly; without Counts, attributes may have any tolerance.
template <std::uint32_t... Counts>
std::size_t listDifferent(AttributeSpan attributes, std::uint32_t corner, std::size_t count,
                          const std::uint32_t* vertices, std::uint32_t* firsts, std::uint32_t* different) {
    // local copies, which the compiler knows not to alias the arrays that are written
    std::array<CornerAttribute, sizeof...(Counts)> exact;
    std::copy_n(attributes.begin(), exact.size(), exact.begin());
    const auto at = [&](std::size_t i, std::uint32_t which) { return cornerValues(exact[i], which); };
    std::size_t different_count = 0;
    for (std::size_t k = 0; k < count; ++k) {
        static_assert(kNoCorner == 0xffffffffu);  // greater than the number of any corner
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

decltype(&listDifferent<>) listerFor([[maybe_unused]] AttributeSpan attributes) {
#ifndef TSPACE_SMALL
    const auto isExact = [&](std::size_t i, std::uint32_t components) {
        return attributes[i].component_count == components && attributes[i].tolerance == 0.0f;
    };
    if (attributes.size() == 1 && isExact(0, 4)) return listDifferent<4>;
    if (attributes.size() == 1 && isExact(0, 3)) return listDifferent<3>;
    if (attributes.size() == 2 && isExact(0, 3) && isExact(1, 4)) return listDifferent<3, 4>;
#endif
    return listDifferent<>;
}

SplitResult split(const IndexView& view, std::size_t vertex_count, std::size_t corner_count, AttributeSpan attributes) {
    SplitResult result;
    resizeAtOnce(result.indices, corner_count, corner_count, 0);
    // Reserves capacity for some copies, which takes no memory until it is used.
    resizeAtOnce(result.source_corners, vertex_count, vertex_count + vertex_count / 8, kNoCorner);
    Variants variants(attributes, result);
    const auto list = listerFor(attributes);
    for (std::size_t begin = 0; begin < corner_count; begin += kCompared) {
        const std::size_t count = std::min(kCompared, corner_count - begin);
        std::array<std::uint32_t, kCompared> different, buffer;
        const std::uint32_t* const vertices = readIndices(view, begin, count, buffer.data());
        std::copy_n(vertices, count, result.indices.data() + begin);
        const std::size_t different_count = list(attributes, static_cast<std::uint32_t>(begin), count, vertices,
                                                 result.source_corners.data(), different.data());
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
            return makeError(ErrorCode::invalidOption, i, "attribute %zu has %u components, but must have 1 to 16", i,
                             attribute.component_count);
        }
        if (!(attribute.tolerance >= 0.0f) || !std::isfinite(attribute.tolerance)) {
            return makeError(ErrorCode::invalidOption, i,
                             "the tolerance of attribute %zu must be finite and not negative", i);
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
    if (vertex_count > kMaxCorners || corner_count > kMaxCorners)
        return {ErrorCode::tooLarge, "the mesh has more than 2^31-1 vertices or corners"};
    Parallel parallel(execution, corner_count);
    if (Error e = checkIndices(indices, vertex_count, &parallel); e.code != ErrorCode::ok) return e;
    if (indices.type == IndexType::none && corner_count > vertex_count) {
        return makeError(ErrorCode::indexOutOfRange, vertex_count,
                         "corner %zu has no vertex: the mesh has %zu vertices and no indices", vertex_count,
                         vertex_count);
    }
    if (indices.type != IndexType::none && corner_count != indices.count) {
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "the number of corners is %zu, but the number of indices is %zu", corner_count, indices.count);
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
