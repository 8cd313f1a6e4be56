// SPDX-License-Identifier: MIT
// Components of the faces around a point, by union-find over smooth edges.
#include "normals/smoothing.h"

#include <algorithm>
#include <tuple>

#include "core/angle.h"

namespace tspace {

namespace {

constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};

// Positions are floats: an edge of 90 degrees by intent is up to some 1e-7 rad more by its numbers.
constexpr double kCreaseSlackRad = 1e-6;

/// Where a normal stands on its turn about an edge: monotonic in the angle, in [0, 4), without trigonometry.
class Turn {
  public:
    explicit Turn(const DVec3& edge) {
        const double x = std::fabs(edge.x), y = std::fabs(edge.y), z = std::fabs(edge.z);
        DVec3 least{0, 0, 1};
        if (x <= y && x <= z)
            least = {1, 0, 0};
        else if (y <= z)
            least = {0, 1, 0};
        right_ = cross(edge, least);
        up_ = cross((1 / std::max(length(edge), 1e-300)) * edge, right_);
    }
    [[nodiscard]] double of(const DVec3& normal) const {
        const double x = dot(normal, right_), y = dot(normal, up_);
        const double sum = std::fabs(x) + std::fabs(y);
        if (sum == 0) return 0;
        const double along = x / sum;
        return y < 0 ? 3 + along : 1 - along;
    }

  private:
    DVec3 right_, up_;
};

class PointComponents {
  public:
    PointComponents(const MeshView& mesh, const FaceTable& faces, const PointTable& points, const SmoothingRule& rule,
                    std::uint32_t point, Link* links, std::uint32_t* parents)
        : mesh_(mesh),
          faces_(faces),
          points_(points),
          rule_(rule),
          point_(point),
          begin_(points.begins[point]),
          end_(points.begins[point + 1]),
          links_(links),
          parents_(parents) {}

    void find() {
        for (std::uint32_t slot = begin_; slot < end_; ++slot) parents_[slot] = slot;
        if (rule_.any_angle)
            joinByGroup();
        else
            joinOverEdges();
        for (std::uint32_t slot = begin_; slot < end_; ++slot) links_[slot - begin_] = {root(slot), slot};
        sortLinks(links_, links_ + (end_ - begin_));
    }

  private:
    /// Corners that follow one another on the same side of a smooth edge, closed into a ring.
    struct Ring {
        std::uint32_t first = kNoSlot, last = kNoSlot;
    };

    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return points_.corners[slot]; }
    [[nodiscard]] std::uint32_t face(std::uint32_t slot) const { return faces_.corner_faces[corner(slot)]; }
    [[nodiscard]] const DVec3& normal(std::uint32_t slot) const { return faces_.normals[face(slot)].unit; }
    [[nodiscard]] std::uint32_t group(std::uint32_t slot) const {
        return rule_.groups.empty() ? 1 : rule_.groups[face(slot)];
    }

    std::uint32_t root(std::uint32_t slot) {
        while (parents_[slot] != slot) slot = parents_[slot] = parents_[parents_[slot]];
        return slot;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        // The lower one stays root: linking by order with halved paths is O(log n) per step, and needs no
        // ranks.
        if (a < b)
            parents_[b] = a;
        else
            parents_[a] = b;
    }
    void joinIfSmooth(std::uint32_t a, std::uint32_t b) {
        if (angleBetween(normal(a), normal(b)) <= rule_.crease_rad) join(a, b);
    }

    static void sortLinks(Link* begin, Link* end) {
        std::sort(begin, end,
                  [](const Link& a, const Link& b) { return std::tie(a.key, a.slot) < std::tie(b.key, b.slot); });
    }

    void joinByGroup() {
        Link* end = links_;
        std::uint32_t first_of_bit[32];
        std::fill(std::begin(first_of_bit), std::end(first_of_bit), kNoSlot);
        for (std::uint32_t slot = begin_; slot < end_; ++slot) {
            const std::uint32_t number = group(slot);
            if (!rule_.groups_are_masks) {
                if (number != 0) *end++ = {number, slot};
                continue;
            }
            for (unsigned bit = 0; bit < 32; ++bit) {
                if ((number >> bit & 1) == 0) continue;
                if (first_of_bit[bit] == kNoSlot)
                    first_of_bit[bit] = slot;
                else
                    join(first_of_bit[bit], slot);
            }
        }
        sortLinks(links_, end);
        for (Link* link = links_; link != end; ++link) {
            if (link != links_ && link->key == link[-1].key) join(link[-1].slot, link->slot);
        }
    }

