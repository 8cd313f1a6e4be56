// SPDX-License-Identifier: MIT
// Range by range: zero the sums, add the triangles that are listed, and finish. A task has some ranges, and
// room for the sums of one.
#include "tangents/estimators/group_estimates.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/add_row.h"
#include "tangents/estimators/estimator.h"

namespace tspace::estimators {

namespace {

constexpr std::size_t kRangeBytes = std::size_t{512} << 10;  // of sums: half of a second cache
constexpr std::size_t kTasksPerThread = 4;
constexpr std::uint32_t kNoVertex = 0xffffffffu;

std::size_t wholeLanes(std::size_t groups) { return (groups + kLaneGroup - 1) / kLaneGroup * kLaneGroup; }

struct Setting {
    Estimator estimator;
    VertexSource source;
    const TriangleGroups& triangles;
    StridedSpan<const Vec3> normals;
    float length_factor;
    std::span<const GroupEstimates> to;
    std::uint32_t group_count;
    const float* from = nullptr;  ///< for a step: of all groups, and zeros for what is no group
    float* next = nullptr;        ///< the same for the step after this round; null: there is none

    [[nodiscard]] std::size_t rowCount() const { return from != nullptr ? kStepRows : estimator.row_count; }
};

/// Room for one range.
struct Room {
    float* sums;              ///< row_count rows of four for each group
    std::uint32_t* vertices;  ///< of each group, any corner's
};

class RangeWork {
  public:
    RangeWork(const Setting& setting, const Room& room) : setting_(setting), room_(room) {}

    void run(std::span<const std::uint32_t> entries, std::size_t first_group, std::size_t group_count) {
        start(first_group, group_count);
        for (const std::uint32_t entry : entries) {
            if ((entry & RangeLists::kBlock) != 0) {
                addBlock((entry & ~RangeLists::kBlock) * kBlockTriangles);
            } else {
                addTriangle(entry);
            }
        }
        flush();
        finish();
    }

    /// All triangles, without lists.
    void runAll(std::size_t group_count) {
        start(0, group_count);
        for (std::size_t t = 0; t < setting_.triangles.count; t += kBlockTriangles) addBlock(t);
        finish();
    }

  private:
    void start(std::size_t first_group, std::size_t group_count) {
        first_group_ = static_cast<std::uint32_t>(first_group);
        group_count_ = static_cast<std::uint32_t>(group_count);
        std::fill_n(room_.sums, wholeLanes(group_count) * 4 * setting_.rowCount(), 0.0f);
        std::fill_n(room_.vertices, group_count, kNoVertex);
    }

    void addBlock(std::size_t first) {
        flush();
        pending_ = std::min(kBlockTriangles, setting_.triangles.count - first);
        setting_.triangles.read(first, pending_, vertices_, groups_);
        flush();
    }

    void addTriangle(std::size_t triangle) {
        setting_.triangles.read(triangle, 1, vertices_ + 3 * pending_, groups_ + 3 * pending_);
        if (++pending_ == kBlockTriangles) flush();
    }

    void flush() {
        if (pending_ == 0) return;
        if (setting_.from != nullptr) {
            for (std::size_t i = 0; i < 3 * pending_; ++i) known_[i] = std::min(groups_[i], setting_.group_count);
            setting_.estimator.add_step(setting_.source, vertices_, known_, setting_.from, pending_, rows_);
        } else {
            setting_.estimator.add(setting_.source, vertices_, pending_, rows_);
        }
        switch (setting_.rowCount()) {
            case 2:
                addRows<2>();
                break;
            case 4:
                addRows<4>();
                break;
            default:
                addRows<kMostRows>();
                break;
        }
        pending_ = 0;
    }

    template <std::size_t kRows>
    void addRows() {
        for (std::size_t i = 0; i < 3 * pending_; ++i) {
            const std::uint32_t place = groups_[i] - first_group_;
            if (place >= group_count_) continue;
            room_.vertices[place] = vertices_[i];
            float* const sums = room_.sums + 4 * kRows * place;
            const float* const rows = rows_ + 4 * kRows * i;
            for (std::size_t r = 0; r < kRows; ++r) addRow(sums + 4 * r, rows + 4 * r);
        }
    }

    void finish() {
        const std::size_t step = 4 * setting_.rowCount();
        alignas(64) float normals[4 * kLaneGroup];
        for (std::size_t first = 0; first < group_count_; first += kLaneGroup) {
            const std::size_t count = std::min<std::size_t>(kLaneGroup, group_count_ - first);
            std::fill_n(normals, 4 * kLaneGroup, 0.0f);
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t vertex = room_.vertices[first + i];
                if (vertex == kNoVertex) continue;
                const Vec3 n = setting_.normals[vertex];
                normals[4 * i] = n.x;
                normals[4 * i + 1] = n.y;
                normals[4 * i + 2] = n.z;
            }
            float* const sums = room_.sums + step * first;
            const std::size_t group = first_group_ + first;
            if (setting_.from != nullptr) {
                setting_.estimator.finish_step(sums, normals, setting_.from + kStepFloats * group, kLaneGroup);
            } else {
                setting_.estimator.finish(sums, normals, kLaneGroup);
            }
            for (std::size_t i = 0; i < count; ++i) writeRound(group + i, sums + step * i);
        }
    }

