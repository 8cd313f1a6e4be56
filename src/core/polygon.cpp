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
    if (a < b) return -1;
    if (a > b) return 1;
    if (a == b) [[likely]]
        return 0;
    const std::uint32_t x = sortable(a), y = sortable(b);
    return x < y ? -1 : (x > y ? 1 : 0);
}

/// A NaN or infinite length is longer than any other.
double orderedLength(double length2) {
    return length2 < std::numeric_limits<double>::infinity() ? length2 : HUGE_VAL;
}

/// What lies to the left of the line a -> b, or no further from it than a distance to the right of it.
class LeftSide {
  public:
    LeftSide(PlanePoint a, PlanePoint b)
        : a_(a), x_(b.x - a.x), y_(b.y - a.y), longest_(std::abs(x_) + std::abs(y_)) {}

    /// Whether c is more than `slack` away from the line, to its left.
    [[nodiscard]] bool isFar(PlanePoint c, double slack) const {
        const double distance = across(c);
        // The length between the two points is not above `longest_`: a square root tells only what is near.
        if (!(distance > 0)) return false;
        return distance > 2 * (slack * longest_) || distance - slack * length() > 0;
    }
    /// Whether c is to the left, or not more than `slack` away.
    [[nodiscard]] bool isNear(PlanePoint c, double slack) const {
        const double distance = across(c);
        if (distance >= 0) return true;
        return !(distance < -2 * (slack * longest_)) && distance + slack * length() >= 0;
    }

  private:
    /// Times the length.
    [[nodiscard]] double across(PlanePoint c) const { return x_ * (c.y - a_.y) - y_ * (c.x - a_.x); }
    [[nodiscard]] double length() const { return std::sqrt(x_ * x_ + y_ * y_); }

    PlanePoint a_;
    double x_, y_, longest_;
};

/// Vertices are numbered in canonical order here.
class Cutter {
  public:
    Cutter(std::uint32_t count, bool has_uvs, PolygonScratch& scratch)
        : count_(count), is_tested_(count <= kMaxTestedCorners), scratch_(scratch) {
        if (scratch.positions.size() < count) grow(count);
        positions_ = scratch.positions.data();
        uvs_ = has_uvs ? scratch.uvs.data() : nullptr;
        points_ = scratch.points.data();
        previous_ = scratch.previous.data();
        next_ = scratch.next.data();
        reflex_ = scratch.reflex.data();
        is_reflex_ = scratch.is_reflex.data();
    }

    void cut(const Vec3* positions, const Vec2* uvs, bool few, std::uint32_t* triangles) {
        start_ = canonicalStart(positions, uvs);
        std::rotate_copy(positions, positions + start_, positions + count_, positions_);
        if (uvs != nullptr) std::rotate_copy(uvs, uvs + start_, uvs + count_, uvs_);
        projectToPlane();
        link();
        if (few) {
            cutBy<SearchAll>(triangles);
        } else {
            cutBy<Heap>(triangles);
        }
    }

  private:
    void grow(std::uint32_t count) {
        scratch_.positions.resize(count);
        scratch_.uvs.resize(count);
        scratch_.points.resize(count);
        scratch_.previous.resize(count);
        scratch_.next.resize(count);
        scratch_.reflex.resize(count);
        scratch_.is_reflex.resize(count);
    }

    [[nodiscard]] std::uint32_t original(std::uint32_t v) const {
        return v < count_ - start_ ? v + start_ : v - (count_ - start_);
    }

    /// Orders two vertices by position and then UV.
    static int compareVertices(const Vec3* positions, const Vec2* uvs, std::uint32_t a, std::uint32_t b) {
        if (int c = compare(positions[a].x, positions[b].x); c != 0) return c;
        if (int c = compare(positions[a].y, positions[b].y); c != 0) return c;
        if (int c = compare(positions[a].z, positions[b].z); c != 0 || uvs == nullptr) return c;
        if (int c = compare(uvs[a].x, uvs[b].x); c != 0) return c;
        return compare(uvs[a].y, uvs[b].y);
    }

    /// Where the least rotation of the sequence of vertices starts. Every sum below runs from there, so that
    /// its rounding does not depend on the caller's first vertex.
    [[nodiscard]] std::uint32_t canonicalStart(const Vec3* positions, const Vec2* uvs) const {
        std::uint32_t least = 0;
        bool is_alone = true;
        for (std::uint32_t v = 1; v < count_; ++v) {
            const int c = compareVertices(positions, uvs, v, least);
            if (c < 0) least = v;
            if (c <= 0) is_alone = c < 0;
        }
        return is_alone ? least : startOfLeastRotation(positions, uvs);
    }