    void joinOverEdges() {
        Link* end = links_;
        for (std::uint32_t slot = begin_; slot < end_; ++slot) end = addEdges(slot, end);
        sortLinks(links_, end);
        for (Link* run = links_; run != end;) {
            Link* past = run + 1;
            while (past != end && past->key == run->key) ++past;
            joinOverEdge(run, past);
            run = past;
        }
    }

    /// Adds the edges from the point to the next and previous one. Edges of length zero connect a face to
    /// itself.
    Link* addEdges(std::uint32_t slot, Link* end) {
        const std::uint32_t next = faces_.next(corner(slot));
        const std::uint32_t previous = faces_.previous(corner(slot));
        if (points_.corner_points[previous] == point_) join(slot, slotOf(previous, slot));
        if (faces_.normals[face(slot)].isDegenerate() || group(slot) == 0) return end;
        if (points_.corner_points[next] != point_) *end++ = {points_.corner_points[next], slot};
        if (points_.corner_points[previous] != point_) *end++ = {points_.corner_points[previous], slot};
        return end;
    }

    /// The slot of the corner before that of `near`: next to it, or at the end of the face when `near` begins
    /// it.
    [[nodiscard]] std::uint32_t slotOf(std::uint32_t wanted, std::uint32_t near) const {
        if (wanted < corner(near)) return near - 1;
        while (corner(near) != wanted) ++near;
        return near;
    }

    void joinOverEdge(Link* run, Link* past) {
        if (past - run < 2) return;
        if (past - run == 2 && rule_.groups.empty()) return joinIfSmooth(run[0].slot, run[1].slot);
        sortAboutEdge(run, past);
        Ring rings[32];
        std::uint32_t number = group(run->slot);
        for (Link* link = run; link != past; ++link) {
            if (rule_.groups_are_masks) {
                for (unsigned bit = 0; bit < 32; ++bit) {
                    if (group(link->slot) >> bit & 1) append(rings[bit], link->slot);
                }
                continue;
            }
            if (group(link->slot) != number) {
                close(rings[0]);
                number = group(link->slot);
            }
            append(rings[0], link->slot);
        }
        for (Ring& ring : rings) close(ring);
    }

    void append(Ring& ring, std::uint32_t slot) {
        if (ring.first == kNoSlot)
            ring.first = slot;
        else
            joinIfSmooth(ring.last, slot);
        ring.last = slot;
    }
    void close(Ring& ring) {
        if (ring.first != ring.last) joinIfSmooth(ring.first, ring.last);
        ring = {};
    }

    void sortAboutEdge(Link* run, Link* past) {
        const std::uint32_t here = corner(run->slot);
        std::uint32_t there = faces_.next(here);
        if (points_.corner_points[there] != run->key) there = faces_.previous(here);
        const Turn turn(toDouble(mesh_.positions[mesh_.indices[there]]) -
                        toDouble(mesh_.positions[mesh_.indices[here]]));
        std::sort(run, past, [&](const Link& a, const Link& b) {
            const std::uint32_t group_a = rule_.groups_are_masks ? 0 : group(a.slot);
            const std::uint32_t group_b = rule_.groups_are_masks ? 0 : group(b.slot);
            if (group_a != group_b) return group_a < group_b;
            const double turn_a = turn.of(normal(a.slot));
            const double turn_b = turn.of(normal(b.slot));
            return turn_a != turn_b ? turn_a < turn_b : a.slot < b.slot;
        });
    }

    const MeshView& mesh_;
    const FaceTable& faces_;
    const PointTable& points_;
    const SmoothingRule& rule_;
    std::uint32_t point_, begin_, end_;
    Link* links_;
    std::uint32_t* parents_;
};

}  // namespace

SmoothingRule makeSmoothingRule(const NormalOptions& options) {
    SmoothingRule rule;
    rule.any_angle = options.crease_angle_deg >= 180;
    rule.crease_rad = double{options.crease_angle_deg} * (kPi / 180) + kCreaseSlackRad;
    rule.groups = options.smoothing_groups;
    rule.groups_are_masks = options.smoothing_groups_are_masks;
    return rule;
}

void findComponents(const MeshView& mesh, const FaceTable& faces, const PointTable& points, const SmoothingRule& rule,
                    std::uint32_t point, Link* links, std::uint32_t* parents) {
    PointComponents(mesh, faces, points, rule, point, links, parents).find();
}

}  // namespace tspace
