// SPDX-License-Identifier: MIT
// ASTC by Arm's astcenc, which is loaded when the first such texture comes.
#include "images/texture_file.h"

#ifdef TSPACE_HAS_ASTC
#define ASTCENC_DYNAMIC_LIBRARY
#include <astcenc.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "images/loaded_library.h"
#endif

namespace tspace {

#ifdef TSPACE_HAS_ASTC

namespace {

/// The functions of the library that is there at run time.
struct Astc {
    decltype(&astcenc_config_init) initConfig = nullptr;
    decltype(&astcenc_context_alloc) allocateContext = nullptr;
    decltype(&astcenc_context_free) freeContext = nullptr;
    decltype(&astcenc_decompress_image) decompress = nullptr;
    bool is_loaded = false;

    Astc() {
        LoadedLibrary library(TSPACE_ASTC_LIBRARY);
        library.find(initConfig, "astcenc_config_init");
        library.find(allocateContext, "astcenc_context_alloc");
        library.find(freeContext, "astcenc_context_free");
        library.find(decompress, "astcenc_decompress_image");
        is_loaded = library.hasAll();
    }
};

const Astc& astc() {
    static const Astc loaded;
    return loaded;
}

struct FreeAstcContext {
    void operator()(astcenc_context* context) const { astc().freeContext(context); }
};

}  // namespace

const char* whyNotAstc() {
    return astc().is_loaded ? nullptr
                            : "it is a KTX2 of ASTC, and the library astcenc (" TSPACE_ASTC_LIBRARY
                              ") is not installed";
}

bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels) {
    const TexelFormat& format = texture.format;
    astcenc_config config{};
    astcenc_context* made = nullptr;
    // With the sRGB curve too: it would only change what the stored numbers mean.
    if (astc().initConfig(ASTCENC_PRF_LDR, format.width, format.height, 1, ASTCENC_PRE_FASTEST,
                          ASTCENC_FLG_DECOMPRESS_ONLY, &config) != ASTCENC_SUCCESS ||
        astc().allocateContext(&config, 1, &made) != ASTCENC_SUCCESS) {
        return false;
    }
    const std::unique_ptr<astcenc_context, FreeAstcContext> context(made);
    void* slice = texels.data();
    astcenc_image image{texture.size.width, texture.size.height, 1, ASTCENC_TYPE_F32, &slice};
    const astcenc_swizzle swizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    if (astc().decompress(context.get(), blocks.data(), blocks.size(), &image, &swizzle, 0) != ASTCENC_SUCCESS)
        return false;
    // Blocks that are none come as what is no number.
    for (std::size_t at = 0; at < texels.size(); at += sizeof(Rgba)) {
        Rgba texel{};
        std::memcpy(&texel, &texels[at], sizeof texel);
        bool is_finite = true;
        for (const float part : texel) is_finite = is_finite && std::isfinite(part);
        if (is_finite) continue;
        texel = {1, 0, 1, 1};  // the colour of errors
        std::memcpy(&texels[at], &texel, sizeof texel);
    }
    return true;
}

#else

const char* whyNotAstc() { return "it is a KTX2 of ASTC, which this build of tspace does not read"; }
bool decodeAstc(const TextureFile&, ByteSpan, std::span<std::uint8_t>) { return false; }

#endif

}  // namespace tspace
