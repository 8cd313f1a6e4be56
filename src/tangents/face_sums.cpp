// SPDX-License-Identifier: MIT
// Sums of dP/du and dP/dv: four triangles at a time in single precision, and in double precision those that
// rounding, overflow or degeneracy could spoil.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
#include "tangents/face_sums.h"

#include <algorithm>

#include "core/float4.h"
#include "core/uv_frame.h"

namespace tspace {

namespace {

constexpr std::size_t kBlock = VertexRanges::kBlock;

// A determinant a - b is taken from single precision when |a - b| > (|a| + |b|) / 32. Its terms are off by
// 3 roundings each, so it is then good to 100 roundings (6e-6) at worst and its sign is certain.
constexpr float kLeastShare = 1.0f / 32;
constexpr float kLeast = 1e-30f, kGreatest = 1e30f;  // far enough from the ends of float for all that follows

/// Elements of a vertex array. With a stride that the compiler knows an address is one instruction.
template <class T, bool kTight>
class Elements {
  public:
    explicit Elements(const StridedSpan<const T>& span)
        : base_(reinterpret_cast<const std::byte*>(span.data)), stride_(span.stride_bytes) {}
    const T& operator[](std::size_t i) const {
        return *reinterpret_cast<const T*>(base_ + i * (kTight ? sizeof(T) : stride_));
    }

  private:
    const std::byte* base_;
    std::size_t stride_;
};

/// dP/du and dP/dv of four triangles, as VertexSums holds them.
struct Derivatives4 {
    Float4 head[4];       ///< per triangle s.x s.y s.z t.x
    Float4 tail[4];       ///< per triangle t.y t.z, and two lanes without meaning
    Mask4 mirrored = {};  ///< of the triangles with negative determinant
    unsigned safe = 0;    ///< bits of the triangles for which all this holds
};

/// `v` are the vertices of four triangles.
template <class Positions, class Uvs>
[[gnu::always_inline]] inline Derivatives4 derivatives(const std::uint32_t* v, const Positions& positions,
                                                       const Uvs& uvs) {
    const auto uv = [&](unsigned k) __attribute__((always_inline)) {
        return gatherVec2(uvs[v[k]], uvs[v[k + 3]], uvs[v[k + 6]], uvs[v[k + 9]]);
    };
    const auto position = [&](unsigned k) __attribute__((always_inline)) {
        return gatherVec3(positions[v[k]], positions[v[k + 3]], positions[v[k + 6]], positions[v[k + 9]]);
    };
    const Vec2x4 uv0 = uv(0), d1 = uv(1) - uv0, d2 = uv(2) - uv0;
    const Float4 plus = d1.x * d2.y, minus = d2.x * d1.y;
    const Float4 determinant = plus - minus;
    const Float4 r = splat(1.0f) / determinant;
    const Float4 size = abs4(determinant);
    Mask4 safe = (size > splat(kLeastShare) * (abs4(plus) + abs4(minus))) & (size > splat(kLeast)) &
                 (size < splat(kGreatest));

    const Vec3x4 p0 = position(0), p1 = position(1), e1 = p1 - p0, p2 = position(2), e2 = p2 - p0;
    // Two corners at one position have one x, which is rarely so.
    const Mask4 collapsed = (e1.x == splat(0.0f)) | (e2.x == splat(0.0f)) | (p1.x == p2.x);
    if (laneBits(collapsed) != 0) [[unlikely]] {
        const auto equal = [](const Vec3x4& a, const Vec3x4& b) {
            return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
        };
        safe &= ~(equal(p0, p1) | equal(p0, p2) | equal(p1, p2));
    }
    // The quotients first: products of edges and UV differences can leave the range of float, these cannot.
    const Vec3x4 s = (d2.y * r) * e1 - (d1.y * r) * e2;
    const Vec3x4 t = (d1.x * r) * e2 - (d2.x * r) * e1;
    // 0 * x is 0 unless x is infinite or a NaN.
    safe &= splat(0.0f) * ((s.x + s.y + s.z) + (t.x + t.y + t.z)) == splat(0.0f);

    Derivatives4 result;
    result.safe = laneBits(safe);
    result.mirrored = determinant < splat(0.0f);
    result.head[0] = s.x + splat(0.0f);  // never -0, see VertexSums
    result.head[1] = s.y;
    result.head[2] = s.z;
    result.head[3] = t.x;
    transpose4(result.head[0], result.head[1], result.head[2], result.head[3]);
    result.tail[0] = __builtin_shufflevector(t.y, t.z, 0, 4, 1, 5);
    result.tail[1] = upperPair(result.tail[0]);
    result.tail[2] = __builtin_shufflevector(t.y, t.z, 2, 6, 3, 7);
    result.tail[3] = upperPair(result.tail[2]);
    return result;
}

struct SumArrays {
    StridedSpan<const Vec3> positions;
    StridedSpan<const Vec2> uvs;
    VertexSums sums;
    float* visits;  ///< null unless asked for
};

/// Adds triangles to the vertices of one range. kWhole: all their vertices are in it. kPlain: tightly packed
/// arrays, and no visits.
template <bool kWhole, bool kPlain>
class BlockSum {
  public:
    BlockSum(const SumArrays& arrays, VertexRange range)
        : positions_(arrays.positions),
          uvs_(arrays.uvs),
          begin_(range.begin),
          size_(range.end - range.begin),
          sums_(arrays.sums),
          visits_(arrays.visits) {}