    /// Two candidates that leap over each other, O(n).
    [[nodiscard]] std::uint32_t startOfLeastRotation(const Vec3* positions, const Vec2* uvs) const {
        std::uint64_t i = 0;
        std::uint64_t j = 1;
        std::uint64_t same = 0;
        while (i < count_ && j < count_ && same < count_) {
            const int c = compareVertices(positions, uvs, static_cast<std::uint32_t>((i + same) % count_),
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
        const DVec3 origin = toDouble(positions_[0]);
        DVec3 sum;
        DVec3 last = toDouble(positions_[count_ - 1]) - origin;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 here = toDouble(positions_[v]) - origin;
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
        const DVec3 origin = toDouble(positions_[0]);
        double extent = 0;
        for (std::uint32_t v = 0; v < count_; ++v) {
            const DVec3 p = toDouble(positions_[v]) - origin;
            points_[v] = {dot(x_axis, p), dot(y_axis, p)};
            extent = std::max({extent, std::abs(points_[v].x), std::abs(points_[v].y)});
        }
        on_line_ = kOnLine * extent;
    }

    void link() {
        for (std::uint32_t v = 0; v < count_; ++v) {
            previous_[v] = v == 0 ? count_ - 1 : v - 1;
            next_[v] = v + 1 == count_ ? 0 : v + 1;
            is_reflex_[v] = 0;
        }
        for (std::uint32_t v = 0; v < count_; ++v) noteReflex(v);
    }

    [[nodiscard]] bool isConvex(std::uint32_t v) const {
        return LeftSide(points_[next_[v]], points_[previous_[v]]).isFar(points_[v], on_line_);
    }

    void noteReflex(std::uint32_t v) {
        const bool reflex = !isConvex(v);
        if (is_tested_ && reflex && is_reflex_[v] == 0) reflex_[reflex_count_++] = v;
        if (!reflex && is_reflex_[v] != 0) dropReflex(v);
        is_reflex_[v] = reflex ? 1 : 0;
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
        const std::uint32_t before = previous_[v], after = next_[v];
        return std::any_of(reflex_, reflex_ + reflex_count_, [=, this](std::uint32_t r) {
            return r != before && r != after &&
                   isInEar(points_[r], points_[before], points_[v], points_[after]);
        });
    }

    [[nodiscard]] bool isInEar(PlanePoint p, PlanePoint a, PlanePoint b, PlanePoint c) const {
        const auto isAt = [](PlanePoint q, PlanePoint r) { return q.x == r.x && q.y == r.y; };
        return LeftSide(a, b).isNear(p, on_line_) && LeftSide(b, c).isNear(p, on_line_) &&
               LeftSide(c, a).isNear(p, on_line_) && !isAt(p, a) && !isAt(p, b) && !isAt(p, c);
    }

    /// Sets all but the version. `is_reflex_` must be there for v.
    void setEar(PolygonEar& ear, std::uint32_t v) const {
        const std::uint32_t a = previous_[v], b = next_[v];
        const DVec3 diagonal = toDouble(positions_[b]) - toDouble(positions_[a]);
        double length2_uv = 0;
        if (uvs_ != nullptr) {
            const double du = double{uvs_[b].x} - double{uvs_[a].x};
            const double dv = double{uvs_[b].y} - double{uvs_[a].y};
            length2_uv = du * du + dv * dv;
        }
        const bool blocked = is_reflex_[v] != 0 || isOccupied(v);
        const auto length2_space = std::bit_cast<std::uint64_t>(orderedLength(dot(diagonal, diagonal)));
        ear.order = length2_space | std::uint64_t{blocked} << 63;
        ear.length2_uv = orderedLength(length2_uv);
        ear.ends[0] = a;
        ear.ends[1] = b;
        ear.vertex = v;
    }

    /// Whether a is cut off before b.
    [[nodiscard]] bool isBefore(const PolygonEar& a, const PolygonEar& b) const {
        return a.order != b.order ? a.order < b.order : isBeforeOfSameOrder(a, b);
    }

    [[nodiscard]] bool isBeforeOfSameOrder(const PolygonEar& a, const PolygonEar& b) const {
        if (a.length2_uv != b.length2_uv) return a.length2_uv < b.length2_uv;
        struct Ends {
            std::uint32_t lesser, greater;
        };
        const auto compareAt = [&](std::uint32_t v, std::uint32_t w) {
            return compareVertices(positions_, uvs_, v, w);
        };
        const auto endsOf = [&](const PolygonEar& ear) {
            const auto [v, w] = ear.ends;
            return compareAt(v, w) <= 0 ? Ends{v, w} : Ends{w, v};
        };
        const Ends of_a = endsOf(a), of_b = endsOf(b);
        if (int c = compareAt(of_a.lesser, of_b.lesser); c != 0) return c < 0;
        if (int c = compareAt(of_a.greater, of_b.greater); c != 0) return c < 0;
        return a.vertex < b.vertex;
    }

    /// The ears of all vertices that are left.
    class SearchAll {
      public:
        explicit SearchAll(Cutter& cutter) : cutter_(cutter) {
            auto& ears = cutter.scratch_.ears;
            if (ears.size() < cutter.count_) ears.resize(cutter.count_);
            ears_ = ears.data();
            for (std::uint32_t v = 0; v < cutter.count_; ++v) renew(v);
        }
        void renew(std::uint32_t v) { cutter_.setEar(ears_[v], v); }
        /// `v` is any that is left.
        std::uint32_t takeBest(std::uint32_t v) const {
            std::uint32_t best = v;
            for (std::uint32_t w = cutter_.next_[v]; w != v; w = cutter_.next_[w]) {
                if (cutter_.isBefore(ears_[w], ears_[best])) best = w;
            }
            return best;
        }

      private:
        Cutter& cutter_;
        PolygonEar* ears_;
    };

    /// The same in O(log n).
    class Heap {
        [[nodiscard]] auto laterThan() const {
            return [this](const PolygonEar& a, const PolygonEar& b) { return cutter_.isBefore(b, a); };
        }

      public:
        explicit Heap(Cutter& cutter)
            : cutter_(cutter), heap_(cutter.scratch_.ears), version_(cutter.scratch_.version) {
            version_.assign(cutter.count_, 0);
            heap_.assign(cutter.count_, {});
            for (std::uint32_t v = 0; v < cutter.count_; ++v) cutter.setEar(heap_[v], v);
            std::make_heap(heap_.begin(), heap_.end(), laterThan());
        }
        void renew(std::uint32_t v) {
            heap_.emplace_back().version = ++version_[v];
            cutter_.setEar(heap_.back(), v);
            std::push_heap(heap_.begin(), heap_.end(), laterThan());
        }
        std::uint32_t takeBest(std::uint32_t) {
            for (;;) {
                std::pop_heap(heap_.begin(), heap_.end(), laterThan());
                const PolygonEar best = heap_.back();
                heap_.pop_back();
                if (best.version != version_[best.vertex]) continue;
                ++version_[best.vertex];
                return best.vertex;
            }
        }

      private:
        Cutter& cutter_;
        std::vector<PolygonEar>& heap_;
        std::vector<std::uint32_t>& version_;
    };

    template <class Ears>
    void cutBy(std::uint32_t* triangles) {
        Ears ears(*this);
        std::uint32_t any_left = 0;
        for (std::uint32_t left = count_; left > 3; --left) {
            const std::uint32_t ear = ears.takeBest(any_left), before = previous_[ear], after = next_[ear];
            *triangles++ = original(before);
            *triangles++ = original(ear);
            *triangles++ = original(after);
            if (is_reflex_[ear] != 0) dropReflex(ear);
            next_[before] = after;
            previous_[after] = before;
            any_left = std::min(before, after);
            if (left == 4) break;
            noteReflex(before);
            noteReflex(after);
            ears.renew(before);
            ears.renew(after);
        }
        // Of the three vertices left, the first in canonical order.
        const std::uint32_t last = std::min({any_left, previous_[any_left], next_[any_left]});
        *triangles++ = original(previous_[last]);
        *triangles++ = original(last);
        *triangles++ = original(next_[last]);
    }

    std::uint32_t count_;
    bool is_tested_;  // ears are tested for emptiness
    PolygonScratch& scratch_;
    std::uint32_t start_ = 0;  // the caller's number of the first vertex
    double on_line_ = 0;
    std::uint32_t reflex_count_ = 0;
    // The lists of scratch_.
    Vec3* positions_;
    Vec2* uvs_;  // null: there are none
    PlanePoint* points_;
    std::uint32_t *previous_, *next_, *reflex_;
    std::uint8_t* is_reflex_;
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
                PolygonScratch& scratch, std::uint32_t few) {
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
    Cutter(count, uvs != nullptr, scratch).cut(positions, uvs, count <= few, triangles);
}

}  // namespace tspace
