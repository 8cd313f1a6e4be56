// SPDX-License-Identifier: MIT
// The sums of all nodes. A task owns a range of nodes: it goes through all triangles in order, computes those
// that have a node in its range, and adds to these nodes only. So each sum is made by one task, in the
// reference's order, and no task waits for another. Triangles at the border of two ranges are computed twice.
#include "tangents/mikktspace/node_sums.h"

#include <algorithm>
#include <cstddef>

#include "core/add_row.h"
#include "tangents/mikktspace/bucket_sums.h"
#include "tangents/mikktspace/node_buckets.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kManyShare = 16;       // one fan in so many may have more than two paths at a time
constexpr std::size_t kNodesPerTask = 4096;  // at least: below, another thread costs more than it saves
/// Where early requests put memory (__builtin_prefetch): there is more of it than a block needs of the first
/// cache, which the kernel works in. Measured: 120 ns per triangle with the first cache, 67 with the second.
constexpr int kSecondCache = 2;

static_assert(NodeBlocks::kTriangles == kTermTriangles);

/// Triangles to compute. The numbers are the caller's own where they can be taken as they are.
struct Block {
    const std::uint32_t* vertices = nullptr;  // where data is read
    const std::uint32_t* nodes = nullptr;     // where it is added
    std::size_t count = 0;
    std::uint32_t own_vertices[kTermCorners] = {};
    std::uint32_t own_nodes[kTermCorners] = {};
    std::uint32_t triangles[kTermTriangles] = {};  // their numbers
};

/// All that a kernel reads of a node, in half a cache line.
struct PackedNode {
    Vec3 position, normal;
    Vec2 uv;
};
static_assert(sizeof(PackedNode) == 32);

/// Copies node data side by side, so that a triangle's corner is one place in memory and not three.
void packNodes(const MeshView& mesh, const Nodes& nodes, PackedNode* packed, CornerSource& source, Parallel& parallel) {
    constexpr std::size_t kGrain = 16384;
    parallel.forRanges(nodes.count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t v = nodes.vertex(n);
            packed[n] = {mesh.positions[v], mesh.normals[v], mesh.uvs[v]};
        }
    });
    source.positions = reinterpret_cast<const std::byte*>(packed);
    source.normals = source.positions + offsetof(PackedNode, normal);
    source.uvs = source.positions + offsetof(PackedNode, uv);
    source.position_stride = source.normal_stride = source.uv_stride = sizeof(PackedNode);
    source.last_vertex = kNone;  // a record holds the four bytes after its vectors
}

class Summer {
  public:
    struct Setting {
        const MeshView& mesh;
        const TriangleList& triangles;
        const Nodes& nodes;
        CornerSource source;
        CornerTermsFunction terms;
        bool scattered = false;  ///< consecutive triangles lie far apart
        bool packed = false;     ///< the source is numbered by nodes, all data of one side by side
    };

    Summer(const Setting& setting, NodeSums& sums, FanRoom fan_room, std::size_t first_node, std::size_t end_node)
        : setting_(setting),
          triangles_(setting.triangles),
          sums_(sums),
          fan_room_(fan_room),
          first_node_(static_cast<std::uint32_t>(first_node)),
          node_count_(static_cast<std::uint32_t>(end_node - first_node)),
          owns_all_(end_node - first_node == sums.nodes.size()) {
        const IndexView& indices = setting.mesh.indices;
        if (indices.type == IndexType::u32 && triangles_.corners.empty())
            direct_ = static_cast<const std::uint32_t*>(indices.data);
    }

    void run() {
        std::fill_n(sums_.nodes.data() + first_node_, node_count_, NodeSum{});
        if (!sums_.rest.empty()) {
            std::fill_n(sums_.rest.data() + first_node_, node_count_, NodeRest{});
            std::fill_n(sums_.lengths_t.data() + first_node_, node_count_, 0.0f);
        }
        // One block is read, and memory asked for what it needs, before the one before it is computed.
        Block blocks[2];
        fill(blocks[0]);
        for (std::size_t current = 0; blocks[current].count != 0; current ^= 1) {
            fill(blocks[current ^ 1]);
            compute(blocks[current]);
        }
        endFace();
    }

    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

  private:
    [[nodiscard]] bool owns(std::uint32_t node) const { return node - first_node_ < node_count_; }
    [[nodiscard]] std::uint32_t nodeAt(std::size_t i) const {
        return setting_.nodes.ofVertex(setting_.mesh.indices[triangles_.corner(i)]);
    }

