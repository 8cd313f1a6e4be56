// SPDX-License-Identifier: MIT
// Finding the variant that a corner belongs to.
#include "frames/variants.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/hash.h"
#include "core/memory.h"

namespace tspace {

namespace {

/// A vertex's first variants are compared one by one; only later ones are worth an index.
constexpr std::uint32_t kScannedVariants = 8;

/// Cells are wider than the tolerance by more than the rounding of x / width, so that two values that are
/// equal within the tolerance never lie two cells apart.
constexpr double kCellMargin = 1.0 + 1.0 / (1 << 20);

constexpr std::uint32_t kNoVariant = 0xffffffffu;  ///< and no number of a node

/// Further than this many cells from 0, floats lie more than 100 tolerances apart: only equal values match.
constexpr double kMostCells = 4294967296.0;

/// Where a component lies on its line; what is equal to it lies there or in a cell beside it.
std::uint64_t cellOf(float value, float tolerance) {
    const double cells = double{value} / (double{tolerance} * kCellMargin);
    if (!(std::abs(cells) < kMostCells)) return 0x7ff8000000000000u | std::bit_cast<std::uint32_t>(value);
    const auto towards_zero = static_cast<std::int64_t>(cells);
    return static_cast<std::uint64_t>(towards_zero - (static_cast<double>(towards_zero) > cells ? 1 : 0));
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

void Variants::prepare() {
    next_.reserve(corners_.capacity());
    askForPages(next_.data(), corners_.size() * sizeof(std::uint32_t));
    next_.assign(corners_.size(), kNoVariant);
}

std::uint32_t Variants::variantOf(std::uint32_t corner, std::uint32_t vertex) {
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

std::uint32_t Variants::append(std::uint32_t corner) {
    corners_.push_back(corner);
    next_.push_back(kNoVariant);
    return static_cast<std::uint32_t>(corners_.size() - 1);
}

void Variants::findCells(std::uint32_t corner, std::uint32_t vertex) {
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

void Variants::addToIndex(std::uint32_t variant) {
    std::uint64_t node = root_;
    for (const std::uint64_t cell : cells_) {
        node = foldHash(node, cell);
        nodes_.indexOf(node);
    }
    const std::uint32_t leaf = nodes_.indexOf(node);
    firsts_.resize(nodes_.size(), kNoVariant);
    next_[variant] = std::exchange(firsts_[leaf], variant);
}

std::uint32_t Variants::findIndexed(std::uint32_t corner) {
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

}  // namespace tspace
