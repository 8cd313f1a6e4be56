// SPDX-License-Identifier: MIT
// Cuts one polygon into triangles by clipping ears, the one with the shortest diagonal first.
// Based on: Meisters, "Polygons have ears", 1975 (ears); Newell's normal as in Sutherland, Sproull &
// Schumacker, 1974; the quad rule is MikkTSpace's.
#include "core/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/basis.h"
#include "core/vec_math.h"

namespace tspace {

namespace {

/// Above this many corners ears are not tested for emptiness, which would take quadratic time.
constexpr std::uint32_t kMaxTestedCorners = 1024;

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
    const std::uint32_t x = sortable(a);
    const std::uint32_t y = sortable(b);
    return x < y ? -1 : (x > y ? 1 : 0);
}

/// A NaN or infinite length is longer than any other.
double orderedLength(double length2) {
    return length2 < std::numeric_limits<double>::infinity() ? length2 : HUGE_VAL;
}

class Cutter {
  public:
    Cutter(const Vec3* positions, const Vec2* uvs, std::uint32_t count, PolygonScratch& scratch)
        : positions_(positions), uvs_(uvs), count_(count), scratch_(scratch) {}

    void cut(std::uint32_t* triangles) {
        start_ = canonicalStart();
        projectToPlane();
        link();
        std::uint32_t left = count_;
        for (; left > 3; --left) {
            const std::uint32_t ear = takeBest();
            const std::uint32_t before = scratch_.previous[ear];
            const std::uint32_t after = scratch_.next[ear];
            *triangles++ = original(before);
            *triangles++ = original(ear);
            *triangles++ = original(after);
            remove(ear, before, after);
        }
        const std::uint32_t last = lowestLeft();
        *triangles++ = original(scratch_.previous[last]);
        *triangles++ = original(last);
        *triangles++ = original(scratch_.next[last]);
    }

  private:
    struct Point {
        double x, y;
    };

    [[nodiscard]] std::uint32_t original(std::uint32_t canonical) const {
        return canonical < count_ - start_ ? canonical + start_ : canonical - (count_ - start_);
    }
    [[nodiscard]] const Vec3& position(std::uint32_t v) const { return positions_[original(v)]; }
    [[nodiscard]] Point point(std::uint32_t v) const {
        return {scratch_.plane[2 * std::size_t{v}], scratch_.plane[2 * std::size_t{v} + 1]};
    }

    /// Orders two vertices, by their original numbers, by position and then UV.
    [[nodiscard]] int compareVertices(std::uint32_t a, std::uint32_t b) const {
        if (int c = compare(positions_[a].x, positions_[b].x); c != 0) return c;
        if (int c = compare(positions_[a].y, positions_[b].y); c != 0) return c;
        if (int c = compare(positions_[a].z, positions_[b].z); c != 0 || uvs_ == nullptr) return c;
        if (int c = compare(uvs_[a].x, uvs_[b].x); c != 0) return c;
        return compare(uvs_[a].y, uvs_[b].y);
    }

    /// The order of the heap, whose top is the vertex to cut off first.
    auto laterThan() const {
        return [this](const PolygonEar& a, const PolygonEar& b) { return compareEars(a, b) > 0; };
    }

    /// Where the least rotation of the sequence of vertices starts (two candidates that leap over each other,
    /// O(n)). Every sum below runs from there, so that its rounding does not depend on the caller's first
    /// vertex.
    [[nodiscard]] std::uint32_t canonicalStart() const {
        std::uint64_t i = 0;
        std::uint64_t j = 1;
        std::uint64_t same = 0;
        while (i < count_ && j < count_ && same < count_) {
            const int c = compareVertices(static_cast<std::uint32_t>((i + same) % count_),
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
        const DVec3 origin = toDouble(position(0));
        DVec3 sum;
        DVec3 last = toDouble(position(count_ - 1)) - origin;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 here = toDouble(position(v)) - origin;
            sum = sum + cross(last, here);
            last = here;
        }
        const double size = length(sum);
        return size > 0 ? (1 / size) * sum : DVec3{};
    }

    /// Coordinates in the plane of the normal, in which the polygon runs counter-clockwise. Without a normal
    /// every coordinate is a zero or a NaN, and nothing is an ear.
    void projectToPlane() {
        scratch_.plane.resize(2 * std::size_t{count_});
        const DVec3 n = unitNormal();
        const auto [x_axis, y_axis] = dot(n, n) > 0 ? planeAxes(n) : PlaneAxes{};
        const DVec3 origin = toDouble(position(0));
        double extent = 0;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 p = toDouble(position(v)) - origin;
            const double x = dot(x_axis, p);
            const double y = dot(y_axis, p);
            scratch_.plane[2 * std::size_t{v}] = x;
            scratch_.plane[2 * std::size_t{v} + 1] = y;
            extent = std::max({extent, std::abs(x), std::abs(y)});
        }
        on_line_ = kOnLine * extent;
    }

