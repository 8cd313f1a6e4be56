// SPDX-License-Identifier: MIT
// FrameShape::symmetric, for results of any method that has bitangents.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/tangents.h"

namespace tspace {

/// The bisector that takes the place of the tangent, or the tangent itself.
Vec3 symmetricTangent(const Vec3& tangent, const Vec3& bitangent, const Vec3& normal);

/// Turns each tangent, in the plane across its normal, half of the way to the direction that is perpendicular
/// to the bitangent. So cross(N, T) and T are each off by half of the UVs' shear, where T alone was exact
/// before. normalOf(i): the normal of entry i. An entry without tangent, bitangent or normal stays as it is.
template <class NormalOf>
void makeSymmetric(const StridedSpan<Vec4>& tangents, const StridedSpan<Vec3>& bitangents, const NormalOf& normalOf,
                   Parallel& parallel) {
    parallel.forRanges(tangents.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec4& tangent = tangents[i];
            const Vec3 turned = symmetricTangent(xyz(tangent), bitangents[i], normalOf(i));
            tangent = {turned.x, turned.y, turned.z, tangent.w};
        }
    });
}

/// Where bitangents go that only the symmetric frame needs.
struct NeededBitangents {
    Buffer<Vec3> own;
    TangentOutput out;

    NeededBitangents(const TangentOutput& wanted, const Allocator* allocator) : out(wanted) {
        if (!wanted.bitangents.empty()) return;
        own = Buffer<Vec3>(allocator, wanted.tangents.count);
        out.bitangents = {own.data(), own.size()};
    }
};

}  // namespace tspace
