// SPDX-License-Identifier: MIT
// Cuts one polygon into triangles by clipping ears, the one with the shortest diagonal first.
// Based on: Meisters, "Polygons have ears", 1975 (ears); Newell's normal as in Sutherland, Sproull &
// Schumacker, 1974; the quad rule is MikkTSpace's.
#include "core/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/unit.h"
#include "core/vec_math.h"

namespace tspace {

namespace {

/// Above this many corners ears are not tested for emptiness, which would take quadratic time.
constexpr std::uint32_t kMaxTestedCorners = 1024;

constexpr std::uint64_t kTaken = ~std::uint64_t{0};  // above the order of any vertex that is left

/// Points closer to a line than this part of the polygon's extent count as on it. Coordinates in the plane
/// carry rounding of about 1e-15 of the extent; floats, from which they come, are a million times coarser
/// than this.
constexpr double kOnLine = 1e-12;

/// Numbers that sort as the floats do: -0 with +0, every NaN last.
std::uint32_t sortable(float value) {
    if (std::isnan(value)) return 0xffffffffu;
    if (value == 0.0f) return 0x80000000u;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

int compare(float a, float b) {
    const std::uint32_t x = sortable(a), y = sortable(b);
    return x < y ? -1 : (x > y ? 1 : 0);
}

/// A NaN or infinite length is longer than any other.
double orderedLength(double length2) { return length2 < std::numeric_limits<double>::infinity() ? length2 : HUGE_VAL; }

/// What lies to the left of the line a -> b, but for points no further than `slack` from it.
class LeftSide {
  public:
    LeftSide(PlanePoint a, PlanePoint b, double slack)
        : a_(a), x_(b.x - a.x), y_(b.y - a.y), margin_(slack * std::sqrt(x_ * x_ + y_ * y_)) {}

    [[nodiscard]] bool has(PlanePoint c) const { return across(c) > margin_; }
    /// The same, with the points near the line.
    [[nodiscard]] bool hasOrTouches(PlanePoint c) const { return across(c) >= -margin_; }

  private:
    /// Distance of c from the line, times the length of a -> b; positive to its left.
    [[nodiscard]] double across(PlanePoint c) const { return x_ * (c.y - a_.y) - y_ * (c.x - a_.x); }

    PlanePoint a_;
    double x_, y_, margin_;
};

/// Vertices are numbered in canonical order here.
class Cutter {
  public:
    Cutter(const Vec3* positions, const Vec2* uvs, std::uint32_t count, PolygonScratch& scratch)
        : corner_positions_(positions),
          corner_uvs_(uvs),
          count_(count),
          is_tested_(count <= kMaxTestedCorners),
          start_(canonicalStart()) {
        if (scratch.vertices.size() < count) {
            scratch.vertices.resize(count);
            scratch.reflex.resize(count);
            scratch.tree.resize(std::size_t{2} * count);
        }
        vertices_ = scratch.vertices.data();
        reflex_ = scratch.reflex.data();
        tree_ = scratch.tree.data();
    }

    void cut(std::uint32_t* triangles) {
        for (std::uint32_t v = 0; v < count_; ++v) vertices_[v].position = toDouble(corner_positions_[original(v)]);
        projectToPlane();
        link();
        for (std::uint32_t v = 0; v < count_; ++v) noteReflex(v);
        startTournament();
        std::uint32_t any_left = 0;
        for (std::uint32_t left = count_; left > 3; --left) {
            const std::uint32_t ear = tree_[1], before = vertices_[ear].previous, after = vertices_[ear].next;
            *triangles++ = original(before);
            *triangles++ = original(ear);
            *triangles++ = original(after);
            if (vertices_[ear].is_reflex) dropReflex(ear);
            vertices_[before].next = after;
            vertices_[after].previous = before;
            any_left = std::min(before, after);
            if (left == 4) break;
            noteReflex(before);
            noteReflex(after);
            renew(ear, kTaken);
            renew(before, orderOf(before));
            renew(after, orderOf(after));
        }
        // Of the three vertices left, the first in canonical order.
        const std::uint32_t last = std::min({any_left, vertices_[any_left].previous, vertices_[any_left].next});
        *triangles++ = original(vertices_[last].previous);
        *triangles++ = original(last);
        *triangles++ = original(vertices_[last].next);
    }

  private:
    [[nodiscard]] std::uint32_t original(std::uint32_t v) const {
        return v < count_ - start_ ? v + start_ : v - (count_ - start_);
    }

    /// Orders two corners of the caller by position and then UV.
    [[nodiscard, gnu::noinline]] int compareCorners(std::uint32_t a, std::uint32_t b) const {
        const Vec3 &p = corner_positions_[a], &q = corner_positions_[b];
        if (int c = compare(p.x, q.x); c != 0) return c;
        if (int c = compare(p.y, q.y); c != 0) return c;
        if (int c = compare(p.z, q.z); c != 0 || corner_uvs_ == nullptr) return c;
        if (int c = compare(corner_uvs_[a].x, corner_uvs_[b].x); c != 0) return c;
        return compare(corner_uvs_[a].y, corner_uvs_[b].y);
    }

    /// Where the least rotation of the sequence of corners starts. Every sum below runs from there, so that
    /// its rounding does not depend on the caller's first corner.
    [[nodiscard]] std::uint32_t canonicalStart() const {
        const auto x = [this](std::uint32_t corner) { return corner_positions_[corner].x; };
        std::uint32_t least = 0, same = 0;
        for (std::uint32_t c = 1; c < count_; ++c) least = x(c) < x(least) ? c : least;
        for (std::uint32_t c = 0; c < count_; ++c) same += x(c) == x(least) ? 1 : 0;
        return same == 1 ? least : startOfLeastRotation();
    }

    /// Two candidates that leap over each other, O(n).
    [[nodiscard]] std::uint32_t startOfLeastRotation() const {
        std::uint64_t i = 0;
        std::uint64_t j = 1;
        std::uint64_t same = 0;
        while (i < count_ && j < count_ && same < count_) {
            const int c = compareCorners(static_cast<std::uint32_t>((i + same) % count_),
                                         static_cast<std::uint32_t>((j + same) % count_));
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

    /// Newell's normal, unit; zero or not finite when the polygon has no plane.
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

    /// Coordinates in the plane of the normal, in which the polygon runs counter-clockwise. Without a normal
    /// every coordinate is a zero or a NaN, and nothing is an ear.
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

    void link() {
        for (std::uint32_t v = 0; v < count_; ++v) {
            vertices_[v].previous = v - 1;
            vertices_[v].next = v + 1;
            vertices_[v].is_reflex = false;
        }
        vertices_[0].previous = count_ - 1;
        vertices_[count_ - 1].next = 0;
    }

    [[nodiscard]] bool isConvex(std::uint32_t v) const {
        const PlanePoint after = vertices_[vertices_[v].next].point, before = vertices_[vertices_[v].previous].point;
        return LeftSide(after, before, on_line_).has(vertices_[v].point);
    }

    void noteReflex(std::uint32_t v) {
        const bool reflex = !isConvex(v);
        if (is_tested_ && reflex && !vertices_[v].is_reflex) reflex_[reflex_count_++] = v;
        if (!reflex && vertices_[v].is_reflex) dropReflex(v);
        vertices_[v].is_reflex = reflex;
    }

    void dropReflex(std::uint32_t v) {
        if (!is_tested_) return;
        --reflex_count_;
        *std::find(reflex_, reflex_ + reflex_count_, v) = reflex_[reflex_count_];
    }

    /// True when a vertex lies in or on the triangle that cutting v off would make. In a simple polygon it is
    /// enough to look at those that are not convex. Vertices at the triangle's own points do not count
    /// (bridges to holes).
    [[nodiscard]] bool isOccupied(std::uint32_t v) const {
        if (reflex_count_ == 0) return false;
        const std::uint32_t before = vertices_[v].previous, after = vertices_[v].next;
        const PlanePoint a = vertices_[before].point, b = vertices_[v].point, c = vertices_[after].point;
        const LeftSide ab(a, b, on_line_), bc(b, c, on_line_), ca(c, a, on_line_);
        const auto isAt = [](PlanePoint p, PlanePoint q) { return p.x == q.x && p.y == q.y; };
        return std::any_of(reflex_, reflex_ + reflex_count_, [&](std::uint32_t r) {
            if (r == before || r == after) return false;
            const PlanePoint p = vertices_[r].point;
            return ab.hasOrTouches(p) && bc.hasOrTouches(p) && ca.hasOrTouches(p) && !isAt(p, a) && !isAt(p, b) &&
                   !isAt(p, c);
        });
    }

    /// Of the diagonal that cuts a vertex off, squared.
    [[nodiscard]] double lengthInUv(std::uint32_t v) const {
        if (corner_uvs_ == nullptr) return 0;
        const Vec2 from = corner_uvs_[original(vertices_[v].previous)], to = corner_uvs_[original(vertices_[v].next)];
        const double du = double{to.x} - double{from.x}, dv = double{to.y} - double{from.y};
        return orderedLength(du * du + dv * dv);
    }

    [[nodiscard]] bool isBefore(std::uint32_t v, std::uint32_t w) const {
        if (vertices_[v].order != vertices_[w].order) return vertices_[v].order < vertices_[w].order;
        return vertices_[v].order == kTaken ? v < w : isBeforeOfSameOrder(v, w);
    }

    [[nodiscard, gnu::noinline]] bool isBeforeOfSameOrder(std::uint32_t v, std::uint32_t w) const {
        const double uv_v = lengthInUv(v), uv_w = lengthInUv(w);
        if (uv_v != uv_w) return uv_v < uv_w;
        const auto endsOf = [&](std::uint32_t ear) {
            const std::uint32_t a = original(vertices_[ear].previous), b = original(vertices_[ear].next);
            return compareCorners(a, b) <= 0 ? std::pair(a, b) : std::pair(b, a);
        };
        const auto [lesser_v, greater_v] = endsOf(v);
        const auto [lesser_w, greater_w] = endsOf(w);
        if (int c = compareCorners(lesser_v, lesser_w); c != 0) return c < 0;
        if (int c = compareCorners(greater_v, greater_w); c != 0) return c < 0;
        return v < w;
    }

    // A tournament: leaf count_ + v is vertex v, the node above two vertices is the one of them that is cut off before the
    // other, node 1 the first of all.

    /// When a vertex is cut off: by the squared length of the diagonal in space, as the bits of a double, which sort as
    /// lengths do. The highest bit: no ear, cut only when no ear is left.
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

    const Vec3* corner_positions_;  // in the caller's order, and so
    const Vec2* corner_uvs_;        // these; null: there are none
    std::uint32_t count_;
    bool is_tested_;       // ears are tested for emptiness
    std::uint32_t start_;  // the caller's number of the first vertex
    double on_line_ = 0;   // from there on a point is not on a line
    std::uint32_t reflex_count_ = 0;
    // The lists of scratch_.
    PolygonVertex* vertices_;
    std::uint32_t *reflex_, *tree_;
};

}  // namespace

void FaceCutter::cutOther(std::size_t first, std::uint32_t size, std::uint32_t* corners) {
    if (size == 3) {
        for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(first + k);
        return;
    }
#ifndef TSPACE_MIKKTSPACE_ONLY  // which skips n-gons
    positions_.clear();
    uvs_.clear();
    for (std::size_t c = first; c < first + size; ++c) {
        const std::uint32_t vertex = mesh_.indices[c];
        positions_.push_back(mesh_.positions[vertex]);
        if (!mesh_.uvs.empty()) uvs_.push_back(mesh_.uvs[vertex]);
    }
    Cutter(positions_.data(), uvs_.empty() ? nullptr : uvs_.data(), size, scratch_).cut(corners);
    for (std::size_t i = 0; i < 3 * (std::size_t{size} - 2); ++i) corners[i] += static_cast<std::uint32_t>(first);
#endif
}

}  // namespace tspace
