// SPDX-License-Identifier: MIT
// The addition that all sums are made of. Not for files that are compiled for one CPU (see
// simd/lanes_scalar.h).
#pragma once

#include "core/float4.h"

namespace tspace {

/// to[0..3] += row[0..3]; both aligned to 16 bytes.
inline void addRow(float* to, const float* row) {
    using Row __attribute__((may_alias)) = Float4;
    *reinterpret_cast<Row*>(to) += *reinterpret_cast<const Row*>(row);
}

/// to[0..2] += row[0..2], where `row` has four numbers.
inline void addVector(float* to, const float* row) {
    const Float4 sum = __builtin_shufflevector(loadPair(to), Float4{to[2], 0, 0, 0}, 0, 1, 4, 5) + loadFloat4(row);
    storePair(to, sum);
    to[2] = sum[2];
}

}  // namespace tspace
