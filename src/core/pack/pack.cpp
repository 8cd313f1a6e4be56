// SPDX-License-Identifier: MIT
// packFrames and unpackFrames: the table of formats, checks, repair, and processing in blocks.
#include "tspace/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>

#include "core/base/border.h"
#include "core/base/vec_math.h"
#include "core/pack/formats.h"

namespace tspace {

namespace pack {

// ---- the table of formats

namespace {

std::uint32_t readWord(const std::byte* in) {
    std::uint32_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&word, in, 4);
    } else {
        for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(in[i]) << (8 * i);
    }
    return word;
}

/// Writes the first `kBytes` bytes of a word.
template <std::size_t kBytes>
void writeWord(std::uint32_t word, std::byte* out) {
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(out, &word, kBytes);
    } else {
        for (std::size_t i = 0; i < kBytes; ++i) out[i] = static_cast<std::byte>(word >> (8 * i) & 0xff);
    }
}

template <std::size_t kBytes>
void readWords(const std::byte* in, std::size_t count, WordBlock& words) {
    // Words in native layout are copied in bulk: words written one by one would have to reach the cache before they can
    // be loaded as vectors.
    if (kBytes == 4 && std::endian::native == std::endian::little) {
        std::memcpy(words.word[0], in, 4 * count);
        return;
    }
    constexpr std::size_t kWhole = kBytes / 4, kRest = kBytes % 4;
    for (std::size_t i = 0; i < count; ++i, in += kBytes) {
        for (std::size_t w = 0; w < kWhole; ++w) words.word[w][i] = readWord(in + 4 * w);
        if constexpr (kRest != 0) words.word[kWhole][i] = readWord(in + kBytes - 4) >> (32 - 8 * kRest);
    }
}

template <std::size_t kBytes>
void writeWords(const WordBlock& words, std::size_t count, std::byte* out) {
    constexpr std::size_t kWhole = kBytes / 4, kRest = kBytes % 4;
    for (std::size_t i = 0; i < count; ++i, out += kBytes) {
        for (std::size_t w = 0; w < kWhole; ++w) writeWord<4>(words.word[w][i], out + 4 * w);
        if constexpr (kRest != 0) writeWord<kRest>(words.word[kWhole][i], out + 4 * kWhole);
    }
}

template <std::size_t kBytes>
constexpr Format formatWith(FrameErrorBound bound, FrameKernel (*kernel)(SimdTarget)) {
    return {kBytes, bound, kernel, readWords<kBytes>, writeWords<kBytes>};
}

#define TSPACE_KERNEL_FOR(kernel) \
    [](SimdTarget requested) { return simd::choose(requested, TSPACE_KERNEL_TABLE(kernel))(); }

/// Table of formats, indexed by the value of the enumerator.
constexpr Format kFormats[] = {
    formatWith<4>({0.135, 0.135}, TSPACE_KERNEL_FOR(frame32Kernel)),
    formatWith<6>({0.0037, 0.0042}, TSPACE_KERNEL_FOR(frame48Kernel)),
    formatWith<8>({0.0001, 0.00015}, TSPACE_KERNEL_FOR(frame64Kernel)),
    formatWith<4>({0.15, 0.165}, TSPACE_KERNEL_FOR(oct32Kernel)),
    formatWith<8>({0.004, 0.004}, TSPACE_KERNEL_FOR(qtangent64Kernel)),
    formatWith<8>({0.391, 0.391}, TSPACE_KERNEL_FOR(snorm8PairKernel)),
    formatWith<16>({0.00152, 0.00152}, TSPACE_KERNEL_FOR(snorm16PairKernel)),
    formatWith<7>({0.391, 0.391}, TSPACE_KERNEL_FOR(gltfSnorm8Kernel)),
    formatWith<14>({0.00152, 0.00152}, TSPACE_KERNEL_FOR(gltfSnorm16Kernel)),
};

}  // namespace

const Format* formatOf(FrameFormat format) {
    const auto index = static_cast<std::size_t>(format);
    return index < std::size(kFormats) ? &kFormats[index] : nullptr;
}

