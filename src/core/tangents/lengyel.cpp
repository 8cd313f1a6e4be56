// SPDX-License-Identifier: MIT
// Lengyel's method: sums of unnormalized dP/du and dP/dv per vertex index, then Gram-Schmidt. Both steps run in single
// precision in kernels (derivative_terms.h); triangles and vertices for which that is not accurate enough are
// recomputed in double precision. Memory traffic dominates, so sums are stored in the memory of the outputs if they
// fit.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/tangents/derivative_terms.h"
#include "core/tangents/indexed_methods.h"

namespace tspace {
namespace {

/// Counts for a range of vertices: triangles are counted in the range of their first vertex.
struct RangeCounts {
    std::uint64_t degenerate = 0;          ///< triangles with two corners at the same position
    std::uint64_t degenerate_uv = 0;       ///< triangles without UV area
    std::uint64_t mirrored = 0;            ///< triangles with negative UV area
    std::uint64_t used = 0, defaults = 0;  ///< number of used vertices, and of vertices with a default tangent
};

/// Sums of all vertices, in single precision and in triangle order: six floats each, because memory traffic dominates
/// the time. They are stored in two arrays, because either may be in the memory of outputs that are written later.
struct VertexSums : derivatives::SumArrays {
    [[nodiscard]] float* head(std::size_t vertex) const { return heads + 4 * vertex; }
    [[nodiscard]] float* tail(std::size_t vertex) const { return tails + 2 * vertex; }
    /// Marks all sums of a range as empty by -0: -0 + x is x for all x, including 0, and addends of s.x are never -0.
    void clear(GroupRange range) const {
        fill(head(range.begin), head(range.end), -0.0f);
        fill(tail(range.begin), tail(range.end), -0.0f);
    }
    [[nodiscard]] bool isTouched(std::size_t v) const { return *head(v) != 0 || !std::signbit(*head(v)); }

  private:
    static void fill(float* begin, float* end, float value) {
        constexpr std::ptrdiff_t kFloats = 16;  // number of floats in a cache line
        for (; end - begin >= kFloats; begin += kFloats) {
            prefetchLines<true>(begin, kFloats * sizeof(float));
            std::fill_n(begin, kFloats, value);
        }
        std::fill(begin, end, value);
    }
};

/// Returns a mask of the lowest `count` bits, 1 to 64.
std::uint64_t lowBits(std::size_t count) { return ~std::uint64_t{0} >> (64 - count); }

static_assert(TriangleBatch::kMost == derivatives::kTermTriangles);
static_assert(TriangleBatch::kMost % derivatives::kTermGroup == 0);
constexpr std::uint32_t kGroup{derivatives::kTermGroup};

/// Triangles of a plan, as groups: the groups of a triangle are its vertices.
class IndexedTriangles final : public TriangleGroups {
  public:
    explicit IndexedTriangles(const IndexView& vertices) : TriangleGroups(vertices.count / 3), vertices_(vertices) {}

    void read(std::size_t first, std::size_t size, std::uint32_t*, std::uint32_t* groups) const override {
        const std::uint32_t* const v = readIndices(vertices_, 3 * first, 3 * size, groups);
        if (v != groups) std::copy_n(v, 3 * size, groups);
    }
    [[nodiscard]] InPlace inPlace(std::size_t first, std::size_t) const override {
        if (vertices_.type != IndexType::u32) return {};
        const std::uint32_t* const vertices = static_cast<const std::uint32_t*>(vertices_.data) + 3 * first;
        return {vertices, vertices};
    }

  private:
    const IndexView& vertices_;
};

/// Sums triangles, in ranges of vertices that may be processed in parallel: blocks are summed in single precision, and
/// triangles for which rounding, overflow or degeneracy matters in double precision.
class FaceSums {
  public:
    /// `visits`, one per vertex, counts the triangles that were added; it may be null. `wanted`: maximum number of
    /// ranges.
    FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions, const derivatives::DerivativeKernel& kernel,
             VertexSums sums, float* visits, unsigned wanted, const Allocator* allocator, Parallel& parallel)
        : plan_(plan), positions_(positions), kernel_(kernel), sums_(sums), visits_(visits),
          triangles_(plan.triangle_vertices),
          ranges_(makeRanges(std::bit_ceil((plan.vertex_count + wanted - 1) / wanted), allocator, parallel)) {}