    /// The next triangles: all of them, or those with a node in the range.
    void fill(Block& block) {
        constexpr std::size_t kFull = kTermTriangles - 16;
        block.count = 0;
        block.vertices = block.own_vertices;
        block.nodes = block.own_nodes;
        while (block.count <= kFull && next_ < triangles_.count) {
            if (!owns_all_ && skipsBlock()) continue;
            const std::size_t count = std::min(triangles_.count - next_, kTermTriangles - block.count);
            if (count == kTermTriangles && direct_ != nullptr && ownsAllFrom(next_)) {
                take(block, next_);
                next_ += count;
                break;
            }
            read(block, next_, count);
            next_ += count;
        }
        if (setting_.scattered) askFor(block);
    }

    /// Goes on to the next block when none of this one's triangles has a node in the range. (Triangles of one
    /// face may be in two blocks, and stay together.)
    bool skipsBlock() {
        const std::size_t block = next_ / kTermTriangles;
        if (!triangles_.faces.empty() ||
            setting_.nodes.blocks.mayUse(block, first_node_, first_node_ + node_count_ - 1))
            return false;
        next_ = (block + 1) * kTermTriangles;
        return true;
    }

    /// Whether all nodes of so many triangles as a block has are known to be in the range.
    [[nodiscard]] bool ownsAllFrom(std::size_t triangle) const {
        if (owns_all_) return true;
        const auto& ranges = setting_.nodes.blocks.ranges;
        if (ranges.empty()) return false;
        const auto ownsAll = [&](const NodeBlocks::Range& r) { return owns(r.first) && owns(r.last); };
        return ownsAll(ranges[triangle / kTermTriangles]) &&
               ownsAll(ranges[(triangle + kTermTriangles - 1) / kTermTriangles]);
    }

    /// A whole block whose vertices can be used where they are.
    void take(Block& block, std::size_t first) const {
        const Nodes& map = setting_.nodes;
        const std::uint32_t* vertices = direct_ + 3 * first;
        block.count = kTermTriangles;
        for (std::size_t t = 0; t < kTermTriangles; ++t) block.triangles[t] = static_cast<std::uint32_t>(first + t);
        block.vertices = block.nodes = vertices;
        if (map.of_vertex.empty()) return;
        for (std::size_t i = 0; i < kTermCorners; ++i) block.own_nodes[i] = map.of_vertex[vertices[i]];
        block.nodes = block.own_nodes;
        if (setting_.packed) {
            block.vertices = block.own_nodes;
        } else if (map.mixed) {
            for (std::size_t i = 0; i < kTermCorners; ++i) block.own_vertices[i] = map.vertex(block.own_nodes[i]);
            block.vertices = block.own_vertices;
        }
    }

    /// Inlined by force: GCC 12 sees a function that only asks for memory as one without effect, and drops
    /// calls to it.
    [[gnu::always_inline]] void askFor(const Block& block) const {
        const CornerSource& source = setting_.source;
        for (std::size_t i = 0; i < 3 * block.count; ++i) {
            __builtin_prefetch(&sums_.nodes[block.nodes[i]], 1, kSecondCache);
            __builtin_prefetch(source.positions + source.position_stride * block.vertices[i], 0, kSecondCache);
            if (setting_.packed) continue;
            __builtin_prefetch(source.normals + source.normal_stride * block.vertices[i], 0, kSecondCache);
            __builtin_prefetch(source.uvs + source.uv_stride * block.vertices[i], 0, kSecondCache);
        }
    }

    void read(Block& block, std::size_t first, std::size_t count) {
        std::uint32_t* vertices = block.own_vertices + 3 * block.count;
        std::uint32_t* nodes = block.own_nodes + 3 * block.count;
        readVertices(3 * first, 3 * count, vertices);
        const Nodes& map = setting_.nodes;
        if (map.of_vertex.empty()) {
            std::copy_n(vertices, 3 * count, nodes);
        } else {
            for (std::size_t i = 0; i < 3 * count; ++i) nodes[i] = map.of_vertex[vertices[i]];
            if (setting_.packed) {
                std::copy_n(nodes, 3 * count, vertices);
            } else if (map.mixed) {
                for (std::size_t i = 0; i < 3 * count; ++i) vertices[i] = map.vertex(nodes[i]);
            }
        }
        std::uint32_t* numbers = block.triangles + block.count;
        for (std::size_t t = 0; t < count; ++t) numbers[t] = static_cast<std::uint32_t>(first + t);
        block.count += owns_all_ ? count : keepOwn(vertices, nodes, numbers, count);
    }

