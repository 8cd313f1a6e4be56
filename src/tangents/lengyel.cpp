// SPDX-License-Identifier: MIT
// The classic: sums of unnormalised dP/du and dP/dv per vertex index, then Gram-Schmidt.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/float4.h"
#include "core/sum_ranges.h"
#include "tangents/face_sums.h"
#include "tangents/indexed_methods.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 16384;
// In triangles. An estimate, from some 50 us for a thread to start; not yet measured on idle cores.
constexpr std::size_t kWorthThreads = 32768;

// Single precision is enough when Gram-Schmidt leaves a sixteenth of the length, and when the volume that
// decides the sign is not just rounding (about 2^-18 of the product of lengths).
constexpr float kLeastRest2 = 1.0f / 256;
constexpr float kLeastVolume = 1.0f / 16384;
constexpr float kLeast = 1e-30f, kGreatest = 1e30f;

/// After its frame is known, the head of a vertex's sums holds the tangent and, here, the tail 1 when it is a
/// default.
float& defaultMark(const VertexSums& sums, std::size_t vertex) { return *sums.tail(vertex); }

struct VertexCounts {
    std::uint64_t used = 0, defaults = 0;
};

/// Turns sums into frames, one entry per vertex.
class VertexFrames {
  public:
    VertexFrames(const VertexSums& sums, const float* visits, StridedSpan<const Vec3> normals, float sign_factor,
                 const TangentOutput& out)
        : sums_(sums), visits_(visits), normals_(normals), sign_factor_(sign_factor), out_(out) {
        has_extras_ = !out.bitangents.empty() || !out.magnitudes_s.empty() || !out.magnitudes_t.empty();
    }

    /// With `mark` the tangents go to the heads of the sums, instead of to the output.
    VertexCounts write(VertexRange range, bool mark) const {
        VertexCounts counts;
        std::uint32_t v = range.begin;
        for (; range.end - v >= 4; v += 4) {
            Four four = frames(v, 1, {&normals_[v], 4, normals_.stride_bytes});
            if (four.safe == 15 && !has_extras_) [[likely]] {
                store(v, four, mark);
                counts.used += 4;
            } else {
                finish(v, 4, four, mark, counts);
            }
        }
        for (; v < range.end; ++v) {
            Four four = frames(v, 0, {&normals_[v], 4, 0});
            finish(v, 1, four, mark, counts);
        }
        return counts;
    }

  private:
    struct Four {
        Float4 tangents[4];
        unsigned safe = 0;  ///< bits of the vertices whose tangents are right
    };

    /// What makeCornerFrame does, in single precision; for vertices v, v + step, ...
    [[nodiscard]] Four frames(std::size_t v, std::size_t step, StridedSpan<const Vec3> normals) const {
        const auto head = [&](std::size_t i) { return loadFloat4(sums_.head(v + i * step)); };
        const auto tail = [&](std::size_t i) { return sums_.tail(v + i * step); };
        Float4 sx = head(0), sy = head(1), sz = head(2), tx = head(3);
        transpose4(sx, sy, sz, tx);
        const Float4 low = joinPairs(tail(0), tail(1)), high = joinPairs(tail(2), tail(3));
        const Vec3x4 s{sx, sy, sz};
        const Vec3x4 t{tx, __builtin_shufflevector(low, high, 0, 2, 4, 6),
                       __builtin_shufflevector(low, high, 1, 3, 5, 7)};
        const Vec3x4 n = gatherVec3(normals[0], normals[1], normals[2], normals[3]);

        const Float4 along = dot(n, s);
        const Vec3x4 rest = s - along * n;
        const Float4 rest2 = dot(rest, rest);
        const Float4 length = sqrt4(rest2);
        const Vec3x4 unit{rest.x / length, rest.y / length, rest.z / length};
        const Float4 volume = dot(cross(n, rest), t);

        const auto size = [](const Vec3x4& a) { return abs4(a.x) + abs4(a.y) + abs4(a.z); };
        const Float4 n_size = size(n), lost = along * n_size;
        const Mask4 safe = (rest2 > splat(kLeastRest2) * (lost * lost)) & (rest2 > splat(kLeast)) &
                           (rest2 < splat(kGreatest)) &
                           (abs4(volume) > splat(kLeastVolume) * n_size * length * size(t));
        const Mask4 sign_bit = std::bit_cast<Mask4>(volume) & std::bit_cast<Mask4>(splat(-0.0f));
        Four result;
        result.safe = laneBits(safe);
        result.tangents[0] = unit.x;
        result.tangents[1] = unit.y;
        result.tangents[2] = unit.z;
        result.tangents[3] = std::bit_cast<Float4>(sign_bit ^ std::bit_cast<Mask4>(splat(sign_factor_)));
        transpose4(result.tangents[0], result.tangents[1], result.tangents[2], result.tangents[3]);
        return result;
    }