    [[nodiscard]] const RangeLists& ranges() const { return ranges_; }

    /// Computes the sums of one range.
    [[nodiscard]] RangeCounts sum(std::size_t index) const {
        const GroupRange range = ranges_.range(index);
        sums_.clear(range);
        if (visits_ != nullptr) std::fill(visits_ + range.begin, visits_ + range.end, 0.0f);

        const derivatives::TriangleSource source{
            reinterpret_cast<const std::byte*>(positions_.data), reinterpret_cast<const std::byte*>(plan_.uvs.data),
            positions_.stride_bytes, plan_.uvs.stride_bytes, static_cast<std::uint32_t>(positions_.count - 1)};
        RangeCounts counts;
        TriangleBatch batch;
        derivatives::DerivativeTerms terms;
        for (RangeLists::Batches batches(triangles_, ranges_, index); batches.next(batch, false);) {
            prefetchLines(batch.groups, 3 * TriangleBatch::kMost * sizeof *batch.groups);
            kernel_.compute(source, fillGroup(batch.groups, batch.count, derivatives::kTermGroup, batch.own_groups),
                            batch.count, terms);
            addBatch(batch, terms, range, counts);
        }
        return counts;
    }

  private:
    [[nodiscard]] RangeLists makeRanges(std::size_t size, const Allocator* allocator, Parallel& parallel) const {
        constexpr std::size_t kBlock = TriangleBatch::kMost;
        if (!RangeLists::areCompact(triangles_, kBlock, plan_.vertex_count, size))
            return {kBlock, plan_.vertex_count, size};
        return {triangles_, kBlock, plan_.vertex_count, size, allocator, parallel};
    }

    /// Adds triangles in order, since the order determines the rounding of sums.
    void addBatch(const TriangleBatch& batch, const derivatives::DerivativeTerms& terms, GroupRange range,
                  RangeCounts& counts) const {
        const std::uint32_t* const v = batch.groups;
        std::uint64_t unsafe = ~terms.safe & lowBits(batch.count);
        for (std::size_t begin = 0; begin < batch.count;) {
            const auto end = unsafe == 0 ? batch.count : static_cast<std::size_t>(std::countr_zero(unsafe));
            if (batch.is_whole)
                kernel_.add(terms, v, begin, end, sums_);
            else
                kernel_.add_some(terms, v, begin, end, sums_, range.begin, range.end);
            if (end != batch.count) addUnsafe(v + 3 * end, range, counts);
            unsafe &= unsafe - 1;
            begin = end + 1;
        }
        counts.mirrored += countIn(range, batch, terms.mirrored);
        counts.degenerate += countIn(range, batch, terms.degenerate);
        if (visits_ == nullptr) return;
        for (std::size_t i = 0; i < 3 * batch.count; ++i) {
            if ((terms.safe >> (i / 3) & 1) != 0 && range.has(v[i])) visits_[v[i]] += 1;
        }
    }

    /// Returns the number of marked triangles that are counted in this range.
    static unsigned countIn(GroupRange range, const TriangleBatch& batch, std::uint64_t marked) {
        if (batch.is_whole) return static_cast<unsigned>(std::popcount(marked));
        unsigned count = 0;
        for (; marked != 0; marked &= marked - 1)
            count += range.has(batch.groups[3 * static_cast<unsigned>(std::countr_zero(marked))]) ? 1u : 0u;
        return count;
    }

