// SPDX-License-Identifier: MIT
// Components of the faces around a point, by union-find over smooth edges.
#include "normals/smoothing.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>

#include "core/angle.h"
#include "core/float4.h"
#include "core/sort.h"

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

[[gnu::noinline]] bool isSmoothByAngle(const SmoothingRule& rule, const FaceRow& a, const FaceRow& b) {
    return angleBetween(a.unit(), b.unit()) <= rule.crease_rad;
}
/// Mostly decided without an angle: that of nearly equal cosines is taken, since the cosine says little near 0 and 180
/// degrees.
inline bool isSmooth(const SmoothingRule& rule, const FaceRow& a, const FaceRow& b) {
    constexpr double kClear = 1e-12;  // rounding is below 1e-15
    const double cosine = a.x * b.x + a.y * b.y + a.z * b.z, sizes = a.size * b.size;
    const double above = cosine - rule.crease_cosine * sizes, clear = kClear * sizes;
    if (above > clear) [[likely]]
        return true;
    return !(above < -clear) && isSmoothByAngle(rule, a, b);
}

using Four = std::int32_t __attribute__((vector_size(16)));

/// The usual point: few corners, and edges that two faces share, all but the two ends of a row.
class FewCorners {
  public:
    static constexpr std::uint32_t kMost = 16;

    FewCorners(const Surroundings& around, const PointCorners& at) : around_(around), at_(at), count_(at.count) {}

    /// Null when it is not the usual point.
    const Link* find(Link* links) {
        if (!read() || !(count_ <= 8 ? connect<2>() : connect<4>())) return nullptr;
        const std::uint32_t all = (1u << count_) - 1;
        Link* link = links;
        for (std::uint32_t left = all; left != 0;) {
            const std::uint32_t component = componentOf(left);
            if (component == all) return oneComponent(count_, links);
            const auto first = static_cast<std::uint32_t>(std::countr_zero(component));
            for (std::uint32_t rest = component; rest != 0; rest &= rest - 1)
                *link++ = {first, static_cast<std::uint32_t>(std::countr_zero(rest))};
            left &= ~component;
        }
        return links;
    }

  private:
    bool read() {
        bool sound = true;
        for (std::uint32_t i = 0; i < count_; ++i) {
            next_[i] = at_.next(i);
            previous_[i] = at_.previous(i);
            rows_[i] = around_.rows + at_.triangle(i);
            sound &= !rows_[i]->isDegenerate();
        }
        return sound;
    }

    /// Finds who may share a normal with whom over an edge. False where an edge has more than two faces, or two that do
    /// not agree on its direction.
    template <std::uint32_t kFours>
    bool connect() {
        Four previous[kFours];
        std::memcpy(previous, previous_, sizeof previous);
        const std::uint32_t all = (1u << count_) - 1;
        std::uint32_t led_to = 0;
        bool has_end = false;
        for (std::uint32_t i = 0; i < count_; ++i) {
            std::uint32_t followers = 0;
            for (std::uint32_t k = 0; k < kFours; ++k)
                followers |= laneBits(previous[k] == static_cast<std::int32_t>(next_[i])) << 4 * k;
            followers &= all;
            if ((followers & (led_to | (followers - 1))) != 0) return false;
            led_to |= followers;
            if (followers == 0) {
                if (has_end) return false;  // of two, each may be the same edge seen from the other side
                has_end = true;
                continue;
            }
            const auto follower = static_cast<std::uint32_t>(std::countr_zero(followers));
            if (!isSmooth(around_.rule, *rows_[i], *rows_[follower]) || !mayConnect(i, follower)) continue;
            connected_[i] |= followers;
            connected_[follower] |= 1u << i;
        }
        return true;
    }

    /// Of the bits `left`, the lowest one and all that are connected with it.
    [[nodiscard]] std::uint32_t componentOf(std::uint32_t left) const {
        std::uint32_t component = left & -left;
        for (std::uint32_t rest = component; rest != 0;) {
            const std::uint32_t more = connected_[std::countr_zero(rest)] & ~component;
            component |= more;
            rest = (rest & (rest - 1)) | more;
        }
        return component;
    }

    [[nodiscard]] bool mayConnect(std::uint32_t a, std::uint32_t b) const {
        // An edge of length zero connects a face to itself.
        if (around_.rule.groups.empty() || next_[a] == at_.point) return true;
        const std::uint32_t g = around_.rule.groups[around_.faces.of(at_.corner(a))];
        const std::uint32_t h = around_.rule.groups[around_.faces.of(at_.corner(b))];
        return around_.rule.groups_are_masks ? (g & h) != 0 : g == h && g != 0;
    }

