// SPDX-License-Identifier: MIT
// The border of this room: checks, mending, and which code and which bytes each format has.
#include "tspace/pack.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/basis.h"
#include "core/border.h"
#include "core/unit.h"
#include "pack/angle_code.h"
#include "pack/rotation_code.h"
#include "pack/snorm_code.h"

namespace tspace {

namespace pack {

namespace {

/// As sanitize: the glTF validator's tolerance, and the sine within which T says nothing.
constexpr double kCountedTolerance = 5e-4, kOneDegree = 0.017452406437283512;
/// Frames this close to unit and orthogonal are encoded as they are, so that unpacked frames are found again exactly.
constexpr double kSoundTolerance = 5e-7;

// ---- frames on the way in

struct Mended {
    SoundFrame frame;
    std::uint64_t PackReport::*cause = nullptr;  ///< null: nothing to count
};

/// Whether T can be used with this unit N; if not, why.
std::uint64_t PackReport::*causeAgainst(const Vec3& tangent, const DVec3& n) {
    if (!isFinite(tangent)) return &PackReport::not_finite_count;
    DVec3 t = toDouble(tangent);
    if (!normalize(t)) return &PackReport::zero_count;
    return length(cross(n, t)) < kOneDegree ? &PackReport::parallel_count : nullptr;
}

bool isUnitWithin(double size, double tolerance) { return std::fabs(size - 1) <= tolerance; }

/// T, which is not parallel to n, made unit and orthogonal to it; twice, since near n the first pass cancels digits.
DVec3 orthogonalized(DVec3 t, const DVec3& n) {
    for (int pass = 0; pass < 2; ++pass) {
        normalize(t);
        t = t - dot(n, t) * n;
    }
    normalize(t);
    return t;
}

Mended mended(const Vec3& normal, const Vec4& tangent) {
    Mended result;
    const auto because = [&](std::uint64_t PackReport::*cause) {
        if (result.cause == nullptr) result.cause = cause;
    };
    DVec3 n = toDouble(normal), t = toDouble(xyz(tangent));
    const double n_size = length(n), t_size = length(t);
    const bool is_sound = isUnitWithin(n_size, kSoundTolerance) && isUnitWithin(t_size, kSoundTolerance) &&
                          std::fabs(dot(n, t)) <= kSoundTolerance;
    if (!is_sound) {
        if (!normalize(n)) {
            n = {0, 0, 1};
            because(&PackReport::bad_normal_count);
        }
        if (std::uint64_t PackReport::*cause = causeAgainst(xyz(tangent), n)) {
            because(cause);
            t = planeAxes(n).x;
        } else {
            if (!isUnitWithin(n_size, kCountedTolerance) || !isUnitWithin(t_size, kCountedTolerance)) {
                because(&PackReport::not_unit_count);
            }
            normalize(t);
            if (std::fabs(dot(n, t)) > kCountedTolerance) because(&PackReport::not_orthogonal_count);
            t = orthogonalized(t, n);
        }
    }
    if (tangent.w != 1.0f && tangent.w != -1.0f) because(&PackReport::bad_sign_count);
    result.frame = {n, t, tangent.w < 0};
    return result;
}

// ---- words

using Bytes = std::byte*;
using ConstBytes = const std::byte*;

void writeWord(std::uint64_t word, std::size_t bytes, Bytes out) {
    for (std::size_t i = 0; i < bytes; ++i) out[i] = static_cast<std::byte>(word >> (8 * i) & 0xff);
}

std::uint64_t readWord(ConstBytes in, std::size_t bytes) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes; ++i) word |= std::to_integer<std::uint64_t>(in[i]) << (8 * i);
    return word;
}

/// A signed number of 1 or 2 bytes.
void writeNumber(std::int32_t number, std::size_t bytes, Bytes out) {
    writeWord(static_cast<std::uint32_t>(number), bytes, out);
}

std::int32_t readNumber(ConstBytes in, std::size_t bytes) {
    const auto word = static_cast<std::uint32_t>(readWord(in, bytes));
    return bytes == 1 ? static_cast<std::int8_t>(word) : static_cast<std::int16_t>(word);
}

// ---- one struct per family of formats: bytes of a frame, write, read

struct Frame32 {
    static constexpr std::size_t kBytes = 4;
    static void write(const SoundFrame& frame, Bytes out) { writeWord(encodeRotation(frame), kBytes, out); }
    static DecodedFrame read(ConstBytes in) { return decodeRotation(static_cast<std::uint32_t>(readWord(in, kBytes))); }
};

/// i, j and k in bit fields, and the sign in the lowest bit.
template <std::size_t byte_count, std::int32_t half, std::int32_t quarter, unsigned i_bits, unsigned k_bits>
struct AngleFields {
    static constexpr std::size_t kBytes = byte_count;
    static constexpr AngleGrid kGrid{half, quarter};
    static_assert(2 * half < 1 << i_bits && 4 * quarter == 1 << k_bits && 2 * i_bits + k_bits + 1 == 8 * byte_count);