    void readVertices(std::size_t first, std::size_t count, std::uint32_t* to) const {
        const IndexView& indices = setting_.mesh.indices;
        if (!triangles_.corners.empty()) {
            for (std::size_t i = 0; i < count; ++i) to[i] = indices[triangles_.corners[first + i]];
            return;
        }
        switch (indices.type) {
            case IndexType::u32:
                std::copy_n(static_cast<const std::uint32_t*>(indices.data) + first, count, to);
                break;
            case IndexType::u16:
                std::copy_n(static_cast<const std::uint16_t*>(indices.data) + first, count, to);
                break;
            case IndexType::u8:
                std::copy_n(static_cast<const std::uint8_t*>(indices.data) + first, count, to);
                break;
            case IndexType::none:
                for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint32_t>(first + i);
                break;
        }
    }

    std::size_t keepOwn(std::uint32_t* vertices, std::uint32_t* nodes, std::uint32_t* numbers, std::size_t count) {
        std::size_t kept = 0;
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t number = numbers[t];
            const bool mine = triangles_.faces.empty()
                                  ? int{owns(nodes[3 * t])} | int{owns(nodes[3 * t + 1])} | int{owns(nodes[3 * t + 2])}
                                  : ownsFaceOf(number);
            for (std::size_t k = 0; k < 3; ++k) {
                vertices[3 * kept + k] = vertices[3 * t + k];
                nodes[3 * kept + k] = nodes[3 * t + k];
            }
            numbers[kept] = number;
            kept += mine ? 1 : 0;
        }
        return kept;
    }

    /// A face is taken or left as a whole: its triangles have to agree. Asked in the order of triangles.
    bool ownsFaceOf(std::uint32_t triangle) {
        const std::uint32_t face = triangles_.faces[triangle];
        if (face == asked_face_) return owns_asked_face_;
        asked_face_ = face;
        owns_asked_face_ = false;
        for (std::size_t t = triangle; t < triangles_.count && triangles_.faces[t] == face; ++t) {
            for (std::size_t k = 0; k < 3; ++k) owns_asked_face_ |= owns(nodeAt(3 * t + k));
        }
        return owns_asked_face_;
    }

    void compute(const Block& block) {
        setting_.terms(setting_.source, block.vertices, block.count, terms_);
        if (owns_all_) {
            degenerate_count += terms_.degenerate_count;
            no_uv_area_count += terms_.no_uv_area_count;
            mirrored_count += terms_.mirrored_count;
        } else {
            countOwn(block);
        }
        if (!triangles_.faces.empty()) compareFaces(block);
        if (setting_.source.weighting == Weighting::none) {
            owns_all_ ? add<true, Sums::none>(block) : add<false, Sums::none>(block);
        } else if (sums_.rest.empty()) {
            owns_all_ ? add<true, Sums::tangents>(block) : add<false, Sums::tangents>(block);
        } else {
            owns_all_ ? add<true, Sums::all>(block) : add<false, Sums::all>(block);
        }
    }

    enum class Sums { none, tangents, all };

    /// Each triangle is counted by the task that owns its first node.
    void countOwn(const Block& block) {
        for (std::size_t t = 0; t < block.count; ++t) {
            if (!owns(block.nodes[3 * t])) continue;
            const std::uint32_t m = terms_.marks[0][t];
            const bool degenerate = (m & kDegenerateMark) != 0, flat = !degenerate && (m & kNoUvArea) != 0;
            degenerate_count += degenerate ? 1 : 0;
            no_uv_area_count += flat ? 1 : 0;
            mirrored_count += !degenerate && !flat && (m & kFacesDown) != 0 ? 1 : 0;
        }
    }

    template <bool kOwnsAll, Sums kSums>
    void add(const Block& block) {
        for (std::size_t t = 0; t < block.count; ++t) {
            const std::uint32_t* n = block.nodes + 3 * t;
            if ((terms_.marks[0][t] & (kDegenerateMark | kNoUvArea)) != 0) [[unlikely]] {
                addUnusual(block, t);
                continue;
            }
            addCorner<kOwnsAll, kSums>(t, 0, n[0], n[1], n[2]);
            addCorner<kOwnsAll, kSums>(t, 1, n[1], n[2], n[0]);
            addCorner<kOwnsAll, kSums>(t, 2, n[2], n[0], n[1]);
        }
    }

    /// Triangles that add nothing to the sums. Nodes of degenerate ones are left to the vertex path.
    void addUnusual(const Block& block, std::size_t t) {
        const std::uint32_t* n = block.nodes + 3 * t;
        const bool degenerate = (terms_.marks[0][t] & kDegenerateMark) != 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!owns(n[k])) continue;
            const bool known = !degenerate && sums_.nodes[n[k]].fan.add(n[(k + 1) % 3], n[(k + 2) % 3], fan_room_);
            if (!known) sums_.marks[n[k]] &= static_cast<std::uint16_t>(degenerate ? 0 : ~kFanKnown);
        }
        if (!degenerate && owns(n[0])) sums_.flat[block.triangles[t]] = 1;
    }

    template <bool kOwnsAll, Sums kSums>
    void addCorner(std::size_t t, std::size_t k, std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
        if (!kOwnsAll && !owns(node)) return;
        NodeSum& sum = sums_.nodes[node];
        const std::size_t row = 3 * t + k;
        if constexpr (kSums != Sums::none) addRow(sum.s, terms_.s[row]);  // and the weight
        std::uint16_t& marks = sums_.marks[node];
        marks = static_cast<std::uint16_t>(marks & terms_.marks[k][t]);
        if (!sum.fan.add(next, previous, fan_room_)) [[unlikely]]
            marks &= static_cast<std::uint16_t>(~kFanKnown);
        if constexpr (kSums == Sums::all) {
            addRow(sums_.rest[node].t, terms_.t[row]);
            sums_.lengths_t[node] += terms_.lengths_t[k][t];
        }
    }

    /// The vertex path gives all triangles of a face one orientation and treats degenerate ones in a way of
    /// their own. Faces whose triangles do not simply agree are left to it.
    void compareFaces(const Block& block) {
        for (std::size_t t = 0; t < block.count; ++t) {
            const std::uint32_t triangle = block.triangles[t], face = triangles_.faces[triangle];
            const std::uint32_t m = terms_.marks[0][t] & (kFacesUp | kFacesDown | kDegenerateMark);
            if (face != open_face_) {
                endFace();
                open_face_ = face;
                open_first_ = triangle;
                open_marks_ = 0;
                open_count_ = 0;
                open_starts_flat_ = (terms_.marks[0][t] & kNoUvArea) != 0;
            }
            ++open_count_;
            open_degenerate_ |= (m & kDegenerateMark) != 0;
            // One without UV area takes the orientation of others, and gives its own only as the first one of
            // a quad.
            if ((terms_.marks[0][t] & kNoUvArea) != 0) continue;
            open_differs_ |= m == 0 || (open_marks_ != 0 && m != open_marks_);
            open_marks_ = m;
        }
    }

    void endFace() {
        open_differs_ |= open_count_ == 2 && open_starts_flat_ && open_marks_ != 0;
        if (open_count_ > 1 && (open_differs_ || open_degenerate_)) {
            for (std::size_t t = open_first_; t < triangles_.count && triangles_.faces[t] == open_face_; ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t node = nodeAt(3 * t + k);
                    if (owns(node)) sums_.marks[node] = 0;
                }
            }
        }
        open_differs_ = open_degenerate_ = false;
    }

    const Setting& setting_;
    const TriangleList& triangles_;
    NodeSums& sums_;
    FanRoom fan_room_;
    std::uint32_t first_node_, node_count_;
    bool owns_all_;
    std::uint32_t asked_face_ = kNone;
    bool owns_asked_face_ = false;
    std::uint32_t open_face_ = kNone, open_first_ = 0, open_marks_ = 0;
    std::uint32_t open_count_ = 0;
    bool open_differs_ = false, open_degenerate_ = false, open_starts_flat_ = false;
    std::size_t next_ = 0;                   // triangle to read
    const std::uint32_t* direct_ = nullptr;  // the vertices of all triangles, when they are there as such
    CornerTerms terms_;
};

}  // namespace

