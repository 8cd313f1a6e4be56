// SPDX-License-Identifier: MIT
// Implements the bounding box tree, the nesting of closed components, and mendWinding.
#include "core/winding/components.h"

#include <bit>
#include <cmath>

#include "core/base/border.h"
#include "core/base/mesh_loops.h"
#include "core/base/near_positions.h"
#include "core/base/weld.h"
#include "tspace/winding.h"

namespace tspace::winding {
namespace {

constexpr std::size_t kLeaf = 8;  // maximum number of boxes in a leaf

}  // namespace

BoxTree::BoxTree(const Buffer<Box>& boxes, std::size_t count, const Allocator* allocator)
    : boxes_(boxes), count_(count), order_(allocator, count),
      nodes_(allocator, 2 * std::bit_ceil(std::max<std::size_t>(1, (count + kLeaf - 1) / kLeaf)), Box{}) {
    for (std::size_t i = 0; i < count; ++i) order_[i] = static_cast<std::uint32_t>(i);
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
        const Range range = rangeOf(node);
        for (std::size_t i = range.begin; i < range.end; ++i) nodes_[node].add(boxes_[order_[i]]);
        if (2 * node >= nodes_.size()) continue;
        const Box& box = nodes_[node];
        int axis = 0;
        for (int k = 1; k < 3; ++k) {
            if (box.most[k] - box.least[k] > box.most[axis] - box.least[axis]) axis = k;
        }
        const auto middle = [&](std::uint32_t i) { return boxes_[i].least[axis] + boxes_[i].most[axis]; };
        std::nth_element(
            order_.data() + range.begin, order_.data() + (range.begin + range.end) / 2, order_.data() + range.end,
            [&](std::uint32_t a, std::uint32_t b) { return middle(a) != middle(b) ? middle(a) < middle(b) : a < b; });
    }
}

BoxTree::Range BoxTree::rangeOf(std::size_t node) const {
    Range range{0, count_};
    for (unsigned level = static_cast<unsigned>(std::bit_width(node)) - 1; level-- > 0;) {
        const std::size_t middle = (range.begin + range.end) / 2;
        if ((node >> level & 1) != 0) {
            range.begin = middle;
        } else {
            range.end = middle;
        }
    }
    return range;
}

// Finds closed components inside other components: casts rays from points of their faces, and counts the intersections
// with the faces of all other components.

namespace {

struct Ray {
    DVec3 from, direction;
    double inverse[3];

    Ray(const DVec3& f, const DVec3& d) : from(f), direction(d), inverse{1 / d.x, 1 / d.y, 1 / d.z} {}

