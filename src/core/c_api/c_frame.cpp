// SPDX-License-Identifier: MIT
// C API: version, errors, conventions and arenas; operations on a single frame; packed frames.
#include <bit>
#include <memory>

#include "core/c_api/c_fields.h"
#include "tspace/execution.h"
#include "tspace/frame.h"
#include "tspace/pack.h"
#include "tspace/tspace.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

uint32_t tspace_version() noexcept { return TSPACE_VERSION_NUMBER; }

const char* tspace_errorName(tspace_ErrorCode code) noexcept { return errorName(static_cast<ErrorCode>(code)); }

size_t tspace_cornerCount(const tspace_Mesh* mesh) noexcept {
    return mesh == nullptr ? 0 : toMesh(*mesh).cornerCount();
}

size_t tspace_faceCount(const tspace_Mesh* mesh) noexcept { return mesh == nullptr ? 0 : toMesh(*mesh).faceCount(); }

tspace_ErrorCode tspace_validate(const tspace_Mesh* mesh, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (Error e = checkMesh(mesh); e.code != ErrorCode::ok) return e;
        return validate(toMesh(*mesh));
    });
}

tspace_ErrorCode tspace_findConvention(const char* name, tspace_Convention* out, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (name == nullptr || out == nullptr) return Error{ErrorCode::nullData, "name and out must not be null"};
        const Convention* convention = findConvention(name);
        if (convention == nullptr)
            return makeError(ErrorCode::invalidOption, kNoElement, "unknown convention \"%s\"", name);
        *out = std::bit_cast<tspace_Convention>(*convention);
        return Done{};
    });
}

float tspace_signFactor(tspace_Convention convention) noexcept { return signFactor(toConvention(convention)); }

float tspace_normalFactor(tspace_Convention convention) noexcept { return normalFactor(toConvention(convention)); }

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

struct tspace_Arena {
    Arena arena;
    tspace_Allocator allocator{arena.allocator()->allocate, arena.allocator()->release, arena.allocator()->user};
};

tspace_ErrorCode tspace_createArena(tspace_Arena** arena, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (arena == nullptr) return Error{ErrorCode::nullData, "arena is null"};
        *arena = nullptr;
        *arena = std::make_unique<tspace_Arena>().release();
        return Done{};
    });
}

const tspace_Allocator* tspace_arenaAllocator(const tspace_Arena* arena) noexcept { return &arena->allocator; }

size_t tspace_arenaHeldBytes(const tspace_Arena* arena) noexcept { return arena->arena.heldBytes(); }

size_t tspace_arenaUsedBytes(const tspace_Arena* arena) noexcept { return arena->arena.usedBytes(); }

void tspace_trimArena(tspace_Arena* arena) noexcept { arena->arena.trim(); }

void tspace_destroyArena(tspace_Arena* arena) noexcept { delete arena; }

namespace {

// C API: operations on a single frame.

// C and C++ structs have the same members in the same order, so values are converted bitwise.
tspace::Vec2 in(const tspace_Vec2& v) { return std::bit_cast<tspace::Vec2>(v); }
tspace::Vec3 in(const tspace_Vec3& v) { return std::bit_cast<tspace::Vec3>(v); }
tspace::Vec4 in(const tspace_Vec4& v) { return std::bit_cast<tspace::Vec4>(v); }
tspace::Frame in(const tspace_Frame& v) { return std::bit_cast<tspace::Frame>(v); }
tspace::Mat3 in(const tspace_Mat3& v) { return std::bit_cast<tspace::Mat3>(v); }
tspace_Vec2 out(const tspace::Vec2& v) { return std::bit_cast<tspace_Vec2>(v); }
tspace_Vec3 out(const tspace::Vec3& v) { return std::bit_cast<tspace_Vec3>(v); }
tspace_Vec4 out(const tspace::Vec4& v) { return std::bit_cast<tspace_Vec4>(v); }
tspace_Frame out(const tspace::Frame& v) { return std::bit_cast<tspace_Frame>(v); }
tspace_Mat3 out(const tspace::Mat3& v) { return std::bit_cast<tspace_Mat3>(v); }
tspace_FaceFrame out(const tspace::FaceFrame& v) { return std::bit_cast<tspace_FaceFrame>(v); }

using MakeFaceFrame = tspace::FaceFrame(const tspace::Vec3*, const tspace::Vec2*);

tspace_FaceFrame faceFrameBy(MakeFaceFrame* make, const tspace_Vec3* positions, const tspace_Vec2* uvs) {
    const tspace::Vec3 p[3] = {in(positions[0]), in(positions[1]), in(positions[2])};
    const tspace::Vec2 t[3] = {in(uvs[0]), in(uvs[1]), in(uvs[2])};
    return out(make(p, t));
}

}  // namespace

