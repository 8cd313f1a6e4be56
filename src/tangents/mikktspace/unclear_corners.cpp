// SPDX-License-Identifier: MIT
// Lists the corners of chosen nodes: finds the triangles around them, computes those once more, gives each
// face one orientation, plans copies for corners of degenerate triangles.
#include "tangents/mikktspace/unclear_corners.h"

#include <algorithm>

#include "core/vec_math.h"
#include "tangents/mikktspace/triangle_pass.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kBlockGrain = 16;

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
        withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
            const std::size_t blocks = (to_.found.size() + kTermTriangles - 1) / kTermTriangles;
            from_.parallel.forRanges(blocks, kBlockGrain, [&](std::size_t begin, std::size_t end) {
                readTriangles(begin, end, vertexOf);
            });
        });
        if (!triangles_.faces.empty()) uniteFaces();
        listCorners();
        if (has_degenerate_) planCopies();
        return std::move(to_);
    }

  private:
    /// The place of a node's second path holds its number in `chosen` from here on; what it held before is no
    /// such number, or that of another node.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t node) const {
        if (from_.sums == nullptr) return node;
        const std::uint32_t number = from_.sums->nodes[node].fan.leaves[1];
        return number < from_.chosen.size() && from_.chosen[number] == node ? number : kNone;
    }

    void findTriangles() {
        to_.found = from_.sums == nullptr ? numbersBelow(triangles_.count, from_.allocator) : aroundChosen();
        const std::size_t count = to_.found.size(), corners = 3 * count;
        to_.triangles = Buffer<FoundTriangle>(from_.allocator, count);
        to_.places = Buffer<std::uint32_t>(from_.allocator, corners);
        to_.marks = Buffer<std::uint16_t>(from_.allocator, corners);
        to_.directions = Buffer<Directions>(from_.allocator, corners);
        if (from_.with_lengths) to_.lengths_t = Buffer<float>(from_.allocator, corners);
    }

    Buffer<std::uint32_t> aroundChosen() {
        for (std::size_t i = 0; i < from_.chosen.size(); ++i)
            from_.sums->nodes[from_.chosen[i]].fan.leaves[1] = static_cast<std::uint32_t>(i);
        Marks at_nodes = noMarks(from_.allocator, from_.nodes.count);
        for (const std::uint32_t node : from_.chosen) at_nodes[node] = 1;
        return collectAround(mesh_, triangles_, from_.nodes, std::move(at_nodes), from_.allocator,
                             from_.parallel);
    }

    template <class VertexOf>
    void readTriangles(std::size_t begin_block, std::size_t end_block, const VertexOf& vertexOf) {
        CornerTerms terms;
        if (from_.source.tangents_only)
            std::fill_n(terms.t[0], 4 * kTermCorners, 0.0f);  // else they are written
        std::uint32_t vertices[kTermCorners] = {};
        for (std::size_t block = begin_block; block < end_block; ++block) {
            const std::size_t begin = block * kTermTriangles,
                              count = std::min(kTermTriangles, to_.found.size() - begin);
            for (std::size_t t = 0; t < count; ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t v = vertexOf(3 * std::size_t{to_.found[begin + t]} + k),
                                        node = from_.nodes.ofVertex(v);
                    vertices[3 * t + k] = from_.nodes.mixed ? from_.nodes.vertex(node) : v;
                    to_.triangles[begin + t].nodes[k] = node;
                    to_.places[3 * (begin + t) + k] = placeOf(node);
                }
            }
            from_.terms(from_.source, vertices, count, terms);
            keepTerms(terms, begin, count);
        }
    }

    void keepTerms(const CornerTerms& terms, std::size_t begin, std::size_t count) {
        for (std::size_t i = 0; i < 3 * count; ++i) {
            std::copy_n(terms.s[i], 4, to_.directions[3 * begin + i].s.at);
            std::copy_n(terms.t[i], 4, to_.directions[3 * begin + i].t.at);
        }
        for (std::size_t t = 0; t < count; ++t) {
            std::uint32_t any = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                to_.marks[3 * (begin + t) + k] = static_cast<std::uint16_t>(terms.marks[k][t]);
                any |= terms.marks[k][t];
                if (!to_.lengths_t.empty()) to_.lengths_t[3 * (begin + t) + k] = terms.lengths_t[k][t];
            }
            to_.triangles[begin + t].flags = flagsOf(any, begin + t);
        }
    }

    /// `marks`: what some corner of the triangle has. A triangle with a NaN has none of both orientations.
    [[nodiscard]] std::uint32_t flagsOf(std::uint32_t marks, std::size_t t) const {
        if ((marks & kDegenerateMark) != 0) return kDegenerate;
        if ((marks & kNoUvArea) != 0) return kAny;
        const bool known = (marks & (kFacesUp | kFacesDown)) != 0;
        return (known ? (marks & kFacesUp) != 0 : uvArea(t) > 0) ? std::uint32_t{kPositive} : 0;
    }

    [[nodiscard]] float uvArea(std::size_t t) const {
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) uv[k] = mesh_.uvs[from_.nodes.vertex(to_.triangles[t].nodes[k])];
        const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
        return a.x * b.y - a.y * b.x;
    }

    /// One orientation for each face. All triangles of a face that does not simply agree have been found; of
    /// another face, a part may be here.
    void uniteFaces() {
        for (std::size_t first = 0; first < to_.found.size();) {
            const std::uint32_t face = triangles_.faces[to_.found[first]];
            std::size_t end = first + 1;
            while (end < to_.found.size() && triangles_.faces[to_.found[end]] == face) ++end;
            if (end - first > 1 && isWhole(first, end)) uniteFace(first, end);
            first = end;
        }
    }

    [[nodiscard]] bool isWhole(std::size_t first, std::size_t end) const {
        const std::size_t before = to_.found[first], after = std::size_t{to_.found[end - 1]} + 1;
        const std::uint32_t face = triangles_.faces[before];
        return (before == 0 || triangles_.faces[before - 1] != face) &&
               (after == triangles_.count || triangles_.faces[after] != face);
    }

    /// Degenerate triangles have no say.
    void uniteFace(std::size_t first, std::size_t end) {
        good_.drop(good_.size());
        bool up = false, down = false;
        for (std::size_t t = first; t < end; ++t) {
            const std::uint32_t flags = to_.triangles[t].flags;
            if ((flags & kDegenerate) != 0) continue;
            good_.push(static_cast<std::uint32_t>(t));
            up |= flags == kPositive;
            down |= flags == 0;
        }
        const auto isAny = [&](std::size_t i) { return (to_.triangles[good_[i]].flags & kAny) != 0; };
        const bool flat_one_may_choose = good_.size() == 2 && isAny(0) && (up || down);
        if (!(up && down) && !flat_one_may_choose) return;
        const std::size_t chosen = orientingTriangle(0, good_.size(), isAny, [&](std::size_t i) {
            const float area = uvArea(good_[i]);
            return area < 0 ? -area : area;
        });
        const std::uint32_t orientation = uvArea(good_[chosen]) > 0 ? kPositive : 0;
        for (const std::uint32_t t : good_)
            to_.triangles[t].flags = (to_.triangles[t].flags & ~std::uint32_t{kPositive}) | orientation;
    }

    void listCorners() {
        to_.begin = Buffer<std::uint32_t>(from_.allocator, from_.chosen.size() + 2, 0u);
        const auto forEachCorner = [&](const auto& body) {
            for (std::size_t t = 0; t < to_.found.size(); ++t) {
                if ((to_.triangles[t].flags & kDegenerate) != 0) continue;
                for (std::size_t k = 0; k < 3; ++k) {
                    if (to_.places[3 * t + k] != kNone) body(4 * t + k, to_.places[3 * t + k]);
                }
            }
        };
        forEachCorner([&](std::size_t, std::uint32_t place) { ++to_.begin[place + 2]; });
        for (std::size_t i = 2; i < to_.begin.size(); ++i) to_.begin[i] += to_.begin[i - 1];
        to_.list = Buffer<std::uint32_t>(from_.allocator, to_.begin[from_.chosen.size() + 1]);
        forEachCorner([&](std::size_t corner, std::uint32_t place) {
            to_.list[to_.begin[place + 1]++] = static_cast<std::uint32_t>(corner);
        });
        for (const FoundTriangle& t : to_.triangles) has_degenerate_ |= (t.flags & kDegenerate) != 0;
    }

    /// The rule of triangle_pass.cpp. All corners of degenerate triangles are at chosen nodes.
    void planCopies() {
        to_.entangled = noMarks(from_.allocator, from_.chosen.size());
        Buffer<std::uint8_t> done;  // of polygons' corners: 1 has a good triangle, 2 is planned
        if (!triangles_.faces.empty()) {
            done = Buffer<std::uint8_t>(from_.allocator, mesh_.cornerCount(), std::uint8_t{0});
            for (std::size_t t = 0; t < to_.found.size(); ++t) {
                if ((to_.triangles[t].flags & kDegenerate) != 0) continue;
                for (std::uint32_t k = 0; k < 3; ++k) done[slot(t, k)] = 1;
            }
        }
        for (std::size_t t = 0; t < to_.found.size(); ++t) {
            if ((to_.triangles[t].flags & kDegenerate) == 0) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t to = slot(t, k), place = to_.places[3 * t + k];
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
        const auto at = [&](std::uint32_t corner) { return mesh_.positions[mesh_.indices[corner]]; };
        for (std::uint32_t j = 1; j < 3; ++j) {
            const std::uint32_t other = slot(t, (k + j) % 3), place = to_.places[3 * t + (k + j) % 3];
            if (done[other] != 1 || !(at(other) == at(slot(t, k)))) continue;
            const std::uint32_t own = to_.places[3 * t + k];
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
        return to_.slot(triangles_, static_cast<std::uint32_t>(4 * t + k));
    }

    const CornerReading& from_;
    const MeshView& mesh_;
    const TriangleList& triangles_;
    UnclearCorners to_;
    Growing<std::uint32_t> good_;  // of one face
    bool has_degenerate_ = false;
};

}  // namespace

UnclearCorners readCorners(const CornerReading& reading) { return CornerReader(reading).run(); }

}  // namespace tspace::mikk
