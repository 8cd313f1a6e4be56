// SPDX-License-Identifier: MIT
// Texels that solve a TexelSystem: as real numbers, or as integers.
#pragma once

#include <span>

#include "core/base/parallel.h"
#include "maps/texel_system.h"

namespace tspace {

/// Weight that holds texels to their start values, relative to one sample at the texel's centre. It decides where
/// samples constrain next to nothing: at the rim of a chart.
inline constexpr float kHold = 0.004F;

/// Things in a ring, of which no two at the same time are beside each other: some(first, number) for every second one from
/// `first` on, of the even ones, then the odd ones, then the last of an odd number. False as soon as some() says so.
template <class Some>
void forApart(std::size_t count, const Some& some) {
    some(std::size_t{0}, count / 2);
    some(std::size_t{1}, count / 2);
    some(count - 1, count % 2);
}

/// row(y) for all rows of an image that repeats.
template <class Row>
void forRowsApart(Parallel& parallel, std::uint32_t height, const Row& row) {
    forApart(height, [&](std::size_t first, std::size_t number) {
        parallel.forRanges(number, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) row(static_cast<std::uint32_t>(first + 2 * i));
        });
    });
}

/// Moves the unknown ones of `texels` (width * height) to the least squares, by conjugate gradients. The same bits for any
/// number of threads.
void solveTexels(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel, const Allocator* allocator);

/// The vectors that integers stand for: n from 0 to `most` is 2 n / most - 1.
struct IntegerChoice {
    unsigned most = 255;
    float least_length = 0.7F, most_length = 1.1F;  ///< of vectors; no component may be over 1
    bool is_two_channel = false;                    ///< z follows from x and y, whose vector is unit
};

/// Makes of `texels` vectors that integers stand for, one after the other, such that what the samples ask is met as well as
/// it can be with those around; `rounds` times. The same bits for any number of threads.
void chooseIntegers(const TexelSystem& system, const IntegerChoice& choice, std::span<Vec3> texels, unsigned rounds,
                    Parallel& parallel, const Allocator* allocator);

struct TexelRounding {
    unsigned most = 65535;
    bool keeps_lengths = false;  ///< else vectors may become longer or shorter by half a hundredth, and point better
    std::span<const bool> keeps = {};  ///< which texels stay; empty: none
};

/// Makes of each component of `texels` a number that an integer from 0 to `most` stands for, such that those around make good
/// under the filter what is rounded off: as chooseIntegers, where integers are so many that all count the same. The image
/// repeats. The same bits for any number of threads.
void roundTexels(std::span<Vec3> texels, std::uint32_t width, const TexelRounding& rounding, Parallel& parallel,
                 const Allocator* allocator);

}  // namespace tspace
