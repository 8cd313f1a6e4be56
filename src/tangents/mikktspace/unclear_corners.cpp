// SPDX-License-Identifier: MIT
// Lists the corners of chosen nodes: finds the triangles around them, counts which node has how many,
// computes the triangles and puts their corners where they belong, gives each face one orientation, plans
// copies for corners of degenerate triangles.
#include "tangents/mikktspace/unclear_corners.h"

#include <algorithm>
#include <atomic>

#include "core/float4.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/triangle_pass.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kBlockGrain = 16, kTriangleGrain = 4096;
constexpr float kNothing[4] = {-0.0f, -0.0f, -0.0f, -0.0f};  // added to any number it leaves all its bits

class CornerReader {
  public:
    explicit CornerReader(const CornerReading& reading)
        : from_(reading),
          mesh_(reading.mesh),
          triangles_(reading.triangles),
          to_(reading.allocator),
          good_(reading.allocator) {}

    UnclearCorners run() {
        findTriangles();
        placeCorners();
        to_.flags = Buffer<std::uint8_t>(from_.allocator, count_);
        const std::size_t blocks = (count_ + kTermTriangles - 1) / kTermTriangles;
        std::atomic<std::uint64_t> degenerate{0}, flat{0}, mirrored{0};
        from_.parallel.forRanges(blocks, kBlockGrain, [&](std::size_t begin, std::size_t end) {
            Counts counts;
            readBlocks(begin, end, counts);
            degenerate += counts.degenerate;
            flat += counts.flat;
            mirrored += counts.mirrored;
        });
        to_.degenerate_count = degenerate;
        to_.no_uv_area_count = flat;
        to_.mirrored_count = mirrored;
        if (!triangles_.faces.empty()) uniteFaces();
        if (to_.degenerate_count != 0) planCopies();
        return std::move(to_);
    }

  private:
    struct Counts {
        std::uint64_t degenerate = 0, flat = 0, mirrored = 0;
    };

