// SPDX-License-Identifier: MIT
// Components of a surface: wound alike by walking over pairs of faces, then decided as a whole.
#pragma once

#include <cstdint>

#include "core/base/call.h"
#include "core/base/parallel.h"
#include "core/winding/box_tree.h"
#include "core/winding/edge_pairs.h"
#include "tspace/winding.h"

namespace tspace::winding {

/// Faces in the order in which they were reached; those of a component lie together.
struct Component {
    std::uint32_t begin = 0, end = 0;  ///< in that order
    Box box = {};
    bool is_closed = true;
    std::uint64_t conflicts_before = 0, conflicts_after = 0;
    // Sums over its faces as they are wound now, before the component is decided:
    double area = 0;    ///< doubled, as all areas here
    double kept = 0;    ///< area of faces that are wound as in the input, minus that of others
    double facing = 0;  ///< area of faces whose normals lie on their side, minus that of those on the other
    double faced = 0;   ///< area of both
    double volume = 0;  ///< six times
    std::uint32_t turned_count = 0;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

/// What all steps look at.
struct WindingCall {
    const Surface& surface;
    const Call<WindingOptions>& options;
    const Buffer<std::uint32_t>& partners;
    StridedSpan<std::uint8_t> turned;
    Parallel& parallel;
    double outward = 1;  ///< normalFactor(convention)

    [[nodiscard]] const Allocator* allocator() const { return options.execution.allocator; }
    /// As the face is wound now.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        return (turned[face] != 0 ? -outward : outward) * surface.areaVector(face);
    }
};

/// Reaches the faces of a component from `first`, winds them alike and writes them to order[begin...]. Faces that were
/// reached are in `reached`.
Component flood(const WindingCall& call, std::uint32_t first, std::uint32_t begin, Buffer<std::uint32_t>& order,
                Buffer<std::uint8_t>& reached);

/// Sums of a component.
void measure(const WindingCall& call, const Buffer<std::uint32_t>& order, Component& component);

/// The mean winding number of the component about points of its own faces: 1/2 where it is nearly closed, and -1/2 where
/// it is inside out; 0 where no side is inside.
double ownWindingNumber(const WindingCall& call, const Buffer<std::uint32_t>& order, const Component& component);

/// Of closed components those that lie in another one: for an odd number of others around it `inside` becomes 1.
void findNested(const WindingCall& call, const Buffer<std::uint32_t>& order, const Buffer<Component>& closed,
                std::size_t count, Buffer<std::uint8_t>& inside);

}  // namespace tspace::winding
