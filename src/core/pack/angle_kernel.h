// SPDX-License-Identifier: MIT
// Kernels of oct32, frame48 and frame64. Included once per instruction set, after lanes_*.h and with TSPACE_LANES set
// to its namespace. Each lane is one frame.
#pragma once

#include "core/pack/frame_kernel.h"

namespace tspace::pack::TSPACE_LANES {

// -- encoding --

/// Grid of the angle formats: the grid of N is 2 * half + 1 wide in both directions; a quarter turn of T has `quarter`
/// steps (a power of two).
struct AngleGrid {
    std::int32_t half, quarter;
};

inline constexpr AngleGrid kOct32Grid{511, 512}, kFrame48Grid{23169, 16384}, kFrame64Grid{1048575, 524288};

// Warps barycentric coordinates b on a face of the octahedron as b (2.5 - b), which makes its cells more uniform: for
// the same grid the maximum error of N decreases from 0.159 to 0.134 degrees. Similarly, x (2.75 - x) warps steps along
// the side of a diamond, so that the angle per step varies by less than 1 %.
inline constexpr double kFaceWarp = 2.5, kAngleWarp = 2.75;

/// Decoded N of grid points, with the sign of its z from the integer coordinates.
struct GridNormals {
    Vectors normal;
    Floats z_sign;
};

inline GridNormals gridNormals(const AngleGrid& grid, Floats i, Floats j) {
    const Floats half = broadcast(static_cast<float>(grid.half));
    const Floats whole = broadcast(static_cast<float>(kFaceWarp) * static_cast<float>(grid.half));
    const Floats from_i = absolute(i - half), from_j = absolute(j - half), rest = half - from_i - from_j;
    const Floats fold = smaller(rest, zero());  // folds the lower half over the edges of the diamond
    const Floats a = from_i + fold, b = from_j + fold, c = absolute(rest);
    const Floats x = a * (whole - a), y = b * (whole - b), z = c * (whole - c);
    const Floats z_sign = select(rest < zero(), broadcast(-1.0f), broadcast(1.0f));
    return {ofUnitLength({select(i < half, minus(x), x), select(j < half, minus(y), y), z_sign * z}), z_sign};
}

struct Bases {
    Vectors p, q;
};

inline Bases basesOf(const GridNormals& g) {
    const Floats one = broadcast(1.0f), s = g.z_sign;
    const Vectors& n = g.normal;
    const Floats h = broadcast(-1.0f) / (s + n.z), d = n.x * n.y * h;
    return {{one + s * n.x * n.x * h, s * d, minus(s) * n.x}, {d, s + n.y * n.y * h, minus(n.y)}};
}

/// Returns T, rotated by `quarters` (lowest two bits) quarter turns and then by `step` of the grid.quarter steps of a
/// quarter turn.
inline Vectors tangentsAt(const AngleGrid& grid, const Bases& basis, Bits quarters, Floats step) {
    const Floats whole = broadcast(static_cast<float>(kAngleWarp) * static_cast<float>(grid.quarter));
    const Floats x = step, y = broadcast(static_cast<float>(grid.quarter)) - step;
    const Floats run = y * (whole - y), rise = x * (whole - x);
    const Floats scale = broadcast(1.0f) / squareRoot(run * run + rise * rise);
    const Floats cosine = run * scale, sine = rise * scale;
    const Mask odd = isSet<0>(quarters);
    const Bits half_turn = signFrom<1>(quarters);
    return flipped(select(odd, minus(sine), cosine), half_turn) * basis.p +
           flipped(select(odd, cosine, sine), half_turn) * basis.q;
}

// -- decoding --

namespace {

/// Decoded integers: i and j in [0, 2 * half], k in [0, 4 * quarter). The sign is the lowest bit of word 0 in all three
/// formats.
struct AngleFields {
    Bits i, j, k;
};
inline Bits lowestOf(const AngleFields& f, Bits mirrored) { return shiftLeft<1>(f.k) | mirrored; }

struct Oct32 {
    static constexpr AngleGrid kGrid = kOct32Grid;
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits w = load(words.word[0] + at), ten = broadcastBits(0x3ff);
        return {shiftRight<22>(w), shiftRight<12>(w) & ten, shiftRight<1>(w) & broadcastBits(0x7ff)};
    }
    static void write(const AngleFields& f, Bits mirrored, WordBlock& words, std::size_t at) {
        store(words.word[0] + at, shiftLeft<22>(f.i) | shiftLeft<12>(f.j) | lowestOf(f, mirrored));
    }
};

struct Frame48 {
    static constexpr AngleGrid kGrid = kFrame48Grid;
    static constexpr std::uint32_t kColumns = 2 * kGrid.half + 1;
    /// Reads the integers of words. Words beyond the last grid point are read as the last one.
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits low = load(words.word[0] + at), high = load(words.word[1] + at);
        const Bits ij = smaller(shiftLeft<15>(high) | shiftRight<17>(low), broadcastBits(kColumns * kColumns - 1));
        const Bits i = quotient<kColumns>(ij);
        return {i, ij - product(i, kColumns), shiftRight<1>(low) & broadcastBits(0xffff)};
    }
    static void write(const AngleFields& f, Bits mirrored, WordBlock& words, std::size_t at) {
        const Bits ij = product(f.i, kColumns) + f.j;
        store(words.word[0] + at, shiftLeft<17>(ij) | lowestOf(f, mirrored));
        store(words.word[1] + at, shiftRight<15>(ij));
    }
};