    void writeRound(std::size_t group, const float* result) const {
        const float* const before = setting_.from == nullptr ? nullptr : setting_.from + kStepFloats * group;
        const bool stays = before != nullptr && result[0] == 0 && result[1] == 0 && result[2] == 0;
        if (!stays) write(group, result);
        if (setting_.next == nullptr) return;
        float* const after = setting_.next + kStepFloats * group;
        if (stays) {
            std::copy_n(before, kStepFloats, after);
            return;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            after[i] = result[3] * result[i];
            after[4 + i] = result[7] * result[4 + i];
        }
        after[3] = before == nullptr ? result[8] : before[3];
        after[7] = 0;
    }

    void write(std::size_t group, const float* result) const {
        const GroupEstimates* next = setting_.to.data();
        for (; group >= next->count; ++next) group -= next->count;
        const GroupEstimates& to = *next;
        std::memcpy(to.tangents + group * to.tangent_stride, result, sizeof(float[3]));
        if (to.rest == nullptr) return;
        const float rest[4] = {result[4], result[5], result[6], result[3] * setting_.length_factor};
        const float length_t = result[7] * setting_.length_factor;
        std::memcpy(to.rest + group * to.rest_stride, rest, sizeof rest);
        std::memcpy(to.lengths_t + group * to.length_stride, &length_t, sizeof(float));
    }

    const Setting& setting_;
    Room room_;
    std::uint32_t first_group_ = 0, group_count_ = 0;
    std::size_t pending_ = 0;  // triangles in the block
    std::uint32_t vertices_[3 * kBlockTriangles] = {}, groups_[3 * kBlockTriangles] = {};
    std::uint32_t known_[3 * kBlockTriangles] = {};  // groups, or the place behind all
    alignas(64) float rows_[3 * kBlockTriangles * 4 * kMostRows];
};

Setting settingOf(Method method, const TriangleGroups& triangles, std::size_t group_count, const Pose& pose,
                  const StridedSpan<const Vec2>& uvs, const InputScale& scale, std::span<const GroupEstimates> to,
                  SimdTarget simd) {
    const VertexSource source{vertexArrays(pose, uvs), scale.positions, scale.uvs};
    const bool tangents_only =
        std::all_of(to.begin(), to.end(), [](const GroupEstimates& groups) { return groups.rest == nullptr; });
    const Estimator estimator =
        method == Method::fast ? twoWeightsFor(simd, tangents_only) : quadraticRecoveryFor(simd);
    return {
        estimator, source, triangles, pose.normals, scale.lengthFactor(), to, static_cast<std::uint32_t>(group_count)};
}

}  // namespace

void estimateGroups(Method method, unsigned refine, const TriangleGroups& triangles, const Pose& pose,
                    const StridedSpan<const Vec2>& uvs, const InputScale& scale, std::span<const GroupEstimates> to,
                    const Execution& execution, Parallel& parallel) {
    std::size_t group_count = 0;
    for (const GroupEstimates& groups : to) group_count += groups.count;
    if (group_count == 0) return;
    Setting setting = settingOf(method, triangles, group_count, pose, uvs, scale, to, execution.simd);
    const std::size_t group_bytes = sizeof(float[4]) * setting.estimator.row_count;
    const std::size_t range_size = std::bit_floor(kRangeBytes / group_bytes);
    const std::size_t ranges = (group_count + range_size - 1) / range_size;
    const std::size_t tasks =
        parallel.width() == 1 ? 1 : std::min(ranges, std::size_t{kTasksPerThread} * parallel.width());
    const std::size_t groups_each = std::min(range_size, wholeLanes(group_count));
    const std::size_t sums_each = groups_each * 4 * setting.estimator.row_count;
    Buffer<float> sums(execution.allocator, tasks * sums_each);
    Buffer<std::uint32_t> vertices(execution.allocator, tasks * groups_each);
    const auto room = [&](std::size_t task) {
        return Room{sums.data() + task * sums_each, vertices.data() + task * groups_each};
    };
    if (setting.estimator.add_step == nullptr) refine = 0;
    const std::size_t step_floats = kStepFloats * (wholeLanes(group_count + 1));
    Buffer<float> steps[2];
    for (unsigned i = 0; i < refine; ++i) steps[i] = Buffer<float>(execution.allocator, step_floats, 0.0f);
    const auto forRounds = [&](const auto& body) {
        for (unsigned round = 0; round <= refine; ++round) {
            setting.from = round == 0 ? nullptr : steps[round - 1].data();
            setting.next = round == refine ? nullptr : steps[round].data();
            body();
        }
    };
    if (ranges == 1) {
        forRounds([&] { RangeWork(setting, room(0)).runAll(group_count); });
        return;
    }
    const RangeLists lists(triangles, kBlockTriangles, group_count, range_size, execution.allocator, parallel);
    forRounds([&] {
        parallel.forTasks(tasks, [&](std::size_t task) {
            RangeWork work(setting, room(task));
            for (std::size_t r = ranges * task / tasks; r < ranges * (task + 1) / tasks; ++r) {
                const std::size_t first = r * range_size;
                work.run(lists.entries(r), first, std::min(range_size, group_count - first));
            }
        });
    });
}

}  // namespace tspace::estimators
