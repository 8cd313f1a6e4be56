// SPDX-License-Identifier: MIT
#include "maps/texel_system.h"

namespace tspace {

namespace {

void addBlock(SymmetricBlock& to, float weight, const SymmetricBlock& metric) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * metric[i];
}

}  // namespace

TexelSystem::TexelSystem(const Allocator* allocator, std::uint32_t width, std::uint32_t height,
                         std::span<const TexelRole> roles)
    : width_(width), height_(height), row_of_(allocator, roles.size(), 0U) {
    std::uint32_t count = 1;
    for (std::size_t i = 0; i < roles.size(); ++i) {
        if (roles[i] != TexelRole::apart) row_of_[i] = count++;
    }
    texel_of_ = Buffer<std::uint32_t>(allocator, count, 0U);
    is_unknown_ = Buffer<bool>(allocator, count, false);
    rows_ = Buffer<TexelRow>(allocator, count, TexelRow{});
    for (std::size_t i = 0; i < roles.size(); ++i) {
        if (row_of_[i] == 0) continue;
        texel_of_[row_of_[i]] = static_cast<std::uint32_t>(i);
        is_unknown_[row_of_[i]] = roles[i] == TexelRole::unknown;
    }
}

void TexelSystem::add(std::uint32_t x, std::uint32_t y, float fx, float fy, const FitSample& sample) {
    const std::uint32_t right_x = right(x), below_y = below(y);
    const std::uint32_t at00 = rowOf(x, y), at10 = rowOf(right_x, y), at01 = rowOf(x, below_y),
                        at11 = rowOf(right_x, below_y);
    if (at00 == 0 || (fx > 0 && at10 == 0) || (fy > 0 && (at01 == 0 || (fx > 0 && at11 == 0)))) return;
    const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
    TexelRow &t00 = rows_[at00], &t10 = rows_[at10], &t01 = rows_[at01], &t11 = rows_[at11];
    addBlock(t00.blocks[0], w00 * w00, sample.metric);
    t00.side = t00.side + w00 * sample.side;
    if (fx > 0) {
        addBlock(t00.blocks[1], w00 * w10, sample.metric);
        addBlock(t10.blocks[0], w10 * w10, sample.metric);
        t10.side = t10.side + w10 * sample.side;
    }
    if (!(fy > 0)) return;
    addBlock(t00.blocks[3], w00 * w01, sample.metric);
    addBlock(t01.blocks[0], w01 * w01, sample.metric);
    t01.side = t01.side + w01 * sample.side;
    if (!(fx > 0)) return;
    addBlock(t00.blocks[4], w00 * w11, sample.metric);
    addBlock(t10.blocks[2], w10 * w01, sample.metric);
    addBlock(t10.blocks[3], w10 * w11, sample.metric);
    addBlock(t01.blocks[1], w01 * w11, sample.metric);
    addBlock(t11.blocks[0], w11 * w11, sample.metric);
    t11.side = t11.side + w11 * sample.side;
}

FitSample acrossSample(const Vec3& wanted, float along, float wanted_length) {
    const float less = 1 - along;
    const Vec3& v = wanted;
    return {{1 - less * v.x * v.x, -less * v.x * v.y, -less * v.x * v.z, 1 - less * v.y * v.y, -less * v.y * v.z,
             1 - less * v.z * v.z},
            (along * wanted_length) * v};
}

FitSample twoChannelSample(const Vec3& wanted) {
    // The derivative of z by x and y. It is unbounded where the surface is seen from the side, so it is clamped.
    const float z = std::max(wanted.z, 0.1f), x = wanted.x / z, y = wanted.y / z;
    const SymmetricBlock metric{1 + x * x, x * y, 0, 1 + y * y, 0, 0};
    return {metric, blockTimes(metric, wanted)};
}

}  // namespace tspace
