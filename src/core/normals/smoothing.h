// SPDX-License-Identifier: MIT
// Which corners around a point share one normal.
#pragma once

#include <cstdint>
#include <span>

#include "core/normals/normals_call.h"

namespace tspace {

/// A triangle at hand; or, of another face, one of its corners with its neighbours, which has one entry.
struct LocalTriangle {
    std::uint32_t points[5];  ///< of the corners, and of the first two again. Named by their lowest vertices.
    std::uint32_t corner;     ///< of the mesh: the first one's number
    double weights[3];        ///< of the face's row
};

/// The corners at a point, ascending: entries, four times a triangle plus a corner of it.
struct PointCorners {
    std::uint32_t point, count;
    const std::uint32_t* entries;
    const LocalTriangle* triangles;

    [[nodiscard]] std::uint32_t triangle(std::uint32_t slot) const { return entries[slot] >> 2; }
    [[nodiscard]] const LocalTriangle& at(std::uint32_t slot) const { return triangles[entries[slot] >> 2]; }
    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return at(slot).corner + (entries[slot] & 3); }
    /// The points after and before it on the border of its face.
    [[nodiscard]] std::uint32_t next(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 2]; }
    [[nodiscard]] double weight(std::uint32_t slot) const { return at(slot).weights[entries[slot] & 3]; }
};

/// Which faces may be smoothed together: creases and smoothing groups.
struct SmoothingRule {
    explicit SmoothingRule(const NormalsCall& c);

    /// No crease: every pair of faces at a point may be connected.
    [[nodiscard]] bool anyAngle() const { return call.options.crease_angle_deg >= 180; }
    /// All corners at a point are one component.
    [[nodiscard]] bool connectsAll() const { return anyAngle() && groups.empty(); }

    const NormalsCall& call;
    double crease_rad, crease_cosine;  ///< with creases faces are connected over edges that turn by no more than this
    std::span<const std::uint32_t> groups;  ///< one per face, or empty
    bool groups_are_masks;
};

/// A corner around a point, by its place there, and the component that it is in.
struct Link {
    std::uint32_t key, slot;
};

/// Finds the components of the corners at a point: returns all of them, sorted by component, then by slot. `links` has
/// room for 2 * count entries, `parents` for count. O(n log n), also when all faces share one edge.
///
/// Below 180 degrees two faces are connected over a shared edge. Where more than two faces meet in an edge,
/// each is held against the next one of its smoothing group as they turn about it, which for flat faces
/// connects the same faces as holding each against each.
///
/// rows   of the triangles at hand, by the mesh, not a pose
const Link* findComponents(const SmoothingRule& rule, const FaceRow* rows, const PointCorners& at, Link* links,
                           std::uint32_t* parents);

/// All corners as one component.
const Link* oneComponent(std::uint32_t count, Link* links);

}  // namespace tspace