struct Frame64 {
    static constexpr AngleGrid kGrid = kFrame64Grid;
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits low = load(words.word[0] + at), high = load(words.word[1] + at);
        return {shiftRight<11>(high), (shiftLeft<10>(high) & broadcastBits(0x1ffc00)) | shiftRight<22>(low),
                shiftRight<1>(low) & broadcastBits(0x1fffff)};
    }
    static void write(const AngleFields& f, Bits mirrored, WordBlock& words, std::size_t at) {
        store(words.word[0] + at, shiftLeft<22>(f.j) | lowestOf(f, mirrored));
        store(words.word[1] + at, shiftLeft<11>(f.i) | shiftRight<10>(f.j));
    }
};

/// Returns the exponent of a power of two.
constexpr int exponentOf(std::int32_t power) { return power == 1 ? 0 : 1 + exponentOf(power / 2); }

/// Returns T at step k of a full turn.
template <class Format>
inline Vectors tangentsAt(const Bases& basis, Bits k) {
    constexpr AngleGrid kGrid = Format::kGrid;
    return tangentsAt(kGrid, basis, shiftRight<exponentOf(kGrid.quarter)>(k),
                      toFloats(k & broadcastBits(kGrid.quarter - 1)));
}

template <class Format>
void decodeAngles(const WordBlock& words, std::size_t count, const FrameRows& rows) {
    constexpr AngleGrid kGrid = Format::kGrid;
    const Floats last = broadcast(static_cast<float>(2 * kGrid.half));
    for (std::size_t at = 0; at < count; at += kWidth) {
        const AngleFields fields = Format::read(words, at);
        // The only value of i and j that is not on the grid is read as its neighbor.
        const GridNormals g = gridNormals(kGrid, smaller(toFloats(fields.i), last), smaller(toFloats(fields.j), last));
        storeFrames(rows, at, {g.normal, tangentsAt<Format>(basesOf(g), fields.k)},
                    signFrom<0>(load(words.word[0] + at)));
    }
}

// ---- encoding: first the nearest N, then the angle of T in the basis of the decoded N. The error of T is therefore
// the hypotenuse of a right-angled spherical triangle whose legs are the error of N and half a step of the angle.
// Positions are computed in double precision, because floats have too few bits for the 21 bits of frame64; codes are
// compared by their decoded values.

/// Intermediate results of a block, which are passed from step to step.
struct AngleSteps {
    alignas(64) float i[kBlockFrames], j[kBlockFrames];        ///< cell of N, later replaced by the grid point of N
    alignas(64) float p[3][kBlockFrames], q[3][kBlockFrames];  ///< basis at that grid point
    alignas(64) float k[kBlockFrames];                         ///< last step that is not after the angle of T
};

/// Position of a unit vector on the unfolded octahedron, [-1, 1] in both directions: it solves b_i (2.5 - b_i) = L
/// |n_i| with sum(b_i) = 1. Newton's method is used for b and L together, starting with b_i proportional to |n_i|,
/// which has an error of at most 0.062: three steps leave errors of 9e-4, 3e-7 and 2e-14.
struct OctahedronPoints {
    Doubles x, y;

    explicit OctahedronPoints(DoubleVectors n) {
        const Doubles warp = broadcastDouble(kFaceWarp), one = broadcastDouble(1.0);
        const Doubles size[3] = {absolute(n.x), absolute(n.y), absolute(n.z)};
        const Doubles scale = one / (size[0] + size[1] + size[2]);
        Doubles b[3] = {scale * size[0], scale * size[1], scale * size[2]};
        for (int step = 0; step < 3; ++step) {
            Doubles value[3], slope[3];
            for (int m = 0; m < 3; ++m) {
                value[m] = b[m] * (warp - b[m]);
                slope[m] = warp - (b[m] + b[m]);
            }
            // Products of the other two slopes, which are the reciprocals of the slopes up to a common factor.
            const Doubles inverse[3] = {slope[1] * slope[2], slope[2] * slope[0], slope[0] * slope[1]};
            const Doubles factor = one / (slope[0] * inverse[0]);
            const Doubles length = (value[0] * inverse[0] + value[1] * inverse[1] + value[2] * inverse[2]) /
                                   (size[0] * inverse[0] + size[1] * inverse[1] + size[2] * inverse[2]);
            for (int m = 0; m < 3; ++m) b[m] = b[m] + (length * size[m] - value[m]) * inverse[m] * factor;
        }
        const DoubleMask is_below = broadcastDouble(0.0) > n.z;
        x = withSignOf(select(is_below, one - b[1], b[0]), n.x);
        y = withSignOf(select(is_below, one - b[0], b[1]), n.y);
    }
};