    static void write(const SoundFrame& frame, Bytes out) {
        const AngleCode code = encodeAngle(kGrid, frame);
        const std::uint64_t ij = static_cast<std::uint64_t>(code.i) << i_bits | static_cast<std::uint64_t>(code.j);
        writeWord((ij << k_bits | static_cast<std::uint64_t>(code.k)) << 1 | (frame.mirrored ? 1u : 0u), kBytes, out);
    }
    static DecodedFrame read(ConstBytes in) {
        const std::uint64_t word = readWord(in, kBytes);
        const auto field = [&](unsigned shift, unsigned bits) {
            return static_cast<std::int32_t>(word >> shift & ((std::uint64_t{1} << bits) - 1));
        };
        // The one value of i and j that the grid does not have reads as its neighbour.
        DecodedFrame frame = decodeAngle(kGrid, {std::min(field(1 + k_bits + i_bits, i_bits), 2 * half),
                                                 std::min(field(1 + k_bits, i_bits), 2 * half), field(1, k_bits)});
        frame.mirrored = (word & 1) != 0;
        return frame;
    }
};
using Oct32 = AngleFields<4, 511, 512, 10, 11>;
using Frame64 = AngleFields<8, 1048575, 524288, 21, 21>;

/// 46339^2 grid points fill 31 bits but for some words, which read as points of the last row.
struct Frame48 {
    static constexpr std::size_t kBytes = 6;
    static constexpr std::uint32_t kWidth = 46339;
    static constexpr AngleGrid kGrid{(kWidth - 1) / 2, 16384};

    static void write(const SoundFrame& frame, Bytes out) {
        const AngleCode code = encodeAngle(kGrid, frame);
        const std::uint64_t ij = static_cast<std::uint64_t>(code.i) * kWidth + static_cast<std::uint64_t>(code.j);
        writeWord(ij << 17 | static_cast<std::uint64_t>(code.k) << 1 | (frame.mirrored ? 1u : 0u), kBytes, out);
    }
    static DecodedFrame read(ConstBytes in) {
        const std::uint64_t word = readWord(in, kBytes);
        const auto ij = std::min(static_cast<std::uint32_t>(word >> 17), kWidth * kWidth - 1);
        DecodedFrame frame =
            decodeAngle(kGrid, {static_cast<std::int32_t>(ij / kWidth), static_cast<std::int32_t>(ij % kWidth),
                                static_cast<std::int32_t>(word >> 1 & 0xffff)});
        frame.mirrored = (word & 1) != 0;
        return frame;
    }
};

struct Qtangent64 {
    static constexpr std::size_t kBytes = 8;
    static void write(const SoundFrame& frame, Bytes out) {
        const std::array<std::int32_t, 4> code = encodeQuaternion(frame);
        for (std::size_t m = 0; m < 4; ++m) writeNumber(code[m], 2, out + 2 * m);
    }
    static DecodedFrame read(ConstBytes in) {
        std::array<std::int32_t, 4> code;
        for (std::size_t m = 0; m < 4; ++m) code[m] = readNumber(in + 2 * m, 2);
        return decodeQuaternion(code);
    }
};

/// N and T apart, in numbers of `number_bytes`; at which of them each begins, and which holds the sign. A number that
/// is left is `most`.
template <std::size_t number_bytes, std::size_t count, std::size_t normal_at, std::size_t sign_at>
struct Vectors {
    static constexpr std::size_t kBytes = number_bytes * count;
    static constexpr std::int32_t kMost = number_bytes == 1 ? 127 : 32767;

