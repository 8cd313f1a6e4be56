// SPDX-License-Identifier: MIT
// Duplicates vertices whose corners disagree.
#include "tspace/split.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/border.h"
#include "core/hash.h"

namespace tspace {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// A vertex's first variants are compared one by one; only later ones are worth an index.
constexpr std::uint32_t kScannedVariants = 8;

/// Cells are wider than the tolerance by more than the rounding of x / width, so that two values that are
/// equal within the tolerance never lie two cells apart.
constexpr double kCellMargin = 1.0 + 1.0 / (1 << 20);

/// Further than this many cells from 0, floats lie more than 100 tolerances apart: only equal values match.
constexpr double kMostCells = 4294967296.0;

/// An open-addressing table from (node, key) to a number.
class NodeTable {
  public:
    /// The slot's value; kNone when there is no such entry.
    [[nodiscard]] std::uint32_t find(std::uint32_t node, std::uint64_t key) const {
        return entries_.empty() ? kNone : entries_[slotOf(node, key)].value;
    }

    /// The entry's value, to be read and set; kNone when it was just made.
    std::uint32_t& at(std::uint32_t node, std::uint64_t key) {
        if (2 * (used_ + 1) > entries_.size()) grow();
        Entry& entry = entries_[slotOf(node, key)];
        if (entry.node == kNone) {
            entry.node = node;
            entry.key = key;
            ++used_;
        }
        return entry.value;
    }

  private:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t node = kNone;
        std::uint32_t value = kNone;
    };

    [[nodiscard]] std::size_t slotOf(std::uint32_t node, std::uint64_t key) const {
        const std::size_t mask = entries_.size() - 1;
        std::size_t slot = foldHash(mixBits(node), key) & mask;
        while (entries_[slot].node != kNone && (entries_[slot].node != node || entries_[slot].key != key)) {
            slot = (slot + 1) & mask;
        }
        return slot;
    }

    void grow() {
        std::vector<Entry> old(entries_.empty() ? 64 : 2 * entries_.size());
        old.swap(entries_);
        for (const Entry& entry : old) {
            if (entry.node != kNone) entries_[slotOf(entry.node, entry.key)] = entry;
        }
    }

    std::vector<Entry> entries_;
    std::size_t used_ = 0;
};

class Splitter {
  public:
    explicit Splitter(std::span<const CornerAttribute> attributes) : attributes_(attributes) {}

    SplitResult split(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count) {
        result_.indices.resize(corner_count);
        result_.source_corners.assign(vertex_count, kNoCorner);
        result_.source_vertices.resize(vertex_count);
        for (std::size_t v = 0; v < vertex_count; ++v)
            result_.source_vertices[v] = static_cast<std::uint32_t>(v);
        next_.assign(vertex_count, kNone);
        for (std::size_t c = 0; c < corner_count; ++c) {
            result_.indices[c] = variantOf(static_cast<std::uint32_t>(c), indices[c]);
        }
        return std::move(result_);
    }

  private:
    /// The new vertex for a corner of `vertex`: its earliest variant that equals the corner, made if there is
    /// none.
    std::uint32_t variantOf(std::uint32_t corner, std::uint32_t vertex) {
        if (result_.source_corners[vertex] == kNoCorner) {
            result_.source_corners[vertex] = corner;
            return vertex;
        }
        std::uint32_t variant = vertex;
        for (std::uint32_t scanned = 1;; ++scanned) {
            if (areEqual(corner, result_.source_corners[variant])) return variant;
            if (scanned == kScannedVariants) break;
            if (next_[variant] == kNone) {
                const std::uint32_t added = append(corner, vertex);
                next_[variant] = added;
                return added;
            }
            variant = next_[variant];
        }
        if (const std::uint32_t found = findIndexed(corner, vertex); found != kNone) return found;
        const std::uint32_t added = append(corner, vertex);
        addToIndex(corner, vertex, added);
        return added;
    }

    std::uint32_t append(std::uint32_t corner, std::uint32_t vertex) {
        const auto added = static_cast<std::uint32_t>(result_.source_vertices.size());
        result_.source_vertices.push_back(vertex);
        result_.source_corners.push_back(corner);
        next_.push_back(kNone);
        return added;
    }

