// SPDX-License-Identifier: MIT
// Writes ASTC with Arm's astcenc.
#include "textures/write_texture.h"

#ifdef TSPACE_HAS_ASTC
#include <algorithm>
#include <atomic>
#include <cstring>

#include "images/textures/astc_library.h"
#include "images/textures/texture_file.h"
#endif

namespace tspace {

#ifdef TSPACE_HAS_ASTC

namespace {

float effortOf(TextureQuality quality) {
    return quality == TextureQuality::quick  ? ASTCENC_PRE_FAST
           : quality == TextureQuality::best ? ASTCENC_PRE_THOROUGH
                                             : ASTCENC_PRE_MEDIUM;
}

/// Decodes ASTC blocks of two channels with the image library.
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

const char* whyNoAstcWritten() {
    return astc().is_loaded ? nullptr
                            : "writing ASTC needs the library astcenc (" TSPACE_ASTC_LIBRARY
                              "), which is not installed (Debian: libastcenc3d)";
}

std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t width, std::uint32_t height, TextureQuality quality,
                                                  std::span<Vec2> texels, Parallel& parallel) {
    constexpr std::uint32_t kSide = 4;
    constexpr std::size_t kBlockBytes = 16;
    const unsigned tasks = parallel.width();
    astcenc_config config{};
    astcenc_context* made = nullptr;
    // Selects the library's angular error metric, with x in red and y in alpha.
    if (astc().initConfig(ASTCENC_PRF_LDR, kSide, kSide, 1, effortOf(quality), ASTCENC_FLG_MAP_NORMAL, &config) !=
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
    // The library distributes the blocks over the tasks. A task that starts late finds no blocks, so the tasks need not
    // run concurrently.
    parallel.forTasks(tasks, [&](std::size_t task) {
        if (astc().compress(context.get(), &image, &swizzle, blocks.data(), blocks.size(),
                            static_cast<unsigned>(task)) != ASTCENC_SUCCESS)
            is_done = false;
    });
    if (!is_done || !decodeTwoChannels(width, height, blocks, texels)) return {};
    return blocks;
}

#else

const char* whyNoAstcWritten() {
    return "this build of tspace cannot write ASTC, because it was built without the library astcenc (Debian: "
           "libastcenc-dev)";
}
std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t, std::uint32_t, TextureQuality, std::span<Vec2>,
                                                  Parallel&) {
    return {};
}

#endif

}  // namespace tspace
