// SPDX-License-Identifier: MIT
#include "images/float_image.h"

#include <cstdlib>
#include <cstring>
#include <memory>

#include "images/codecs.h"
#ifdef TSPACE_HAS_IMAGES
#include "images/png_context.h"
#endif

namespace tspace {

namespace {

FloatImage floatsOf(const RgbImage& image) {
    FloatImage out{image.width, image.height, 8, std::vector<Vec3>(std::size_t{image.width} * image.height), {}};
    const std::uint8_t* at = image.rgb.data();
    for (Vec3& texel : out.texels) {
        texel = {static_cast<float>(at[0]) / 255.0f, static_cast<float>(at[1]) / 255.0f,
                 static_cast<float>(at[2]) / 255.0f};
        at += 3;
    }
    return out;
}

#ifdef TSPACE_HAS_IMAGES

/// All that PNG can hold as RGBA of 16 bits: what has fewer is widened by repeating its bits, which keeps n / largest.
std::optional<FloatImage> decodeDeepPng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    constexpr std::size_t kMostChunkBytes = std::size_t{64} << 20;
    const PngContext context(spng_ctx_new(0));
    spng_ihdr header{};
    why = "it is a broken PNG";
    if (!context || spng_set_chunk_limits(context.get(), kMostChunkBytes, kMostChunkBytes) != 0 ||
        spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
        spng_get_ihdr(context.get(), &header) != 0) {
        return {};
    }
    const ImageSize size{header.width, header.height};
    if (isTooLarge(size, bytes.size(), most_pixels, why)) return {};
    std::size_t byte_count = 0;
    if (spng_decoded_image_size(context.get(), SPNG_FMT_RGBA16, &byte_count) != 0 || byte_count != 8 * size.pixels())
        return {};
    std::vector<std::uint16_t> words(4 * size.pixels());
    if (spng_decode_image(context.get(), words.data(), byte_count, SPNG_FMT_RGBA16, SPNG_DECODE_TRNS) != 0) return {};
    FloatImage image{size.width, size.height, header.bit_depth == 16 ? 16u : 8u, std::vector<Vec3>(size.pixels()), {}};
    spng_trns transparency{};
    const bool has_alpha = (header.color_type & 4) != 0 || spng_get_trns(context.get(), &transparency) == 0;
    if (has_alpha) image.alpha.resize(image.texels.size());
    const auto part = [](std::uint16_t word) { return static_cast<float>(word) / 65535.0f; };
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] = {part(words[4 * i]), part(words[4 * i + 1]), part(words[4 * i + 2])};
        if (has_alpha) image.alpha[i] = part(words[4 * i + 3]);
    }
    return image;
}

unsigned nearest(float part, unsigned largest) {
    if (!(part > 0)) return 0;
    const double scaled = static_cast<double>(part) * largest + 0.5;
    return scaled >= largest ? largest : static_cast<unsigned>(scaled);
}

/// Samples one after the other, those of 16 bits as this machine has them: libspng turns them round.
std::vector<std::uint8_t> samplesOf(const FloatImage& image, unsigned bits) {
    const bool has_alpha = !image.alpha.empty();
    const std::size_t sample_bytes = bits / 8;
    std::vector<std::uint8_t> samples(image.texels.size() * (has_alpha ? 4 : 3) * sample_bytes);
    std::uint8_t* at = samples.data();
    const auto put = [&](float part) {
        const unsigned value = nearest(part, bits == 16 ? 65535 : 255);
        const auto word = static_cast<std::uint16_t>(value);
        if (bits == 16) {
            std::memcpy(at, &word, sizeof word);
        } else {
            *at = static_cast<std::uint8_t>(value);
        }
        at += sample_bytes;
    };
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        put(image.texels[i].x);
        put(image.texels[i].y);
        put(image.texels[i].z);
        if (has_alpha) put(image.alpha[i]);
    }
    return samples;
}

/// One filter for all rows: to try all on each row takes as long as all else, and saves a hundredth of the bytes.
std::optional<std::vector<std::uint8_t>> encodeSamples(spng_ihdr header, const std::vector<std::uint8_t>& samples) {
    // Of 16 bits the lower half is noise: to look for more repeats takes four times as long, and saves a tenth.
    const int level = header.bit_depth == 16 ? 1 : 6;  // 6: what zlib takes by itself
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    const PngContext context(spng_ctx_new(SPNG_CTX_ENCODER));
    if (!context || spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1) != 0 ||
        spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_PAETH) != 0 ||
        spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, level) != 0 ||
        spng_set_ihdr(context.get(), &header) != 0 ||
        spng_encode_image(context.get(), samples.data(), samples.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE) != 0) {
        return {};
    }
    std::size_t size = 0;
    int result = 0;
    const std::unique_ptr<void, Free> file(spng_get_png_buffer(context.get(), &size, &result));
    if (!file || result != 0) return {};
    const auto* first = static_cast<const std::uint8_t*>(file.get());
    return std::vector<std::uint8_t>(first, first + size);
}

#endif

}  // namespace

std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    const ImageFormat format = imageFormat(bytes);
#ifdef TSPACE_HAS_IMAGES
    if (format == ImageFormat::png) return decodeDeepPng(bytes, most_pixels, why);
#endif
#ifdef TSPACE_HAS_OPENEXR
    if (format == ImageFormat::exr && whyNotRead(format) == nullptr) return decodeExr(bytes, most_pixels, why);
#endif
    const std::optional<RgbImage> image = decodeImage(bytes, most_pixels, why);
    if (!image) return {};
    return floatsOf(*image);
}

#ifndef TSPACE_HAS_OPENEXR
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage&, unsigned) { return {}; }
#endif

std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits) {
#ifdef TSPACE_HAS_IMAGES
    spng_ihdr header{};
    header.width = image.width;
    header.height = image.height;
    header.bit_depth = static_cast<std::uint8_t>(bits);
    header.color_type = image.alpha.empty() ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    return encodeSamples(header, samplesOf(image, bits));
#else
    (void)image;
    (void)bits;
    return {};
#endif
}

std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image) {
#ifdef TSPACE_HAS_IMAGES
    spng_ihdr header{};
    header.width = image.width;
    header.height = image.height;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    return encodeSamples(header, image.rgb);
#else
    (void)image;
    return {};
#endif
}

}  // namespace tspace
