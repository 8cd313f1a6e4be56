// SPDX-License-Identifier: MIT
// Normals of a call, normalized if TangentOptions::normalize_normals requests it.
#pragma once

#include <cstddef>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/span.h"

namespace tspace {

/// Normals of unit length (withUnitLength): a view of the input if all normals are unit, or if `is_wanted` is false;
/// otherwise a copy. Throws OutOfMemory.
class UnitNormals {
  public:
    UnitNormals(StridedSpan<const Vec3> normals, bool is_wanted, const Allocator* allocator, Parallel& parallel)
        : view_(normals) {
        if (!is_wanted) return;
        const std::uint64_t count = sumRanges(parallel, normals.count, Parallel::kGrain, [&](auto begin, auto end) {
            std::uint64_t scaled = 0;
            for (std::size_t i = begin; i < end; ++i) scaled += unitScale(normals[i]) != 1 ? 1 : 0;
            return scaled;
        });
        if (count == 0) return;
        copy_ = Buffer<Vec3>(allocator, normals.count);
        parallel.forRanges(normals.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) copy_[i] = withUnitLength(normals[i]);
        });
        view_ = {copy_.data(), copy_.size()};
    }

    [[nodiscard]] const StridedSpan<const Vec3>& view() const { return view_; }

  private:
    Buffer<Vec3> copy_;
    StridedSpan<const Vec3> view_;
};

}  // namespace tspace
