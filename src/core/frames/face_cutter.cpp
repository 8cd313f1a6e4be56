// SPDX-License-Identifier: MIT
// Triangulation of a polygon by ear clipping, shortest diagonal first.
// Based on: Meisters, "Polygons have ears", 1975 (ears); Newell's normal as in Sutherland, Sproull & Schumacker, 1974;
// the quad rule is from MikkTSpace.
#include "core/frames/face_cutter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/base/build_parts.h"
#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "tspace/mesh.h"

namespace tspace {
namespace {

/// Above this many corners ears are not tested for emptiness, which would take quadratic time.
constexpr std::uint32_t kMaxTestedCorners = 1024;

constexpr std::uint64_t kRemoved = ~std::uint64_t{0};  // greater than the order of any remaining vertex

/// Tolerance, as a fraction of the polygon's extent, within which a point counts as on a line. Coordinates in the plane
/// have a rounding error of about 1e-15 of the extent; the original floats are a million times coarser than this
/// tolerance.
constexpr double kOnLine = 1e-12;

/// Orders two corners by position and then UV. NaNs are last.
[[gnu::noinline]] int compare(const PolygonVertex& v, const PolygonVertex& w) {
    for (std::size_t k = 0; k < 5; ++k) {
        const float a = v.values[k], b = w.values[k];
        if (a < b || (std::isnan(b) && !std::isnan(a))) return -1;
        if (b < a || (std::isnan(a) && !std::isnan(b))) return 1;
    }
    return 0;
}

/// Returns the squared length, or a value longer than any other for NaN and infinity.
double orderedLength(double length2) { return length2 < std::numeric_limits<double>::infinity() ? length2 : HUGE_VAL; }

struct Line {
    Line(PlanePoint from, PlanePoint to, double slack)
        : a(from), x(to.x - from.x), y(to.y - from.y), margin(slack * std::sqrt(x * x + y * y)) {}

    /// Returns the distance of c from the line, times the line's length; positive to its left. Within the margin, c
    /// counts as on the line.
    [[nodiscard]] double across(PlanePoint c) const { return x * (c.y - a.y) - y * (c.x - a.x); }

    PlanePoint a;
    double x, y, margin;
};

class Cutter {
  public:
    /// The scratch memory must contain the vertices in canonical order, with their values, corners and positions.
    explicit Cutter(PolygonScratch& scratch)
        : count_(static_cast<std::uint32_t>(scratch.vertices.size())), vertices_(scratch.vertices.data()) {
        scratch.reflex.resize(count_);
        scratch.tree.resize(std::size_t{2} * count_);
        reflex_ = scratch.reflex.data();
        tree_ = scratch.tree.data();
    }

    /// Returns the start of the lexicographically smallest rotation of the corners, with two candidates, in O(n).
    static std::uint32_t canonicalStart(std::span<const PolygonVertex> vertices) {
        const std::size_t count = vertices.size();
        std::size_t i = 0, j = 1, same = 0;
        while (i < count && j < count && same < count) {
            const int c = compare(vertices[(i + same) % count], vertices[(j + same) % count]);
            if (c == 0) {
                ++same;
                continue;
            }
            (c > 0 ? i : j) += same + 1;
            if (i == j) ++j;
            same = 0;
        }
        return static_cast<std::uint32_t>(std::min(i, j));
    }

    void cut(std::uint32_t* triangles) {
        projectToPlane();
        for (std::uint32_t v = 0; v < count_; ++v) {
            vertices_[v].previous = v == 0 ? count_ - 1 : v - 1;
            vertices_[v].next = v + 1 == count_ ? 0 : v + 1;
        }
        for (std::uint32_t v = 0; v < count_; ++v) noteReflex(v);
        startTournament();
        const auto writeEar = [&](std::uint32_t v) {
            for (const std::uint32_t w : {vertices_[v].previous, v, vertices_[v].next})
                *triangles++ = vertices_[w].corner;
        };
        std::uint32_t any_left = 0;
        for (std::uint32_t left = count_; left > 3; --left) {
            const std::uint32_t ear = tree_[1], before = vertices_[ear].previous, after = vertices_[ear].next;
            writeEar(ear);
            if (vertices_[ear].is_reflex) dropReflex(ear);
            vertices_[before].next = after;
            vertices_[after].previous = before;
            any_left = std::min(before, after);
            if (left == 4) break;
            noteReflex(before);
            noteReflex(after);
            renew(ear, kRemoved);
            renew(before, orderOf(before));
            renew(after, orderOf(after));
        }
        // Three vertices are left. Their triangle starts with the first of them in canonical order.
        writeEar(std::min({any_left, vertices_[any_left].previous, vertices_[any_left].next}));
    }

