// SPDX-License-Identifier: MIT
// KTX2 and DDS files whose headers are valid except for some values from the input, with arbitrary bytes as blocks and
// levels. fuzz_image covers files that are corrupt anywhere.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "byte_reader.h"
#include "images/float_image.h"
#include "images/image.h"
#include "tspace/map_files.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Number>
void put(Bytes& to, Number number) {
    for (std::size_t i = 0; i < sizeof number; ++i) to.push_back(static_cast<std::uint8_t>(number >> 8 * i));
}

/// Values in the header of a file, which may be wrong.
struct Claims {
    std::uint32_t format = 0, width = 0, height = 0, levels = 1;
    std::uint8_t scheme = 0, model = 1, channel = 0, transfer = 1;
    std::uint64_t unpacked = 0;
};

Bytes makeKtx2(const Claims& claims, const Bytes& data) {
    Bytes file{0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
    for (const std::uint32_t number : {claims.format, 1U, claims.width, claims.height, 0U, 0U, 1U, claims.levels,
                                       std::uint32_t{claims.scheme}, 104U, 44U, 0U, 0U, 0U, 0U, 0U, 0U})
        put(file, number);
    put(file, std::uint64_t{148});
    put(file, std::uint64_t{data.size()});
    put(file, claims.unpacked);
    for (const std::uint32_t number : {44U, 0U, 2U | 40U << 16}) put(file, number);
    for (const std::uint8_t byte : {claims.model, std::uint8_t{1}, claims.transfer, std::uint8_t{0}})
        file.push_back(byte);
    file.resize(135);
    file.push_back(claims.channel);
    file.resize(148);
    file.insert(file.end(), data.begin(), data.end());
    return file;
}

Bytes makeDds(const Claims& claims, const Bytes& data) {
    Bytes file{'D', 'D', 'S', ' '};
    for (const std::uint32_t number : {124U, 0x1007U, claims.height, claims.width, 0U, 0U, claims.levels})
        put(file, number);
    file.resize(76);
    for (const std::uint32_t number : {32U, 4U, 0x30315844U}) put(file, number);  // pixel format with the code DX10
    file.resize(128);
    for (const std::uint32_t number : {claims.format, 3U, 0U, 1U, 0U}) put(file, number);
    file.insert(file.end(), data.begin(), data.end());
    return file;
}

void look(const Bytes& file) {
    constexpr std::uint64_t kMostPixels = 1 << 16;
    std::string why;
    tspace::imageWorkBytes(file);
    const auto deep = tspace::decodeFloatImage(file, kMostPixels, why);
    const auto image = tspace::decodeImage(file, kMostPixels, why);
    require(deep.has_value() == image.has_value(), "an image is read with 8 bits where it is with all");
    if (!deep) return;
    for (const tspace::Vec3& texel : deep->texels) {
        require(std::isfinite(texel.x) && std::isfinite(texel.y) && std::isfinite(texel.z), "texels are finite");
    }
    const auto flipped = tspace::flipGreen(file);
    if (!flipped) return;
    const auto turned = tspace::decodeFloatImage(flipped->bytes, kMostPixels, why);
    require(turned && turned->texels.size() == deep->texels.size(), "what is flipped can be read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(data, size);
    const bool is_ktx2 = in.byte() % 2 == 0;
    Claims claims{.format = in.byte(), .width = 1 + in.byte() % 40U, .height = 1 + in.byte() % 40U};
    const std::uint8_t choices = in.byte();
    claims.scheme = static_cast<std::uint8_t>(choices % 5 < 3 ? 0 : choices % 5 - 1);
    claims.model = choices % 3 == 0 ? 166 : 1;
    claims.channel = choices / 16;
    if (claims.model == 166) claims.format = 0;
    claims.levels = 1;
    // Sometimes the header states the size of 16-byte blocks. The file is then invalid for other formats, unless the
    // sizes happen to match.
    const std::uint64_t blocks = (claims.width + 3) / 4 * ((claims.height + 3) / 4);
    const std::uint8_t per_texel = in.byte() % 18;
    claims.unpacked = per_texel > 16   ? blocks * 16
                      : per_texel == 0 ? blocks * 8
                                       : std::uint64_t{per_texel} * claims.width * claims.height;
    Bytes texels(claims.unpacked);
    for (std::uint8_t& byte : texels) byte = in.byte();
    look(is_ktx2 ? makeKtx2(claims, texels) : makeDds(claims, texels));
    return 0;
}