    void add(const std::uint32_t* v, std::size_t triangle_count, TriangleCounts& counts) const {
        std::size_t i = 0;
        Mask4 mirrored = {};  // minus a count per lane
        for (; i + 4 <= triangle_count; i += 4) {
            if (!namesAny(v + 3 * i)) continue;
            const Derivatives4 d = derivatives(v + 3 * i, positions_, uvs_);
            if (d.safe == 15) [[likely]] {
                mirrored += d.mirrored & owned(v + 3 * i);
                for (unsigned k = 0; k < 4; ++k) addTriangle(v + 3 * (i + k), d.head[k], d.tail[k]);
            } else {
                addSome(v + 3 * i, 4, counts);
            }
        }
        counts.mirrored -= static_cast<std::int64_t>(mirrored[0]) + mirrored[1] + mirrored[2] + mirrored[3];
        if (i == triangle_count) return;
        std::uint32_t last[12];  // what is missing of the four repeats the first one, and is not added
        for (std::size_t k = 0; k < 12; ++k) last[k] = v[3 * i + (k < 3 * (triangle_count - i) ? k : k % 3)];
        addSome(last, triangle_count - i, counts);
    }

  private:
    [[nodiscard]] bool isInRange(std::uint32_t vertex) const { return kWhole || vertex - begin_ < size_; }

    /// Whether any of four triangles has a vertex in the range.
    [[nodiscard]] bool namesAny(const std::uint32_t* v) const {
        bool any = kWhole;
        for (unsigned k = 0; k < 12 && !kWhole; ++k) any |= isInRange(v[k]);
        return any;
    }
    /// Those of four triangles whose first vertex is in the range.
    [[nodiscard]] Mask4 owned(const std::uint32_t* v) const {
        return Mask4{-isInRange(v[0]), -isInRange(v[3]), -isInRange(v[6]), -isInRange(v[9])};
    }

    [[gnu::always_inline]] void addAt(std::uint32_t vertex, Float4 head, Float4 tail) const {
        if (!isInRange(vertex)) return;
        float *const to_head = sums_.head(vertex), *const to_tail = sums_.tail(vertex);
        storeFloat4(to_head, loadFloat4(to_head) + head);
        storePair(to_tail, loadPair(to_tail) + tail);
        if (!kPlain && visits_ != nullptr) visits_[vertex] += 1;
    }
    [[gnu::always_inline]] void addTriangle(const std::uint32_t* v, Float4 head, Float4 tail) const {
        addAt(v[0], head, tail);
        addAt(v[1], head, tail);
        addAt(v[2], head, tail);
    }