bool NodeSums::isOneGroup(std::size_t node, const Vec3& normal, bool may_split) const {
    const std::uint32_t m = marks[node];
    if ((m & (kFacesUp | kFacesDown)) == 0 || (m & kFanKnown) == 0) return false;
    if (!nodes.empty() && !nodes[node].fan.isOne()) return false;
    return !may_split || sumCannotSplit(row(node), m, normal);
}

bool sumCannotSplit(const float* sum, std::uint32_t marks, const Vec3& normal) {
    if ((marks & (kTurnsLeft | kTurnsRight)) == 0 || (marks & kNotLight) == 0) return false;
    const float lightest = (marks & kHeavy) != 0       ? kHeavyWeight
                           : (marks & kNotMiddle) != 0 ? kMiddleWeight
                                                       : kLightWeight;
    const float least = sum[3] - 0.4f * lightest;
    const float square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
    const float normal_square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
    // With a weight sum of at most 1024 times the lightest, the rounding errors of the sums stay below 0.1 of
    // it.
    return square > least * least && sum[3] < 1024 * lightest && normal_square > 0.98f && normal_square < 1.02f;
}

void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel) {
    constexpr std::size_t kStep = 64, kGrain = 128;  // nodes; steps
    parallel.forRanges((count + kStep - 1) / kStep, kGrain, [&](std::size_t begin, std::size_t end) {
        finish(begin * kStep, std::min(end * kStep, count));
    });
}

