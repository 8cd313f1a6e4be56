// SPDX-License-Identifier: MIT
// Rounds over the triangles, each range by range of points: zero the sums, add the triangles that are listed, finish.
#include "normals/best_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/input_scale.h"
#include "core/range_lists.h"
#include "core/typed_indices.h"
#include "core/vertex_ranges.h"

namespace tspace::smooth {

namespace {

constexpr std::size_t kRangePoints = 4096;  // whose sums are half of a second cache
constexpr std::size_t kTasksPerThread = 4;
constexpr std::size_t kNormalFloats = 8;  // from one of the given normals to the next

std::size_t wholeGroups(std::size_t count) { return (count + kBestGroup - 1) / kBestGroup * kBestGroup; }

/// The mesh's triangles, as range lists read them.
class PointTriangles final : public TriangleGroups {
  public:
    PointTriangles(const MeshView& mesh, const Buffer<std::uint32_t>& points)
        : TriangleGroups(mesh.faceCount()), mesh_(mesh), points_(points) {}

    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const override {
        const std::uint32_t* const v = readIndices(mesh_.indices, 3 * first, 3 * size, groups);
        if (v != groups) std::copy_n(v, 3 * size, groups);
        if (vertices != nullptr) std::copy_n(groups, 3 * size, vertices);
        if (points_.empty()) return;
        for (std::size_t i = 0; i < 3 * size; ++i) groups[i] = points_[groups[i]];
    }

  private:
    const MeshView& mesh_;
    const Buffer<std::uint32_t>& points_;
};

struct Setting {
    const TriangleGroups& triangles;
    BestKernel kernel;
    BestSource source;
    const float* normals;
    float* sharp;    ///< four floats per point, as is
    float* results;  ///< the normals of `best`, or of the step before
    std::size_t point_count;
};

/// One range of points in one round. kRows is 1 for the `max` normals, kFitRows, or kStepRows: from `results` to
/// `sharp`.
template <std::size_t kRows>
class RangeWork {
  public:
    RangeWork(const Setting& setting, float* sums) : setting_(setting), sums_(sums) {}

    void run(std::span<const std::uint32_t> entries, std::size_t first_point) {
        first_ = static_cast<std::uint32_t>(first_point);
        count_ = static_cast<std::uint32_t>(std::min(kRangePoints, setting_.point_count - first_point));
        std::fill_n(sums_, 4 * kRows * wholeGroups(count_), 0.0f);
        for (const std::uint32_t entry : entries) {
            if ((entry & RangeLists::kBlock) == 0) {
                addTriangle(entry);
            } else {
                flush();
                read((entry & ~RangeLists::kBlock) * kBestTriangles, kBestTriangles);
                flush();
            }
        }
        flush();
        finish();
    }

  private:
    void read(std::size_t first, std::size_t size) {
        size = std::min(size, setting_.triangles.count - first);
        setting_.triangles.read(first, size, vertices_ + 3 * pending_, points_ + 3 * pending_);
        pending_ += size;
    }

    void addTriangle(std::size_t triangle) {
        read(triangle, 1);
        if (pending_ == kBestTriangles) flush();
    }

    void flush() {
        if (pending_ == 0) return;
        if constexpr (kRows == 1) {
            setting_.kernel.add_sharp(setting_.source, vertices_, pending_, rows_);
        } else if constexpr (kRows == kFitRows) {
            setting_.kernel.add_fit(setting_.source, vertices_, points_, pending_, rows_);
        } else {
            setting_.kernel.add_step(setting_.source, vertices_, points_, pending_, rows_);
        }
        for (std::size_t i = 0; i < 3 * pending_; ++i) {
            const std::uint32_t place = points_[i] - first_;
            if (place >= count_) continue;
            addRows<kRows>(sums_ + 4 * kRows * place, rows_ + 4 * kRows * i);
        }
        pending_ = 0;
    }