    [[gnu::noinline]] void addSome(const std::uint32_t* v, std::size_t count, TriangleCounts& counts) const {
        const Derivatives4 d = derivatives(v, positions_, uvs_);
        for (unsigned k = 0; k < count; ++k) {
            if ((d.safe >> k & 1) == 0) {
                addUnsafe(v + 3 * k, counts);
                continue;
            }
            if (isInRange(v[3 * k])) counts.mirrored += d.mirrored[k] != 0 ? 1 : 0;
            addTriangle(v + 3 * k, d.head[k], d.tail[k]);
        }
    }

    /// In double. A triangle that has no derivatives adds nothing, but its vertices have been named.
    void addUnsafe(const std::uint32_t* v, TriangleCounts& counts) const {
        const Vec3 &p0 = positions_[v[0]], &p1 = positions_[v[1]], &p2 = positions_[v[2]];
        const UvFrame frame = uvFrame(p0, p1, p2, uvs_[v[0]], uvs_[v[1]], uvs_[v[2]]);
        const bool has_area = hasUvArea(frame.determinant);
        if (isInRange(v[0])) {
            counts.degenerate += p0 == p1 || p1 == p2 || p2 == p0 ? 1 : 0;
            counts.degenerate_uv += has_area ? 0 : 1;
            counts.mirrored += has_area && frame.determinant < 0 ? 1 : 0;
        }
        const double r = has_area ? 1 / frame.determinant : 0;
        const Vec3 s = toFloat(r * frame.tangent);
        const Vec3 t = toFloat(r * frame.bitangent);
        if (has_area && isFinite(s) && isFinite(t)) {
            addTriangle(v, Float4{s.x + 0.0f, s.y, s.z, t.x}, Float4{t.y, t.z, 0, 0});
            return;
        }
        for (unsigned i = 0; i < 3; ++i) {
            if (isInRange(v[i])) *sums_.head(v[i]) += 0.0f;
        }
    }

    Elements<Vec3, kPlain> positions_;
    Elements<Vec2, kPlain> uvs_;
    std::uint32_t begin_, size_;
    VertexSums sums_;
    float* visits_;
};

}  // namespace

TriangleCounts& TriangleCounts::operator+=(const TriangleCounts& other) {
    degenerate += other.degenerate;
    degenerate_uv += other.degenerate_uv;
    mirrored += other.mirrored;
    return *this;
}

FaceSums::FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions, VertexSums sums, float* visits)
    : plan_(plan), positions_(positions), sums_(sums), visits_(visits), ranges_(plan.vertex_count) {}

void FaceSums::cutIntoRanges(unsigned wanted, const Allocator* allocator, Parallel& parallel) {
    const auto vertices = [&](std::size_t first, std::size_t count, std::uint32_t* buffer) {
        return blockVertices(plan_.triangle_vertices, first, count, buffer);
    };
    ranges_.cut(wanted, plan_.triangleCount(), vertices, allocator, parallel);
}

TriangleCounts FaceSums::sum(unsigned index) const {
    const VertexRange range = ranges_.range(index);
    sums_.clear(range);
    if (visits_ != nullptr) std::fill(visits_ + range.begin, visits_ + range.end, 0.0f);

    TriangleCounts counts;
    const auto walk = [&](const auto& whole, const auto& part) {
        std::uint32_t buffer[3 * kBlock];
        const std::size_t triangle_count = plan_.triangleCount();
        for (std::size_t first = 0, block = 0; first < triangle_count; first += kBlock, ++block) {
            if (!ranges_.names(block, index)) continue;
            const std::size_t count = std::min(kBlock, triangle_count - first);
            const std::uint32_t* const v = blockVertices(plan_.triangle_vertices, first, count, buffer);
            if (ranges_.namesOnly(block, index))
                whole.add(v, count, counts);
            else
                part.add(v, count, counts);
        }
    };
    const SumArrays arrays{positions_, plan_.uvs, sums_, visits_};
    if (visits_ == nullptr && positions_.stride_bytes == sizeof(Vec3) &&
        plan_.uvs.stride_bytes == sizeof(Vec2)) {
        walk(BlockSum<true, true>(arrays, range), BlockSum<false, true>(arrays, range));
    } else {
        walk(BlockSum<true, false>(arrays, range), BlockSum<false, false>(arrays, range));
    }
    return counts;
}

}  // namespace tspace