    void store(std::uint32_t v, const Four& four, bool mark) const {
        if (mark) {
            for (std::uint32_t i = 0; i < 4; ++i) {
                storeFloat4(sums_.head(v + i), four.tangents[i]);
                defaultMark(sums_, v + i) = 0.0f;
            }
            return;
        }
        const StridedSpan<Vec4> to{&out_.tangents[v], 4, out_.tangents.stride_bytes};
        for (std::size_t i = 0; i < 4; ++i) storeFloat4(&to[i].x, four.tangents[i]);
    }

    /// Writes `count` vertices: from `four`, and in double what frames() could not do.
    [[gnu::noinline]] void finish(std::uint32_t first, unsigned count, const Four& four, bool mark,
                                  VertexCounts& counts) const {
        for (unsigned i = 0; i < count; ++i) {
            const std::uint32_t v = first + i;
            const bool is_used = sums_.isTouched(v);
            Float4 tangent = four.tangents[i];
            bool is_default = false;
            if (has_extras_ || (four.safe >> i & 1) == 0) {
                const CornerFrame frame = is_used ? frameInDouble(v) : CornerFrame{};
                const Vec4& t = frame.tangent;
                if ((four.safe >> i & 1) == 0) tangent = Float4{t.x, t.y, t.z, t.w};
                is_default = frame.is_default;
                writeExtras(out_, v, frame);
            }
            counts.used += is_used ? 1 : 0;
            counts.defaults += is_default ? 1 : 0;
            storeFloat4(mark ? sums_.head(v) : &out_.tangents[v].x, tangent);
            if (mark) defaultMark(sums_, v) = is_default ? 1.0f : 0.0f;
        }
    }

    [[nodiscard]] CornerFrame frameInDouble(std::uint32_t v) const {
        const float *head = sums_.head(v), *tail = sums_.tail(v);
        const Derivatives d{{head[0], head[1], head[2]}, {head[3], tail[0], tail[1]}};
        CornerFrame frame = makeCornerFrame(d, normals_[v], sign_factor_);
        if (visits_ != nullptr && !frame.is_default) {
            frame.magnitude_s = meanLength(d.s, visits_[v]);
            frame.magnitude_t = meanLength(d.t, visits_[v]);
        }
        return frame;
    }

    VertexSums sums_;
    const float* visits_;
    StridedSpan<const Vec3> normals_;
    float sign_factor_;
    TangentOutput out_;
    bool has_extras_;
};

/// Outputs per vertex from which those per corner are copied. The tangents are in the places of the sums.
struct VertexExtras {
    Buffer<Vec3> bitangents;
    Buffer<float> magnitudes_s, magnitudes_t;

