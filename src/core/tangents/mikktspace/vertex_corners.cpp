// SPDX-License-Identifier: MIT
// Lists the corners of chosen nodes: finds the triangles around them, computes their terms, gives each face one orientation,
// sorts corners by node (a counting sort), and plans copies for corners of degenerate triangles.
#include "core/tangents/mikktspace/vertex_path.h"

#include <algorithm>
#include <cmath>

#include "core/base/float4.h"
#include "core/base/vec_math.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kBlockGrain = 16;

class CornerReader {
  public:
    explicit CornerReader(const VertexPath& path)
        : path_(path),
          in_(path.setting),
          source_(cornerSource({in_.mesh.positions, in_.mesh.normals}, in_.mesh.uvs, in_.options.method, false)),
          terms_(cornerTermsFor(in_.options.execution.simd)),
          allocator_(in_.options.execution.allocator),
          by_node_(in_, nullptr),
          to_(allocator_),
          good_(allocator_) {
        source_.adding_only = true;
        if (path.use == PlanUse::kept && !in_.maySplit()) source_.weighting = Weighting::none;
    }

    VertexCorners run() {
        if (!path_.are_all) findTriangles();
        count_ = path_.are_all ? in_.triangles.count : to_.found.size();
        readTriangles();
        if (!in_.triangles.faces.empty()) uniteFaces();
        countCorners();
        placeCorners();
        if (to_.report.degenerate_triangle_count != 0) planCopies();
        return std::move(to_);
    }

  private:
    void findTriangles() {
        place_of_ = Buffer<std::uint32_t>(allocator_, in_.nodes.count, kNone);
        for (std::uint32_t i = 0; i < path_.chosen.size(); ++i) place_of_[path_.chosen[i]] = i;
        const auto markOf = [places = place_of_.data(), nodes = in_.nodes.of_vertex.data()](std::uint32_t vertex) {
            return ~places[nodes == nullptr ? vertex : nodes[vertex]];
        };
        to_.found = collectTriangles(in_.mesh, in_.triangles, markOf, ~0u, allocator_, path_.parallel);
    }

