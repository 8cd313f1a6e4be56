// SPDX-License-Identifier: MIT
// WebAssembly module of the package entry point "tspace/pack".
#include "tspace/pack.h"

#include "reports.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

TSPACE_JS_EXPORT(frameBytes) std::size_t bytesOf(std::uint32_t format) {
    return frameBytes(static_cast<FrameFormat>(format));
}

/// Packs frames of three floats per normal and four per tangent.
TSPACE_JS_EXPORT(packFrames)
std::uint32_t pack(const float* normals, std::size_t normal_count, const float* tangents, std::size_t tangent_count,
                   std::uint32_t format, std::byte* out, std::size_t out_bytes) {
    auto result = packFrames(vec3Span(normals, normal_count), vec4Span(tangents, tangent_count),
                             static_cast<FrameFormat>(format), {out, out_bytes});
    if (!result) return codeOf(result);
    keep(*result);
    return 0;
}

TSPACE_JS_EXPORT(unpackFrames)
std::uint32_t unpack(const std::byte* bytes, std::size_t byte_count, std::uint32_t format, float* normals,
                     float* tangents, std::size_t count) {
    auto result = unpackFrames({bytes, byte_count}, static_cast<FrameFormat>(format), vec3Span(normals, count),
                               vec4Span(tangents, count));
    return codeOf(result);
}

}  // extern "C"
