// SPDX-License-Identifier: MIT
// Passes of the methods `fast` and `best`: the estimate, and the refinement steps after it.
#include "core/tangents/estimators/group_estimates.h"

#include <algorithm>
#include <cstring>

#include "core/base/range_lists.h"
#include "core/tangents/estimators/estimator.h"

namespace tspace::estimators {
namespace {

static_assert(kBlockTriangles == SumRound::kTriangles && kLaneGroup == SumRound::kGroups);

struct Setting {
    Estimator estimator;
    VertexSource source;
    StridedSpan<const Vec3> normals;
    float length_factor;
    std::span<const GroupEstimates> to;
    std::uint32_t group_count;
};

class EstimateRound final : public SumRound {
  public:
    /// `from`: input of a refinement step, for all groups, with zeros for the dummy group; null for the first pass.
    /// `next`: output for the next step; null if there is none.
    EstimateRound(const Setting& setting, const float* from, float* next)
        : SumRound(from != nullptr ? kStepRows : setting.estimator.row_count), setting_(setting), from_(from),
          next_(next) {}

    void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count,
             float* rows) const override {
        if (from_ == nullptr) return setting_.estimator.add(setting_.source, vertices, count, rows);
        std::uint32_t known[3 * kTriangles];  // group of each corner, or the dummy group, which follows all others
        for (std::size_t i = 0; i < 3 * kTriangles; ++i) known[i] = std::min(groups[i], setting_.group_count);
        setting_.estimator.add_step(setting_.source, vertices, known, from_, count, rows);
    }

    void finish(float* sums, const std::uint32_t* vertices, std::size_t first, std::size_t count) const override {
        alignas(64) float normals[4 * kGroups] = {};
        for (std::size_t i = 0; i < count; ++i) {
            if (vertices[i] == kNoVertex) continue;
            const Vec3 n = setting_.normals[vertices[i]];
            normals[4 * i] = n.x;
            normals[4 * i + 1] = n.y;
            normals[4 * i + 2] = n.z;
        }
        if (from_ != nullptr)
            setting_.estimator.finish_step(sums, normals, from_ + kStepFloats * first, kGroups);
        else
            setting_.estimator.finish(sums, normals, kGroups);
        for (std::size_t i = 0; i < count; ++i) writeRound(first + i, sums + 4 * row_count * i);
    }

  private:
    void writeRound(std::size_t group, const float* result) const {
        const float* const before = from_ == nullptr ? nullptr : from_ + kStepFloats * group;
        const bool stays = before != nullptr && result[0] == 0 && result[1] == 0 && result[2] == 0;
        if (!stays) write(group, result);
        if (next_ == nullptr) return;
        float* const after = next_ + kStepFloats * group;
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
        to.rest[group] = {{result[4], result[5], result[6], result[3] * setting_.length_factor},
                          result[7] * setting_.length_factor};
    }

    const Setting& setting_;
    const float* from_;
    float* next_;
};

Setting settingOf(Method method, std::size_t group_count, const Pose& pose, const StridedSpan<const Vec2>& uvs,
                  const InputScale& scale, std::span<const GroupEstimates> to, SimdTarget simd) {
    const VertexSource source{vertexArrays(pose, uvs), scale.positions, scale.uvs};
    const bool tangents_only =
        std::all_of(to.begin(), to.end(), [](const GroupEstimates& groups) { return groups.rest == nullptr; });
    const Estimator estimator =
        method == Method::fast ? twoWeightsFor(simd, tangents_only) : quadraticRecoveryFor(simd);
    return {estimator, source, pose.normals, scale.lengthFactor(), to, static_cast<std::uint32_t>(group_count)};
}

}  // namespace

void estimateGroups(Method method, unsigned refine, const TriangleGroups& triangles, const Pose& pose,
                    const StridedSpan<const Vec2>& uvs, const InputScale& scale, std::span<const GroupEstimates> to,
                    const Execution& execution, Parallel& parallel) {
    std::size_t group_count = 0;
    for (const GroupEstimates& groups : to) group_count += groups.count;
    if (group_count == 0) return;
    const Setting setting = settingOf(method, group_count, pose, uvs, scale, to, execution.simd);
    SumRounds rounds(triangles, 3, group_count, setting.estimator.row_count, execution.allocator, parallel);
    if (setting.estimator.add_step == nullptr) refine = 0;
    const std::size_t step_floats = kStepFloats * (group_count + kLaneGroup);
    Buffer<float> steps[2];
    for (unsigned i = 0; i < refine; ++i) steps[i] = Buffer<float>(execution.allocator, step_floats, 0.0f);
    for (unsigned round = 0; round <= refine; ++round) {
        rounds.run(EstimateRound(setting, round == 0 ? nullptr : steps[round - 1].data(),
                                 round == refine ? nullptr : steps[round].data()));
    }
}

}  // namespace tspace::estimators
