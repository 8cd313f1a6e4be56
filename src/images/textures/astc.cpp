// SPDX-License-Identifier: MIT
// Reads ASTC with Arm's astcenc, which is loaded for the first ASTC texture.
#include "images/textures/texture_file.h"

#ifdef TSPACE_HAS_ASTC
#include <cmath>
#include <cstring>

#include "images/textures/astc_library.h"
#endif

namespace tspace {

#ifdef TSPACE_HAS_ASTC

const char* whyNotAstc() {
    return astc().is_loaded ? nullptr
                            : "the KTX2 contains ASTC, and the library astcenc (" TSPACE_ASTC_LIBRARY
                              ") is not installed";
}

bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels) {
    const TexelFormat& format = texture.format;
    astcenc_config config{};
    astcenc_context* made = nullptr;
    // The linear profile is used for sRGB textures too, because sRGB only changes the interpretation of the stored
    // values.
    if (astc().initConfig(ASTCENC_PRF_LDR, format.width, format.height, 1, ASTCENC_PRE_FASTEST,
                          ASTCENC_FLG_DECOMPRESS_ONLY, &config) != ASTCENC_SUCCESS)
        return false;
    const astcenc_error result = astc().allocateContext(&config, 1, &made);
    if (result == ASTCENC_ERR_OUT_OF_MEM) throwOutOfMemory();
    if (result != ASTCENC_SUCCESS) return false;
    const AstcContext context(made);
    void* slice = texels.data();
    astcenc_image image{texture.size.width, texture.size.height, 1, ASTCENC_TYPE_F32, &slice};
    const astcenc_swizzle swizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    if (astc().decompress(context.get(), blocks.data(), blocks.size(), &image, &swizzle, 0) != ASTCENC_SUCCESS)
        return false;
    // Invalid blocks are decoded as NaN.
    for (std::size_t at = 0; at < texels.size(); at += sizeof(Rgba)) {
        Rgba texel{};
        std::memcpy(&texel, &texels[at], sizeof texel);
        bool is_finite = true;
        for (const float part : texel) is_finite = is_finite && std::isfinite(part);
        if (is_finite) continue;
        texel = {1, 0, 1, 1};  // magenta, which ASTC defines as the error color
        std::memcpy(&texels[at], &texel, sizeof texel);
    }
    return true;
}

#else

const char* whyNotAstc() { return "the KTX2 contains ASTC, which this build of tspace does not support"; }
bool decodeAstc(const TextureFile&, ByteSpan, std::span<std::uint8_t>) { return false; }

#endif

}  // namespace tspace
