// SPDX-License-Identifier: MIT
// Kernel of frame32. Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its namespace.
// Each lane processes one frame.
#pragma once

#include "core/pack/frame_kernel.h"

namespace tspace::pack::TSPACE_LANES {

// -- encoding --

// The steps along x and z (rotations about T and N) range from -kSide to kSide. There are kRows along y (rotations
// about B, which move both N and T, so these steps are finer). Columns with odd x + z are shifted by half a step. The
// 24 charts have kColumns * kRows * kColumns codes each, which is all but 176,672 of 2^31.
inline constexpr std::int32_t kSide = 226, kColumns = 2 * kSide + 1, kRows = 436, kCharts = 24;
inline constexpr std::uint32_t kCodes = static_cast<std::uint32_t>(kCharts) * kColumns * kRows * kColumns;
static_assert(kCodes < 0x80000000u);

// The warp p = u (kLinear + kCubic u^2) reaches tan(22.5 degrees) at the faces of the cube, where its slope is 1.13
// times that of a straight line. In the center its slope is 0.935 times as large, because rotations are denser far from
// the center of a chart.
inline constexpr double kHalfEdge = 0.41421356237309503;
inline constexpr double kWarp = 0.065;
inline constexpr double kLinear = kHalfEdge * (1 - kWarp), kCubic = kHalfEdge * kWarp;

inline Floats warped(Floats u) {
    return u * (broadcast(static_cast<float>(kLinear)) + broadcast(static_cast<float>(kCubic)) * (u * u));
}
/// Return the component of p for a column index (x or z), and for a row index. `twice_y`: 2 y, plus 1 in columns that
/// are shifted by half a step.
inline Floats atColumn(Floats x) { return warped((x - broadcast(kSide)) * broadcast(1.0f / kSide)); }
inline Floats atRow(Floats twice_y) { return warped((twice_y - broadcast(kRows)) * broadcast(1.0f / (kRows - 1))); }

/// Charts: rows of the small rotation in the order and with the signs of chart g = 4 * order + signs. The orders are
/// first three cyclic permutations of x, y, z, then the three swaps, which are cyclic permutations of x, z, y. Two
/// signs are free, and the third keeps the determinant at +1.
struct Charts {
    Mask is_swap, is_turned_once, is_turned_twice;
    Bits signs[3];

    explicit Charts(Bits g) {
        const Floats order = toFloats(shiftRight<2>(g));
        is_swap = order > broadcast(2.5f);
        const Floats turns = order - select(is_swap, broadcast(3.0f), zero());
        is_turned_once = turns == broadcast(1.0f);
        is_turned_twice = turns == broadcast(2.0f);
        signs[0] = signFrom<0>(g);
        signs[1] = signFrom<1>(g);
        signs[2] = signs[0] ^ signs[1] ^ orWhere(broadcastBits(0), is_swap, 0x80000000u);
    }
    [[nodiscard]] Vectors apply(Vectors v) const {
        const Floats y = select(is_swap, v.z, v.y), z = select(is_swap, v.y, v.z);
        const auto turned = [&](Floats none, Floats once, Floats twice) {
            return select(is_turned_twice, twice, select(is_turned_once, once, none));
        };
        return {flipped(turned(v.x, y, z), signs[0]), flipped(turned(y, z, v.x), signs[1]),
                flipped(turned(z, v.x, y), signs[2])};
    }
};

inline Frames rotationFrames(const Charts& charts, Floats x, Floats twice_y, Floats z) {
    const Frames small = framesOf(atColumn(x), atRow(twice_y), atColumn(z), broadcast(1.0f));
    return {charts.apply(small.normal), charts.apply(small.tangent)};
}

// -- decoding --

namespace {

/// Decodes the rotations of a block. Words that no chart uses are read as the last valid word.
void decodeRotations(const WordBlock& words, std::size_t count, const FrameRows& rows) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Bits word = load(words.word[0] + at), code = smaller(shiftRight<1>(word), broadcastBits(kCodes - 1));
        const Bits columns = quotient<kColumns>(code), z = code - product(columns, kColumns);
        const Bits rest = quotient<kRows>(columns), y = columns - product(rest, kRows);
        const Bits g = quotient<kColumns>(rest), x = rest - product(g, kColumns);
        const Bits twice_y = y + y + ((x + z) & broadcastBits(1));
        storeFrames(rows, at, rotationFrames(Charts(g), toFloats(x), toFloats(twice_y), toFloats(z)),
                    signFrom<0>(word));
    }
}

// ---- encoding: searches every chart that contains the rotation, not just the one around the nearest of the 24
// rotations: the corners of a cube are in other charts too, and each word must be reproduced from its decoded frame.

/// Matrices of rotations with columns T, N x T, N: at[row][column][frame].
struct Matrices {
    alignas(64) float at[3][3][kBlockFrames];
};

