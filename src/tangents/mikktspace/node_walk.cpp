// SPDX-License-Identifier: MIT
// The nodes that one pass leaves unclear. The triangles around them are computed once more, their corners
// listed, and then each node is worked on alone, as groups.cpp and evaluate.cpp do, but without a plan in
// between. Nodes where something rare happens are left to the general steps: groups that split, results that
// are not finite, copies between nodes, more than kSmallNode corners.
//
// A triangle without UV area takes the orientation of the first group that reaches it, at any of its nodes.
// Where its nodes have one orientation only, that is the one, whoever is first. Others are contested: the
// nodes of those are grouped one after the other, in the reference's order.
#include "tangents/mikktspace/node_walk.h"

#include <algorithm>
#include <atomic>

#include "tangents/mikktspace/add_row.h"
#include "tangents/mikktspace/corner_source.h"
#include "tangents/mikktspace/pairing.h"
#include "tangents/mikktspace/results.h"
#include "tangents/mikktspace/triangle_pass.h"
#include "tangents/mikktspace/unclear_corners.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kNodeGrain = 512;
constexpr std::size_t kLookAhead = 4;  // nodes; far enough for their corners to arrive from memory
constexpr std::size_t kSmall = 1024;   // triangles; all about so few is in the cache
constexpr std::uint8_t kNoGroup = 0xff;

/// What became of a node.
enum State : std::uint8_t { kDone, kLeft, kFirstIsDefault };

Vec3 vectorOf(const Row& row) { return {row.at[0], row.at[1], row.at[2]}; }

/// What a group's members add up to.
struct Sum {
    Row s, t;  ///< with the weights, and with weighted |dP/du|
    float length_t = 0;
    std::uint32_t marks = kAllMarks, adding = 0;  ///< how many members add to it
    bool positive = false;
};

/// The corners around one node, and their groups.
struct Members {
    const std::uint32_t* corners = nullptr;
    std::uint32_t count = 0, group_count = 0;
    std::uint8_t group[kSmallNode];
};