    void link() {
        scratch_.previous.resize(count_);
        scratch_.next.resize(count_);
        scratch_.version.assign(count_, 0);
        scratch_.is_reflex.assign(count_, 0);
        scratch_.reflex.clear();
        scratch_.heap.clear();
        for (std::uint32_t v = 0; v < count_; ++v) {
            scratch_.previous[v] = v == 0 ? count_ - 1 : v - 1;
            scratch_.next[v] = v + 1 == count_ ? 0 : v + 1;
        }
        for (std::uint32_t v = 0; v < count_; ++v) noteReflex(v);
        for (std::uint32_t v = 0; v < count_; ++v) scratch_.heap.push_back(candidate(v));
        std::make_heap(scratch_.heap.begin(), scratch_.heap.end(), laterThan());
    }

    /// How far c lies to the left of the line a -> b, less `slack`; times |b - a|.
    [[nodiscard]] static double leftOf(Point a, Point b, Point c, double slack) {
        const double abx = b.x - a.x;
        const double aby = b.y - a.y;
        return abx * (c.y - a.y) - aby * (c.x - a.x) - slack * std::sqrt(abx * abx + aby * aby);
    }

    [[nodiscard]] bool isConvex(std::uint32_t v) const {
        return leftOf(point(scratch_.next[v]), point(scratch_.previous[v]), point(v), on_line_) > 0;
    }

    void noteReflex(std::uint32_t v) {
        if (count_ > kMaxTestedCorners) return;
        const bool reflex = !isConvex(v);
        if (reflex && scratch_.is_reflex[v] == 0) scratch_.reflex.push_back(v);
        if (!reflex && scratch_.is_reflex[v] != 0) dropReflex(v);
        scratch_.is_reflex[v] = reflex ? 1 : 0;
    }

    void dropReflex(std::uint32_t v) {
        auto& list = scratch_.reflex;
        *std::find(list.begin(), list.end(), v) = list.back();
        list.pop_back();
    }

    /// True when a vertex lies in or on the triangle that cutting v off would make. In a simple polygon it is
    /// enough to look at those that are not convex. Vertices at the triangle's own points do not count
    /// (bridges to holes).
    [[nodiscard]] bool isOccupied(std::uint32_t v) const {
        const Point a = point(scratch_.previous[v]);
        const Point b = point(v);
        const Point c = point(scratch_.next[v]);
        const auto isAt = [](Point p, Point q) { return p.x == q.x && p.y == q.y; };
        return std::any_of(scratch_.reflex.begin(), scratch_.reflex.end(), [&](std::uint32_t r) {
            const Point p = point(r);
            return leftOf(a, b, p, -on_line_) >= 0 && leftOf(b, c, p, -on_line_) >= 0 &&
                   leftOf(c, a, p, -on_line_) >= 0 && !isAt(p, a) && !isAt(p, b) && !isAt(p, c);
        });
    }