void sumNodes(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const CornerSource& source,
              CornerTermsFunction terms, ScratchBlock& brief, const Allocator* allocator, Parallel& parallel,
              NodeSums& sums, const FinishNodes& finish) {
    if (!source.tangents_only) {
        sums.rest = Buffer<NodeRest>(allocator, nodes.count);
        sums.lengths_t = Buffer<float>(allocator, nodes.count);
    }
    sums.flat = Buffer<std::uint8_t>(brief.allocator(), triangles.count, std::uint8_t{0});
    sums.scattered = nodes.blocks.scattered;
    if (sums.scattered && triangles.faces.empty()) {
        NodeBuckets buckets(mesh, triangles, nodes, allocator, parallel);
        if (buckets.fill(brief)) {
            sums.makeRows(allocator, nodes.count);
            sums.marks = Buffer<std::uint16_t>(allocator, nodes.count);
            sumBuckets(buckets, nodes, source, terms, sums, finish, allocator, parallel);
            return;
        }
    }
    sums.makeNodes(allocator, nodes.count);
    sums.marks = Buffer<std::uint16_t>(allocator, nodes.count, std::uint16_t{kAllMarks});
    if (triangles.count == 0) {
        std::fill(sums.nodes.begin(), sums.nodes.end(), NodeSum{});
        std::fill(sums.rest.begin(), sums.rest.end(), NodeRest{});
        std::fill(sums.lengths_t.begin(), sums.lengths_t.end(), 0.0f);
        finishInRanges(nodes.count, finish, parallel);
        return;
    }
    Summer::Setting setting{mesh, triangles, nodes, source, terms};
    setting.scattered = sums.scattered;
    Buffer<PackedNode> packed;
    if (setting.scattered && brief.has(nodes.count * sizeof(PackedNode))) {
        packed = Buffer<PackedNode>(brief.allocator(), nodes.count);
        packNodes(mesh, nodes, packed.data(), setting.source, parallel);
        setting.packed = true;
    }
    struct Counts {
        std::uint64_t degenerate, no_uv_area, mirrored;
    };
    const std::size_t tasks =
        std::clamp<std::size_t>(nodes.count / kNodesPerTask, 1, std::max<std::size_t>(1, parallel.width()));
    Buffer<Counts> counts(allocator, tasks);
    const std::size_t fans_each = nodes.count / kManyShare / tasks + 64;
    Buffer<ManyPaths> many_paths(brief.allocator(), tasks * fans_each);
    parallel.forTasks(tasks, [&](std::size_t task) {
        Summer summer(setting, sums, {many_paths.data() + task * fans_each, fans_each}, nodes.count * task / tasks,
                      nodes.count * (task + 1) / tasks);
        summer.run();
        counts[task] = {summer.degenerate_count, summer.no_uv_area_count, summer.mirrored_count};
    });
    for (std::size_t task = 0; task < tasks; ++task) {
        const Counts& c = counts[task];
        sums.degenerate_count += c.degenerate;
        sums.no_uv_area_count += c.no_uv_area;
        sums.mirrored_count += c.mirrored;
    }
    finishInRanges(nodes.count, finish, parallel);
}

}  // namespace tspace::mikk