  private:
    /// Returns Newell's unit normal; zero or not finite if the polygon has no plane.
    [[nodiscard]] DVec3 unitNormal() const {
        const DVec3 origin = vertices_[0].position;
        DVec3 sum;
        DVec3 last = vertices_[count_ - 1].position - origin;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 here = vertices_[v].position - origin;
            sum = sum + cross(last, here);
            last = here;
        }
        const double size = length(sum);
        return size > 0 ? (1 / size) * sum : DVec3{};
    }

    /// Computes coordinates in the plane of the normal, in which the polygon is counter-clockwise. Without a normal
    /// every coordinate is zero or NaN, and there are no ears.
    void projectToPlane() {
        const DVec3 n = unitNormal();
        const auto [x_axis, y_axis] = dot(n, n) > 0 ? planeAxes(n) : PlaneAxes{};
        const DVec3 origin = vertices_[0].position;
        double extent = 0;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 p = vertices_[v].position - origin;
            vertices_[v].point = {dot(x_axis, p), dot(y_axis, p)};
            extent = std::max({extent, std::abs(vertices_[v].point.x), std::abs(vertices_[v].point.y)});
        }
        on_line_ = kOnLine * extent;
    }

    void noteReflex(std::uint32_t v) {
        const PolygonVertex &before = vertices_[vertices_[v].previous], &after = vertices_[vertices_[v].next];
        const Line diagonal(after.point, before.point, on_line_);
        const bool reflex = !(diagonal.across(vertices_[v].point) > diagonal.margin);
        if (isTested() && reflex && !vertices_[v].is_reflex) reflex_[reflex_count_++] = v;
        if (!reflex && vertices_[v].is_reflex) dropReflex(v);
        vertices_[v].is_reflex = reflex;
    }

    void dropReflex(std::uint32_t v) {
        if (!isTested()) return;
        --reflex_count_;
        *std::find(reflex_, reflex_ + reflex_count_, v) = reflex_[reflex_count_];
    }

    /// Returns whether any vertex is in or on the ear at v. Testing reflex vertices suffices in a simple polygon.
    /// Vertices coincident with the ear's corners (hole bridges) are ignored.
    [[nodiscard]] bool isOccupied(std::uint32_t v) const {
        if (reflex_count_ == 0) return false;
        const std::uint32_t before = vertices_[v].previous, after = vertices_[v].next;
        const PlanePoint a = vertices_[before].point, b = vertices_[v].point, c = vertices_[after].point;
        const Line ab(a, b, on_line_), bc(b, c, on_line_), ca(c, a, on_line_);
        return std::any_of(reflex_, reflex_ + reflex_count_, [&](std::uint32_t r) {
            if (r == before || r == after) return false;
            const PlanePoint p = vertices_[r].point;
            const auto isInside = [p](const Line& side) {
                return side.across(p) >= -side.margin && (p.x != side.a.x || p.y != side.a.y);
            };
            return isInside(ab) && isInside(bc) && isInside(ca);
        });
    }

    /// Returns the squared UV length of the diagonal that cuts off a vertex.
    [[nodiscard]] double lengthInUv(std::uint32_t v) const {
        const float *from = vertices_[vertices_[v].previous].values, *to = vertices_[vertices_[v].next].values;
        const double du = double{to[3]} - double{from[3]}, dv = double{to[4]} - double{from[4]};
        return orderedLength(du * du + dv * dv);
    }

