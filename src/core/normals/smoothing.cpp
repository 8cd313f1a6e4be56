// SPDX-License-Identifier: MIT
// Components of the faces around a point, by union-find over smooth edges.
#include "core/normals/normals_call.h"

#include <algorithm>
#include <bit>

#include "core/base/disjoint_sets.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};
/// number of corners at a point that are processed without allocation; few points have more
constexpr std::uint32_t kFew = 8;

// Tolerance for the rounding of float positions: an intended right angle may exceed 90 degrees by some 1e-7 rad.
constexpr double kCreaseSlackRad = 1e-6;

/// Position of a normal in the rotation about an edge: a value in [0, 4) that is monotonic in the angle, computed
/// without trigonometry.
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
/// Returns whether two faces are smooth across their edge. Mostly decided by cosines; for nearly equal cosines the
/// angle is computed, because the cosine is inaccurate near 0 and 180 degrees.
inline bool isSmooth(const SmoothingRule& rule, const FaceRow& a, const FaceRow& b) {
    constexpr double kClear = 1e-12;  // minimum difference of cosines that decides; rounding is below 1e-15
    const double cosine = a.x * b.x + a.y * b.y + a.z * b.z, sizes = a.size * b.size;
    const double above = cosine - rule.crease_cosine * sizes, clear = kClear * sizes;
    if (above > clear) [[likely]]
        return true;
    return !(above < -clear) && isSmoothByAngle(rule, a, b);
}

/// Points of up to kFew corners, as SIMD vectors.
struct FewPoints {
    Mask4 four[kFew / 4] = {Mask4{} - 1, Mask4{} - 1};

    void set(std::uint32_t slot, std::uint32_t point) { four[slot / 4][slot % 4] = static_cast<std::int32_t>(point); }
    /// Returns the corners that have a given point, as bits.
    [[nodiscard]] std::uint32_t with(std::uint32_t point) const {
        const Mask4 wanted = Mask4{} + static_cast<std::int32_t>(point);
        return laneBits(four[0] == wanted) | laneBits(four[1] == wanted) << 4;
    }
};

/// Components of the corners around one point.
class PointComponents {
  public:
    PointComponents(const SmoothingRule& rule, const FaceRow* rows, const PointCorners& at, Link* links,
                    std::uint32_t* parents)
        : rule_(rule), faces_(rule.call.faces), rows_(rows), at_(at), count_(at.count), components_(at.count),
          links_(links), parents_(parents) {}

    const Link* find() {
        for (std::uint32_t slot = 0; slot < count_; ++slot) parents_[slot] = slot;
        if (rule_.anyAngle())
            joinByGroup();
        else
            joinOverEdges();
        if (components_ == 1) return oneComponent(count_, links_);
        for (std::uint32_t slot = 0; slot < count_; ++slot) links_[slot] = {rootOf(parents_, slot), slot};
        sortLinks(links_, links_ + count_);
        return links_;
    }

