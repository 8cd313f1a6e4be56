// SPDX-License-Identifier: MIT
// Lists the corners of chosen nodes: finds the triangles around them, computes them, gives each face one
// orientation, counts which node has how many, puts corners where they belong, plans copies for corners of
// degenerate triangles.
#include "tangents/mikktspace/vertex_corners.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/float4.h"
#include "core/vec_math.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kBlockGrain = 16;
constexpr float kNothing[4] = {-0.0f, -0.0f, -0.0f, -0.0f};  // added to any number it leaves all its bits

class CornerReader {
  public:
    explicit CornerReader(const CornerReading& reading)
        : from_(reading),
          mesh_(reading.mesh),
          triangles_(reading.triangles),
          to_(reading.allocator),
          good_(reading.allocator) {}

    VertexCorners run() {
        if (from_.sums != nullptr) to_.found = aroundChosen();
        count_ = from_.sums != nullptr ? to_.found.size() : triangles_.count;
        readTriangles();
        if (!triangles_.faces.empty()) uniteFaces();
        countCorners();
        makeRoom();
        placeCorners();
        if (to_.degenerate_count != 0) planCopies();
        return std::move(to_);
    }

  private:
    struct Counts {
        std::uint64_t degenerate = 0, degenerate_uvs = 0, mirrored = 0;
    };

    Buffer<std::uint32_t> aroundChosen() {
        for (std::size_t i = 0; i < from_.chosen.size(); ++i)
            from_.sums->setNumber(from_.chosen[i], static_cast<std::uint32_t>(i));
        Marks at_nodes = noMarks(from_.allocator, from_.nodes.count);
        for (const std::uint32_t node : from_.chosen) at_nodes[node] = 1;
        const Nodes& nodes = from_.nodes;
        return collectTriangles(
            mesh_, triangles_, from_.blocks, [&](std::uint32_t v) { return at_nodes[nodes.ofVertex(v)]; }, 1,
            from_.allocator, from_.parallel);
    }