void findMatrices(const FrameBlock& frames, std::size_t count, Matrices& rotations) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Vectors t = loadVectors(frames.tangent, at), n = loadVectors(frames.normal, at), b = cross(n, t);
        const Vectors columns[3] = {t, b, n};
        for (std::size_t c = 0; c < 3; ++c) {
            store(rotations.at[0][c] + at, columns[c].x);
            store(rotations.at[1][c] + at, columns[c].y);
            store(rotations.at[2][c] + at, columns[c].z);
        }
    }
}

/// Candidate encodings: for each one, a frame and a chart that contains its rotation.
struct Places {
    static constexpr std::size_t kMost = 4 * kBlockFrames;
    alignas(64) float p[3][kMost], scale[kMost];  ///< the Rodrigues vector is p / scale
    alignas(64) std::uint32_t chart[kMost], frame[kMost];
    std::size_t count = 0;
};

/// For each of the 6 orders, the row of a chart's rotation for each row of the small rotation (see Charts).
constexpr std::size_t kRowAt[6][3] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

/// Half of the side of the cube, and a little more than half a step: a code on the cube's face may be the nearest one
/// for a rotation outside.
constexpr float kReach = static_cast<float>(kHalfEdge * (1 + 0.6 / kSide));
/// Lower bound of the trace of all rotations within kReach: in the corners of the cube it is 1.640.
constexpr float kLeastTrace = 1.63f;

/// Adds candidates for the rotations, among the first `count`, that are in chart g.
void addPlaces(const Matrices& rotations, std::size_t count, std::uint32_t g, Places& places) {
    const bool minus_0 = (g & 1) != 0, minus_1 = (g >> 1 & 1) != 0, minus_2 = (minus_0 != minus_1) != (g >= 12);
    const Floats signs[3] = {broadcast(minus_0 ? -1.0f : 1.0f), broadcast(minus_1 ? -1.0f : 1.0f),
                             broadcast(minus_2 ? -1.0f : 1.0f)};
    alignas(64) float p[3][kBlockFrames], scale[kBlockFrames];
    std::uint64_t held = 0;
    for (std::size_t at = 0; at < count; at += kWidth) {
        Vectors row[3];
        for (std::size_t r = 0; r < 3; ++r) {
            const std::size_t m = kRowAt[g >> 2][r];
            const auto& [x, y, z] = rotations.at[m];
            row[r] = signs[m] * Vectors{load(x + at), load(y + at), load(z + at)};
        }
        const Floats trace = row[0].x + row[1].y + row[2].z, divisor = broadcast(1.0f) + trace;
        const Vectors v{row[2].y - row[1].z, row[0].z - row[2].x, row[1].x - row[0].y};
        const Floats most = larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
        const Mask holds = (trace > broadcast(kLeastTrace)) & !(most > broadcast(kReach) * divisor);
        held |= std::uint64_t{bitsOf(holds)} << at;
        store(p, at, v);
        store(scale + at, divisor);
    }
    if (count < kBlockFrames) held &= (std::uint64_t{1} << count) - 1;
    for (; held != 0; held &= held - 1) {
        const auto frame = static_cast<std::uint32_t>(__builtin_ctzll(held));
        const std::size_t i = places.count++;
        for (std::size_t c = 0; c < 3; ++c) places.p[c][i] = p[c][frame];
        places.scale[i] = scale[frame];
        places.chart[i] = g;
        places.frame[i] = frame;
    }
}

/// Inverts the warp: after an initial guess, two steps of Newton's method reach float precision.
inline Floats unwarped(Floats p) {
    const auto number = [](double x) { return broadcast(static_cast<float>(x)); };
    const Floats straight = p * number(1 / kHalfEdge), one = number(1);
    Floats u = straight * (one + number(kWarp) * (one - straight * straight));
    for (int step = 0; step < 2; ++step) u = u - (warped(u) - p) / (number(kLinear) + number(3 * kCubic) * (u * u));
    return u;
}

/// Returns the largest code not above x, limited to the range from 0 to last - 1, so that there is a code above it.
inline Floats codeBelow(Floats x, std::int32_t last) { return clamped(wholeBelow(x), 0, static_cast<float>(last - 1)); }

/// Codes of a chart, each with its squared distance from the frame.
struct Cells {
    Floats error, x, twice_y, z;
};

