// SPDX-License-Identifier: MIT
// Finding the variant that a corner belongs to.
#include "frames/variants.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/hash.h"

namespace tspace {

namespace {

/// A vertex's first variants are compared one by one; only later ones are worth an index.
constexpr std::uint32_t kScannedVariants = 8;

/// Cells are wider than the tolerance by more than the rounding of x / width, so that two values that are
/// equal within the tolerance never lie two cells apart.
constexpr double kCellMargin = 1.0 + 1.0 / (1 << 20);

/// Further than this many cells from 0, floats lie more than 100 tolerances apart: only equal values match.
constexpr double kMostCells = 4294967296.0;

/// The node that the index of later variants starts with.
constexpr std::uint32_t kRoot = 0;

/// Where a component lies on its line. A value far out, or not finite, has a key of its own that no cell
/// has.
struct Cell {
    std::uint64_t key;
    bool has_neighbors;
};

Cell cellOf(float value, float tolerance) {
    const double cells = double{value} / (double{tolerance} * kCellMargin);
    if (!(std::abs(cells) < kMostCells)) {
        return {0x7ff8000000000000u | std::bit_cast<std::uint32_t>(value), false};
    }
    const auto towards_zero = static_cast<std::int64_t>(cells);
    const std::int64_t floor = towards_zero - (static_cast<double>(towards_zero) > cells ? 1 : 0);
    return {static_cast<std::uint64_t>(floor), true};
}

}  // namespace

bool equalCorners(std::span<const CornerAttribute> attributes, std::uint32_t corner, std::uint32_t other) {
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

std::uint32_t NodeTable::find(std::uint32_t node, std::uint64_t key) const {
    return entries_.empty() ? kNone : entries_[slotOf(node, key)].value;
}

std::uint32_t& NodeTable::at(std::uint32_t node, std::uint64_t key) {
    if (2 * (used_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[slotOf(node, key)];
    if (entry.node == kNone) {
        entry.node = node;
        entry.key = key;
        ++used_;
    }
    return entry.value;
}

std::size_t NodeTable::slotOf(std::uint32_t node, std::uint64_t key) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = foldHash(mixBits(node), key) & mask;
    while (entries_[slot].node != kNone && (entries_[slot].node != node || entries_[slot].key != key)) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

void NodeTable::grow() {
    Buffer<Entry> old(allocator_, entries_.empty() ? 64 : 2 * entries_.size(), Entry{});
    std::swap(old, entries_);
    for (const Entry& entry : old) {
        if (entry.node != kNone) entries_[slotOf(entry.node, entry.key)] = entry;
    }
}

void Variants::prepare() {
    next_.reserve(corners_.capacity());
    askForPages(next_.data(), corners_.size() * sizeof(std::uint32_t));
    next_.assign(corners_.size(), NodeTable::kNone);
}

std::uint32_t Variants::variantOf(std::uint32_t corner, std::uint32_t vertex) {
    std::uint32_t variant = vertex;
    for (std::uint32_t scanned = 1; scanned < kScannedVariants; ++scanned) {
        if (next_[variant] == NodeTable::kNone) {
            const std::uint32_t added = append(corner);
            next_[variant] = added;
            return added;
        }
        variant = next_[variant];
        if (equalCorners(attributes_, corner, corners_[variant])) return variant;
    }
    if (const std::uint32_t found = findIndexed(corner, vertex); found != NodeTable::kNone) return found;
    const std::uint32_t added = append(corner);
    addToIndex(corner, vertex, added);
    return added;
}

std::uint32_t Variants::append(std::uint32_t corner) {
    corners_.push_back(corner);
    next_.push_back(NodeTable::kNone);
    return static_cast<std::uint32_t>(corners_.size() - 1);
}

std::uint64_t Variants::exactKey(std::uint32_t corner, std::uint32_t vertex) const {
    std::uint64_t hash = vertex;
    for (const CornerAttribute& attribute : attributes_) {
        if (attribute.tolerance != 0.0f) continue;
        const float* a = cornerValues(attribute, corner);
        for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
            hash = foldHash(hash, std::bit_cast<std::uint32_t>(a[k]));
        }
    }
    return hash;
}

/// body(component, tolerance) for each component of the tolerant attributes.
template <class Body>
void Variants::forEachTolerant(std::uint32_t corner, Body&& body) const {
    for (const CornerAttribute& attribute : attributes_) {
        if (attribute.tolerance == 0.0f) continue;
        const float* a = cornerValues(attribute, corner);
        for (std::uint32_t k = 0; k < attribute.component_count; ++k) body(a[k], attribute.tolerance);
    }
}

void Variants::addToIndex(std::uint32_t corner, std::uint32_t vertex, std::uint32_t variant) {
    // A value is the number of a node, or on the last level the variant that the leaf's list starts with.
    std::uint32_t* value = &edges_.at(kRoot, exactKey(corner, vertex));
    forEachTolerant(corner, [&](float component, float tolerance) {
        if (*value == NodeTable::kNone) *value = ++node_count_;
        const std::uint32_t node = *value;
        value = &edges_.at(node, cellOf(component, tolerance).key);
    });
    next_[variant] = *value;
    *value = variant;
}

std::uint32_t Variants::findIndexed(std::uint32_t corner, std::uint32_t vertex) {
    reached_.clear();
    if (const std::uint32_t node = edges_.find(kRoot, exactKey(corner, vertex)); node != NodeTable::kNone) {
        reached_.push_back(node);
    }
    forEachTolerant(corner, [&](float component, float tolerance) {
        further_.clear();
        for (const std::uint32_t node : reached_) follow(node, component, tolerance);
        reached_.swap(further_);
    });
    std::uint32_t earliest = NodeTable::kNone;
    for (std::uint32_t variant : reached_) {
        for (; variant != NodeTable::kNone; variant = next_[variant]) {
            if (variant < earliest && equalCorners(attributes_, corner, corners_[variant])) earliest = variant;
        }
    }
    return earliest;
}

void Variants::follow(std::uint32_t node, float component, float tolerance) {
    const auto visit = [&](std::uint64_t key) {
        if (const std::uint32_t value = edges_.find(node, key); value != NodeTable::kNone) further_.push_back(value);
    };
    const Cell cell = cellOf(component, tolerance);
    visit(cell.key);
    if (!cell.has_neighbors) return;
    visit(cell.key - 1);
    visit(cell.key + 1);
}

}  // namespace tspace
