// SPDX-License-Identifier: MIT
// Faces that go on into one another, boxes around them, and components of a surface.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/normals/normals_call.h"
#include "tspace/winding.h"

namespace tspace::winding {

// Finds faces that are connected by shared edges.

/// The faces of a call and the points that they share.
struct Surface {
    const MeshView& mesh;
    const MeshFaces& faces;
    const Buffer<std::uint32_t>& points;  ///< point of each corner

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const { return points[corner]; }
    [[nodiscard]] DVec3 position(std::uint32_t corner) const { return toDouble(mesh.positions[mesh.indices[corner]]); }
    /// Twice the area times the normal that a counter-clockwise winding gives.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        return areaVector(face, [](const Vec3&) {});
    }
    /// see(position): of each corner, on the way.
    template <class See>
    DVec3 areaVector(std::uint32_t face, const See& see) const {
        const std::uint32_t first = faces.first(face), past = faces.past(face);
        const auto at = [&](std::uint32_t corner) {
            const Vec3 p = mesh.positions[mesh.indices[corner]];
            see(p);
            return toDouble(p);
        };
        const DVec3 origin = at(first);
        DVec3 sum, before = at(first + 1) - origin;
        for (std::uint32_t c = first + 2; c < past; ++c) {
            const DVec3 here = at(c) - origin;
            sum = sum + cross(before, here);
            before = here;
        }
        return sum;
    }
};

inline constexpr std::uint32_t kNoPartner = 0xffffffffu;
/// Mark of a pair in conflict. A pair of coincident faces has none: neither is turned against the other.
inline constexpr std::uint32_t kAgainst = 0x80000000u;

/// For each corner c: the corner whose edge, from it to the next one of its face, is the other half of c's edge.
struct EdgePairs {
    /// With kAgainst; kNoPartner at borders, and for faces that are not used or touch a point twice. c itself: see `doubtful`.
    Buffer<std::uint32_t> sure;
    /// Partners that were found by turn about an edge of more than two faces, with kOdd where their number is odd. Empty where
    /// there are no such edges.
    Buffer<std::uint32_t> doubtful;
};
inline constexpr std::uint32_t kOdd = 0x80000000u;
EdgePairs pairEdges(const Surface& surface, const Allocator* allocator);

// A tree of boxes, halved at the median of the widest side: for rays and for points.

struct Box {
    float least[3] = {3e38f, 3e38f, 3e38f}, most[3] = {-3e38f, -3e38f, -3e38f};

    void add(const Vec3& p) {
        const float at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], at[k]);
            most[k] = std::max(most[k], at[k]);
        }
    }
    void add(const Box& b) {
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], b.least[k]);
            most[k] = std::max(most[k], b.most[k]);
        }
    }
    [[nodiscard]] bool holds(const Box& b) const {
        for (int k = 0; k < 3; ++k) {
            if (!(least[k] <= b.least[k] && b.most[k] <= most[k])) return false;
        }
        return true;
    }
};

class BoxTree {
  public:
    /// `boxes` stay where they are as long as the tree.
    BoxTree(const Buffer<Box>& boxes, std::size_t count, const Allocator* allocator);

    /// body(number) for the boxes that, as all nodes above them, are accepted by accepts(box).
    template <class Accepts, class Body>
    void visit(Accepts&& accepts, Body&& body) const {
        std::size_t stack[64], depth = 0;
        if (count_ != 0) stack[depth++] = 1;
        while (depth != 0) {
            const std::size_t node = stack[--depth];
            if (!accepts(nodes_[node])) continue;
            if (2 * node + 1 < nodes_.size()) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            const Range range = rangeOf(node);
            for (std::size_t i = range.begin; i < range.end; ++i) {
                if (accepts(boxes_[order_[i]])) body(order_[i]);
            }
        }
    }

  private:
    struct Range {
        std::size_t begin, end;
    };
    /// Nodes are numbered from 1, level by level; each level halves the ranges of the one above.
    [[nodiscard]] Range rangeOf(std::size_t node) const;

    const Buffer<Box>& boxes_;
    std::size_t count_;
    Buffer<std::uint32_t> order_;
    Buffer<Box> nodes_;
};

// Components of a surface: wound alike by walking over pairs of faces, then decided as a whole.

/// Faces in the order in which they were reached; those of a component lie together.
struct Component {
    std::uint32_t begin = 0, end = 0;  ///< range in that order
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

/// Input shared by all steps.
struct WindingCall {
    const Surface& surface;
    const Call<WindingOptions>& options;
    const EdgePairs& pairs;
    StridedSpan<std::uint8_t> turned;
    Parallel& parallel;
    double outward = 1;  ///< normalFactor(convention)

    [[nodiscard]] const Allocator* allocator() const { return options.execution.allocator; }
    /// Area vector with the current winding of the face.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        return (turned[face] != 0 ? -outward : outward) * surface.areaVector(face);
    }
};

struct FloodMemory {
    Buffer<std::uint32_t> order;
    Buffer<std::uint8_t> reached;    ///< whether a face was reached
    Buffer<std::uint8_t> at_border;  ///< whether a point is at the border; empty until needed

    FloodMemory(const Allocator* allocator, std::size_t face_count)
        : order(allocator, face_count), reached(allocator, face_count, 0) {}
};

/// Reaches the faces of a component from `first`, winds them alike and writes them to order[begin...]. Faces that were
/// reached are in `reached`. Over doubtful pairs it goes only to what sure pairs do not lead to: those of an even
/// number of faces first. Those that contradict the others are no pairs.
/// Where an edge had four faces and holes took two, the others may be no neighbours. Such a pair puts all that is reached
/// over it on the wrong side, and contradicts the pairs around. So a component that has borders and contradicts itself is
/// reached again, first over the pairs whose edge touches no border or with one end; the way with fewer conflicts stays.
Component flood(const WindingCall& call, std::uint32_t first, std::uint32_t begin, FloodMemory& memory);

/// Sums of a component.
void measure(const WindingCall& call, const Buffer<std::uint32_t>& order, Component& component);

/// The mean winding number of the component about points of its own faces: 1/2 where it is nearly closed, and -1/2 where
/// it is inside out; 0 where no side is inside.
double ownWindingNumber(const WindingCall& call, const Buffer<std::uint32_t>& order, const Component& component);

/// Finds closed components inside other ones: for an odd number of enclosing components `inside` becomes 1.
void findNested(const WindingCall& call, const Buffer<std::uint32_t>& order, const Buffer<Component>& closed,
                std::size_t count, Buffer<std::uint8_t>& inside);

}  // namespace tspace::winding