    [[nodiscard]] bool meets(const Box& box) const {
        const double at[3] = {from.x, from.y, from.z};
        double near = 0, far = 1e300;
        for (int k = 0; k < 3; ++k) {
            const double a = (double{box.least[k]} - at[k]) * inverse[k],
                         b = (double{box.most[k]} - at[k]) * inverse[k];
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        // The margin compensates for rounding, which can make boxes slightly too small.
        return near <= far * (1 + 1e-12);
    }
    /// Returns whether the ray intersects a triangle. Based on: Moeller and Trumbore, 1997.
    [[nodiscard]] bool meets(const DVec3& a, const DVec3& b, const DVec3& c) const {
        const DVec3 ab = b - a, ac = c - a, across = cross(direction, ac);
        const double scale = dot(ab, across);
        if (scale == 0) return false;
        const DVec3 to = from - a;
        const double u = dot(to, across) / scale;
        if (u < 0 || u > 1) return false;
        const DVec3 turn = cross(to, ab);
        const double v = dot(direction, turn) / scale;
        return v >= 0 && u + v <= 1 && dot(ac, turn) / scale > 0;
    }
};

/// Returns the number of intersections of the ray with a face, which is divided into the triangles at its first corner.
unsigned crossings(const Surface& surface, std::uint32_t face, const Ray& ray) {
    const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
    unsigned count = 0;
    for (std::uint32_t c = first + 1; c + 1 < past; ++c)
        count += ray.meets(surface.position(first), surface.position(c), surface.position(c + 1)) ? 1U : 0U;
    return count;
}

/// Returns whether the box of any other component contains the box of component i.
bool isEnclosed(const BoxTree& boxes, const Buffer<Component>& closed, std::size_t i) {
    bool is_enclosed = false;
    boxes.visit([&](const Box& box) { return !is_enclosed && box.holds(closed[i].box); },
                [&](std::uint32_t other) { is_enclosed |= other != i; });
    return is_enclosed;
}

}  // namespace

void findNested(const WindingCall& call, const Buffer<std::uint32_t>& order, const Buffer<Component>& closed,
                std::size_t count, Buffer<std::uint8_t>& inside) {
    if (count < 2) return;
    const Surface& surface = call.surface;
    Buffer<std::uint32_t> enclosed(call.allocator(), count);
    std::size_t enclosed_count = 0;
    {
        Buffer<Box> boxes(call.allocator(), count);
        for (std::size_t i = 0; i < count; ++i) boxes[i] = closed[i].box;
        const BoxTree tree(boxes, count, call.allocator());
        for (std::size_t i = 0; i < count; ++i) {
            if (isEnclosed(tree, closed, i)) enclosed[enclosed_count++] = static_cast<std::uint32_t>(i);
        }
    }
    if (enclosed_count == 0) return;
    std::size_t face_count = 0;
    for (std::size_t i = 0; i < count; ++i) face_count += closed[i].size();
    Buffer<std::uint32_t> faces(call.allocator(), face_count), owners(call.allocator(), face_count);
    Buffer<Box> boxes(call.allocator(), face_count, Box{});
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::uint32_t k = closed[i].begin; k < closed[i].end; ++k, ++next) {
            faces[next] = order[k];
            owners[next] = static_cast<std::uint32_t>(i);
            for (std::uint32_t c = surface.faces.first(order[k]); c < surface.faces.past(order[k]); ++c)
                boxes[next].add(surface.mesh.positions[surface.mesh.indices[c]]);
        }
    }
    const BoxTree tree(boxes, face_count, call.allocator());
    // Directions of rays. They avoid axes and diagonal planes, so that few rays hit edges.
    constexpr DVec3 kDirections[] = {{0.8129, 0.3571, 0.4603}, {-0.2887, 0.9013, -0.3233}, {0.1733, -0.4441, 0.8791}};
    constexpr std::uint32_t kRays = 16;  // number of rays in each direction
    constexpr double kClear = 0.7;
    call.parallel.forRanges(enclosed_count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            const Component& own = closed[enclosed[h]];
            int odd = 0, even = 0;
            for (std::uint32_t p = 0; p < kRays; ++p) {
                const std::uint64_t place = (2 * std::uint64_t{p} + 1) * own.size() / (2 * kRays);
                const std::uint32_t face = order[own.begin + static_cast<std::uint32_t>(place)];
                // The ray starts off-center: from centroids, rays often hit edges.
                const std::uint32_t c = surface.faces.first(face);
                const DVec3 from =
                    0.46 * surface.position(c) + 0.33 * surface.position(c + 1) + 0.21 * surface.position(c + 2);
                for (const DVec3& direction : kDirections) {
                    const Ray ray(from, direction);
                    unsigned through = 0;
                    tree.visit([&](const Box& box) { return ray.meets(box); },
                               [&](std::uint32_t number) {
                                   if (owners[number] != enclosed[h]) through += crossings(surface, faces[number], ray);
                               });
                    ++(through % 2 != 0 ? odd : even);
                }
            }
            inside[enclosed[h]] = odd - even > kClear * (odd + even) ? 1 : 0;
        }
    });
}

}  // namespace tspace::winding

