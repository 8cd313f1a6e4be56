// SPDX-License-Identifier: MIT
// The variants of vertices: a vertex itself with its first corner, and the copies that later corners got.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/memory.h"
#include "core/unique_index.h"
#include "tspace/split.h"

namespace tspace {

inline const float* cornerValues(const CornerAttribute& attribute, std::uint32_t corner) {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(attribute.data) +
                                          corner * attribute.stride_bytes);
}

/// The rule of CornerAttribute::tolerance, for all attributes together.
[[gnu::noinline]] inline bool equalCorners(std::span<const CornerAttribute> attributes, std::uint32_t corner,
                                           std::uint32_t other) {
    for (const CornerAttribute& attribute : attributes) {
        const float* a = cornerValues(attribute, corner);
        const float* b = cornerValues(attribute, other);
        if (std::memcmp(a, b, attribute.component_count * sizeof(float)) == 0) continue;
        if (attribute.tolerance == 0.0f) return false;
        for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
            if (std::bit_cast<std::uint32_t>(a[k]) == std::bit_cast<std::uint32_t>(b[k])) continue;
            if (!(std::abs(double{a[k]} - double{b[k]}) <= double{attribute.tolerance})) return false;
        }
    }
    return true;
}

/// A vertex's first variants are compared one by one; only later ones are worth an index.
inline constexpr std::uint32_t kScannedVariants = 8;

/// Cells are wider than the tolerance by more than the rounding of x / width, so that two values that are
/// equal within the tolerance never lie two cells apart.
inline constexpr double kCellMargin = 1.0 + 1.0 / (1 << 20);

inline constexpr std::uint32_t kNoVariant = 0xffffffffu;  ///< and no number of a node

/// Further than this many cells from 0, floats lie more than 100 tolerances apart: only equal values match.
inline constexpr double kMostCells = 4294967296.0;

/// Where a component lies on its line; what is equal to it lies there or in a cell beside it.
inline std::uint64_t cellOf(float value, float tolerance) {
    const double cells = double{value} / (double{tolerance} * kCellMargin);
    if (!(std::abs(cells) < kMostCells)) return 0x7ff8000000000000u | std::bit_cast<std::uint32_t>(value);
    const auto towards_zero = static_cast<std::int64_t>(cells);
    return static_cast<std::uint64_t>(towards_zero - (static_cast<double>(towards_zero) > cells ? 1 : 0));
}

[[gnu::noinline]] inline void resizeAtOnce(std::vector<std::uint32_t>& values, std::size_t count, std::size_t capacity,
                                           std::uint32_t value) {
    values.reserve(capacity);
    askForPages(values.data(), count * sizeof(std::uint32_t));
    values.resize(count, value);
}

class Variants {
  public:
    /// `result` needs a first corner in source_corners for each vertex that is asked for. It gets the copies; its
    /// source_vertices serve as links between variants and are to be written when all corners are done.
    Variants(std::span<const CornerAttribute> attributes, SplitResult& result)
        : attributes_(attributes), corners_(result.source_corners), next_(result.source_vertices) {}

    /// The new vertex for a corner of `vertex` that differs from its first corner: its earliest variant that equals
    /// the corner, made if there is none.
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

    // The index of later variants is a tree of which each node is known by a hash. The first level is the old vertex with
    // the bits of all exact attributes; then comes one level for each component of the others, by its cell on a line cut
    // into cells as wide as the tolerance. A leaf is a list, linked by next_, of variants that nearly always has one entry. A
    // look-up follows the three neighbouring cells on each level, as far as there are any; the number of variants that can lie
    // around one point is bounded, so the cost per corner is too.

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

    std::span<const CornerAttribute> attributes_;
    std::vector<std::uint32_t>& corners_;  ///< of each variant
    /// The vertex's next variant among the scanned ones; the leaf's next one among the indexed ones.
    std::vector<std::uint32_t>& next_;
    UniqueIndex<std::uint64_t> nodes_;
    std::vector<std::uint32_t> firsts_;  ///< of each node, if it is a leaf, the variant that its list starts with
    std::uint64_t root_ = 0;             ///< of the corner that is looked up
    std::vector<std::uint64_t> cells_, reached_, further_;
};

}  // namespace tspace