  private:
    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return at_.corner(slot); }
    [[nodiscard]] const FaceRow& row(std::uint32_t slot) const { return rows_[at_.triangle(slot)]; }
    [[nodiscard]] std::uint32_t group(std::uint32_t slot) const {
        return rule_.groups.empty() ? 1 : rule_.groups[faces_.of(corner(slot))];
    }

    void join(std::uint32_t a, std::uint32_t b) {
        if (joinSets(parents_, a, b)) --components_;
    }
    void joinIfSmooth(std::uint32_t a, std::uint32_t b) {
        if (rule_.anyAngle() || isSmooth(rule_, row(a), row(b))) join(a, b);
    }

    static void sortLinks(Link* begin, Link* end) {
        sortList(begin, end,
                 [](const Link& a, const Link& b) { return a.key != b.key ? a.key < b.key : a.slot < b.slot; });
    }

    void joinByGroup() {
        Link* end = links_;
        for (std::uint32_t slot = 0; slot < count_; ++slot) {
            if (group(slot) != 0) *end++ = {rule_.groups_are_masks ? 0 : group(slot), slot};
        }
        sortLinks(links_, end);
        joinGroups(links_, end);
    }

    void joinOverEdges() {
        if (count_ <= kFew && joinFans()) return;
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

    /// Joins the corners around a point in the frequent case of few corners, no two of which have the same next or the
    /// same previous point. No list of edges has to be sorted then. Returns false for other cases, without changes.
    /// (std::has_single_bit is a function call on baseline x86-64.)
    bool joinFans() {
        FewPoints next, previous;
        std::uint8_t follower[kFew];
        for (std::uint32_t slot = 0; slot < count_; ++slot) {
            if (row(slot).isDegenerate() || group(slot) == 0 || at_.next(slot) == at_.point) return false;
            next.set(slot, at_.next(slot));
            previous.set(slot, at_.previous(slot));
        }
        for (std::uint32_t slot = 0; slot < count_; ++slot) {
            const std::uint32_t found = previous.with(at_.next(slot));
            const std::uint32_t like = next.with(at_.next(slot)), behind = previous.with(at_.previous(slot));
            if ((like & (like - 1)) != 0 || (behind & (behind - 1)) != 0) return false;
            follower[slot] =
                static_cast<std::uint8_t>(found != 0 ? static_cast<unsigned>(std::countr_zero(found)) : slot);
        }
        for (std::uint32_t slot = 0; slot < count_; ++slot) {
            if (follower[slot] != slot) joinTwo(slot, follower[slot], corner(slot));
        }
        return true;
    }

    /// Adds the edges from the point to the next and previous one. Edges of length zero connect a face with itself.
    Link* addEdges(std::uint32_t slot, Link* end) {
        const std::uint32_t next = at_.next(slot), previous = at_.previous(slot);
        if (previous == at_.point) join(slot, slotOf(faces_.previous(corner(slot)), slot));
        if (row(slot).isDegenerate() || group(slot) == 0) return end;
        if (next != at_.point) *end++ = {next, slot};
        if (previous != at_.point) *end++ = {previous, slot};
        return end;
    }

    /// Returns the slot of corner `wanted`, which precedes the corner of slot `near` in its face: the previous slot, or
    /// the last slot of the face if `near` is its first.
    [[nodiscard]] std::uint32_t slotOf(std::uint32_t wanted, std::uint32_t near) const {
        if (wanted < corner(near)) return near - 1;
        while (corner(near) != wanted) ++near;
        return near;
    }

    void joinOverEdge(Link* run, Link* past) {
        if (past - run < 2) return;
        if (past - run == 2) {
            const std::uint32_t here = corner(run->slot);
            return joinTwo(run[0].slot, run[1].slot, at_.next(run->slot) == run->key ? here : faces_.previous(here));
        }
        sortAboutEdge(run, past);
        joinGroups(run, past);
    }

    /// Joins two faces at their common edge if they are smooth. `edge`: the corner at the start of the edge.
    void joinTwo(std::uint32_t a, std::uint32_t b, std::uint32_t edge) {
        const std::uint32_t g = group(a), h = group(b);
        if (rule_.groups_are_masks ? (g & h) == 0 : g != h) return;
        const EdgeKind kind = rule_.call.edges == nullptr ? EdgeKind::byAngle : rule_.call.edges[edge];
        if (kind == EdgeKind::byAngle) return joinIfSmooth(a, b);
        if (kind == EdgeKind::soft) join(a, b);
    }

    /// Joins the faces of each smoothing group separately. Links are sorted by group, unless groups are masks.
    void joinGroups(const Link* run, const Link* past) {
        std::uint32_t masks = 0;
        for (const Link* link = run; rule_.groups_are_masks && link != past; ++link) masks |= group(link->slot);
        for (; masks != 0; masks &= masks - 1)
            joinRing(run, past, [&, bit = masks & -masks](std::uint32_t slot) { return (group(slot) & bit) != 0; });
        for (const Link* end = run; !rule_.groups_are_masks && run != past; run = end) {
            while (end != past && group(end->slot) == group(run->slot)) ++end;
            joinRing(run, end, [](std::uint32_t) { return true; });
        }
    }

    /// Joins each corner that `counts` accepts to the previous one, and the last to the first.
    template <class Counts>
    void joinRing(const Link* run, const Link* past, const Counts& counts) {
        std::uint32_t first = kNoSlot, last = kNoSlot;
        for (; run != past; ++run) {
            if (!counts(run->slot)) continue;
            if (first == kNoSlot)
                first = run->slot;
            else
                joinIfSmooth(last, run->slot);
            last = run->slot;
        }
        if (first != last) joinIfSmooth(first, last);
    }

    void sortAboutEdge(Link* run, Link* past) {
        const std::uint32_t here = corner(run->slot);
        const std::uint32_t there = at_.next(run->slot) == run->key ? faces_.next(here) : faces_.previous(here);
        const MeshView& mesh = rule_.call.mesh;
        const Turn turn(toDouble(mesh.positions[mesh.indices[there]]) - toDouble(mesh.positions[mesh.indices[here]]));
        sortList(run, past, [&](const Link& a, const Link& b) {
            const std::uint32_t group_a = rule_.groups_are_masks ? 0 : group(a.slot);
            const std::uint32_t group_b = rule_.groups_are_masks ? 0 : group(b.slot);
            if (group_a != group_b) return group_a < group_b;
            const double turn_a = turn.of(row(a.slot).unit());
            const double turn_b = turn.of(row(b.slot).unit());
            return turn_a != turn_b ? turn_a < turn_b : a.slot < b.slot;
        });
    }

    const SmoothingRule& rule_;
    const MeshFaces& faces_;
    const FaceRow* rows_;
    const PointCorners& at_;
    std::uint32_t count_, components_;
    Link* links_;
    std::uint32_t* parents_;
};

}  // namespace

SmoothingRule::SmoothingRule(const NormalsCall& c)
    : call(c), crease_rad(double{c.options.crease_angle_deg} * (kPi / 180) + kCreaseSlackRad),
      crease_cosine(sineCosine(crease_rad < kPi ? crease_rad : kPi).cosine), groups(c.options.smoothing_groups),
      groups_are_masks(c.options.smoothing_groups_are_masks) {}

const Link* findComponents(const SmoothingRule& rule, const FaceRow* rows, const PointCorners& at, Link* links,
                           std::uint32_t* parents) {
    return rule.connectsAll() ? oneComponent(at.count, links) : PointComponents(rule, rows, at, links, parents).find();
}

const Link* oneComponent(std::uint32_t count, Link* links) {
    static constexpr Link kInOne[kFew] = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {0, 6}, {0, 7}};
    if (count <= kFew) return kInOne;
    for (std::uint32_t slot = 0; slot < count; ++slot) links[slot] = {0, slot};
    return links;
}

}  // namespace tspace