namespace {

/// Tolerances of sanitize: the tolerance of the glTF validator for lengths, and the sine below which T has no direction
/// perpendicular to N.
constexpr double kCountedTolerance = 5e-4, kOneDegree = 0.017452406437283512;

// ---- repair of input frames

/// Returns the counter of the reason why T cannot be used with this unit N; null if it can.
std::uint64_t PackReport::*causeAgainst(const Vec3& tangent, const DVec3& n) {
    if (!isFinite(tangent)) return &PackReport::not_finite_count;
    DVec3 t = toDouble(tangent);
    if (!normalize(t)) return &PackReport::zero_count;
    return length(cross(n, t)) < kOneDegree ? &PackReport::parallel_count : nullptr;
}

bool isCounted(double size) { return !(std::fabs(size - 1) <= kCountedTolerance); }

/// Returns T made unit and orthogonal to n, which T must not be parallel to. Orthogonalizes twice, because close to n
/// the first pass loses digits by cancellation.
DVec3 orthogonalized(DVec3 t, const DVec3& n) {
    for (int pass = 0; pass < 2; ++pass) {
        normalize(t);
        t = t - dot(n, t) * n;
    }
    normalize(t);
    return t;
}

/// Makes N and T unit and orthogonal. Returns the counter of the cause, or null if they were valid.
std::uint64_t PackReport::*repair(Vec3& normal, Vec3& tangent) {
    std::uint64_t PackReport::*cause = nullptr;
    const auto because = [&](std::uint64_t PackReport::*next) {
        if (cause == nullptr) cause = next;
    };
    DVec3 n = toDouble(normal), t = toDouble(tangent);
    const double n_size = length(n), t_size = length(t);
    if (!normalize(n)) {
        n = {0, 0, 1};
        because(&PackReport::bad_normal_count);
    }
    if (std::uint64_t PackReport::*against = causeAgainst(tangent, n)) {
        because(against);
        t = planeAxes(n).x;
    } else {
        if (isCounted(n_size) || isCounted(t_size)) because(&PackReport::not_unit_count);
        normalize(t);
        if (std::fabs(dot(n, t)) > kCountedTolerance) because(&PackReport::not_orthogonal_count);
        t = orthogonalized(t, n);
    }
    normal = toFloat(n);
    tangent = toFloat(t);
    return cause;
}

// ---- blocks

void setVector(float (&to)[3][kBlockFrames], std::size_t i, const Vec3& v) {
    to[0][i] = v.x;
    to[1][i] = v.y;
    to[2][i] = v.z;
}
Vec3 vectorAt(const float (&from)[3][kBlockFrames], std::size_t i) { return {from[0][i], from[1][i], from[2][i]}; }

/// Returns a block of axis-aligned frames, so that entries that are not set later are valid.
FrameBlock axisAlignedBlock() {
    FrameBlock frames{};
    for (std::size_t i = 0; i < kBlockFrames; ++i) {
        setVector(frames.normal, i, {0, 0, 1});
        setVector(frames.tangent, i, {1, 0, 0});
    }
    return frames;
}

/// Reads frames starting with number `begin`, and repairs them.
void fill(FrameBlock& frames, const StridedSpan<const Vec3>& normals, const StridedSpan<const Vec4>& tangents,
          std::size_t begin, std::size_t count, SimdTarget requested, PackReport& report) {
    std::uint64_t odd_signs = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec4& t = tangents[begin + i];
        setVector(frames.normal, i, normals[begin + i]);
        setVector(frames.tangent, i, xyz(t));
        frames.mirrored[i] = t.w < 0 ? 1 : 0;
        odd_signs |= std::uint64_t{t.w != 1.0f && t.w != -1.0f} << i;
    }
    const std::uint64_t asked = ~std::uint64_t{0} >> (kBlockFrames - count);
    const std::uint64_t valid = simd::choose(requested, TSPACE_KERNEL_TABLE(validFrames))(frames, count);
    for (std::uint64_t left = asked & (~valid | odd_signs); left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        std::uint64_t PackReport::*cause = nullptr;
        if ((valid >> i & 1) == 0) {
            Vec3 n = vectorAt(frames.normal, i), t = vectorAt(frames.tangent, i);
            cause = repair(n, t);
            setVector(frames.normal, i, n);
            setVector(frames.tangent, i, t);
        }
        if (cause == nullptr && (odd_signs >> i & 1) != 0) cause = &PackReport::bad_sign_count;
        if (cause != nullptr) ++(report.*cause);
    }
}