class NodeWalk {
  public:
    NodeWalk(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
             const Nodes& nodes, std::span<const std::uint32_t> chosen, const TangentOutput& out,
             Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          chosen_(chosen),
          out_(out),
          sign_factor_(signFactor(options.convention) * normalFactor(options.convention)),
          sink_(out, sign_factor_, signFactor(options.convention)),
          parallel_(parallel),
          allocator_(options.execution.allocator),
          may_split_(options.method == Method::mikktspace),
          has_polygons_(!triangles.faces.empty()),
          tangents_only_(wantsTangentsOnly(out)),
          full_(has_polygons_ || !tangents_only_),
          is_small_(triangles.count < kSmall),
          corners_(allocator_) {}

    WalkedNodes run(std::span<const std::uint32_t> doubtful, CornerSource source, CornerTermsFunction terms,
                    NodeSums* sums) {
        source.tangents_only = !full_ && !may_split_;
        corners_ = readCorners(
            {mesh_, triangles_, nodes_, chosen_, source, full_, terms, sums, allocator_, parallel_});
        state_ = Buffer<std::uint8_t>(allocator_, chosen_.size(), std::uint8_t{kDone});
        if (sums == nullptr ? findContestedOfAll() : findContested(doubtful)) groupContested();
        std::atomic<std::uint64_t> groups{0}, defaults{0};
        parallel_.forRanges(chosen_.size(), kNodeGrain, [&](std::size_t begin, std::size_t end) {
            Counts counts;
            for (std::size_t place = begin; place < end; ++place) {
                if (!is_small_ && place + kLookAhead < end) fetch(place + kLookAhead);
                walkNode(place, counts);
            }
            groups += counts.groups;
            defaults += counts.defaults;
        });
        WalkedNodes result;
        countTriangles(result);
        result.group_count = groups + contested_counts_.groups;
        result.default_corner_count = defaults + contested_counts_.defaults + copyToDegenerate();
        std::size_t left_count = 0;
        for (std::uint8_t& state : state_) {
            state = state == kLeft ? 1 : 0;
            left_count += state;
        }
        result.left_count = left_count;
        result.left = std::move(state_);
        return result;
    }

  private:
    struct Counts {
        std::uint64_t groups = 0, defaults = 0;
    };

    /// Marks contested triangles and their nodes. Returns whether there are any.
    bool findContested(std::span<const std::uint32_t> doubtful) {
        bool any = false;
        const std::uint32_t *found = corners_.found.data(), *end = found + corners_.found.size(),
                            *next = found;
        for (const std::uint32_t triangle : doubtful) {
            next = std::lower_bound(next, end, triangle);
            const auto t = static_cast<std::size_t>(next - found);
            const std::uint32_t* p = corners_.places.data() + 3 * t;
            if ((facing(p[0]) | facing(p[1]) | facing(p[2])) != 3) continue;
            if (!any) contested_ = noMarks(allocator_, chosen_.size());
            any = true;
            corners_.triangles[t].flags |= kContested;
            for (std::size_t k = 0; k < 3; ++k) contested_[p[k]] = 1;
        }
        return any;
    }

    /// The same among all triangles.
    bool findContestedOfAll() {
        Buffer<std::uint8_t> facing(allocator_, chosen_.size(), std::uint8_t{0});
        bool any_flat = false;
        const auto forEachTriangle = [&](const auto& body) {
            for (std::size_t t = 0; t < corners_.found.size(); ++t)
                body(corners_.triangles[t].flags, corners_.triangles[t].nodes, t);
        };
        forEachTriangle([&](std::uint32_t flags, const std::uint32_t* nodes, std::size_t) {
            any_flat |= (flags & kAny) != 0;
            if ((flags & (kAny | kDegenerate)) != 0) return;
            const std::uint8_t up = (flags & kPositive) != 0 ? 1 : 2;
            for (std::size_t k = 0; k < 3; ++k) facing[nodes[k]] |= up;
        });
        if (!any_flat) return false;
        bool any = false;
        forEachTriangle([&](std::uint32_t flags, const std::uint32_t* nodes, std::size_t t) {
            if ((flags & kAny) == 0 || (facing[nodes[0]] | facing[nodes[1]] | facing[nodes[2]]) != 3) return;
            if (!any) contested_ = noMarks(allocator_, chosen_.size());
            any = true;
            corners_.triangles[t].flags |= kContested;
            for (std::size_t k = 0; k < 3; ++k) contested_[nodes[k]] = 1;
        });
        return any;
    }

    void countTriangles(WalkedNodes& result) const {
        for (std::size_t t = 0; t < corners_.found.size(); ++t) {
            const std::uint32_t flags = corners_.triangles[t].flags;
            const bool degenerate = (flags & kDegenerate) != 0, flat = (flags & kAny) != 0;
            result.degenerate_count += degenerate ? 1 : 0;
            result.no_uv_area_count += flat ? 1 : 0;
            result.mirrored_count +=
                !degenerate && !flat && (corners_.marks[3 * t] & kFacesDown) != 0 ? 1 : 0;
        }
    }

    /// Which orientations the triangles at a node have.
    [[nodiscard]] unsigned facing(std::size_t place) const {
        unsigned result = 0;
        for (std::uint32_t i = corners_.begin[place]; i < corners_.begin[place + 1]; ++i) {
            const std::uint32_t flags = corners_.flags(corners_.list[i]);
            if ((flags & kAny) == 0) result |= (flags & kPositive) != 0 ? 1 : 2;
        }
        return result;
    }

    /// Nodes that share contested triangles are left together or not at all.
    void groupContested() {
        if (spreadContested()) return;
        contested_counts_ = {};
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] != 0) state_[place] = kLeft;
        }
    }

    bool spreadContested() {
        const std::size_t size = corners_.list.size();
        Buffer<std::uint8_t> links(allocator_, 2 * size), group(allocator_, size, kNoGroup);
        std::uint8_t *left = links.data(), *right = left + size;
        struct Progress {
            std::uint8_t cursor = 0, group_count = 0;
        };
        Buffer<Progress> progress(allocator_, chosen_.size(), Progress{});
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] == 0) continue;
            const std::uint32_t begin = corners_.begin[place];
            if (corners_.count(place) > kSmallNode) return false;
            linkContested(place, left + begin, right + begin);
        }
        for (std::size_t row = 0; row < corners_.places.size(); ++row) {
            const std::uint32_t place = corners_.places[row];
            if (place == kNone || contested_[place] == 0) continue;
            const std::uint32_t flags = corners_.triangles[row / 3].flags;
            if ((flags & kDegenerate) != 0) continue;
            const std::uint32_t begin = corners_.begin[place], seed = progress[place].cursor++;
            std::uint8_t* groups = group.data() + begin;
            if ((flags & kAny) != 0 || groups[seed] != kNoGroup) continue;
            groups[seed] = progress[place].group_count++;
            for (const std::uint8_t* link : {left + begin, right + begin}) {
                for (std::uint8_t m = link[seed]; m != kNoGroup && groups[m] == kNoGroup; m = link[m]) {
                    if (!joinsContested(corners_.list[begin + m] >> 2, flags & kPositive)) break;
                    groups[m] = groups[seed];
                }
            }
        }
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] == 0) continue;
            Members members = membersOf(place);
            std::copy_n(group.data() + corners_.begin[place], members.count, members.group);
            members.group_count = progress[place].group_count;
            if (!finish(place, members, contested_counts_)) return false;
        }
        return true;
    }

    [[nodiscard]] Members membersOf(std::size_t place) const {
        Members members;
        members.corners = corners_.list.data() + corners_.begin[place];
        members.count = corners_.count(place);
        return members;
    }

    void linkContested(std::size_t place, std::uint8_t* to_left, std::uint8_t* to_right) const {
        std::uint32_t left[kSmallNode], right[kSmallNode];
        const Members members = membersOf(place);
        link(members, left, right);
        for (std::uint32_t i = 0; i < members.count; ++i) {
            to_left[i] = static_cast<std::uint8_t>(left[i]);  // kNone becomes kNoGroup
            to_right[i] = static_cast<std::uint8_t>(right[i]);
        }
    }

    void link(const Members& members, std::uint32_t* left, std::uint32_t* right) const {
        std::uint32_t next[kSmallNode], previous[kSmallNode];
        for (std::uint32_t i = 0; i < members.count; ++i) {
            next[i] = corners_.next(members.corners[i]);
            previous[i] = corners_.previous(members.corners[i]);
        }
        Around around{members.count, nullptr, next, previous, left, right};
        pairSmall(around);
    }

    /// As in groups.cpp. A triangle that is not contested joins any group.
    bool joinsContested(std::uint32_t triangle, std::uint32_t orientation) {
        std::uint32_t& flags = corners_.triangles[triangle].flags;
        if ((flags & (kAny | kContested)) == kAny) return true;
        if ((flags & kAny) != 0 && (flags & kGrouped) == 0)
            flags = (flags & ~std::uint32_t{kPositive}) | orientation;
        if ((flags & kPositive) != orientation) return false;
        flags |= kGrouped;
        return true;
    }

    [[gnu::always_inline]] void fetch(std::size_t place) const {
        const std::uint32_t begin = corners_.begin[place],
                            end = begin + std::min(corners_.count(place), kSmallNode);
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t corner = corners_.list[i];
            __builtin_prefetch(&corners_.triangles[corner >> 2]);
            __builtin_prefetch(&corners_.directions[UnclearCorners::row(corner)]);
        }
    }

    void walkNode(std::size_t place, Counts& counts) {
        if (!contested_.empty() && contested_[place] != 0) return;
        Members members = membersOf(place);
        if (members.count > kSmallNode) {
            state_[place] = kLeft;
            return;
        }
        if (tangents_only_ && finishOneFan(place, members, counts)) return;
        formGroups(members);
        finish(place, members, counts);
    }

    /// The usual case, when only tangents are asked for: one fan of one orientation, and nothing else to see
    /// to. Then all corners have one result, however often the reference writes it. Returns false when it is
    /// something else.
    bool finishOneFan(std::size_t place, const Members& members, Counts& counts) {
        if (!corners_.entangled.empty() && corners_.entangled[place] == UnclearCorners::kOtherNode)
            return false;
        Fan fan;
        FanRoom no_room(nullptr, 0);  // more than two paths are rare
        Sum sum;
        bool known = true;
        std::uint32_t some = 0, all = ~0u;
        for (std::uint32_t i = 0; i < members.count; ++i) {
            const std::uint32_t corner = members.corners[i], flags = corners_.flags(corner);
            known &= fan.add(corners_.next(corner), corners_.previous(corner), no_room);
            if ((flags & kAny) != 0) continue;
            some |= flags;
            all &= flags;
            ++sum.adding;
            addRows(sum, UnclearCorners::row(corner));
        }
        if (!known || !fan.isOne() || sum.adding == 0 || ((some ^ all) & kPositive) != 0) return false;
        sum.positive = (all & kPositive) != 0;
        if (may_split_ && sum.adding > 1 &&
            !keepTogether(place, sum, members, [](std::uint32_t) { return true; }))
            return false;
        const Tangents result = resultOf(sum);
        if (!isSound(result)) return false;
        const Vec4 tangent{result.s.x, result.s.y, result.s.z, sink_.sign(result.positive)};
        for (std::uint32_t i = 0; i < members.count; ++i) out_.tangents[slotOf(members.corners[i])] = tangent;
        ++counts.groups;
        return true;
    }

    [[nodiscard]] bool isSound(const Tangents& result) const {
        return isFinite(result.s) && (!has_polygons_ || sameResult(result, result)) &&
               (may_split_ || notZero(result.s));
    }

    /// Groups of a node without contested triangles: those without UV area join any.
    void formGroups(Members& members) const {
        std::uint32_t left[kSmallNode], right[kSmallNode];
        link(members, left, right);
        std::fill_n(members.group, members.count, kNoGroup);
        for (std::uint32_t seed = 0; seed < members.count; ++seed) {
            const std::uint32_t flags = corners_.flags(members.corners[seed]);
            if ((flags & kAny) != 0 || members.group[seed] != kNoGroup) continue;
            const auto group = static_cast<std::uint8_t>(members.group_count++);
            members.group[seed] = group;
            for (const std::uint32_t* links : {left, right}) {
                for (std::uint32_t m = links[seed]; m != kNone && members.group[m] == kNoGroup;
                     m = links[m]) {
                    const std::uint32_t other = corners_.flags(members.corners[m]);
                    if ((other & kAny) == 0 && ((other ^ flags) & kPositive) != 0) break;
                    members.group[m] = group;
                }
            }
        }
    }

    /// Sums, results and corners of a node. Returns false when it is left.
    bool finish(std::size_t place, const Members& members, Counts& counts) {
        const bool kept = members.group_count <= 1   ? finishGroups<1>(place, members, counts)
                          : members.group_count <= 4 ? finishGroups<4>(place, members, counts)
                                                     : finishGroups<kSmallNode>(place, members, counts);
        if (!kept) state_[place] = kLeft;
        return kept;
    }

    template <std::size_t kMost>
    bool finishGroups(std::size_t place, const Members& members, Counts& counts) {
        if (has_polygons_ && repeatsApart(members)) return false;
        if (isEntangled(place, members)) return false;
        Sum sums[kMost];
        Tangents results[kMost];
        for (std::uint32_t i = 0; i < members.count; ++i) {
            const std::uint32_t corner = members.corners[i], flags = corners_.flags(corner);
            if (members.group[i] == kNoGroup || (flags & kAny) != 0) continue;
            Sum& sum = sums[members.group[i]];
            sum.positive = (flags & kPositive) != 0;
            ++sum.adding;
            addRows(sum, UnclearCorners::row(corner));
        }
        for (std::uint32_t g = 0; g < members.group_count; ++g) {
            if (may_split_ && sums[g].adding > 1 && splits(place, members, g, sums[g])) return false;
            results[g] = resultOf(sums[g]);
            if (!isSound(results[g])) return false;
        }
        counts.groups += members.group_count;
        write(place, members, results, counts);
        return true;
    }

    void addRows(Sum& sum, std::size_t row) const {
        sum.marks &= corners_.marks[row];
        addRow(sum.s.at, corners_.directions[row].s.at);
        addRow(sum.t.at, corners_.directions[row].t.at);
        if (full_) sum.length_t += corners_.lengths_t[row];
    }

    /// The angular test. Nearly all groups keep together; of others all pairs are compared, as the reference
    /// does.
    [[nodiscard]] bool splits(std::size_t place, const Members& members, std::uint32_t g,
                              const Sum& sum) const {
        const auto isMember = [&](std::uint32_t i) { return members.group[i] == g; };
        return !keepTogether(place, sum, members, isMember) &&
               anyOpposed(members, g, mesh_.normals[nodes_.vertex(chosen_[place])]);
    }

    /// Whether the members keep to one side of the planes across their sums: then no two are opposed.
    template <class IsMember>
    [[nodiscard]] bool keepTogether(std::size_t place, const Sum& sum, const Members& members,
                                    const IsMember& isMember) const {
        if (sumCannotSplit(sum.s.at, sum.marks, mesh_.normals[nodes_.vertex(chosen_[place])])) return true;
        const Vec3 s = vectorOf(sum.s), t = vectorOf(sum.t);
        const float limit_s = kOffPlane * length(s), limit_t = kOffPlane * length(t);
        for (std::uint32_t i = 0; i < members.count; ++i) {
            if (!isMember(i) || (corners_.flags(members.corners[i]) & kAny) != 0) continue;
            const Directions& here = corners_.directions[UnclearCorners::row(members.corners[i])];
            const float weight = here.s.at[3];
            if (!(weight > kLeastWeight) || !(dot(s, vectorOf(here.s)) > weight * limit_s) ||
                !(dot(t, vectorOf(here.t)) > weight * limit_t))
                return false;
        }
        return true;
    }

    [[nodiscard]] bool adds(const Members& members, std::uint32_t i, std::uint32_t g) const {
        return members.group[i] == g && (corners_.flags(members.corners[i]) & kAny) == 0;
    }

    [[nodiscard]] bool anyOpposed(const Members& members, std::uint32_t g, const Vec3& normal) const {
        struct Direction {
            Vec3 s, t;
            std::uint32_t face;
        };
        Direction directions[kSmallNode];
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < members.count; ++i) {
            if (!adds(members, i, g)) continue;
            const std::uint32_t t = members.corners[i] >> 2;
            const TriangleFrame frame = frameOf(t);
            const Direction here{flatten(normal, frame.s), flatten(normal, frame.t),
                                 triangles_.face(corners_.found[t])};
            for (std::uint32_t j = 0; j < count; ++j) {
                const Direction& other = directions[j];
                if (other.face != here.face &&
                    !(dot(here.s, other.s) > -1.0f && dot(here.t, other.t) > -1.0f))
                    return true;
            }
            directions[count++] = here;
        }
        return false;
    }

    [[nodiscard]] TriangleFrame frameOf(std::uint32_t triangle) const {
        Vec3 p[3];
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = nodes_.vertex(corners_.triangles[triangle].nodes[k]);
            p[k] = mesh_.positions[vertex];
            uv[k] = mesh_.uvs[vertex];
        }
        return triangleShape(p[0], p[1], p[2], uv[0], uv[1], uv[2]).frame;
    }

    [[nodiscard]] Tangents resultOf(const Sum& sum) const {
        Tangents r;
        r.positive = sum.positive;
        r.s = unit(vectorOf(sum.s));
        if (!full_) return r;
        r.t = unit(vectorOf(sum.t));
        r.mag_s = sum.t.at[3];
        r.mag_t = sum.length_t;
        if (sum.s.at[3] > 0) {
            r.mag_s /= sum.s.at[3];
            r.mag_t /= sum.s.at[3];
        }
        return r;
    }

    [[nodiscard]] std::uint32_t slotOf(std::uint32_t corner) const {
        return corners_.slot(triangles_, corner);
    }
    [[nodiscard]] std::uint32_t faceOf(std::uint32_t corner) const {
        return triangles_.faces[corners_.found[corner >> 2]];
    }

    /// Whether corners of triangles that are one corner of the mesh have others between them. So it is only
    /// in a polygon with two corners at one node.
    [[nodiscard]] bool repeatsApart(const Members& members) const {
        for (std::uint32_t i = 0; i + 2 < members.count; ++i) {
            const std::uint32_t slot = slotOf(members.corners[i]), face = faceOf(members.corners[i]);
            bool apart = false;
            for (std::uint32_t j = i + 1; j < members.count && faceOf(members.corners[j]) == face; ++j) {
                const bool repeats = slotOf(members.corners[j]) == slot;
                if (repeats && apart) return true;
                apart |= !repeats;
            }
        }
        return false;
    }

    /// Whether a copy of one of the node's corners depends on more than its first corner.
    [[nodiscard]] bool isEntangled(std::size_t place, const Members& members) const {
        if (corners_.entangled.empty() || corners_.entangled[place] == 0) return false;
        if (corners_.entangled[place] == UnclearCorners::kOtherNode) return true;
        return members.group_count != 0 && std::find(members.group, members.group + members.count,
                                                     kNoGroup) != members.group + members.count;
    }

    void write(std::size_t place, const Members& members, const Tangents* results, Counts& counts) {
        for (std::uint32_t i = 0; i < members.count;) {
            const std::uint32_t slot = slotOf(members.corners[i]);
            std::uint32_t end = i + 1;
            while (has_polygons_ && end < members.count && slotOf(members.corners[end]) == slot) ++end;
            if (!writeSlot(slot, members.group + i, members.group + end, results)) {
                sink_.write(slot, Tangents{});
                ++counts.defaults;
                if (i == 0) state_[place] = kFirstIsDefault;
            }
            i = end;
        }
    }

    /// The corners of a polygon's triangles that are one corner of the mesh are neighbours in the list. Their
    /// groups' results are merged in the order of groups. Returns false when there is none.
    bool writeSlot(std::uint32_t slot, const std::uint8_t* first, const std::uint8_t* end,
                   const Tangents* results) const {
        std::uint8_t lowest = kNoGroup, highest = 0;
        for (const std::uint8_t* g = first; g != end; ++g) {
            if (*g == kNoGroup) continue;
            lowest = std::min(lowest, *g);
            highest = std::max(highest, *g);
        }
        if (lowest == kNoGroup) return false;
        Tangents merged = results[lowest];
        for (std::uint32_t next = lowest + 1u; next <= highest; ++next) {
            for (const std::uint8_t* g = first; g != end; ++g) {
                if (*g == next) merge(merged, results[next]);
            }
        }
        sink_.write(slot, merged);
        return true;
    }

    /// Returns how many corners get the default.
    std::uint64_t copyToDegenerate() {
        std::uint64_t defaults = 0;
        for (const auto& [copy, place] : corners_.copies) {
            if (state_[place] == kLeft) continue;
            const bool none = corners_.count(place) == 0;
            if (none) {
                sink_.write(copy.to, Tangents{});
            } else {
                const bool first = (copy.from & kMark) != 0;
                sink_.copy({copy.to, first ? slotOf(corners_.list[corners_.begin[place]]) : copy.from});
            }
            defaults += none || state_[place] == kFirstIsDefault ? 1 : 0;
        }
        return defaults;
    }

    /// Sine of the angle that vectors must keep from a plane: far more than rounding errors.
    static constexpr float kOffPlane = 0.02f;
    static constexpr float kLeastWeight = 1e-4f;  // below, a corner says too little about its direction

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    std::span<const std::uint32_t> chosen_;
    TangentOutput out_;
    float sign_factor_;
    Sink sink_;
    Parallel& parallel_;
    const Allocator* allocator_;
    bool may_split_;      // the angular test applies
    bool has_polygons_;   // several triangles may have one corner of the mesh
    bool tangents_only_;  // no more than tangents is asked for
    bool full_;           // results with bitangents and lengths
    bool is_small_;       // memory need not be asked for early

    UnclearCorners corners_;
    Buffer<std::uint8_t> state_;
    Marks contested_;  // empty when there are none
    Counts contested_counts_;
};

}  // namespace

WalkedNodes walkNodes(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                      const Nodes& nodes, std::span<const std::uint32_t> chosen,
                      std::span<const std::uint32_t> doubtful, const CornerSource& source,
                      CornerTermsFunction terms, NodeSums* sums, const TangentOutput& out,
                      Parallel& parallel) {
    return NodeWalk(mesh, options, triangles, nodes, chosen, out, parallel)
        .run(doubtful, source, terms, sums);
}

}  // namespace tspace::mikk