/// Returns the best code around p: the rows below and above it in the four columns around it.
/// The rotation between p and a code's p' has the Rodrigues vector (p' - p - p x p') / (1 + p.p'), in the axes of the
/// frame. The divisor differs by less than 2 in 1000 between these codes, and is omitted.
inline Cells bestAround(Vectors p) {
    const Floats one = broadcast(1.0f), side = broadcast(kSide);
    const Floats x0 = codeBelow(unwarped(p.x) * side + side, kColumns - 1);
    const Floats z0 = codeBelow(unwarped(p.z) * side + side, kColumns - 1);
    const Floats twice_row = unwarped(p.y) * broadcast(kRows - 1) + broadcast(kRows), half = broadcast(0.5f);
    const Floats x[2] = {x0, x0 + one}, z[2] = {z0, z0 + one};
    const Floats dx[2] = {atColumn(x[0]) - p.x, atColumn(x[1]) - p.x};
    const Floats dz[2] = {atColumn(z[0]) - p.z, atColumn(z[1]) - p.z};
    // Shifts of the columns: (x0, z0) and (x1, z1) have one shift, (x0, z1) and (x1, z0) the other.
    const Floats half_sum = (x0 + z0) * half, is_odd = (half_sum - wholeBelow(half_sum)) * broadcast(2.0f);
    const Floats shift[2] = {is_odd, one - is_odd};
    Floats twice_y[2][2], dy[2][2];
    for (std::size_t i = 0; i < 2; ++i) {
        const Floats y0 = codeBelow((twice_row - shift[i]) * half, kRows - 1);
        twice_y[i][0] = y0 + y0 + shift[i];
        twice_y[i][1] = twice_y[i][0] + broadcast(2.0f);
        for (std::size_t up = 0; up < 2; ++up) dy[i][up] = atRow(twice_y[i][up]) - p.y;
    }
    Cells best{broadcast(__builtin_huge_valf()), x0, twice_y[0][0], z0};
    for (std::size_t choice = 0; choice < 8; ++choice) {
        const std::size_t right = choice & 1, back = choice >> 1 & 1, up = choice >> 2, other = right ^ back;
        const Vectors d{dx[right], dy[other][up], dz[back]};
        const Floats error = squaredReach(d - cross(p, d));
        const Mask is_better = error < best.error;
        best = {select(is_better, error, best.error), select(is_better, x[right], best.x),
                select(is_better, twice_y[other][up], best.twice_y), select(is_better, z[back], best.z)};
    }
    return best;
}

/// Maximum difference of errors that is rounding noise: adjacent charts share codes except for the last bits, and only
/// decoding shows which one the frame came from.
constexpr float kTwinError = 1e-11f;

/// Returns the errors of codes against frames, by decoding.
inline Floats decodedErrors(const Cells& cells, const Places& places, std::size_t at, const FrameBlock& frames) {
    alignas(64) float normal[3][kBlockFrames], tangent[3][kBlockFrames];
    for (std::size_t i = 0; i < kWidth; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            normal[c][i] = frames.normal[c][places.frame[at + i]];
            tangent[c][i] = frames.tangent[c][places.frame[at + i]];
        }
    }
    const Frames found = rotationFrames(Charts(load(places.chart + at)), cells.x, cells.twice_y, cells.z);
    const Vectors n = found.normal - loadVectors(normal, 0), t = found.tangent - loadVectors(tangent, 0);
    return larger(dot(n, n), dot(t, t));
}

/// Best codes found so far for the frames of a block.
struct Codes {
    alignas(64) std::uint32_t code[kBlockFrames];
    float error[kBlockFrames];
};

/// Searches the best codes of all candidates in `places`, and then clears it.
void searchPlaces(Places& places, const FrameBlock& frames, Codes& best) {
    alignas(64) float errors[Places::kMost];
    alignas(64) std::uint32_t codes[Places::kMost];
    for (std::size_t at = 0; at < places.count; at += kWidth) {
        const Floats scale = broadcast(1.0f) / load(places.scale + at);
        Cells cells = bestAround(
            {scale * load(places.p[0] + at), scale * load(places.p[1] + at), scale * load(places.p[2] + at)});
        const Mask may_be_twin = cells.error < broadcast(kTwinError);
        if (bitsOf(may_be_twin) != 0)
            cells.error = select(may_be_twin, decodedErrors(cells, places, at, frames), cells.error);
        const Bits column = product(load(places.chart + at), kColumns) + wholeBits(cells.x);
        const Bits row = product(column, kRows) + shiftRight<1>(wholeBits(cells.twice_y));
        store(codes + at, product(row, kColumns) + wholeBits(cells.z));
        store(errors + at, cells.error);
    }
    for (std::size_t i = 0; i < places.count; ++i) {
        const std::uint32_t frame = places.frame[i];
        if (errors[i] < best.error[frame]) {
            best.error[frame] = errors[i];
            best.code[frame] = codes[i];
        }
    }
    places.count = 0;
}

void encodeRotations(const FrameBlock& frames, std::size_t count, WordBlock& words) {
    Matrices rotations;
    findMatrices(frames, count, rotations);
    Places places{};
    Codes best{};
    for (float& error : best.error) error = __builtin_huge_valf();
    for (std::uint32_t g = 0; g < kCharts; ++g) {
        addPlaces(rotations, count, g, places);
        if (places.count + kBlockFrames > Places::kMost) searchPlaces(places, frames, best);
    }
    searchPlaces(places, frames, best);
    for (std::size_t at = 0; at < count; at += kWidth)
        store(words.word[0] + at, shiftLeft<1>(load(best.code + at)) | load(frames.mirrored + at));
}

}  // namespace

FrameKernel frame32Kernel() { return {encodeRotations, decodeRotations}; }

}  // namespace tspace::pack::TSPACE_LANES