// ---- API boundary

template <class N, class T>
Error check(FrameFormat format, const StridedSpan<N>& normals, const StridedSpan<T>& tangents, const void* bytes,
            std::size_t byte_count) {
    const std::size_t each = frameBytes(format);
    if (each == 0) return {ErrorCode::invalidOption, "the format is not a value of FrameFormat"};
    if (Error e = checkSpan(normals, normals.count, "normals"); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(tangents, normals.count, "tangents"); e.code != ErrorCode::ok) return e;
    if (byte_count / each != normals.count || byte_count % each != 0) {
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "%zu frames of %zu bytes do not match a buffer of %zu bytes", normals.count, each, byte_count);
    }
    return checkSpan(bytes, byte_count, 1, 1, byte_count, "bytes");
}

}  // namespace

PackReport pack(const Format& format, SimdTarget requested, const StridedSpan<const Vec3>& normals,
                const StridedSpan<const Vec4>& tangents, std::byte* bytes) {
    const FrameKernel kernel = format.kernel(requested);
    FrameBlock frames = axisAlignedBlock();
    WordBlock words{};
    PackReport report;
    for (std::size_t begin = 0; begin < normals.count; begin += kBlockFrames) {
        const std::size_t count = std::min(normals.count - begin, kBlockFrames);
        fill(frames, normals, tangents, begin, count, requested, report);
        kernel.encode(frames, count, words);
        format.write(words, count, bytes + begin * format.bytes);
    }
    return report;
}

void unpack(const Format& format, SimdTarget requested, const std::byte* bytes, const StridedSpan<Vec3>& normals,
            const StridedSpan<Vec4>& tangents) {
    const FrameKernel kernel = format.kernel(requested);
    const bool is_dense = normals.stride_bytes == sizeof(Vec3) && tangents.stride_bytes == sizeof(Vec4);
    WordBlock words{};
    alignas(64) float block_normals[3 * kBlockFrames + 1], block_tangents[4 * kBlockFrames];
    for (std::size_t begin = 0; begin < normals.count; begin += kBlockFrames) {
        const std::size_t count = std::min(normals.count - begin, kBlockFrames);
        format.read(bytes + begin * format.bytes, count, words);
        if (is_dense &&
            begin + kBlockFrames < normals.count) {  // bytes written past the block are overwritten by the next block
            kernel.decode(words, count, {&normals[begin].x, &tangents[begin].x});
            continue;
        }
        kernel.decode(words, count, {block_normals, block_tangents});
        for (std::size_t i = 0; i < count; ++i) {
            const float *n = block_normals + 3 * i, *t = block_tangents + 4 * i;
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

Result<PackReport> packFrames(StridedSpan<const Vec3> normals, StridedSpan<const Vec4> tangents, FrameFormat format,
                              std::span<std::byte> out) {
    return atBorder([&]() -> Result<PackReport> {
        if (Error e = pack::check(format, normals, tangents, out.data(), out.size()); e.code != ErrorCode::ok) return e;
        return pack::pack(*pack::formatOf(format), SimdTarget::best, normals, tangents, out.data());
    });
}

Result<Done> unpackFrames(std::span<const std::byte> bytes, FrameFormat format, StridedSpan<Vec3> normals,
                          StridedSpan<Vec4> tangents) {
    return atBorder([&]() -> Result<Done> {
        if (Error e = pack::check(format, normals, tangents, bytes.data(), bytes.size()); e.code != ErrorCode::ok)
            return e;
        pack::unpack(*pack::formatOf(format), SimdTarget::best, bytes.data(), normals, tangents);
        return Done{};
    });
}

const char* frameFormatName(FrameFormat format) {
    static constexpr std::array kNames{"frame32",     "frame48",      "frame64",     "oct32",       "qtangent64",
                                       "snorm8_pair", "snorm16_pair", "gltf_snorm8", "gltf_snorm16"};
    const auto number = static_cast<std::size_t>(format);
    return number < kNames.size() ? kNames[number] : "";
}

}  // namespace tspace