    /// Adds one triangle, computed in double precision. A triangle without derivatives adds nothing, but marks its
    /// vertices as used. Not inlined, because it would take registers from the surrounding loop.
    [[gnu::noinline]] void addUnsafe(const std::uint32_t* v, GroupRange range, RangeCounts& counts) const {
        const Vec3 &p0 = positions_[v[0]], &p1 = positions_[v[1]], &p2 = positions_[v[2]];
        const UvFrame frame = uvFrame(p0, p1, p2, plan_.uvs[v[0]], plan_.uvs[v[1]], plan_.uvs[v[2]]);
        const bool has_area = hasUvArea(frame.determinant);
        if (range.has(v[0])) {
            counts.degenerate_uv += has_area ? 0 : 1;
            counts.mirrored += has_area && frame.determinant < 0 ? 1 : 0;
        }
        const double r = has_area ? 1 / frame.determinant : 0;
        const Vec3 s = toFloat(r * frame.tangent), t = toFloat(r * frame.bitangent);
        const bool adds = has_area && isFinite(s) && isFinite(t);
        const float row[6] = {s.x + 0.0f, s.y, s.z, t.x, t.y, t.z};
        for (unsigned k = 0; k < 3; ++k) {
            if (!range.has(v[k])) continue;
            float *const head = sums_.head(v[k]), *const tail = sums_.tail(v[k]);
            if (!adds) {
                *head += 0.0f;
                continue;
            }
            for (unsigned i = 0; i < 4; ++i) head[i] += row[i];
            for (unsigned i = 0; i < 2; ++i) tail[i] += row[4 + i];
            if (visits_ != nullptr) visits_[v[k]] += 1;
        }
    }

    const IndexedPlan& plan_;
    StridedSpan<const Vec3> positions_;
    derivatives::DerivativeKernel kernel_;
    VertexSums sums_;
    float* visits_;
    IndexedTriangles triangles_;
    RangeLists ranges_;
};

/// Converts sums to frames, one entry per vertex. Tangents overwrite the heads of the sums, and are copied if `out`
/// stores them elsewhere.
class VertexFrames {
  public:
    /// out.has_tangent must be empty or all 1 before the call.
    VertexFrames(const derivatives::DerivativeKernel& kernel, const VertexSums& sums, const float* visits,
                 StridedSpan<const Vec3> normals, float sign_factor, const TangentOutput& out)
        : kernel_(kernel), sums_(sums), visits_(visits), normals_(normals), sign_factor_(sign_factor), out_(out) {
        has_extras_ = !out.bitangents.empty() || !out.magnitudes_s.empty() || !out.magnitudes_t.empty();
        copies_tangents_ = !out.tangents.empty() && &out.tangents.data->x != sums.heads;
    }

    void write(GroupRange range, RangeCounts& counts) const {
        for (std::uint32_t v = range.begin; v != range.end;) {
            const std::uint32_t left = std::min(kMost, range.end - v);
            // Finishes whole groups, without the very last vertex: the kernel would read past its normal.
            const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(left, normals_.count - 1 - v));
            const std::uint32_t whole = has_extras_ ? 0 : most / kGroup * kGroup;
            whole != 0 ? finishInPlace(v, whole, counts) : finishCopy(v, left, counts);
            v += whole != 0 ? whole : left;
        }
        if (copies_tangents_) copyTangents(range);
    }

  private:
    static constexpr std::uint32_t kMost = 64;  ///< maximum number of vertices per iteration

    void finishInPlace(std::uint32_t first, std::uint32_t count, RangeCounts& counts) const {
        const auto* normals = reinterpret_cast<const std::byte*>(&normals_[first]);
        prefetchLines<true>(sums_.head(first), kMost * 4 * sizeof(float));
        prefetchLines(sums_.tail(first), kMost * 2 * sizeof(float));
        prefetchLines(normals, kMost * normals_.stride_bytes);
        const std::uint64_t safe =
            kernel_.finish({sums_.head(first), sums_.tail(first)}, normals, normals_.stride_bytes, sign_factor_, count);
        finishOthers(first, count, safe, counts);
    }

    /// Finishes any vertices in a copy, and writes all outputs.
    [[gnu::noinline]] void finishCopy(std::uint32_t first, std::uint32_t count, RangeCounts& counts) const {
        float heads[4 * kMost] = {}, tails[2 * kMost] = {};
        Vec3 normals[kMost + 1] = {};
        std::copy_n(sums_.head(first), 4 * count, heads);
        std::copy_n(sums_.tail(first), 2 * count, tails);
        for (std::uint32_t i = 0; i < count; ++i) normals[i] = normals_[first + i];
        const std::uint32_t groups = (count + kGroup - 1) / kGroup;
        const std::uint64_t safe = kernel_.finish({heads, tails}, reinterpret_cast<const std::byte*>(normals),
                                                  sizeof(Vec3), sign_factor_, groups * derivatives::kTermGroup);
        finishOthers(first, count, has_extras_ ? 0 : safe, counts);
        for (std::uint32_t i = 0; i < count; ++i) {
            if ((safe >> i & 1) != 0) storeFloat4(sums_.head(first + i), loadFloat4(heads + 4 * i));
        }
    }