    VertexExtras(const TangentOutput& out, std::size_t vertex_count, const Allocator* allocator) {
        if (!out.bitangents.empty()) bitangents = Buffer<Vec3>(allocator, vertex_count);
        if (!out.magnitudes_s.empty()) magnitudes_s = Buffer<float>(allocator, vertex_count);
        if (!out.magnitudes_t.empty()) magnitudes_t = Buffer<float>(allocator, vertex_count);
    }
    TangentOutput output() {
        TangentOutput out;
        out.bitangents = {bitangents.data(), bitangents.size()};
        out.magnitudes_s = {magnitudes_s.data(), magnitudes_s.size()};
        out.magnitudes_t = {magnitudes_t.data(), magnitudes_t.size()};
        return out;
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

/// Copies the tangents of used corners; returns how many of them are defaults, of which `is_default` knows,
/// one per vertex; null: none. vertexOf(c): the vertex of a corner.
template <class VertexOf>
std::uint64_t copyTangents(const IndexedPlan& plan, const float* from, const std::uint8_t* is_default,
                           const StridedSpan<Vec4>& out, std::size_t begin, std::size_t end,
                           const VertexOf& vertexOf) {
    const std::uint8_t* const used = plan.corner_used.data();
    const std::size_t stride = out.stride_bytes;
    auto* to = reinterpret_cast<std::byte*>(&out[begin]);
    std::uint64_t defaults = 0;
    for (std::size_t c = begin; c < end; ++c, to += stride) {
        if (used != nullptr && used[c] == 0) continue;
        const std::size_t vertex = vertexOf(c);
        storeFloat4(&reinterpret_cast<Vec4*>(to)->x, loadFloat4(from + 4 * vertex));
        if (is_default != nullptr) defaults += is_default[vertex];
    }
    return defaults;
}

std::uint64_t copyTangents(const IndexedPlan& plan, const float* from, const std::uint8_t* is_default,
                           const StridedSpan<Vec4>& out, std::size_t begin, std::size_t end) {
    const IndexView& view = plan.corner_vertices;
    if (view.type != IndexType::u32) {
        return copyTangents(plan, from, is_default, out, begin, end, [&](std::size_t c) { return view[c]; });
    }
    const auto* const vertices = static_cast<const std::uint32_t*>(view.data);
    return copyTangents(plan, from, is_default, out, begin, end, [=](std::size_t c) { return vertices[c]; });
}

/// The places of the sums. Fresh memory costs time, so what the outputs' memory can hold meanwhile is there: the
/// tails, or, where outputs are per vertex, the heads, which then become the tangents in place.
struct SumPlaces {
    Buffer<float> head_buffer, tail_buffer;
    VertexSums sums;

    SumPlaces(const StridedSpan<Vec4>& tangents, std::size_t vertex_count, bool per_corner,
              const Allocator* allocator) {
        const bool is_tight = tangents.stride_bytes == sizeof(Vec4);
        if (is_tight && !per_corner) sums.heads = &tangents.data->x;
        if (is_tight && per_corner && 2 * tangents.count >= vertex_count) sums.tails = &tangents.data->x;
        if (sums.heads == nullptr) head_buffer = Buffer<float>(allocator, 4 * vertex_count);
        if (sums.tails == nullptr) tail_buffer = Buffer<float>(allocator, 2 * vertex_count);
        if (sums.heads == nullptr) sums.heads = head_buffer.data();
        if (sums.tails == nullptr) sums.tails = tail_buffer.data();
    }
};

/// One per vertex.
Buffer<std::uint8_t> listDefaults(const VertexSums& sums, std::size_t vertex_count, const Allocator* allocator) {
    Buffer<std::uint8_t> is_default(allocator, vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) is_default[v] = defaultMark(sums, v) != 0 ? 1 : 0;
    return is_default;
}

}  // namespace

void evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                     const Allocator* allocator, Parallel& parallel, TangentReport& report) {
    if (plan.vertex_count == 0) return;
    const bool per_corner = plan.domain == OutputDomain::corner;
    const bool has_magnitudes = !out.magnitudes_s.empty() || !out.magnitudes_t.empty();
    const SumPlaces places(out.tangents, plan.vertex_count, per_corner, allocator);
    const VertexSums& sums = places.sums;
    Buffer<float> visits(allocator, has_magnitudes ? plan.vertex_count : 0);
    VertexExtras extras(per_corner ? out : TangentOutput{}, plan.vertex_count, allocator);

    FaceSums faces(plan, pose.positions, sums, visits.data());
    if (parallel.width() > 1 && plan.triangleCount() >= kWorthThreads) {
        faces.cutIntoRanges(parallel.width(), allocator, parallel);
    }
    const VertexFrames frames(sums, visits.data(), pose.normals, plan.sign_factor,
                              per_corner ? extras.output() : out);
    const unsigned range_count = faces.ranges().count();
    std::array<TriangleCounts, VertexRanges::kMostRanges> triangle_counts;
    std::array<VertexCounts, VertexRanges::kMostRanges> vertex_counts;
    parallel.forTasks(range_count, [&](std::size_t task) {
        const auto range = static_cast<unsigned>(task);
        triangle_counts[task] = faces.sum(range);
        vertex_counts[task] = frames.write(faces.ranges().range(range), per_corner);
    });
    for (unsigned task = 0; task < range_count; ++task) {
        report.degenerate_triangle_count += triangle_counts[task].degenerate;
        report.degenerate_uv_count += triangle_counts[task].degenerate_uv;
        report.mirrored_count += triangle_counts[task].mirrored;
        report.group_count += vertex_counts[task].used;
        report.default_corner_count += vertex_counts[task].defaults;
    }
    if (!per_corner) return;
    Buffer<std::uint8_t> is_default;
    if (report.default_corner_count != 0) is_default = listDefaults(sums, plan.vertex_count, allocator);
    report.default_corner_count =
        sumRanges(parallel, plan.cornerCount(), kGrain, [&](std::size_t begin, std::size_t end) {
            copyToCorners(plan, extras.bitangents.data(), out.bitangents, begin, end);
            copyToCorners(plan, extras.magnitudes_s.data(), out.magnitudes_s, begin, end);
            copyToCorners(plan, extras.magnitudes_t.data(), out.magnitudes_t, begin, end);
            return copyTangents(plan, sums.heads, is_default.data(), out.tangents, begin, end);
        });
}

}  // namespace tspace