void findCells(const AngleGrid& grid, const FrameBlock& frames, std::size_t count, AngleSteps& steps) {
    const Doubles half = broadcastDouble(grid.half), one = broadcastDouble(1.0);
    for (std::size_t at = 0; at < count; at += kPart) {
        const OctahedronPoints point(loadAsDoubles(frames.normal, at));
        storeAsFloats(steps.i + at, wholeBelow((point.x + one) * half));
        storeAsFloats(steps.j + at, wholeBelow((point.y + one) * half));
    }
}

/// Finds, for each frame, the corner of the grid cell whose decoded N is closest.
void findNormals(const AngleGrid& grid, const FrameBlock& frames, std::size_t count, AngleSteps& steps) {
    const auto last = static_cast<float>(2 * grid.half - 1);
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Vectors wanted = loadVectors(frames.normal, at);
        const Floats i0 = clamped(load(steps.i + at), 0, last), j0 = clamped(load(steps.j + at), 0, last);
        GridNormals best{};
        Floats least = broadcast(__builtin_huge_valf()), best_i = i0, best_j = j0;
        for (int corner = 0; corner < 4; ++corner) {
            const Floats i = i0 + broadcast(static_cast<float>(corner >> 1));
            const Floats j = j0 + broadcast(static_cast<float>(corner & 1));
            const GridNormals found = gridNormals(grid, i, j);
            const Vectors off = found.normal - wanted;
            const Floats error = dot(off, off);
            const Mask is_better = error < least;
            least = select(is_better, error, least);
            best_i = select(is_better, i, best_i);
            best_j = select(is_better, j, best_j);
            best = {select(is_better, found.normal, best.normal), select(is_better, found.z_sign, best.z_sign)};
        }
        store(steps.i + at, best_i);
        store(steps.j + at, best_j);
        const Bases basis = basesOf(best);
        store(steps.p, at, basis.p);
        store(steps.q, at, basis.q);
    }
}

/// Returns the last step that is not after the angle with this cosine and sine. Within a quarter, s y (2.75 - y) = c x
/// (2.75 - x) with y = 1 - x is a quadratic equation, solved here in the form that does not divide by a difference.
inline Doubles stepsBefore(Doubles c, Doubles s, std::int32_t quarter) {
    const auto number = [](double x) { return broadcastDouble(x); };
    const Doubles zero = number(0.0);
    const DoubleMask is_odd = zero > c * s, is_second_half = zero > select(is_odd, s, c + s);
    const Doubles turns = keepWhere(is_odd, number(1.0)) + keepWhere(is_second_half, number(2.0));
    const Doubles run = absolute(select(is_odd, s, c)), rise = absolute(select(is_odd, c, s));
    const Doubles square = rise - run, linear = number(kAngleWarp) * run + number(kAngleWarp - 2) * rise;
    const Doubles constant = number(kAngleWarp - 1) * rise;
    const Doubles below = linear + squareRoot(linear * linear + number(4.0) * square * constant);
    const Doubles x = (constant + constant) / below;
    return turns * number(quarter) + smaller(wholeBelow(x * number(quarter)), number(quarter));
}

void findAngles(const AngleGrid& grid, const FrameBlock& frames, std::size_t count, AngleSteps& steps) {
    for (std::size_t at = 0; at < count; at += kPart) {
        const DoubleVectors t = loadAsDoubles(frames.tangent, at);
        const Doubles c = dot(t, loadAsDoubles(steps.p, at)), s = dot(t, loadAsDoubles(steps.q, at));
        storeAsFloats(steps.k + at, stepsBefore(c, s, grid.quarter));
    }
}

template <class Format>
void encodeAngles(const FrameBlock& frames, std::size_t count, WordBlock& words) {
    AngleSteps steps{};
    findCells(Format::kGrid, frames, count, steps);
    findNormals(Format::kGrid, frames, count, steps);
    findAngles(Format::kGrid, frames, count, steps);
    const Bits whole_turn = broadcastBits(4 * Format::kGrid.quarter - 1);
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Bases basis{loadVectors(steps.p, at), loadVectors(steps.q, at)};
        const Vectors wanted = loadVectors(frames.tangent, at);
        const auto errorAt = [&](Bits k) {
            const Vectors off = tangentsAt<Format>(basis, k) - wanted;
            return dot(off, off);
        };
        const Bits k0 = wholeBits(load(steps.k + at)), k1 = k0 + broadcastBits(1);
        const Mask is_second = errorAt(k1 & whole_turn) < errorAt(k0 & whole_turn);
        const Bits k = k0 + orWhere(broadcastBits(0), is_second, 1);
        Format::write({wholeBits(load(steps.i + at)), wholeBits(load(steps.j + at)), k & whole_turn},
                      load(frames.mirrored + at), words, at);
    }
}

}  // namespace

FrameKernel oct32Kernel() { return {encodeAngles<Oct32>, decodeAngles<Oct32>}; }
FrameKernel frame48Kernel() { return {encodeAngles<Frame48>, decodeAngles<Frame48>}; }
FrameKernel frame64Kernel() { return {encodeAngles<Frame64>, decodeAngles<Frame64>}; }

}  // namespace tspace::pack::TSPACE_LANES