    static const float* values(const CornerAttribute& attribute, std::uint32_t corner) {
        return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(attribute.data) +
                                              corner * attribute.stride_bytes);
    }

    [[nodiscard]] bool areEqual(std::uint32_t corner, std::uint32_t other) const {
        for (const CornerAttribute& attribute : attributes_) {
            const float* a = values(attribute, corner);
            const float* b = values(attribute, other);
            if (std::memcmp(a, b, attribute.component_count * sizeof(float)) == 0) continue;
            if (attribute.tolerance == 0.0f) return false;
            for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
                if (std::bit_cast<std::uint32_t>(a[k]) == std::bit_cast<std::uint32_t>(b[k])) continue;
                if (!(std::abs(double{a[k]} - double{b[k]}) <= double{attribute.tolerance})) return false;
            }
        }
        return true;
    }

    // The index of later variants is a tree whose edges live in one table. The first level is the old vertex
    // with the bits of all exact attributes; then comes one level for each component of the others, keyed by
    // its cell on a line cut into cells as wide as the tolerance. A leaf is a list, linked by next_, of
    // variants that nearly always has one entry. A look-up follows the three neighbouring cells on each
    // level, as far as there are any; the number of variants that can lie around one point is bounded, so the
    // cost per corner is too.

    static constexpr std::uint32_t kRoot = 0;

    [[nodiscard]] std::uint64_t exactKey(std::uint32_t corner, std::uint32_t vertex) const {
        std::uint64_t hash = vertex;
        for (const CornerAttribute& attribute : attributes_) {
            if (attribute.tolerance != 0.0f) continue;
            const float* a = values(attribute, corner);
            for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
                hash = foldHash(hash, std::bit_cast<std::uint32_t>(a[k]));
            }
        }
        return hash;
    }

    /// Where a component lies on its line. A value far out, or not finite, has a key of its own that no cell
    /// has.
    struct Cell {
        std::uint64_t key;
        bool has_neighbors;
    };

    static Cell cellOf(float value, float tolerance) {
        const double cells = double{value} / (double{tolerance} * kCellMargin);
        if (!(std::abs(cells) < kMostCells)) {
            return {0x7ff8000000000000u | std::bit_cast<std::uint32_t>(value), false};
        }
        const auto towards_zero = static_cast<std::int64_t>(cells);
        const std::int64_t floor = towards_zero - (static_cast<double>(towards_zero) > cells ? 1 : 0);
        return {static_cast<std::uint64_t>(floor), true};
    }

    /// body(component, tolerance) for each component of the tolerant attributes.
    template <class Body>
    void forEachTolerant(std::uint32_t corner, Body&& body) const {
        for (const CornerAttribute& attribute : attributes_) {
            if (attribute.tolerance == 0.0f) continue;
            const float* a = values(attribute, corner);
            for (std::uint32_t k = 0; k < attribute.component_count; ++k) body(a[k], attribute.tolerance);
        }
    }

    void addToIndex(std::uint32_t corner, std::uint32_t vertex, std::uint32_t variant) {
        // A value is the number of a node, or on the last level the variant that the leaf's list starts with.
        std::uint32_t* value = &edges_.at(kRoot, exactKey(corner, vertex));
        forEachTolerant(corner, [&](float component, float tolerance) {
            if (*value == kNone) *value = ++node_count_;
            const std::uint32_t node = *value;
            value = &edges_.at(node, cellOf(component, tolerance).key);
        });
        next_[variant] = *value;
        *value = variant;
    }

    [[nodiscard]] std::uint32_t findIndexed(std::uint32_t corner, std::uint32_t vertex) {
        reached_.clear();
        if (const std::uint32_t node = edges_.find(kRoot, exactKey(corner, vertex)); node != kNone) {
            reached_.push_back(node);
        }
        forEachTolerant(corner, [&](float component, float tolerance) {
            further_.clear();
            for (const std::uint32_t node : reached_) follow(node, component, tolerance);
            reached_.swap(further_);
        });
        std::uint32_t earliest = kNone;
        for (std::uint32_t variant : reached_) {
            for (; variant != kNone; variant = next_[variant]) {
                if (variant < earliest && areEqual(corner, result_.source_corners[variant]))
                    earliest = variant;
            }
        }
        return earliest;
    }

    void follow(std::uint32_t node, float component, float tolerance) {
        const auto visit = [&](std::uint64_t key) {
            if (const std::uint32_t value = edges_.find(node, key); value != kNone) further_.push_back(value);
        };
        const Cell cell = cellOf(component, tolerance);
        visit(cell.key);
        if (!cell.has_neighbors) return;
        visit(cell.key - 1);
        visit(cell.key + 1);
    }

    std::span<const CornerAttribute> attributes_;
    SplitResult result_;
    /// The vertex's next variant among the scanned ones; the leaf's next one among the indexed ones.
    std::vector<std::uint32_t> next_;
    NodeTable edges_;
    std::uint32_t node_count_ = kRoot;
    std::vector<std::uint32_t> reached_, further_;
};

Error checkAttributes(std::span<const CornerAttribute> attributes, std::size_t corner_count) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const CornerAttribute& attribute = attributes[i];
        const std::string name = "attribute " + std::to_string(i);
        if (attribute.component_count < 1 || attribute.component_count > 16) {
            return {ErrorCode::invalidOption,
                    name + " has " + std::to_string(attribute.component_count) + " components, not 1 to 16",
                    i};
        }
        if (!(attribute.tolerance >= 0.0f) || !std::isfinite(attribute.tolerance)) {
            return {ErrorCode::invalidOption, name + " has a tolerance that is negative or not finite", i};
        }
        Error e = checkSpan(attribute.data, corner_count, attribute.stride_bytes,
                            attribute.component_count * sizeof(float), kNoElement, name.c_str());
        if (e.code != ErrorCode::ok) return e;
    }
    return {ErrorCode::ok, {}};
}

Error check(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
            std::span<const CornerAttribute> attributes) {
    if (vertex_count > kMaxCorners || corner_count > kMaxCorners) {
        return {ErrorCode::tooLarge, "more than 2^31-1 vertices or corners"};
    }
    if (Error e = checkIndices(indices, vertex_count); e.code != ErrorCode::ok) return e;
    if (indices.type == IndexType::none && corner_count > vertex_count) {
        return {ErrorCode::indexOutOfRange,
                "corner " + std::to_string(vertex_count) + " has no vertex: there are " +
                    std::to_string(vertex_count) + " vertices and no indices",
                vertex_count};
    }
    if (indices.type != IndexType::none && corner_count != indices.count) {
        return {ErrorCode::countMismatch,
                std::to_string(corner_count) + " corners but " + std::to_string(indices.count) + " indices"};
    }
    return checkAttributes(attributes, corner_count);
}

}  // namespace

Result<SplitResult> splitVertices(const IndexView& indices, std::size_t vertex_count,
                                  std::size_t corner_count, std::span<const CornerAttribute> attributes) {
    return atBorder([&]() -> Result<SplitResult> {
        if (Error e = check(indices, vertex_count, corner_count, attributes); e.code != ErrorCode::ok)
            return e;
        return Splitter(attributes).split(indices, vertex_count, corner_count);
    });
}

}  // namespace tspace