    [[nodiscard]] bool isBefore(std::uint32_t v, std::uint32_t w) const {
        if (vertices_[v].order != vertices_[w].order) return vertices_[v].order < vertices_[w].order;
        return vertices_[v].order == kRemoved ? v < w : isBeforeOfSameOrder(v, w);
    }

    [[nodiscard, gnu::noinline]] bool isBeforeOfSameOrder(std::uint32_t v, std::uint32_t w) const {
        const double uv_v = lengthInUv(v), uv_w = lengthInUv(w);
        if (uv_v != uv_w) return uv_v < uv_w;
        const auto endsOf = [&](std::uint32_t ear) {
            const PolygonVertex &a = vertices_[vertices_[ear].previous], &b = vertices_[vertices_[ear].next];
            return compare(a, b) <= 0 ? std::pair(&a, &b) : std::pair(&b, &a);
        };
        const auto [lesser_v, greater_v] = endsOf(v);
        const auto [lesser_w, greater_w] = endsOf(w);
        if (int c = compare(*lesser_v, *lesser_w); c != 0) return c < 0;
        if (int c = compare(*greater_v, *greater_w); c != 0) return c < 0;
        return v < w;
    }

    // Tournament tree: leaf count_ + v is vertex v, and an inner node is the vertex of its two children that is cut off
    // first. Node 1 is therefore the next vertex to cut off.

    /// Returns the sort key of a vertex: the squared length of its diagonal in space, as the bits of a double, which
    /// sort like the lengths. The highest bit marks vertices that are not ears, which are cut only if no ear is left.
    [[nodiscard]] std::uint64_t orderOf(std::uint32_t v) const {
        const DVec3 diagonal = vertices_[vertices_[v].next].position - vertices_[vertices_[v].previous].position;
        const bool is_blocked = vertices_[v].is_reflex || isOccupied(v);
        return std::bit_cast<std::uint64_t>(orderedLength(dot(diagonal, diagonal))) | std::uint64_t{is_blocked} << 63;
    }

    void startTournament() {
        for (std::uint32_t v = 0; v < count_; ++v) {
            vertices_[v].order = orderOf(v);
            tree_[count_ + v] = v;
        }
        for (std::uint32_t node = count_ - 1; node > 0; --node) play(node);
    }
    void play(std::uint32_t node) {
        const std::uint32_t v = tree_[2 * node], w = tree_[2 * node + 1];
        tree_[node] = isBefore(v, w) ? v : w;
    }
    void renew(std::uint32_t v, std::uint64_t order) {
        vertices_[v].order = order;
        for (std::uint32_t node = (count_ + v) / 2; node > 0; node /= 2) play(node);
    }

    /// Returns whether ears are tested for emptiness.
    [[nodiscard]] bool isTested() const { return count_ <= kMaxTestedCorners; }

    std::uint32_t count_, reflex_count_ = 0;
    double on_line_ = 0;  // maximum distance of points that count as on a line
    PolygonVertex* vertices_;
    std::uint32_t *reflex_, *tree_;
};

}  // namespace

void FaceCutter::cutOther(std::size_t first, std::uint32_t size, std::uint32_t* corners) {
    if (size == 3 || kIsMinimal) {
        for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(first + k);
        return;
    }
    scratch_.vertices.resize(size);
    const auto gather = [&](std::uint32_t start) {
        for (std::uint32_t v = 0; v < size; ++v) {
            const std::size_t corner = first + (v < size - start ? v + start : v + start - size);
            const std::uint32_t vertex = mesh_.indices[corner];
            const Vec3& p = mesh_.positions[vertex];
            const Vec2 uv = mesh_.uvs.empty() ? Vec2{} : mesh_.uvs[vertex];
            scratch_.vertices[v] = {.values = {p.x, p.y, p.z, uv.x, uv.y},
                                    .corner = static_cast<std::uint32_t>(corner),
                                    .position = toDouble(p)};
        }
    };
    gather(0);
    // The polygon starts with its canonical first corner, so that the rounding of sums does not depend on the caller's
    // first corner.
    gather(Cutter::canonicalStart(scratch_.vertices));
    Cutter(scratch_).cut(corners);
}

}  // namespace tspace
