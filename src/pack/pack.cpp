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
#include "pack/formats.h"
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

void writeWord(std::uint64_t word, std::size_t bytes, Bytes out) {
    for (std::size_t i = 0; i < bytes; ++i) out[i] = static_cast<std::byte>(word >> (8 * i) & 0xff);
}

/// A signed number of 1 or 2 bytes.
void writeNumber(std::int32_t number, std::size_t bytes, Bytes out) {
    writeWord(static_cast<std::uint32_t>(number), bytes, out);
}

// ---- one struct per family of formats: bytes of a frame, write

struct Frame32 {
    static constexpr std::size_t kBytes = 4;
    static void write(const SoundFrame& frame, Bytes out) { writeWord(encodeRotation(frame), kBytes, out); }
};

/// i, j and k in bit fields, and the sign in the lowest bit.
template <std::size_t byte_count, const AngleGrid& kGrid, unsigned i_bits, unsigned k_bits>
struct AngleFields {
    static constexpr std::size_t kBytes = byte_count;
    static_assert(2 * kGrid.half < 1 << i_bits && 4 * kGrid.quarter == 1 << k_bits &&
                  2 * i_bits + k_bits + 1 == 8 * byte_count);

    static void write(const SoundFrame& frame, Bytes out) {
        const AngleCode code = encodeAngle(kGrid, frame);
        const std::uint64_t ij = static_cast<std::uint64_t>(code.i) << i_bits | static_cast<std::uint64_t>(code.j);
        writeWord((ij << k_bits | static_cast<std::uint64_t>(code.k)) << 1 | (frame.mirrored ? 1u : 0u), kBytes, out);
    }
};
using Oct32 = AngleFields<4, kOct32Grid, 10, 11>;
using Frame64 = AngleFields<8, kFrame64Grid, 21, 21>;

/// 46339^2 grid points fill 31 bits but for some words, which read as points of the last row.
struct Frame48 {
    static constexpr std::size_t kBytes = 6;
    static constexpr std::uint32_t kWidth = 46339;

    static void write(const SoundFrame& frame, Bytes out) {
        const AngleCode code = encodeAngle(kFrame48Grid, frame);
        const std::uint64_t ij = static_cast<std::uint64_t>(code.i) * kWidth + static_cast<std::uint64_t>(code.j);
        writeWord(ij << 17 | static_cast<std::uint64_t>(code.k) << 1 | (frame.mirrored ? 1u : 0u), kBytes, out);
    }
};

struct Qtangent64 {
    static constexpr std::size_t kBytes = 8;
    static void write(const SoundFrame& frame, Bytes out) {
        const std::array<std::int32_t, 4> code = encodeQuaternion(frame);
        for (std::size_t m = 0; m < 4; ++m) writeNumber(code[m], 2, out + 2 * m);
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

void unpack(const Format& format, SimdTarget wish, const std::byte* bytes, const StridedSpan<Vec3>& normals,
            const StridedSpan<Vec4>& tangents) {
    const FrameKernel kernel = format.kernel(wish);
    WordBlock words{};
    FrameRows rows;
    for (std::size_t begin = 0; begin < normals.count; begin += kBlockFrames) {
        const std::size_t count = std::min(normals.count - begin, kBlockFrames);
        format.read(bytes + begin * format.bytes, count, words);
        kernel.decode(words, count, rows);
        for (std::size_t i = 0; i < count; ++i) {
            const float *n = rows.normal[i], *t = rows.tangent[i];
            normals[begin + i] = {n[0], n[1], n[2]};
            tangents[begin + i] = {t[0], t[1], t[2], t[3]};
        }
    }
}

}  // namespace pack

std::size_t frameBytes(FrameFormat format) {
    const pack::Format* known = pack::formatOf(format);
    return known != nullptr ? known->bytes : 0;
}

FrameErrorBound frameErrorBound(FrameFormat format) {
    const pack::Format* known = pack::formatOf(format);
    return known != nullptr ? known->bound : FrameErrorBound{};
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
        pack::unpack(*pack::formatOf(format), SimdTarget::best, bytes.data(), normals, tangents);
        return Done{};
    });
}

}  // namespace tspace