    const Surroundings& around_;
    const PointCorners& at_;
    std::uint32_t count_;
    std::uint32_t connected_[kMost] = {}, next_[kMost];  ///< bits of other corners; points
    alignas(16) std::uint32_t previous_[kMost];
    const FaceRow* rows_[kMost];
};

/// Any point.
class PointComponents {
  public:
    PointComponents(const Surroundings& around, const PointCorners& at, Link* links, std::uint32_t* parents)
        : mesh_(around.mesh),
          faces_(around.faces),
          rule_(around.rule),
          rows_(around.rows),
          at_(at),
          count_(at.count),
          links_(links),
          parents_(parents) {}

    [[gnu::noinline]] void find() {
        for (std::uint32_t slot = 0; slot < count_; ++slot) parents_[slot] = slot;
        if (rule_.any_angle)
            joinByGroup();
        else
            joinOverEdges();
        for (std::uint32_t slot = 0; slot < count_; ++slot) links_[slot] = {root(slot), slot};
        sortLinks(links_, links_ + count_);
    }

  private:
    /// Corners that follow one another on the same side of a smooth edge, closed into a ring.
    struct Ring {
        std::uint32_t first = kNoSlot, last = kNoSlot;
    };

    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return at_.corner(slot); }
    [[nodiscard]] const FaceRow& row(std::uint32_t slot) const { return rows_[at_.triangle(slot)]; }
    [[nodiscard]] std::uint32_t group(std::uint32_t slot) const {
        return rule_.groups.empty() ? 1 : rule_.groups[faces_.of(corner(slot))];
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
        if (isSmooth(rule_, row(a), row(b))) join(a, b);
    }

    static void sortLinks(Link* begin, Link* end) {
        sortList(begin, end,
                 [](const Link& a, const Link& b) { return a.key != b.key ? a.key < b.key : a.slot < b.slot; });
    }

    void joinByGroup() {
        Link* end = links_;
        std::uint32_t first_of_bit[32];
        std::fill(std::begin(first_of_bit), std::end(first_of_bit), kNoSlot);
        for (std::uint32_t slot = 0; slot < count_; ++slot) {
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
        for (std::uint32_t slot = 0; slot < count_; ++slot) end = addEdges(slot, end);
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
        const std::uint32_t next = at_.next(slot), previous = at_.previous(slot);
        if (previous == at_.point) join(slot, slotOf(faces_.previous(corner(slot)), slot));
        if (row(slot).isDegenerate() || group(slot) == 0) return end;
        if (next != at_.point) *end++ = {next, slot};
        if (previous != at_.point) *end++ = {previous, slot};
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
        const std::uint32_t there = at_.next(run->slot) == run->key ? faces_.next(here) : faces_.previous(here);
        const Turn turn(toDouble(mesh_.positions[mesh_.indices[there]]) -
                        toDouble(mesh_.positions[mesh_.indices[here]]));
        sortList(run, past, [&](const Link& a, const Link& b) {
            const std::uint32_t group_a = rule_.groups_are_masks ? 0 : group(a.slot);
            const std::uint32_t group_b = rule_.groups_are_masks ? 0 : group(b.slot);
            if (group_a != group_b) return group_a < group_b;
            const double turn_a = turn.of(row(a.slot).unit());
            const double turn_b = turn.of(row(b.slot).unit());
            return turn_a != turn_b ? turn_a < turn_b : a.slot < b.slot;
        });
    }

    const MeshView& mesh_;
    const Faces& faces_;
    const SmoothingRule& rule_;
    const FaceRow* rows_;
    const PointCorners& at_;
    std::uint32_t count_;
    Link* links_;
    std::uint32_t* parents_;
};

}  // namespace

SmoothingRule::SmoothingRule(const NormalOptions& options)
    : any_angle(options.crease_angle_deg >= 180),
      crease_rad(double{options.crease_angle_deg} * (kPi / 180) + kCreaseSlackRad),
      crease_cosine(sineCosine(crease_rad < kPi ? crease_rad : kPi).cosine),
      groups(options.smoothing_groups),
      groups_are_masks(options.smoothing_groups_are_masks) {}

const Link* findComponents(const Surroundings& around, const PointCorners& at, Link* links, std::uint32_t* parents) {
    if (!around.rule.any_angle && at.count <= FewCorners::kMost) {
        if (const Link* const few = FewCorners(around, at).find(links); few != nullptr) return few;
    }
    PointComponents(around, at, links, parents).find();
    return links;
}

const Link* oneComponent(std::uint32_t count, Link* links) {
    static constexpr Link kFew[8] = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {0, 6}, {0, 7}};
    if (count <= std::size(kFew)) return kFew;
    for (std::uint32_t slot = 0; slot < count; ++slot) links[slot] = {0, slot};
    return links;
}

}  // namespace tspace