namespace tspace {

// mendWinding: validation, and the decision for each component.

namespace {

using winding::Component;

/// Minimum winding number of a component that has an inside: between 0, the mean without an inside, and 1/2 for a
/// nearly closed component.
constexpr double kLeastWindingNumber = 0.15;
// minimum number of faces of a component whose outside is decided: a tetrahedron has four
constexpr std::uint32_t kFewest = 4;

class WindingRepair {
  public:
    WindingRepair(const winding::WindingCall& call, WindingReport& report)
        : call_(call), report_(report), memory_(call.allocator(), call.surface.mesh.faceCount()),
          closed_(call.allocator(), call.surface.mesh.faceCount() / kFewest + 1) {}

    void run() {
        const MeshFaces& faces = call_.surface.faces;
        const auto count = static_cast<std::uint32_t>(call_.surface.mesh.faceCount());
        std::uint32_t done = 0;
        for (std::uint32_t face = 0; face < count; ++face) {
            if (memory_.reached[face] != 0 || !faces.isUsed(face)) continue;
            Component component = flood(call_, face, done, memory_);
            done = component.end;
            decide(component);
        }
        decideClosed();
    }

  private:
    void decide(Component& component) {
        ++report_.component_count;
        report_.conflict_count_before += component.conflicts_before;
        if (component.size() < kFewest) return decideSmall(component);
        if (component.conflicts_after != 0 && component.conflicts_after >= component.conflicts_before) {
            for (std::uint32_t i = component.begin; i < component.end; ++i) call_.turned[memory_.order[i]] = 0;
            component.conflicts_after = component.conflicts_before;
            // Contradictions do not prove that a component is one-sided: in an open body with holes, an edge may have
            // had four faces, and the two that are left are not neighbors. The winding number then decides.
            const double number = component.is_closed ? 0 : ownWindingNumber(call_, memory_.order, component);
            return finish(component, number < -kLeastWindingNumber, report_.one_sided_count);
        }
        measure(call_, memory_.order, component);
        if (normalsAgree(component)) {
            finish(component, component.facing < 0, report_.by_normals_count);
        } else if (component.is_closed && hasVolume(component)) {
            // Nesting can be decided only when all components are known.
            closed_[closed_count_++] = component;
        } else {
            decideOpen(component);
        }
    }

    /// Returns whether at least half of the area has normals, and four fifths of that area have them on the same side.
    static bool normalsAgree(const Component& component) {
        return component.faced > 0.5 * component.area && std::fabs(component.facing) > 0.6 * component.faced;
    }

    /// Decides small components, such as leaves and cards, whose outside only normals can indicate.
    void decideSmall(Component& component) {
        if (component.conflicts_after != 0) return keepWinding(component, report_.small_count);
        measure(call_, memory_.order, component);
        if (!normalsAgree(component)) return keepWinding(component, report_.small_count);
        finish(component, component.facing < 0, report_.by_normals_count);
    }

    /// Keeps the winding of a component: flips none of its faces.
    void keepWinding(const Component& component, std::uint64_t& counter) {
        for (std::uint32_t i = component.begin; i < component.end; ++i) call_.turned[memory_.order[i]] = 0;
        ++counter;
        report_.conflict_count_after += component.conflicts_before;
    }

    /// Counts a component, and flips all of its faces if `is_inside_out` is true.
    void finish(const Component& component, bool is_inside_out, std::uint64_t& counter) {
        std::uint32_t turned = component.turned_count;
        if (is_inside_out) {
            turned = component.size() - turned;
            for (std::uint32_t i = component.begin; i < component.end; ++i) call_.turned[memory_.order[i]] ^= 1;
        }
        ++counter;
        report_.turned_count += turned;
        report_.turned_component_count += turned > component.size() - turned ? 1U : 0U;
        report_.conflict_count_after += component.conflicts_after;
    }