    void readTriangles() {
        to_.nodes = Buffer<std::uint32_t>(allocator_, 3 * count_);
        if (!path_.are_all) to_.places = Buffer<std::uint32_t>(allocator_, 3 * count_);
        to_.flags = Buffer<std::uint8_t>(allocator_, count_);
        to_.terms = Buffer<CornerTerms>(allocator_, (count_ + kTermTriangles - 1) / kTermTriangles);
        path_.parallel.forRanges(to_.terms.size(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t block = begin; block < end; ++block) readBlock(block);
        });
        for (const std::uint8_t flags : to_.flags) {
            to_.report.degenerate_triangle_count += flags == kDegenerate ? 1 : 0;
            to_.report.degenerate_uv_count += flags == kAny ? 1 : 0;
            to_.report.mirrored_count += flags == kFacesDown ? 1 : 0;
        }
    }

    void readBlock(std::size_t block) {
        const std::size_t begin = block * kTermTriangles, count = std::min(kTermTriangles, count_ - begin);
        std::uint32_t vertices[kTermCorners], *nodes = to_.nodes.data() + 3 * begin;
        if (path_.are_all) {
            by_node_.read(begin, count, vertices, nodes);
        } else {
            by_node_.readSome(to_.found.data() + begin, count, vertices, nodes);
            std::uint32_t* const places = to_.places.data() + 3 * begin;
            const auto nowhere = static_cast<std::uint32_t>(path_.chosen.size());
            for (std::size_t i = 0; i < 3 * count; ++i) places[i] = std::min(place_of_[nodes[i]], nowhere);
        }
        // Kernels read whole blocks, so the rest of the block needs valid vertices. A block has at least one triangle.
        std::fill(vertices + 3 * count, vertices + kTermCorners, vertices[0]);
        CornerTerms& terms = to_.terms[block];
        terms_(source_, vertices, count, terms);
        std::uint8_t* flags = to_.flags.data() + begin;
        for (std::size_t t = 0; t < count; ++t) flags[t] = flagsOf(terms.marks[0][t]);
    }

    /// Counts the corners of each node, without those of degenerate triangles, and allocates their list.
    void countCorners() {
        const std::size_t chosen_count = path_.chosen.size();
        to_.facing = noMarks(allocator_, chosen_count + 1);
        to_.begin = Buffer<std::uint32_t>(allocator_, chosen_count + 3, 0u);
        std::uint8_t* facing = to_.facing.data();
        std::uint32_t *begin = to_.begin.data(), *sizes = begin + 2;
        const std::uint8_t* flags = to_.flags.data();
        const std::uint32_t* places = to_.placesOf(0);
        const std::size_t count = count_;
        for (std::size_t t = 0; t < count; ++t, places += 3) {
            const std::uint8_t of_triangle = flags[t];
            if ((of_triangle & kDegenerate) != 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                ++sizes[places[k]];
                facing[places[k]] |= of_triangle & kFacing;
            }
        }
        facing[chosen_count] = 0;
        // begin[place + 1] now becomes where the place begins; placeCorners moves it to where the place ends.
        for (std::size_t place = 0; place < chosen_count; ++place) begin[place + 2] += begin[place + 1];
        to_.corners = Buffer<NodeCorner>(allocator_, begin[chosen_count + 1]);
    }

    void placeCorners() {
        const auto nowhere = static_cast<std::uint32_t>(path_.chosen.size());
        std::uint32_t* const ends = to_.begin.data() + 1;
        NodeCorner* const corners = to_.corners.data();
        const std::uint32_t *n = to_.nodes.data(), *places = to_.placesOf(0);
        const std::uint8_t* const all_flags = to_.flags.data();
        const CornerTerms* const terms = to_.terms.data();
        const auto count = static_cast<std::uint32_t>(3 * count_);
        for (std::uint32_t h = 0; h < count; h += 3, n += 3, places += 3) {
            const std::uint32_t flags = all_flags[h / 3], facing = flags & kFacing;
            if ((flags & kDegenerate) != 0) continue;
            const float(*const rows)[4] = terms[h / kTermCorners].s + h % kTermCorners;
            if (places[0] != nowhere) corners[ends[places[0]]++] = {rows[0], h, n[1], n[2], facing};
            if (places[1] != nowhere) corners[ends[places[1]]++] = {rows[1], h + 1, n[2], n[0], facing};
            if (places[2] != nowhere) corners[ends[places[2]]++] = {rows[2], h + 2, n[0], n[1], facing};
        }
    }

    static std::uint8_t flagsOf(std::uint32_t marks) {
        if ((marks & kDegenerateMark) != 0) return kDegenerate;
        if ((marks & kNoUvArea) != 0) return kAny;
        return (marks & kMirroredMark) != 0 ? kFacesDown : kFacesUp;
    }

    [[nodiscard]] float uvArea(std::size_t t) const {
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) uv[k] = in_.mesh.uvs[in_.nodes.vertex(to_.nodes[3 * t + k])];
        const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
        return a.x * b.y - a.y * b.x;
    }

    [[nodiscard]] std::uint32_t faceOf(std::size_t t) const { return in_.triangles.faces[to_.triangleOf(t)]; }

    /// Gives all triangles of a face one orientation. Of faces whose triangles differ, all triangles have been found.
    void uniteFaces() {
        for (std::size_t t = 1; t < count_;) {
            if (to_.flags[t] == to_.flags[t - 1] || faceOf(t) != faceOf(t - 1)) {
                ++t;
                continue;
            }
            std::size_t first = t - 1;
            while (first > 0 && faceOf(first - 1) == faceOf(t)) --first;
            while (t < count_ && faceOf(t) == faceOf(first)) ++t;
            uniteFace(first, t);
        }
    }

    /// Degenerate triangles do not take part.
    void uniteFace(std::size_t first, std::size_t end) {
        good_.drop(good_.size());
        std::uint32_t facing = 0;
        for (std::size_t t = first; t < end; ++t) {
            if ((to_.flags[t] & kDegenerate) != 0) continue;
            good_.push(static_cast<std::uint32_t>(t));
            facing |= to_.flags[t] & kFacing;
        }
        const bool degenerate_uv_may_choose = good_.size() == 2 && isAny(0) && facing != 0;
        if (facing != kFacing && !degenerate_uv_may_choose) return;
        const std::uint8_t orientation = uvArea(orientingTriangle()) > 0 ? kFacesUp : kFacesDown;
        for (const std::uint32_t t : good_) {
            if ((to_.flags[t] & kAny) == 0) to_.flags[t] = orientation;
        }
    }

    [[nodiscard]] bool isAny(std::size_t i) const { return (to_.flags[good_[i]] & kAny) != 0; }

    /// The triangle whose orientation the face takes. In a quad the first, unless the second has a usable UV area and the
    /// first's is not at least as large; in an n-gon the largest with a usable UV area.
    [[nodiscard]] std::size_t orientingTriangle() const {
        const auto area = [&](std::size_t i) { return std::fabs(uvArea(good_[i])); };
        if (good_.size() == 2) return good_[!isAny(1) && !(area(0) >= area(1)) ? 1 : 0];
        std::size_t chosen = 0;
        for (std::size_t i = 1; i < good_.size(); ++i) {
            if (!isAny(i) && (isAny(chosen) || area(i) > area(chosen))) chosen = i;
        }
        return good_[chosen];
    }

    /// Plans copies for corners that only degenerate triangles have. Where the face has good triangles too, such a corner
    /// copies the corner of the face at its own position; else the first good corner of its node. (The reference searches the
    /// face's good triangle for the position; in a quad there is only one such corner.) All corners of degenerate triangles
    /// are at chosen nodes.
    void planCopies() {
        Buffer<std::uint8_t> done;  // one per corner of polygons: 1 has a good triangle, 2 is planned
        if (!in_.triangles.faces.empty()) {
            done = Buffer<std::uint8_t>(allocator_, in_.mesh.cornerCount(), std::uint8_t{0});
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
                if (from == kNone && !around.empty()) from = in_.triangles.corner(to_.halfEdgeOf(around[0].half_edge));
                to_.copies.push({to, from});
            }
        }
    }

    /// Another corner of the triangle at the same position, if a good triangle of the face has it too; else kNone.
    std::uint32_t copiedInFace(std::size_t t, std::uint32_t k, const Buffer<std::uint8_t>& done) const {
        const auto position = [&](std::uint32_t corner) { return in_.mesh.positions[in_.mesh.indices[corner]]; };
        for (std::uint32_t j = 1; j < 3; ++j) {
            const std::uint32_t other = slot(t, (k + j) % 3);
            if (done[other] == 1 && position(other) == position(slot(t, k))) return other;
        }
        return kNone;
    }

    [[nodiscard]] std::uint32_t slot(std::size_t t, std::uint32_t k) const {
        return in_.triangles.corner(3 * std::size_t{to_.triangleOf(t)} + k);
    }

    const VertexPath& path_;
    const NodeSetting& in_;
    CornerSource source_;
    CornerTermsFunction terms_;
    const Allocator* allocator_;
    MeshTriangles by_node_;
    VertexCorners to_;
    Buffer<std::uint32_t> place_of_;  // one per node: its position in `chosen`, or kNone
    std::size_t count_ = 0;           // number of triangles
    Growing<std::uint32_t> good_;     // the triangles of one face that are not degenerate
};

}  // namespace

VertexCorners readCorners(const VertexPath& path) { return CornerReader(path).run(); }

}  // namespace tspace::mikk