    /// The place of a node's second path holds its number in `chosen` from here on; what it held before is no
    /// such number, or that of another node.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t node) const {
        if (from_.sums == nullptr) return node;
        const std::uint32_t number = from_.sums->nodes[node].fan.leaves[1];
        return number < from_.chosen.size() && from_.chosen[number] == node ? number : kNone;
    }

    void findTriangles() {
        if (from_.sums != nullptr) to_.found = aroundChosen();
        count_ = from_.sums != nullptr ? to_.found.size() : triangles_.count;
        to_.nodes = Buffer<std::uint32_t>(from_.allocator, 3 * count_);
        withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
            const std::uint32_t* node_of =
                from_.nodes.of_vertex.empty() ? nullptr : from_.nodes.of_vertex.data();
            from_.parallel.forRanges(count_, kTriangleGrain, [&](std::size_t begin, std::size_t end) {
                for (std::size_t t = begin; t < end; ++t) {
                    const std::size_t first = 3 * std::size_t{to_.triangleOf(t)};
                    for (std::size_t k = 0; k < 3; ++k) {
                        const std::uint32_t v = vertexOf(first + k);
                        to_.nodes[3 * t + k] = node_of == nullptr ? v : node_of[v];
                    }
                }
            });
        });
    }

    Buffer<std::uint32_t> aroundChosen() {
        for (std::size_t i = 0; i < from_.chosen.size(); ++i)
            from_.sums->nodes[from_.chosen[i]].fan.leaves[1] = static_cast<std::uint32_t>(i);
        Marks at_nodes = noMarks(from_.allocator, from_.nodes.count);
        for (const std::uint32_t node : from_.chosen) at_nodes[node] = 1;
        return collectAround(mesh_, triangles_, from_.nodes, std::move(at_nodes), from_.allocator,
                             from_.parallel);
    }

    /// Degenerate triangles get places too: which those are is not known yet.
    void placeCorners() {
        const std::size_t node_count = from_.chosen.size();
        to_.at = Buffer<std::uint32_t>(from_.allocator, 3 * count_);
        to_.begin = Buffer<std::uint32_t>(from_.allocator, node_count);
        to_.end = Buffer<std::uint32_t>(from_.allocator, node_count + 1, 0u);
        std::uint32_t *end = to_.end.data(), *at = to_.at.data();
        if (from_.sums == nullptr) std::copy_n(to_.nodes.data(), 3 * count_, at);
        for (std::size_t i = 0; i < 3 * count_; ++i) {
            if (from_.sums != nullptr) at[i] = placeOf(to_.nodes[i]);
            ++end[at[i] == kNone ? node_count : at[i]];
        }
        std::uint32_t sum = 0;
        for (std::size_t place = 0; place < node_count; ++place) {
            const std::uint32_t size = end[place];
            to_.begin[place] = end[place] = sum;
            sum += size;
        }
        for (std::size_t i = 0; i < 3 * count_; ++i) {
            if (at[i] != kNone) at[i] = end[at[i]]++;
        }
        to_.corners = Buffer<UnclearCorner>(from_.allocator, sum);
        if (from_.sums == nullptr) return;
        places_ = Buffer<std::uint32_t>(from_.allocator, sum);
        for (std::size_t place = 0; place < node_count; ++place)
            std::fill(places_.data() + to_.begin[place], places_.data() + end[place],
                      static_cast<std::uint32_t>(place));
    }

    void readBlocks(std::size_t begin_block, std::size_t end_block, Counts& counts) {
        CornerTerms terms;
        if (from_.source.tangents_only) {  // else they are written
            std::fill_n(terms.t[0], 4 * kTermCorners, 0.0f);
            std::fill_n(terms.lengths_t[0], kTermCorners, 0.0f);
        }
        std::uint32_t own[kTermCorners] = {};
        for (std::size_t block = begin_block; block < end_block; ++block) {
            const std::size_t begin = block * kTermTriangles,
                              count = std::min(kTermTriangles, count_ - begin);
            const std::uint32_t *nodes = to_.nodes.data() + 3 * begin, *vertices = nodes;
            if (count < kTermTriangles || !from_.nodes.vertices.empty()) {
                for (std::size_t i = 0; i < 3 * count; ++i) own[i] = from_.nodes.vertex(nodes[i]);
                vertices = own;
            }
            from_.terms(from_.source, vertices, count, terms);
            counts.degenerate += terms.degenerate_count;
            counts.flat += terms.no_uv_area_count;
            counts.mirrored += terms.mirrored_count;
            keepTerms(terms, begin, count);
        }
    }

    void keepTerms(const CornerTerms& terms, std::size_t begin, std::size_t count) {
        const std::uint32_t *nodes = to_.nodes.data() + 3 * begin, *at = to_.at.data() + 3 * begin;
        const std::uint32_t* found = to_.found.empty() ? nullptr : to_.found.data() + begin;
        const std::uint32_t* places = places_.empty() ? nullptr : places_.data();
        const std::uint32_t* slots = triangles_.corners.empty() ? nullptr : triangles_.corners.data();
        UnclearCorner* corners = to_.corners.data();
        std::uint8_t* all_flags = to_.flags.data() + begin;
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t *n = nodes + 3 * t, *to = at + 3 * t;
            const auto number = static_cast<std::uint32_t>(begin + t);
            const std::uint32_t first = 3 * (found == nullptr ? number : found[t]);
            const std::uint8_t flags =
                flagsOf(terms.marks[0][t] | terms.marks[1][t] | terms.marks[2][t], number);
            all_flags[t] = flags;
            const bool flat = (flags & kAny) != 0;
            const std::uint32_t facing = facingBit(flags);
            const auto keep = [&](std::uint32_t k, std::uint32_t next, std::uint32_t previous) {
                if (to[k] == kNone) return;
                UnclearCorner& corner = corners[to[k]];
                storeFloat4(corner.s, loadFloat4(flat ? kNothing : terms.s[3 * t + k]));
                storeFloat4(corner.t, loadFloat4(flat ? kNothing : terms.t[3 * t + k]));
                corner.length_t = flat ? kNothing[0] : terms.lengths_t[k][t];
                corner.next = next;
                corner.previous = previous;
                corner.triangle = number;
                corner.slot = slots == nullptr ? first + k : slots[first + k];
                corner.place = places == nullptr ? n[k] : places[to[k]];
                corner.common = flat ? ~0u : terms.marks[k][t] | facing;
                corner.flags = flags;
            };
            keep(0, n[1], n[2]);
            keep(1, n[2], n[0]);
            keep(2, n[0], n[1]);
        }
    }

    static std::uint32_t facingBit(std::uint8_t flags) { return (flags & kPositive) != 0 ? kIsUp : kIsDown; }

    /// `marks`: what some corner of the triangle has. A triangle with a NaN has none of both orientations.
    [[nodiscard]] std::uint8_t flagsOf(std::uint32_t marks, std::size_t t) const {
        if ((marks & kDegenerateMark) != 0) return kDegenerate;
        if ((marks & kNoUvArea) != 0) return kAny;
        const bool known = (marks & (kFacesUp | kFacesDown)) != 0;
        return (known ? (marks & kFacesUp) != 0 : uvArea(t) > 0) ? std::uint8_t{kPositive} : std::uint8_t{0};
    }

    [[nodiscard]] float uvArea(std::size_t t) const {
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) uv[k] = mesh_.uvs[from_.nodes.vertex(to_.nodes[3 * t + k])];
        const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
        return a.x * b.y - a.y * b.x;
    }

    [[nodiscard]] std::uint32_t faceOf(std::size_t t) const { return triangles_.faces[to_.triangleOf(t)]; }

    /// One orientation for each face. All triangles of a face that does not simply agree have been found; of
    /// another face, a part may be here.
    void uniteFaces() {
        for (std::size_t t = 1; t < count_;) {
            if (to_.flags[t] == to_.flags[t - 1] || faceOf(t) != faceOf(t - 1)) {
                ++t;
                continue;
            }
            std::size_t first = t - 1;
            while (first > 0 && faceOf(first - 1) == faceOf(t)) --first;
            while (t < count_ && faceOf(t) == faceOf(first)) ++t;
            if (isWhole(first, t)) uniteFace(first, t);
        }
    }

    [[nodiscard]] bool isWhole(std::size_t first, std::size_t end) const {
        const std::size_t before = to_.triangleOf(first), after = std::size_t{to_.triangleOf(end - 1)} + 1;
        const std::uint32_t face = triangles_.faces[before];
        return (before == 0 || triangles_.faces[before - 1] != face) &&
               (after == triangles_.count || triangles_.faces[after] != face);
    }

    /// Degenerate triangles have no say.
    void uniteFace(std::size_t first, std::size_t end) {
        good_.drop(good_.size());
        bool up = false, down = false;
        for (std::size_t t = first; t < end; ++t) {
            const std::uint32_t flags = to_.flags[t];
            if ((flags & kDegenerate) != 0) continue;
            good_.push(static_cast<std::uint32_t>(t));
            up |= flags == kPositive;
            down |= flags == 0;
        }
        const auto isAny = [&](std::size_t i) { return (to_.flags[good_[i]] & kAny) != 0; };
        const bool flat_one_may_choose = good_.size() == 2 && isAny(0) && (up || down);
        if (!(up && down) && !flat_one_may_choose) return;
        const std::size_t chosen = orientingTriangle(0, good_.size(), isAny, [&](std::size_t i) {
            const float area = uvArea(good_[i]);
            return area < 0 ? -area : area;
        });
        const std::uint32_t orientation = uvArea(good_[chosen]) > 0 ? kPositive : 0;
        for (const std::uint32_t t : good_) {
            const auto flags = static_cast<std::uint8_t>((to_.flags[t] & ~unsigned{kPositive}) | orientation);
            to_.flags[t] = flags;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t at = to_.at[3 * std::size_t{t} + k];
                if (at == kNone) continue;
                UnclearCorner& corner = to_.corners[at];
                corner.flags = flags;
                if ((flags & kAny) == 0)
                    corner.common = (corner.common & ~(kIsUp | kIsDown)) | facingBit(flags);
            }
        }
    }

    /// The rule of triangle_pass.cpp. All corners of degenerate triangles are at chosen nodes.
    void planCopies() {
        to_.entangled = noMarks(from_.allocator, from_.chosen.size());
        Buffer<std::uint8_t> done;  // of polygons' corners: 1 has a good triangle, 2 is planned
        if (!triangles_.faces.empty()) {
            done = Buffer<std::uint8_t>(from_.allocator, mesh_.cornerCount(), std::uint8_t{0});
            for (std::size_t t = 0; t < count_; ++t) {
                if ((to_.flags[t] & kDegenerate) != 0) continue;
                for (std::uint32_t k = 0; k < 3; ++k) done[slot(t, k)] = 1;
            }
        }
        for (std::size_t t = 0; t < count_; ++t) {
            if ((to_.flags[t] & kDegenerate) == 0) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t to = slot(t, k), place = placeAt(t, k);
                std::uint32_t from = kMark | place;
                if (!done.empty()) {
                    if (done[to] != 0) continue;
                    done[to] = 2;
                    from = copiedInFace(t, k, from, done);
                }
                to_.copies.push({{to, from}, place});
            }
        }
    }

    /// The corner at the same position in the same triangle, if a good triangle of its face has it too.
    std::uint32_t copiedInFace(std::size_t t, std::uint32_t k, std::uint32_t otherwise,
                               const Buffer<std::uint8_t>& done) {
        const auto position = [&](std::uint32_t corner) { return mesh_.positions[mesh_.indices[corner]]; };
        for (std::uint32_t j = 1; j < 3; ++j) {
            const std::uint32_t other = slot(t, (k + j) % 3), place = placeAt(t, (k + j) % 3);
            if (done[other] != 1 || !(position(other) == position(slot(t, k)))) continue;
            const std::uint32_t own = placeAt(t, k);
            if (place == own) {
                to_.entangled[own] = std::max(to_.entangled[own], UnclearCorners::kSameNode);
            } else {
                to_.entangled[own] = to_.entangled[place] = UnclearCorners::kOtherNode;
            }
            return other;
        }
        return otherwise;
    }

    [[nodiscard]] std::uint32_t slot(std::size_t t, std::uint32_t k) const {
        return triangles_.corner(3 * std::size_t{to_.triangleOf(t)} + k);
    }
    [[nodiscard]] std::uint32_t placeAt(std::size_t t, std::uint32_t k) const {
        return to_.corners[to_.at[3 * t + k]].place;
    }

    const CornerReading& from_;
    const MeshView& mesh_;
    const TriangleList& triangles_;
    UnclearCorners to_;
    std::size_t count_ = 0;         // of triangles
    Buffer<std::uint32_t> places_;  // of each corner; empty: places are nodes
    Growing<std::uint32_t> good_;   // of one face
};

}  // namespace

void UnclearCorners::dropDegenerate(std::size_t place) {
    std::uint32_t to = begin[place];
    for (std::uint32_t i = to; i < end[place]; ++i) {
        if ((corners[i].flags & kDegenerate) != 0) continue;
        if (to != i) corners[to] = corners[i];
        ++to;
    }
    end[place] = to;
}

UnclearCorners readCorners(const CornerReading& reading) { return CornerReader(reading).run(); }

}  // namespace tspace::mikk