    /// A node's row holds its number in `chosen` from here on; what it held before is no such number, or that of
    /// another node.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t node) const {
        const std::uint32_t number = from_.sums->number(node);
        return number < from_.chosen.size() && from_.chosen[number] == node
                   ? number
                   : static_cast<std::uint32_t>(from_.chosen.size());
    }

    void readTriangles() {
        to_.nodes = Buffer<std::uint32_t>(from_.allocator, 3 * count_);
        if (from_.sums != nullptr) to_.places = Buffer<std::uint32_t>(from_.allocator, 3 * count_);
        to_.flags = Buffer<std::uint8_t>(from_.allocator, count_);
        to_.terms = Buffer<CornerTerms>(from_.allocator, (count_ + kTermTriangles - 1) / kTermTriangles);
        std::atomic<std::uint64_t> degenerate{0}, degenerate_uvs{0}, mirrored{0};
        from_.parallel.forRanges(to_.terms.size(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
            Counts counts;
            for (std::size_t block = begin; block < end; ++block) readBlock(block, counts);
            degenerate += counts.degenerate;
            degenerate_uvs += counts.degenerate_uvs;
            mirrored += counts.mirrored;
        });
        to_.degenerate_count = degenerate;
        to_.no_uv_area_count = degenerate_uvs;
        to_.mirrored_count = mirrored;
    }

    void readBlock(std::size_t block, Counts& counts) {
        const std::size_t begin = block * kTermTriangles, count = std::min(kTermTriangles, count_ - begin);
        std::uint32_t vertices[kTermCorners];
        if (to_.found.empty()) {
            const std::uint32_t* read = mikk::readTriangles(mesh_, triangles_, begin, count, vertices);
            if (read != vertices) std::copy_n(read, 3 * count, vertices);
        } else {
            for (std::size_t t = 0; t < count; ++t) {
                const std::size_t first = 3 * std::size_t{to_.found[begin + t]};
                for (std::size_t k = 0; k < 3; ++k) vertices[3 * t + k] = mesh_.indices[triangles_.corner(first + k)];
            }
        }
        // The rest of the block may be any vertex; a block has one triangle at least.
        std::fill(vertices + 3 * count, vertices + kTermCorners, vertices[0]);
        readNodes(3 * begin, 3 * count, vertices);
        CornerTerms& terms = to_.terms[block];
        from_.terms(from_.source, vertices, count, terms);
        counts.degenerate += terms.degenerate_count;
        counts.degenerate_uvs += terms.no_uv_area_count;
        counts.mirrored += terms.mirrored_count;
        std::uint8_t* flags = to_.flags.data() + begin;
        for (std::size_t t = 0; t < count; ++t) {
            flags[t] = flagsOf(terms.marks[0][t] | terms.marks[1][t] | terms.marks[2][t], begin + t);
            if ((flags[t] & kAny) != 0) clearRows(terms, t);
        }
    }

    static void clearRows(CornerTerms& terms, std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) {
            storeFloat4(terms.s[3 * t + k], loadFloat4(kNothing));
            storeFloat4(terms.t[3 * t + k], loadFloat4(kNothing));
            terms.lengths_t[k][t] = kNothing[0];
        }
    }

    /// And takes those vertices whose data stand for the nodes.
    void readNodes(std::size_t first, std::size_t count, std::uint32_t* vertices) {
        const Nodes& map = from_.nodes;
        std::uint32_t* nodes = to_.nodes.data() + first;
        if (map.ofVertices(vertices, count, nodes) == vertices) std::copy_n(vertices, count, nodes);
        for (std::size_t i = 0; map.mixed && i < count; ++i) vertices[i] = map.vertex(nodes[i]);
        if (to_.places.empty()) return;
        for (std::size_t i = 0; i < count; ++i) to_.places[first + i] = placeOf(nodes[i]);
    }

    /// Corners of all triangles but degenerate ones.
    void countCorners() {
        const std::size_t place_count = from_.chosen.size() + 1;
        to_.facing = noMarks(from_.allocator, place_count);
        to_.end = Buffer<std::uint32_t>(from_.allocator, place_count, 0u);
        std::uint8_t* facing = to_.facing.data();
        std::uint32_t* sizes = to_.end.data();
        const std::uint8_t* flags = to_.flags.data();
        const std::uint32_t* places = to_.placesOf(0);
        const std::size_t count = count_;
        for (std::size_t t = 0; t < count; ++t, places += 3) {
            if ((flags[t] & kDegenerate) != 0) continue;
            const std::uint8_t here = facingOf(flags[t]);
            for (std::size_t k = 0; k < 3; ++k) {
                ++sizes[places[k]];
                facing[places[k]] |= here;
            }
        }
        facing[place_count - 1] = 0;
    }

    void makeRoom() {
        const std::size_t place_count = from_.chosen.size();
        to_.begin = Buffer<std::uint32_t>(from_.allocator, place_count);
        std::uint32_t *begin = to_.begin.data(), *end = to_.end.data(), sum = 0;
        for (std::size_t place = 0; place < place_count; ++place) {
            const std::uint32_t size = end[place];
            begin[place] = end[place] = sum;
            sum += size;
        }
        to_.corners = Buffer<NodeCorner>(from_.allocator, sum);
    }

    void placeCorners() {
        const auto nowhere = static_cast<std::uint32_t>(from_.chosen.size());
        const std::uint32_t* slots = triangles_.corners.empty() ? nullptr : triangles_.corners.data();
        const std::uint32_t* found = to_.found.empty() ? nullptr : to_.found.data();
        std::uint32_t* ends = to_.end.data();
        NodeCorner* corners = to_.corners.data();
        for (std::size_t begin = 0; begin < count_; begin += kTermTriangles) {
            const CornerTerms& terms = to_.terms[begin / kTermTriangles];
            const std::size_t count = std::min(kTermTriangles, count_ - begin);
            const std::uint32_t *n = to_.nodes.data() + 3 * begin, *places = to_.placesOf(begin);
            const std::uint8_t* flags = to_.flags.data() + begin;
            for (std::size_t t = 0; t < count; ++t, n += 3, places += 3) {
                if ((flags[t] & kDegenerate) != 0) continue;
                const std::uint32_t first =
                    3 * (found == nullptr ? static_cast<std::uint32_t>(begin + t) : found[begin + t]);
                const std::uint32_t orientation = orientationOf(flags[t]);
                const auto place = [&](std::uint32_t k, std::uint32_t next, std::uint32_t previous) {
                    if (places[k] == nowhere) return;
                    corners[ends[places[k]]++] = {terms.s[3 * t + k], next, previous,
                                                  slots == nullptr ? first + k : slots[first + k],
                                                  terms.marks[k][t] | orientation};
                };
                place(0, n[1], n[2]);
                place(1, n[2], n[0]);
                place(2, n[0], n[1]);
            }
        }
    }

    static std::uint8_t facingOf(std::uint8_t flags) {
        const std::uint32_t facing = (flags & kPositive) != 0 ? kFacesUp : kFacesDown;
        return static_cast<std::uint8_t>((flags & kAny) != 0 ? 0 : facing);
    }
    static std::uint32_t orientationOf(std::uint8_t flags) {
        const std::uint32_t orientation = (flags & kPositive) != 0 ? kIsUp : kIsDown;
        return (flags & kAny) != 0 ? NodeCorner::kAddsNothing : orientation;
    }

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
        const bool degenerate_uv_may_choose = good_.size() == 2 && isAny(0) && (up || down);
        if (!(up && down) && !degenerate_uv_may_choose) return;
        const std::uint32_t orientation = uvArea(orientingTriangle()) > 0 ? kPositive : 0;
        for (const std::uint32_t t : good_) {
            to_.flags[t] = static_cast<std::uint8_t>((to_.flags[t] & ~unsigned{kPositive}) | orientation);
        }
    }

    [[nodiscard]] bool isAny(std::size_t i) const { return (to_.flags[good_[i]] & kAny) != 0; }

    /// In a quad the first, unless the second has a usable UV area and the first's is not at least as large; in an n-gon
    /// the largest that has a usable one.
    [[nodiscard]] std::size_t orientingTriangle() const {
        const auto area = [&](std::size_t i) { return std::fabs(uvArea(good_[i])); };
        if (good_.size() == 2) return good_[!isAny(1) && !(area(0) >= area(1)) ? 1 : 0];
        std::size_t chosen = 0;
        for (std::size_t i = 1; i < good_.size(); ++i) {
            if (!isAny(i) && (isAny(chosen) || area(i) > area(chosen))) chosen = i;
        }
        return good_[chosen];
    }

    /// Corners that only degenerate triangles have. Where a face has good triangles too, such a corner takes the result of
    /// the corner at its own position in the same face; else that of the first good corner of its node. (The reference
    /// searches the face's good triangle for the position; in a quad there is only one such corner.) All corners of
    /// degenerate triangles are at chosen nodes.
    void planCopies() {
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
                const std::uint32_t to = slot(t, k);
                std::uint32_t from = kNone;
                if (!done.empty()) {
                    if (done[to] != 0) continue;
                    done[to] = 2;
                    from = copiedInFace(t, k, done);
                }
                const std::span<const NodeCorner> around = to_.around(to_.placesOf(t)[k]);
                if (from == kNone && !around.empty()) from = around[0].slot;
                to_.copies.push({to, from});
            }
        }
    }

    /// The corner at the same position in the same triangle, if a good triangle of its face has it too; else kNone.
    std::uint32_t copiedInFace(std::size_t t, std::uint32_t k, const Buffer<std::uint8_t>& done) const {
        const auto position = [&](std::uint32_t corner) { return mesh_.positions[mesh_.indices[corner]]; };
        for (std::uint32_t j = 1; j < 3; ++j) {
            const std::uint32_t other = slot(t, (k + j) % 3);
            if (done[other] == 1 && position(other) == position(slot(t, k))) return other;
        }
        return kNone;
    }

    [[nodiscard]] std::uint32_t slot(std::size_t t, std::uint32_t k) const {
        return triangles_.corner(3 * std::size_t{to_.triangleOf(t)} + k);
    }

    const CornerReading& from_;
    const MeshView& mesh_;
    const TriangleList& triangles_;
    VertexCorners to_;
    std::size_t count_ = 0;        // of triangles
    Growing<std::uint32_t> good_;  // of one face
};

}  // namespace

VertexCorners readCorners(const CornerReading& reading) { return CornerReader(reading).run(); }

}  // namespace tspace::mikk
