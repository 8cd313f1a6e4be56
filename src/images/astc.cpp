// SPDX-License-Identifier: MIT
// ASTC with Arm's astcenc, which is loaded for the first ASTC texture.
#include "images/texture_file.h"
#include "images/write_texture.h"

#ifdef TSPACE_HAS_ASTC
#define ASTCENC_DYNAMIC_LIBRARY
#include <astcenc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>

#include "images/loaded_library.h"
#endif

namespace tspace {

#ifdef TSPACE_HAS_ASTC

namespace {

/// Functions of the library installed at run time.
struct Astc {
    LoadedLibrary library = LoadedLibrary(TSPACE_ASTC_LIBRARY, std::size_t{8} << 20);
    decltype(&astcenc_config_init) initConfig = library.find("astcenc_config_init");
    decltype(&astcenc_context_alloc) allocateContext = library.find("astcenc_context_alloc");
    decltype(&astcenc_context_free) freeContext = library.find("astcenc_context_free");
    decltype(&astcenc_decompress_image) decompress = library.find("astcenc_decompress_image");
    decltype(&astcenc_compress_image) compress = library.find("astcenc_compress_image");
    bool is_loaded = library.hasAll();
};

const Astc& astc() {
    static const Astc loaded;
    return loaded;
}

struct FreeAstcContext {
    void operator()(astcenc_context* context) const { astc().freeContext(context); }
};
using AstcContext = std::unique_ptr<astcenc_context, FreeAstcContext>;

float effortOf(AstcEffort effort) {
    return effort == AstcEffort::quick  ? ASTCENC_PRE_FAST
           : effort == AstcEffort::best ? ASTCENC_PRE_THOROUGH
                                        : ASTCENC_PRE_MEDIUM;
}

/// Decodes the blocks with the library.
bool decodeTwoChannels(std::uint32_t width, std::uint32_t height, ByteSpan blocks, std::span<Vec2> texels) {
    TextureFile texture{.size = {width, height}, .format = texelFormat(TexelKind::astc)};
    std::vector<std::uint8_t> decoded(sizeof(Rgba) * texels.size());
    if (!decodeAstc(texture, blocks, decoded)) return false;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        Rgba texel{};
        std::memcpy(&texel, &decoded[sizeof texel * i], sizeof texel);
        texels[i] = {2 * texel[0] - 1, 2 * texel[3] - 1};
    }
    return true;
}

}  // namespace

const char* whyNotAstc() {
    return astc().is_loaded ? nullptr
                            : "the KTX2 contains ASTC, and the library astcenc (" TSPACE_ASTC_LIBRARY
                              ") is not installed";
}

bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels) {
    const TexelFormat& format = texture.format;
    astcenc_config config{};
    astcenc_context* made = nullptr;
    // Also for sRGB: the curve only changes the interpretation of the stored values.
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
        texel = {1, 0, 1, 1};  // the error color
        std::memcpy(&texels[at], &texel, sizeof texel);
    }
    return true;
}

const char* whyNoAstcWritten() {
    return astc().is_loaded ? nullptr
                            : "writing ASTC needs the library astcenc (" TSPACE_ASTC_LIBRARY
                              "), which is not installed (Debian: libastcenc3d)";
}

std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t width, std::uint32_t height, AstcEffort effort,
                                                  std::span<Vec2> texels, Parallel& parallel) {
    constexpr std::uint32_t kSide = 4;
    constexpr std::size_t kBlockBytes = 16;
    const unsigned tasks = parallel.width();
    astcenc_config config{};
    astcenc_context* made = nullptr;
    // Selects the library's angular error metric, with x in red and y in alpha.
    if (astc().initConfig(ASTCENC_PRF_LDR, kSide, kSide, 1, effortOf(effort), ASTCENC_FLG_MAP_NORMAL, &config) !=
            ASTCENC_SUCCESS ||
        astc().allocateContext(&config, tasks, &made) != ASTCENC_SUCCESS)
        return {};
    const AstcContext context(made);
    std::vector<Rgba> source;
    source.reserve(texels.size());
    for (const Vec2& texel : texels)
        source.push_back(
            {0.5F + 0.5F * std::clamp(texel.x, -1.0F, 1.0F), 0.5F + 0.5F * std::clamp(texel.y, -1.0F, 1.0F), 0, 1});
    void* slice = source.data();
    astcenc_image image{width, height, 1, ASTCENC_TYPE_F32, &slice};
    const astcenc_swizzle swizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_G};
    const std::size_t across = (width + kSide - 1) / kSide, down = (height + kSide - 1) / kSide;
    std::vector<std::uint8_t> blocks(kBlockBytes * across * down);
    std::atomic<bool> is_done{true};
    // The library distributes the blocks over the tasks; a late task finds none, so the tasks need not run
    // concurrently.
    parallel.forTasks(tasks, [&](std::size_t task) {
        if (astc().compress(context.get(), &image, &swizzle, blocks.data(), blocks.size(),
                            static_cast<unsigned>(task)) != ASTCENC_SUCCESS)
            is_done = false;
    });
    if (!is_done || !decodeTwoChannels(width, height, blocks, texels)) return {};
    return blocks;
}

#else

const char* whyNotAstc() { return "the KTX2 contains ASTC, which this build of tspace does not support"; }
bool decodeAstc(const TextureFile&, ByteSpan, std::span<std::uint8_t>) { return false; }

const char* whyNoAstcWritten() {
    return "this build of tspace cannot write ASTC, because it was built without the library astcenc (Debian: "
           "libastcenc-dev)";
}
std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t, std::uint32_t, AstcEffort, std::span<Vec2>,
                                                  Parallel&) {
    return {};
}

#endif

}  // namespace tspace