    /// Returns whether a closed component encloses a volume, which a two-sided sheet does not. The volume of a cube is
    /// 1/15 of its area to the power of 3/2; for a box of 1 x 1 x 0.0001 it is still 1/30,000.
    static bool hasVolume(const Component& component) {
        const double area = 0.5 * component.area, volume = component.volume / 6;
        return std::fabs(volume) > 1e-7 * area * std::sqrt(area);
    }

    void decideOpen(const Component& component) {
        const double number = ownWindingNumber(call_, memory_.order, component);
        if (std::fabs(number) > kLeastWindingNumber) {
            finish(component, number < 0, report_.by_winding_number_count);
        } else {
            finish(component, component.kept < 0, report_.by_majority_count);
        }
    }

    /// Decides closed components. A cavity has the opposite winding, but a body inside another body does not. Therefore
    /// the predominant winding of the input is kept, unless it is unclear.
    void decideClosed() {
        constexpr double kClear = 0.2;
        Buffer<std::uint8_t> inside(call_.allocator(), closed_count_, 0);
        findNested(call_, memory_.order, closed_, closed_count_, inside);
        for (std::size_t i = 0; i < closed_count_; ++i) {
            const Component& component = closed_[i];
            const bool is_negative = component.volume < 0;
            if (inside[i] == 0) {
                finish(component, is_negative, report_.by_volume_count);
            } else if (std::fabs(component.kept) > kClear * component.area) {
                finish(component, component.kept < 0, report_.by_nesting_count);
            } else {
                finish(component, !is_negative, report_.by_nesting_count);
            }
        }
    }

    const winding::WindingCall& call_;
    WindingReport& report_;
    winding::FloodMemory memory_;
    Buffer<Component> closed_;
    std::size_t closed_count_ = 0;
};

Buffer<std::uint32_t> pointsOfCorners(const MeshView& mesh, const Call<WindingOptions>& options, Parallel& parallel) {
    const Allocator* const allocator = options.execution.allocator;
    const Buffer<std::uint32_t> roots =
        options.weld_positions ? weldPositions(mesh, allocator, parallel) : Buffer<std::uint32_t>();
    Buffer<std::uint32_t> points(allocator, mesh.cornerCount());
    withIndices(mesh.indices, [&](auto vertexOf) {
        parallel.forRanges(points.size(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) points[c] = roots.empty() ? vertexOf(c) : roots[vertexOf(c)];
        });
    });
    return points;
}

Result<WindingReport> checkAndRepair(const MeshView& given, const Call<WindingOptions>& options,
                                     StridedSpan<std::uint8_t> turned) {
    // Amount of work: about four times the time of averaging normals.
    Parallel parallel(options.execution, 4 * given.cornerCount());
    if (Error e = checkMesh(given, &parallel); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(turned, given.faceCount(), "turned"); e.code != ErrorCode::ok) return e;
    if (Error e = checkWeldDistance(options.weld_distance); e.code != ErrorCode::ok) return e;
    const Allocator* const allocator = options.execution.allocator;
    const NearMesh near(given, options.weld_positions ? options.weld_distance : 0, allocator, parallel);
    const MeshView& mesh = near.view();
    for (std::size_t face = 0; face < turned.count; ++face) turned[face] = 0;
    const MeshFaces faces(mesh, allocator);
    WindingReport report{.face_count = faces.usedCount()};
    if (report.face_count == 0) return report;
    const Buffer<std::uint32_t> corner_points = pointsOfCorners(mesh, options, parallel);
    const winding::Surface surface{mesh, faces, corner_points};
    const winding::EdgePairs pairs = winding::pairEdges(surface, allocator);
    WindingRepair({surface, options, pairs, turned, parallel, normalFactor(options.convention)}, report).run();
    return report;
}

}  // namespace

Result<WindingReport> mendWinding(const MeshView& mesh, const WindingOptions& options, StridedSpan<std::uint8_t> turned,
                                  const Execution& execution) {
    return atBorder([&] { return checkAndRepair(mesh, {options, execution}, turned); });
}

}  // namespace tspace