    /// Finishes the vertices that are not `done`, in double precision, and counts all vertices.
    void finishOthers(std::uint32_t first, std::uint32_t count, std::uint64_t done, RangeCounts& counts) const {
        counts.used += static_cast<unsigned>(std::popcount(done & lowBits(count)));
        for (std::uint64_t rest = ~done & lowBits(count); rest != 0; rest &= rest - 1)
            finishInDouble(first + static_cast<std::uint32_t>(std::countr_zero(rest)), counts);
    }

    void finishInDouble(std::uint32_t v, RangeCounts& counts) const {
        float *const head = sums_.head(v), *const tail = sums_.tail(v);
        if (!sums_.isTouched(v)) {
            writeExtras(out_, v, {});
            return storeFloat4(head, Float4{});
        }
        ++counts.used;
        const Derivatives d{{head[0], head[1], head[2]}, {head[3], tail[0], tail[1]}};
        CornerFrame frame = makeCornerFrame(d, normals_[v], sign_factor_);
        if (!frame.has_tangent) {
            ++counts.defaults;
        } else if (visits_ != nullptr) {
            frame.magnitude_s = meanLength(d.s, visits_[v]);
            frame.magnitude_t = meanLength(d.t, visits_[v]);
        }
        writeExtras(out_, v, frame);
        storeFloat4(head, loadFloat4(&frame.tangent.x));
    }

    void copyTangents(GroupRange range) const {
        for (std::uint32_t v = range.begin; v != range.end; ++v)
            storeFloat4(&out_.tangents[v].x, loadFloat4(sums_.head(v)));
    }

    derivatives::DerivativeKernel kernel_;
    VertexSums sums_;
    const float* visits_;
    StridedSpan<const Vec3> normals_;
    float sign_factor_;
    TangentOutput out_;
    bool has_extras_ = false, copies_tangents_ = false;
};

/// Outputs per vertex from which outputs per corner are copied. The tangents are stored in place of the sums.
struct VertexExtras {
    Buffer<Vec3> bitangents;
    Buffer<float> magnitudes_s, magnitudes_t;
    Buffer<std::uint8_t> has_tangent;

    TangentOutput out;

    VertexExtras(const TangentOutput& wanted, std::size_t vertex_count, const Allocator* allocator)
        : has_tangent(allocator, vertex_count, std::uint8_t{1}) {
        const auto make = [&]<class T>(const StridedSpan<T>& like, Buffer<T>& buffer, StridedSpan<T>& span) {
            if (!like.empty()) buffer = Buffer<T>(allocator, vertex_count);
            span = {buffer.data(), buffer.size()};
        };
        make(wanted.bitangents, bitangents, out.bitangents);
        make(wanted.magnitudes_s, magnitudes_s, out.magnitudes_s);
        make(wanted.magnitudes_t, magnitudes_t, out.magnitudes_t);
        out.has_tangent = {has_tangent.data(), has_tangent.size()};
    }
};

template <class T>
void copyToCorners(const IndexedPlan& plan, const T* from, const StridedSpan<T>& to, std::size_t begin,
                   std::size_t end) {
    if (to.empty()) return;
    for (std::size_t c = begin; c < end; ++c) {
        if (plan.isUsed(c)) to[c] = from[plan.corner_vertices[c]];
    }
}

/// Copies the tangents of used corners. Returns the number of corners whose vertex has a default. `has_tangent`: one
/// per vertex; null: all have a tangent.
std::uint64_t copyTangents(const IndexedPlan& plan, const float* from, const std::uint8_t* has_tangent,
                           const StridedSpan<Vec4>& out, std::size_t begin, std::size_t end) {
    const std::uint8_t* const used = plan.corner_used.data();
    constexpr std::size_t kAhead = 2048;  // prefetch distance in bytes
    return withIndices(plan.corner_vertices, [&](const auto& vertexOf) {
        auto* to = reinterpret_cast<std::byte*>(&out[begin]);
        std::uint64_t defaults = 0;
        for (std::size_t c = begin; c < end; ++c, to += out.stride_bytes) {
            // A store waits for its cache line unless the line was prefetched.
            prefetchLines<true>(to, 1, kAhead);
            if (used != nullptr && used[c] == 0) continue;
            const std::size_t vertex = vertexOf(c);
            storeFloat4(&reinterpret_cast<Vec4*>(to)->x, loadFloat4(from + 4 * vertex));
            if (has_tangent != nullptr) defaults += 1u - has_tangent[vertex];
        }
        return defaults;
    });
}