    static void write(const SoundFrame& frame, Bytes out) {
        std::array<std::int32_t, count> numbers;
        numbers.fill(kMost);
        const auto t = encodeVector(frame.tangent, kMost), n = encodeVector(frame.normal, kMost);
        std::copy(t.begin(), t.end(), numbers.begin());
        std::copy(n.begin(), n.end(), numbers.begin() + normal_at);
        if (frame.mirrored) numbers[sign_at] = -kMost;
        for (std::size_t m = 0; m < count; ++m) writeNumber(numbers[m], number_bytes, out + number_bytes * m);
    }
    static DecodedFrame read(ConstBytes in) {
        const auto number = [&](std::size_t m) {
            return std::max(readNumber(in + number_bytes * m, number_bytes), -kMost);
        };
        DecodedFrame frame = decodeVectors({number(normal_at), number(normal_at + 1), number(normal_at + 2)},
                                           {number(0), number(1), number(2)});
        frame.mirrored = number(sign_at) < 0;
        return frame;
    }
};
using Snorm8Pair = Vectors<1, 8, 4, 7>;
using Snorm16Pair = Vectors<2, 8, 4, 7>;
using GltfSnorm8 = Vectors<1, 7, 4, 3>;
using GltfSnorm16 = Vectors<2, 7, 4, 3>;

/// Calls visit(Code{}) with the struct of this format; `none` for what is no format.
template <class Value, class Visit>
Value visitFormat(FrameFormat format, Value none, const Visit& visit) {
    switch (format) {
        case FrameFormat::frame32:
            return visit(Frame32{});
        case FrameFormat::frame48:
            return visit(Frame48{});
        case FrameFormat::frame64:
            return visit(Frame64{});
        case FrameFormat::oct32:
            return visit(Oct32{});
        case FrameFormat::qtangent64:
            return visit(Qtangent64{});
        case FrameFormat::snorm8_pair:
            return visit(Snorm8Pair{});
        case FrameFormat::snorm16_pair:
            return visit(Snorm16Pair{});
        case FrameFormat::gltf_snorm8:
            return visit(GltfSnorm8{});
        case FrameFormat::gltf_snorm16:
            return visit(GltfSnorm16{});
    }
    return none;
}

template <class N, class T>
Error check(FrameFormat format, const StridedSpan<N>& normals, const StridedSpan<T>& tangents, const void* bytes,
            std::size_t byte_count) {
    const std::size_t each = frameBytes(format);
    if (each == 0) return {ErrorCode::invalidOption, "the format is none of FrameFormat"};
    if (Error e = checkSpan(normals, normals.count, "normals"); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(tangents, normals.count, "tangents"); e.code != ErrorCode::ok) return e;
    if (byte_count / each != normals.count || byte_count % each != 0) {
        return makeError(ErrorCode::countMismatch, kNoElement, "%zu frames of %zu bytes do not fit into %zu bytes",
                         normals.count, each, byte_count);
    }
    return checkSpan(bytes, byte_count, 1, 1, byte_count, "bytes");
}

}  // namespace

}  // namespace pack

std::size_t frameBytes(FrameFormat format) {
    return pack::visitFormat(format, std::size_t{0}, [](auto code) { return decltype(code)::kBytes; });
}

FrameErrorBound frameErrorBound(FrameFormat format) {
    switch (format) {
        case FrameFormat::frame32:
            return {0.135, 0.135};
        case FrameFormat::frame48:
            return {0.0037, 0.0042};
        case FrameFormat::frame64:
            return {0.0001, 0.00015};
        case FrameFormat::oct32:
            return {0.15, 0.165};
        case FrameFormat::qtangent64:
            return {0.004, 0.004};
        case FrameFormat::snorm8_pair:
        case FrameFormat::gltf_snorm8:
            return {0.391, 0.391};
        case FrameFormat::snorm16_pair:
        case FrameFormat::gltf_snorm16:
            return {0.00152, 0.00152};
    }
    return {};
}

Result<PackReport> packFrames(FrameFormat format, StridedSpan<const Vec3> normals, StridedSpan<const Vec4> tangents,
                              std::span<std::byte> out) {
    return atBorder([&]() -> Result<PackReport> {
        if (Error e = pack::check(format, normals, tangents, out.data(), out.size()); e.code != ErrorCode::ok) return e;
        return pack::visitFormat(format, PackReport{}, [&](auto code) {
            PackReport report;
            for (std::size_t i = 0; i < normals.count; ++i) {
                const pack::Mended mended = pack::mended(normals[i], tangents[i]);
                if (mended.cause != nullptr) ++(report.*mended.cause);
                code.write(mended.frame, out.data() + i * code.kBytes);
            }
            return report;
        });
    });
}

Result<Done> unpackFrames(FrameFormat format, std::span<const std::byte> bytes, StridedSpan<Vec3> normals,
                          StridedSpan<Vec4> tangents) {
    return atBorder([&]() -> Result<Done> {
        if (Error e = pack::check(format, normals, tangents, bytes.data(), bytes.size()); e.code != ErrorCode::ok) {
            return e;
        }
        return pack::visitFormat(format, Done{}, [&](auto code) {
            for (std::size_t i = 0; i < normals.count; ++i) {
                const pack::DecodedFrame frame = code.read(bytes.data() + i * code.kBytes);
                normals[i] = frame.normal;
                tangents[i] = {frame.tangent.x, frame.tangent.y, frame.tangent.z, frame.mirrored ? -1.0f : 1.0f};
            }
            return Done{};
        });
    });
}

}  // namespace tspace
