// SPDX-License-Identifier: MIT
// Defines how packed tangent frames are stored in glTF attributes.
#include "model/gltf/packed_layout.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#include "core/base/parallel.h"
#include "model/io/file_error.h"
#include "tspace/execution.h"
#include "tspace/pack.h"
#include "tspace/result.h"

namespace tspace::gltf {

// Table of formats. glTF does not allow 32-bit integers as attributes, so words are stored as bytes or shorts, at most
// four per accessor, which every reader supports; vectors are normalized, so that a GPU decodes them.

namespace {

constexpr ComponentType kI8 = ComponentType::i8, kU8 = ComponentType::u8, kI16 = ComponentType::i16,
                        kU16 = ComponentType::u16;

constexpr PackedPart kFrame32Parts[] = {{"_FRAME32", kU8, "VEC4", false, 0, 4}};
constexpr PackedPart kFrame48Parts[] = {{"_FRAME48", kU16, "VEC3", false, 0, 6}};
constexpr PackedPart kFrame64Parts[] = {{"_FRAME64", kU16, "VEC4", false, 0, 8}};
constexpr PackedPart kOct32Parts[] = {{"_OCT32", kU8, "VEC4", false, 0, 4}};
constexpr PackedPart kQtangent64Parts[] = {{"_QTANGENT64", kI16, "VEC4", true, 0, 8}};
constexpr PackedPart kSnorm8PairParts[] = {{"_SNORM8_PAIR_TANGENT", kI8, "VEC4", true, 0, 4},
                                           {"_SNORM8_PAIR_NORMAL", kI8, "VEC4", true, 4, 4}};
constexpr PackedPart kSnorm16PairParts[] = {{"_SNORM16_PAIR_TANGENT", kI16, "VEC4", true, 0, 8},
                                            {"_SNORM16_PAIR_NORMAL", kI16, "VEC4", true, 8, 8}};
constexpr PackedPart kGltfSnorm8Parts[] = {{"_GLTF_SNORM8_TANGENT", kI8, "VEC4", true, 0, 4},
                                           {"_GLTF_SNORM8_NORMAL", kI8, "VEC3", true, 4, 3}};
constexpr PackedPart kGltfSnorm16Parts[] = {{"_GLTF_SNORM16_TANGENT", kI16, "VEC4", true, 0, 8},
                                            {"_GLTF_SNORM16_NORMAL", kI16, "VEC3", true, 8, 6}};

constexpr PackedLayout kLayouts[] = {
    {FrameFormat::frame32, kFrame32Parts},         {FrameFormat::frame48, kFrame48Parts},
    {FrameFormat::frame64, kFrame64Parts},         {FrameFormat::oct32, kOct32Parts},
    {FrameFormat::qtangent64, kQtangent64Parts},   {FrameFormat::snorm8Pair, kSnorm8PairParts},
    {FrameFormat::snorm16Pair, kSnorm16PairParts}, {FrameFormat::gltfSnorm8, kGltfSnorm8Parts},
    {FrameFormat::gltfSnorm16, kGltfSnorm16Parts},
};

}  // namespace

std::span<const PackedLayout> packedLayouts() { return kLayouts; }

const PackedLayout& packedLayout(FrameFormat format) { return kLayouts[static_cast<std::size_t>(format)]; }

bool isPackedAttribute(const std::string& name) {
    return std::any_of(std::begin(kLayouts), std::end(kLayouts), [&](const PackedLayout& layout) {
        return std::any_of(layout.parts.begin(), layout.parts.end(),
                           [&](const PackedPart& part) { return name == part.attribute; });
    });
}

Bytes takePart(const Bytes& words, FrameFormat format, const PackedPart& part) {
    const std::size_t word_bytes = frameBytes(format), count = words.size() / word_bytes;
    Bytes elements(count * part.byte_count);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(elements.data() + i * part.byte_count, words.data() + i * word_bytes + part.begin, part.byte_count);
    return elements;
}

void putPart(const Bytes& elements, FrameFormat format, const PackedPart& part, Bytes& words) {
    const std::size_t word_bytes = frameBytes(format), count = words.size() / word_bytes;
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(words.data() + i * word_bytes + part.begin, elements.data() + i * part.byte_count, part.byte_count);
}

namespace {

/// Minimum number of frames per task. Parallel measures work in corners processed by a method; packing a frame costs
/// about ten of them.
constexpr std::size_t kPackGrain = 512, kCornersPerFrame = 10;

void add(const PackReport& part, PackReport& sum) {
    sum.bad_normal_count += part.bad_normal_count;
    sum.not_finite_count += part.not_finite_count;
    sum.zero_count += part.zero_count;
    sum.parallel_count += part.parallel_count;
    sum.not_unit_count += part.not_unit_count;
    sum.not_orthogonal_count += part.not_orthogonal_count;
    sum.bad_sign_count += part.bad_sign_count;
}

}  // namespace

Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report) {
    const std::size_t word_bytes = frameBytes(format);
    Bytes words(normals.size() * word_bytes);
    const auto out = std::as_writable_bytes(std::span(words));
    Error failure{ErrorCode::ok, {}};
    std::mutex mutex;
    Parallel parallel(execution, kCornersPerFrame * normals.size());
    parallel.forRanges(normals.size(), kPackGrain, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        const Result<PackReport> packed =
            tspace::packFrames(normals.subspan(begin, count), tangents.subspan(begin, count), format,
                               out.subspan(begin * word_bytes, count * word_bytes));
        const std::lock_guard lock(mutex);
        if (packed) {
            add(*packed, report);
        } else {
            failure = packed.error();
        }
    });
    if (failure.code != ErrorCode::ok) failFile(failure.code, failure.message);
    return words;
}

}  // namespace tspace::gltf