/// Memory for the sums. Page faults of fresh memory cost time, so one of the two arrays is stored in outputs that are
/// written later: the tails, or, if outputs are per vertex, the heads, which are then replaced by the tangents in
/// place.
struct SumPlaces {
    Buffer<float> head_buffer, tail_buffer;
    VertexSums sums;

    SumPlaces(const StridedSpan<Vec4>& tangents, std::size_t vertex_count, bool per_corner,
              const Allocator* allocator) {
        const bool is_tight = tangents.stride_bytes == sizeof(Vec4);
        if (is_tight && !per_corner) sums.heads = &tangents.data->x;
        if (is_tight && per_corner && 2 * tangents.count >= vertex_count) sums.tails = &tangents.data->x;
        if (sums.heads == nullptr) sums.heads = (head_buffer = Buffer<float>(allocator, 4 * vertex_count)).data();
        if (sums.tails == nullptr) sums.tails = (tail_buffer = Buffer<float>(allocator, 2 * vertex_count)).data();
    }
};

}  // namespace

void evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Execution& execution,
                     Parallel& parallel, TangentReport& report) {
    if (plan.vertex_count == 0) return;
    const Allocator* const allocator = execution.allocator;
    const derivatives::DerivativeKernel kernel = derivatives::derivativeKernelFor(execution.simd);
    const bool per_corner = plan.domain == OutputDomain::corner;
    const bool has_magnitudes = !out.magnitudes_s.empty() || !out.magnitudes_t.empty();
    const SumPlaces places(out.tangents, plan.vertex_count, per_corner, allocator);
    const VertexSums& sums = places.sums;
    Buffer<float> visits(allocator, has_magnitudes ? plan.vertex_count : 0);
    const VertexExtras extras(per_corner ? out : TangentOutput{}, per_corner ? plan.vertex_count : 0, allocator);

    constexpr unsigned kMostRanges = 64;
    const unsigned wanted = plan.triangleCount() >= Parallel::kGrain ? std::min(parallel.width(), kMostRanges) : 1;
    const FaceSums faces(plan, pose.positions, kernel, sums, visits.data(), wanted, allocator, parallel);
    const VertexFrames frames(kernel, sums, visits.data(), pose.normals, plan.sign_factor,
                              per_corner ? extras.out : out);
    std::array<RangeCounts, kMostRanges> counts;
    parallel.forTasks(faces.ranges().count(), [&](std::size_t range) {
        counts[range] = faces.sum(range);
        frames.write(faces.ranges().range(range), counts[range]);
    });
    for (const RangeCounts& of_range : std::span(counts).first(faces.ranges().count())) {
        report.degenerate_triangle_count += of_range.degenerate;
        report.degenerate_uv_count += of_range.degenerate_uv;
        report.mirrored_count += of_range.mirrored;
        report.group_count += of_range.used;
        report.default_corner_count += of_range.defaults;
    }
    if (!per_corner) return;
    const std::uint8_t* const has_tangent = report.default_corner_count == 0 ? nullptr : extras.has_tangent.data();
    report.default_corner_count =
        sumRanges(parallel, plan.cornerCount(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            copyToCorners(plan, extras.bitangents.data(), out.bitangents, begin, end);
            copyToCorners(plan, extras.magnitudes_s.data(), out.magnitudes_s, begin, end);
            copyToCorners(plan, extras.magnitudes_t.data(), out.magnitudes_t, begin, end);
            copyToCorners(plan, extras.has_tangent.data(), out.has_tangent, begin, end);
            return copyTangents(plan, sums.heads, has_tangent, out.tangents, begin, end);
        });
}

}  // namespace tspace