    void finish() {
        const std::size_t whole = wholeGroups(count_);
        if constexpr (kRows == 1) {
            setting_.kernel.finish_sharp(sums_, whole);
            std::copy_n(sums_, 4 * count_, setting_.sharp + std::size_t{4} * first_);
        } else if constexpr (kRows == kStepRows) {
            alignas(64) float normals[4 * kBestGroup];
            for (std::size_t group = 0; group < whole; group += kBestGroup) {
                const std::size_t size = std::min(kBestGroup, count_ - group), first = first_ + group;
                std::fill_n(normals, 4 * kBestGroup, 0.0f);
                std::copy_n(setting_.results + 4 * first, 4 * size, normals);
                float* const sums = sums_ + 4 * kRows * group;
                setting_.kernel.finish_step(sums, normals, kBestGroup);
                for (std::size_t i = 0; i < size; ++i)
                    std::copy_n(sums + 4 * kRows * i, 4, setting_.sharp + 4 * (first + i));
            }
        } else {
            alignas(64) float robust[4 * kBestGroup], sharp[4 * kBestGroup];
            for (std::size_t group = 0; group < whole; group += kBestGroup) {
                const std::size_t size = std::min(kBestGroup, count_ - group), first = first_ + group;
                std::fill_n(robust, 4 * kBestGroup, 0.0f);
                std::fill_n(sharp, 4 * kBestGroup, 0.0f);
                for (std::size_t i = 0; i < size; ++i)
                    std::copy_n(setting_.normals + kNormalFloats * (first + i), 4, robust + 4 * i);
                std::copy_n(setting_.sharp + 4 * first, 4 * size, sharp);
                float* const sums = sums_ + 4 * kRows * group;
                setting_.kernel.finish_fit(sums, robust, sharp, kBestGroup);
                for (std::size_t i = 0; i < size; ++i)
                    std::copy_n(sums + 4 * kRows * i, 4, setting_.results + 4 * (first + i));
            }
        }
    }

    const Setting& setting_;
    float* sums_;
    std::uint32_t first_ = 0, count_ = 0;
    std::size_t pending_ = 0;  // triangles in the block
    std::uint32_t vertices_[3 * kBestTriangles] = {}, points_[3 * kBestTriangles] = {};
    alignas(64) float rows_[3 * kBestTriangles * 4 * kRows] = {};
};

template <std::size_t kRows>
void runRound(const Setting& setting, const RangeLists& lists, Buffer<float>& sums, std::size_t tasks,
              Parallel& parallel) {
    const std::size_t room = sums.size() / tasks;
    parallel.forTasks(tasks, [&](std::size_t task) {
        RangeWork<kRows> work(setting, sums.data() + task * room);
        for (std::size_t r = lists.count() * task / tasks; r < lists.count() * (task + 1) / tasks; ++r)
            work.run(lists.entries(r), r * kRangePoints);
    });
}

}  // namespace

BestSource bestSource(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions, double factor) {
    BestSource source;
    source.positions = reinterpret_cast<const std::byte*>(positions.data);
    source.stride = positions.stride_bytes;
    source.last_vertex = static_cast<std::uint32_t>(positions.count - 1);
    source.scale = inputScale(triangles, positions, {}).positions;
    source.factor = static_cast<float>(factor);
    return source;
}

void refineTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                     const Buffer<std::uint32_t>& points, const NormalOptions& options, float* normals,
                     Parallel& parallel) {
    const Allocator* const allocator = options.execution.allocator;
    const std::size_t count = mesh.vertexCount();
    Buffer<float> sharp(allocator, 4 * count), results(allocator, 4 * count);
    const PointTriangles triangles(mesh, points);
    const RangeLists lists(triangles, kBestTriangles, count, kRangePoints, allocator, parallel);
    const std::size_t tasks =
        parallel.width() == 1 ? 1 : std::min(lists.count(), std::size_t{kTasksPerThread} * parallel.width());
    Buffer<float> sums(allocator, tasks * 4 * kFitRows * std::min(kRangePoints, wholeGroups(count)));
    BestSource source = bestSource(triangles, positions, normalFactor(options.convention));
    source.robust = reinterpret_cast<const std::byte*>(normals);
    source.sharp = reinterpret_cast<const std::byte*>(sharp.data());
    Setting setting{triangles, bestKernelFor(options.execution.simd), source, normals, sharp.data(), results.data(),
                    count};
    runRound<1>(setting, lists, sums, tasks, parallel);
    runRound<kFitRows>(setting, lists, sums, tasks, parallel);
    parallel.forRanges(count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            float* const normal = normals + kNormalFloats * p;
            const float* const s = sharp.data() + 4 * p;
            const bool has_mean = !std::signbit(normal[3]);
            if (has_mean) std::copy_n(results.data() + 4 * p, 3, normal);
            const bool takes_part = has_mean && (s[0] != 0 || s[1] != 0 || s[2] != 0);
            if (!takes_part) std::fill_n(results.data() + 4 * p, 4, 0.0f);
        }
    });
    for (unsigned step = 0; step < options.refine; ++step) {
        setting.source.robust = reinterpret_cast<const std::byte*>(setting.results);
        setting.source.robust_stride = 4 * sizeof(float);
        runRound<kStepRows>(setting, lists, sums, tasks, parallel);
        std::swap(setting.results, setting.sharp);
    }
    if (options.refine == 0) return;
    parallel.forRanges(count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const float* const result = setting.results + 4 * p;
            if (result[0] != 0 || result[1] != 0 || result[2] != 0) std::copy_n(result, 3, normals + kNormalFloats * p);
        }
    });
}

}  // namespace tspace::smooth
