// SPDX-License-Identifier: MIT
#include "maps/texel_system.h"

#include <algorithm>

namespace tspace {

namespace {

void addBlock(SymmetricBlock& to, float weight, const SymmetricBlock& metric) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * metric[i];
}

}  // namespace

void TexelRow::add(const TexelRow& other) {
    for (std::size_t i = 0; i < blocks.size(); ++i) addBlock(blocks[i], 1, other.blocks[i]);
    side = side + other.side;
}

void addSample(TexelRow* here, TexelRow* next, std::uint32_t x, std::uint32_t right, float fx, float fy,
               const FitSample& sample) {
    const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
    TexelRow &t00 = here[x], &t10 = here[right], &t01 = next[x], &t11 = next[right];
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

Vec3 TexelSystem::aroundTexel(const Vec3* texels, std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t left_x = left(x), right_x = right(x), above_y = above(y), below_y = below(y);
    const TexelRow *here = row(y), *up = row(above_y);
    const Vec3* at = texels + std::size_t{y} * width_;
    const Vec3 *at_above = texels + std::size_t{above_y} * width_, *at_below = texels + std::size_t{below_y} * width_;
    Vec3 sum = blockTimes(here[x].blocks[1], at[right_x]);
    sum = sum + blockTimes(here[x].blocks[2], at_below[left_x]);
    sum = sum + blockTimes(here[x].blocks[3], at_below[x]);
    sum = sum + blockTimes(here[x].blocks[4], at_below[right_x]);
    sum = sum + blockTimes(here[left_x].blocks[1], at[left_x]);
    sum = sum + blockTimes(up[right_x].blocks[2], at_above[right_x]);
    sum = sum + blockTimes(up[x].blocks[3], at_above[x]);
    return sum + blockTimes(up[left_x].blocks[4], at_above[left_x]);
}

FitSample acrossSample(const Vec3& wanted, float along, float wanted_length) {
    const float less = 1 - along;
    const Vec3& v = wanted;
    return {{1 - less * v.x * v.x, -less * v.x * v.y, -less * v.x * v.z, 1 - less * v.y * v.y, -less * v.y * v.z,
             1 - less * v.z * v.z},
            (along * wanted_length) * v};
}

FitSample twoChannelSample(const Vec3& wanted) {
    // What a change of x and y does to z. Where the surface is seen from the side it has no bound, and is kept from one.
    const float z = std::max(wanted.z, 0.1f), x = wanted.x / z, y = wanted.y / z;
    const SymmetricBlock metric{1 + x * x, x * y, 0, 1 + y * y, 0, 0};
    return {metric, blockTimes(metric, wanted)};
}

}  // namespace tspace
