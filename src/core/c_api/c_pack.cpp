// SPDX-License-Identifier: MIT
// C API: packed frames.
#include "core/c_api/c_convert.h"
#include "tspace/pack.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

static_assert(TSPACE_FRAME_FORMAT_FRAME32 == static_cast<std::uint32_t>(FrameFormat::frame32));
static_assert(TSPACE_FRAME_FORMAT_FRAME48 == static_cast<std::uint32_t>(FrameFormat::frame48));
static_assert(TSPACE_FRAME_FORMAT_FRAME64 == static_cast<std::uint32_t>(FrameFormat::frame64));
static_assert(TSPACE_FRAME_FORMAT_OCT32 == static_cast<std::uint32_t>(FrameFormat::oct32));
static_assert(TSPACE_FRAME_FORMAT_QTANGENT64 == static_cast<std::uint32_t>(FrameFormat::qtangent64));
static_assert(TSPACE_FRAME_FORMAT_SNORM8_PAIR == static_cast<std::uint32_t>(FrameFormat::snorm8Pair));
static_assert(TSPACE_FRAME_FORMAT_SNORM16_PAIR == static_cast<std::uint32_t>(FrameFormat::snorm16Pair));
static_assert(TSPACE_FRAME_FORMAT_GLTF_SNORM8 == static_cast<std::uint32_t>(FrameFormat::gltfSnorm8));
static_assert(TSPACE_FRAME_FORMAT_GLTF_SNORM16 == static_cast<std::uint32_t>(FrameFormat::gltfSnorm16));

namespace {

void writePackReport(const PackReport& from, tspace_PackReport* to) {
    tspace_PackReport made;
    TSPACE_INIT(made);
    made.bad_normal_count = from.bad_normal_count;
    made.not_finite_count = from.not_finite_count;
    made.zero_count = from.zero_count;
    made.parallel_count = from.parallel_count;
    made.not_unit_count = from.not_unit_count;
    made.not_orthogonal_count = from.not_orthogonal_count;
    made.bad_sign_count = from.bad_sign_count;
    made.mended_count = from.mendedCount();
    give(made, to);
}

/// A span can be made of these bytes: null has none.
Error checkBytes(const void* bytes, std::size_t count) { return checkSpan(bytes, count, 1, 1, count, "bytes"); }

}  // namespace

size_t tspace_frameBytes(tspace_FrameFormat format) noexcept { return frameBytes(static_cast<FrameFormat>(format)); }

tspace_FrameErrorBound tspace_frameErrorBound(tspace_FrameFormat format) noexcept {
    const FrameErrorBound bound = frameErrorBound(static_cast<FrameFormat>(format));
    return {bound.normal_deg, bound.tangent_deg};
}

tspace_ErrorCode tspace_packFrames(tspace_ConstSpan normals, tspace_ConstSpan tangents, tspace_FrameFormat format,
                                   void* out, size_t out_bytes, tspace_PackReport* report,
                                   tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        const Error e =
            firstError([&] { return checkSized(report, "report"); }, [&] { return checkBytes(out, out_bytes); });
        if (e.code != ErrorCode::ok) return e;
        const Result<PackReport> result =
            packFrames(toSpan<Vec3>(normals), toSpan<Vec4>(tangents), static_cast<FrameFormat>(format),
                       {static_cast<std::byte*>(out), out_bytes});
        if (!result) return result.error();
        writePackReport(*result, report);
        return Done{};
    });
}

tspace_ErrorCode tspace_unpackFrames(const void* bytes, size_t byte_count, tspace_FrameFormat format,
                                     tspace_Span normals, tspace_Span tangents, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (Error e = checkBytes(bytes, byte_count); e.code != ErrorCode::ok) return e;
        return unpackFrames({static_cast<const std::byte*>(bytes), byte_count}, static_cast<FrameFormat>(format),
                            toSpan<Vec3>(normals), toSpan<Vec4>(tangents));
    });
}
