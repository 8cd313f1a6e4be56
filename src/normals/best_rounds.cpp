// SPDX-License-Identifier: MIT
#include "normals/best_rounds.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/input_scale.h"

namespace tspace::smooth {

namespace {

static_assert(kBestTriangles == SumRound::kTriangles && kBestGroup == SumRound::kGroups);

constexpr std::size_t kRowsOf[] = {1, kFitRows, kStepRows};  // of each kind
constexpr std::size_t kNormalFloats = 8;                     // from one of the given normals to the next

/// The vectors of a block of groups, from `first` on.
struct Fours {
    alignas(64) float floats[4 * SumRound::kGroups] = {};

    Fours(const std::byte* from, std::size_t stride, std::size_t first, std::size_t count) {
        from += stride * first;
        for (std::size_t i = 0; i < count; ++i, from += stride) std::memcpy(floats + 4 * i, from, sizeof(float[3]));
    }
};

bool isZero(const float* vector) { return vector[0] == 0 && vector[1] == 0 && vector[2] == 0; }

}  // namespace

BestRound::BestRound(Kind kind, const BestKernel& kernel, const BestSource& source, void* to, std::size_t to_stride)
    : SumRound(kRowsOf[static_cast<std::size_t>(kind)], kind == Kind::fit),
      kind_(kind),
      kernel_(kernel),
      source_(source),
      to_(static_cast<std::byte*>(to)),
      to_stride_(to_stride) {}

void BestRound::add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count, float* rows) const {
    if (kind_ == Kind::sharp)
        kernel_.add_sharp(source_, vertices, count, rows);
    else
        (kind_ == Kind::fit ? kernel_.add_fit : kernel_.add_step)(source_, vertices, groups, count, rows);
}

void BestRound::finish(float* sums, const std::uint32_t*, std::size_t first, std::size_t count) const {
    if (kind_ == Kind::sharp) {
        kernel_.finish_sharp(sums, kGroups);
    } else {
        const Fours robust(source_.robust, source_.robust_stride, first, count);
        if (kind_ == Kind::step)
            kernel_.finish_step(sums, robust.floats, kGroups);
        else
            kernel_.finish_fit(sums, robust.floats, Fours(source_.sharp, source_.sharp_stride, first, count).floats,
                               kGroups);
    }
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(to_ + to_stride_ * (first + i), sums + 4 * row_count * i, sizeof(Vec3));
}

BestSource bestSource(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions,
                      Convention convention) {
    BestSource source;
    source.positions = reinterpret_cast<const std::byte*>(positions.data);
    source.stride = positions.stride_bytes;
    source.last_vertex = static_cast<std::uint32_t>(positions.count - 1);
    source.scale = inputScale(triangles, positions, {}).positions;
    source.factor = static_cast<float>(normalFactor(convention));
    return source;
}

void refineTriangles(const TriangleGroups& triangles, std::size_t point_count, const StridedSpan<const Vec3>& positions,
                     const NormalOptions& options, float* normals, Parallel& parallel) {
    const Allocator* const allocator = options.execution.allocator;
    Buffer<float> sharp(allocator, 4 * point_count), results(allocator, 4 * point_count);
    constexpr std::size_t kStride = sizeof(float[4]);
    const BestKernel kernel = bestKernelFor(options.execution.simd);
    BestSource source = bestSource(triangles, positions, options.convention);
    source.robust = reinterpret_cast<const std::byte*>(normals);
    source.sharp = reinterpret_cast<const std::byte*>(sharp.data());
    source.robust_stride = sizeof(float[kNormalFloats]);
    source.sharp_stride = kStride;
    SumRounds rounds(triangles, 3, point_count, kFitRows, allocator, parallel);
    rounds.run(BestRound(BestRound::Kind::sharp, kernel, source, sharp.data(), kStride));
    rounds.run(BestRound(BestRound::Kind::fit, kernel, source, results.data(), kStride));
    parallel.forRanges(point_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            float *const normal = normals + kNormalFloats * p, *const result = results.data() + 4 * p;
            const bool has_mean = !std::signbit(normal[3]);
            if (has_mean) std::copy_n(result, 3, normal);
            if (!has_mean || isZero(sharp.data() + 4 * p)) std::fill_n(result, 3, 0.0f);  // takes no part
        }
    });
    source.robust_stride = kStride;
    for (unsigned step = 0; step < options.refine; ++step) {
        source.robust = reinterpret_cast<const std::byte*>(results.data());
        rounds.run(BestRound(BestRound::Kind::step, kernel, source, sharp.data(), kStride));
        std::swap(results, sharp);
    }
    if (options.refine == 0) return;
    parallel.forRanges(point_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const float* const result = results.data() + 4 * p;
            if (!isZero(result)) std::copy_n(result, 3, normals + kNormalFloats * p);
        }
    });
}

}  // namespace tspace::smooth