    [[nodiscard]] PolygonEar candidate(std::uint32_t v) const {
        const std::uint32_t a = original(scratch_.previous[v]);
        const std::uint32_t b = original(scratch_.next[v]);
        const DVec3 diagonal = toDouble(positions_[b]) - toDouble(positions_[a]);
        double length2_uv = 0;
        if (uvs_ != nullptr) {
            const double du = double{uvs_[b].x} - double{uvs_[a].x};
            const double dv = double{uvs_[b].y} - double{uvs_[a].y};
            length2_uv = du * du + dv * dv;
        }
        const bool in_order = compareVertices(a, b) <= 0;
        return {.blocked = !isConvex(v) || isOccupied(v),
                .length2_space = orderedLength(dot(diagonal, diagonal)),
                .length2_uv = orderedLength(length2_uv),
                .ends = {in_order ? a : b, in_order ? b : a},
                .vertex = v,
                .version = scratch_.version[v]};
    }

    /// Negative when a is cut off before b.
    [[nodiscard]] int compareEars(const PolygonEar& a, const PolygonEar& b) const {
        if (a.blocked != b.blocked) return a.blocked ? 1 : -1;
        if (a.length2_space != b.length2_space) return a.length2_space < b.length2_space ? -1 : 1;
        if (a.length2_uv != b.length2_uv) return a.length2_uv < b.length2_uv ? -1 : 1;
        for (int k = 0; k < 2; ++k) {
            if (int c = compareVertices(a.ends[k], b.ends[k]); c != 0) return c;
        }
        return a.vertex < b.vertex ? -1 : (a.vertex > b.vertex ? 1 : 0);
    }

    std::uint32_t takeBest() {
        auto& heap = scratch_.heap;
        for (;;) {
            std::pop_heap(heap.begin(), heap.end(), laterThan());
            const PolygonEar best = heap.back();
            heap.pop_back();
            if (best.version == scratch_.version[best.vertex]) return best.vertex;
        }
    }

    void remove(std::uint32_t ear, std::uint32_t before, std::uint32_t after) {
        if (scratch_.is_reflex[ear] != 0) dropReflex(ear);
        ++scratch_.version[ear];
        scratch_.next[before] = after;
        scratch_.previous[after] = before;
        last_cut_neighbor_ = std::min(before, after);
        for (const std::uint32_t v : {before, after}) noteReflex(v);
        for (const std::uint32_t v : {before, after}) {
            ++scratch_.version[v];
            scratch_.heap.push_back(candidate(v));
            std::push_heap(scratch_.heap.begin(), scratch_.heap.end(), laterThan());
        }
    }

    /// Of the three vertices left, the first in canonical order.
    [[nodiscard]] std::uint32_t lowestLeft() const {
        const std::uint32_t v = last_cut_neighbor_;
        return std::min({v, scratch_.previous[v], scratch_.next[v]});
    }

    const Vec3* positions_;
    const Vec2* uvs_;
    std::uint32_t count_;
    PolygonScratch& scratch_;
    std::uint32_t start_ = 0;
    std::uint32_t last_cut_neighbor_ = 0;
    double on_line_ = 0;
};

}  // namespace

bool quadCutsAlong13(const Vec3 positions[4], const Vec2* uvs) {
    if (uvs != nullptr) {
        const Vec2 d02 = uvs[2] - uvs[0];
        const Vec2 d13 = uvs[3] - uvs[1];
        const float length2_02 = d02.x * d02.x + d02.y * d02.y;
        const float length2_13 = d13.x * d13.x + d13.y * d13.y;
        if (length2_02 < length2_13) return false;
        if (length2_13 < length2_02) return true;
    }
    const Vec3 d02 = positions[2] - positions[0];
    const Vec3 d13 = positions[3] - positions[1];
    return dot(d13, d13) < dot(d02, d02);
}

void cutPolygon(const Vec3* positions, const Vec2* uvs, std::uint32_t count, std::uint32_t* triangles,
                PolygonScratch& scratch) {
    if (count < 3) return;
    if (count == 3) {
        for (std::uint32_t k = 0; k < 3; ++k) triangles[k] = k;
        return;
    }
    if (count == 4) {
        constexpr std::uint32_t kAlong02[6] = {0, 1, 2, 0, 2, 3};
        constexpr std::uint32_t kAlong13[6] = {0, 1, 3, 1, 2, 3};
        std::copy_n(quadCutsAlong13(positions, uvs) ? kAlong13 : kAlong02, 6, triangles);
        return;
    }
    Cutter(positions, uvs, count, scratch).cut(triangles);
}

}  // namespace tspace