tspace_FaceFrame tspace_faceFrame(const tspace_Vec3* positions, const tspace_Vec2* uvs) noexcept {
    return faceFrameBy(tspace::faceFrame, positions, uvs);
}

tspace_FaceFrame tspace_faceFrameFromPath(const tspace_Vec3* positions, const tspace_Vec2* uvs) noexcept {
    return faceFrameBy(tspace::faceFrameFromPath, positions, uvs);
}

float tspace_determinant(tspace_Frame frame) noexcept { return tspace::determinant(in(frame)); }

float tspace_frameSign(tspace_Frame frame) noexcept { return tspace::frameSign(in(frame)); }

tspace_Vec3 tspace_rebuildBitangent(tspace_Vec3 normal, tspace_Vec4 tangent) noexcept {
    return out(tspace::rebuildBitangent(in(normal), in(tangent)));
}

tspace_Frame tspace_orthonormalize(tspace_Frame frame) noexcept { return out(tspace::orthonormalize(in(frame))); }

tspace_Vec4 tspace_packTangent(tspace_Frame frame) noexcept { return out(tspace::packTangent(in(frame))); }

tspace_Frame tspace_basisFromNormal(tspace_Vec3 unit_normal) noexcept {
    return out(tspace::basisFromNormal(in(unit_normal)));
}

tspace_Mat3 tspace_tangentToObject(tspace_Frame frame) noexcept { return out(tspace::tangentToObject(in(frame))); }

tspace_Mat3 tspace_objectToTangentOrthonormal(tspace_Frame frame) noexcept {
    return out(tspace::objectToTangentOrthonormal(in(frame)));
}

int tspace_objectToTangent(tspace_Frame frame, tspace_Mat3* result) noexcept {
    tspace::Mat3 inverse;
    if (!tspace::objectToTangent(in(frame), inverse)) return 0;
    *result = out(inverse);
    return 1;
}

tspace_Vec3 tspace_transform(tspace_Mat3 m, tspace_Vec3 v) noexcept { return out(tspace::transform(in(m), in(v))); }

tspace_Vec3 tspace_toTangentSpace(tspace_Frame frame, tspace_Vec3 direction) noexcept {
    return out(tspace::toTangentSpace(in(frame), in(direction)));
}

tspace_Vec3 tspace_toObjectSpace(tspace_Frame frame, tspace_Vec3 direction) noexcept {
    return out(tspace::toObjectSpace(in(frame), in(direction)));
}

tspace_Vec3 tspace_decodeNormal(tspace_Vec3 texel, float scale, tspace_Green green) noexcept {
    return out(tspace::decodeNormal(in(texel), {scale, static_cast<tspace::Green>(green)}));
}

tspace_Vec2 tspace_tileUv(tspace_Vec2 uv, tspace_Vec2 tiling, tspace_Vec2 offset) noexcept {
    return out(tspace::tileUv(in(uv), in(tiling), in(offset)));
}

float tspace_lambert(tspace_Frame frame, tspace_Vec3 light_direction, tspace_Vec3 tangent_space_normal) noexcept {
    return tspace::lambert(in(frame), in(light_direction), in(tangent_space_normal));
}

tspace_Vec3 tspace_objectNormal(tspace_Frame frame, tspace_Vec3 tangent_space_normal) noexcept {
    return out(tspace::objectNormal(in(frame), in(tangent_space_normal)));
}

tspace_Vec3 tspace_objectNormalMikktspace(tspace_Vec3 interpolated_normal, tspace_Vec4 interpolated_tangent,
                                          tspace_Vec3 tangent_space_normal) noexcept {
    return out(
        tspace::objectNormalMikktspace(in(interpolated_normal), in(interpolated_tangent), in(tangent_space_normal)));
}

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

// C API: packed frames.

/// Checks a span of bytes: null is valid only with a count of 0.
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
        writeReport(toReport(*result), report);
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
