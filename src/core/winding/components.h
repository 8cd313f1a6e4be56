// SPDX-License-Identifier: MIT
// Connected faces, bounding boxes, and components of a surface.
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

// Faces of a call that are connected by shared edges.

/// Faces of a call, and the points that their corners share.
struct Surface {
    const MeshView& mesh;
    const MeshFaces& faces;
    const Buffer<std::uint32_t>& points;  ///< point of each corner

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const { return points[corner]; }
    [[nodiscard]] DVec3 position(std::uint32_t corner) const { return toDouble(mesh.positions[mesh.indices[corner]]); }
    /// Returns twice the area times the normal for counter-clockwise winding.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        return areaVector(face, [](const Vec3&) {});
    }
    /// Returns the area vector, and calls see(position) for each corner.
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
/// Flag of a pair that is in conflict. Pairs of coincident faces do not have it, because their relative winding is
/// kept.
inline constexpr std::uint32_t kConflict = 0x80000000u;

/// Pairs of half-edges: for each corner c, the corner at the start of the half-edge that is paired with the half-edge
/// of c.
struct EdgePairs {
    /// Sure partners, combined with kConflict. kNoPartner: the half-edge is at a border, or its face is ignored or
    /// touches a point twice. c itself: the partner is in `doubtful`.
    Buffer<std::uint32_t> sure;
    /// Partners found by the angle about an edge of more than two faces, with kOdd if the number of faces is odd. Empty
    /// if there are no such edges.
    Buffer<std::uint32_t> doubtful;
};
inline constexpr std::uint32_t kOdd = 0x80000000u;
EdgePairs pairEdges(const Surface& surface, const Allocator* allocator);

// Bounding box tree for queries with rays and points, split at the median of the widest side.

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
    /// Builds the tree. `boxes` must not move during the lifetime of the tree.
    BoxTree(const Buffer<Box>& boxes, std::size_t count, const Allocator* allocator);

    /// Calls body(number) for each box such that accepts(box) is true for it and for the boxes of all its ancestors.
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
    /// Returns the range of the boxes below a node. Nodes are numbered from 1, level by level; each level halves the
    /// ranges of the previous one.
    [[nodiscard]] Range rangeOf(std::size_t node) const;

    const Buffer<Box>& boxes_;
    std::size_t count_;
    Buffer<std::uint32_t> order_;
    Buffer<Box> nodes_;
};

// Components of a surface. Their winding is made consistent by traversing pairs of faces; then the outside of each
// component is decided as a whole.

/// Component: a range of faces in the order in which they were reached, with sums over its faces.
struct Component {
    std::uint32_t begin = 0, end = 0;  ///< range of the faces in the order of reaching
    Box box = {};
    bool is_closed = true;
    std::uint64_t conflicts_before = 0, conflicts_after = 0;
    // Sums over the faces in their current winding, before the outside is decided:
    double area = 0;  ///< sum of areas; all areas in this struct are doubled
    double kept = 0;  ///< area of faces wound as in the input, minus the area of others
    /// Area of faces whose normals are on their front side, minus the area of those whose normals are on the back side.
    double facing = 0;
    double faced = 0;   ///< area of all faces that have normals
    double volume = 0;  ///< six times the volume
    std::uint32_t turned_count = 0;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

/// Input that all steps share.
struct WindingCall {
    const Surface& surface;
    const Call<WindingOptions>& options;
    const EdgePairs& pairs;
    StridedSpan<std::uint8_t> turned;
    Parallel& parallel;
    double outward = 1;  ///< normalFactor(convention)

    [[nodiscard]] const Allocator* allocator() const { return options.execution.allocator; }
    /// Returns the area vector for the current winding of the face.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        return (turned[face] != 0 ? -outward : outward) * surface.areaVector(face);
    }
};

struct FloodMemory {
    Buffer<std::uint32_t> order;
    Buffer<std::uint8_t> reached;    ///< one flag per face: 1 if it was reached
    Buffer<std::uint8_t> at_border;  ///< one flag per point: 1 if it is at a border; empty until needed

    FloodMemory(const Allocator* allocator, std::size_t face_count)
        : order(allocator, face_count), reached(allocator, face_count, 0) {}
};

/// Reaches the faces of a component from `first`, makes their winding consistent and writes them to order[begin...].
/// Reached faces are marked in `reached`. Doubtful pairs are used only for faces that sure pairs do not reach, first
/// those of an even number of faces. Doubtful pairs that contradict the others are ignored.
/// If an edge had four faces and two of them were removed by holes, the remaining two may not be neighbors. Such a pair
/// puts all faces reached over it on the wrong side, and contradicts the surrounding pairs. A component that has
/// borders and contradicts itself is therefore traversed again, first over pairs whose edge touches the border with at
/// most one end; the result with fewer conflicts is kept.
Component flood(const WindingCall& call, std::uint32_t first, std::uint32_t begin, FloodMemory& memory);

/// Computes the sums of a component.
void measure(const WindingCall& call, const Buffer<std::uint32_t>& order, Component& component);

/// Returns the mean winding number of the component about points of its own faces: 1/2 if it is nearly closed, -1/2 if
/// it is inside out; 0 if it has no inside.
double ownWindingNumber(const WindingCall& call, const Buffer<std::uint32_t>& order, const Component& component);

/// Finds closed components inside other ones: sets `inside` to 1 for an odd number of enclosing components.
void findNested(const WindingCall& call, const Buffer<std::uint32_t>& order, const Buffer<Component>& closed,
                std::size_t count, Buffer<std::uint8_t>& inside);

}  // namespace tspace::winding
