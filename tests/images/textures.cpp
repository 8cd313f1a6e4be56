// SPDX-License-Identifier: MIT
#include "images/textures.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

namespace tspace::test {

namespace {

template <class Number>
void put(std::string& to, Number number) {
    for (std::size_t i = 0; i < sizeof number; ++i) to += static_cast<char>(number >> 8 * i & 255);
}

std::string ddsHead(std::uint32_t width, std::uint32_t height, std::uint32_t levels,
                    const std::vector<std::uint32_t>& pixel_format) {
    std::string file = "DDS ";
    for (const std::uint32_t number : {124U, 0x1007U | (levels > 1 ? 0x20000U : 0U), height, width, 0U, 0U, levels})
        put(file, number);
    file.append(44, '\0');
    put(file, 32U);
    for (const std::uint32_t number : pixel_format) put(file, number);
    put(file, 0x1000U);
    file.append(16, '\0');
    return file;
}

std::uint32_t codeOf(const std::string& text) {
    std::uint32_t code = 0;
    for (unsigned i = 0; i < 4; ++i) code |= std::uint32_t{static_cast<std::uint8_t>(text[i])} << 8 * i;
    return code;
}

std::string bc4Block(const std::uint8_t (&values)[16]) {
    const auto [least, most] = std::minmax_element(std::begin(values), std::end(values));
    std::string block{static_cast<char>(*most), static_cast<char>(*least)};
    std::uint64_t codes = 0;
    for (unsigned i = 0; i < 16; ++i) {
        const int range = *most - *least;
        // steps from 0 to 7, starting at the largest value
        const int step = range == 0 ? 0 : (7 * (*most - values[i]) + range / 2) / range;
        const auto code = static_cast<std::uint64_t>(step == 0 ? 0 : step == 7 ? 1 : step + 1);
        codes |= code << 3 * i;
    }
    for (unsigned i = 0; i < 6; ++i) block += static_cast<char>(codes >> 8 * i & 255);
    return block;
}

}  // namespace

std::string ddsFile(std::uint32_t format, std::uint32_t width, std::uint32_t height, const std::string& data,
                    std::uint32_t levels) {
    std::string file = ddsHead(width, height, levels, {4, codeOf("DX10"), 0, 0, 0, 0, 0});
    for (const std::uint32_t number : {format, 3U, 0U, 1U, 0U}) put(file, number);
    return file + data;
}

std::string oldDdsFile(const std::string& code, std::uint32_t width, std::uint32_t height, const std::string& data) {
    return ddsHead(width, height, 1, {4, codeOf(code), 0, 0, 0, 0, 0}) + data;
}

std::string maskedDdsFile(std::uint32_t bits, std::vector<std::uint32_t> masks, std::uint32_t width,
                          std::uint32_t height, const std::string& data) {
    masks.resize(4);
    const std::uint32_t flags = 0x40U | (masks[3] != 0 ? 1U : 0U);
    return ddsHead(width, height, 1, {flags, 0, bits, masks[0], masks[1], masks[2], masks[3]}) + data;
}

std::string ktx2File(const Ktx2Parts& parts) {
    const std::size_t count = parts.levels.size();
    std::string description;
    for (const std::uint32_t number : {44U, 0U, 2U | 40U << 16}) put(description, number);
    for (const std::uint8_t byte : {parts.model, std::uint8_t{0}, parts.transfer, std::uint8_t{0}})
        description += static_cast<char>(byte);
    description.append(12, '\0');
    description += std::string{0, 0, '\x7f', static_cast<char>(parts.channel)};
    description.append(12, '\0');
    std::string values;
    for (const auto& [key, value] : parts.values) {
        put(values, static_cast<std::uint32_t>(key.size() + 1 + value.size() + 1));
        values += key + '\0' + value + '\0';
        values.resize((values.size() + 3) / 4 * 4);
    }
    std::string file = "\xabKTX 20\xbb\r\n\x1a\n";
    for (const std::uint32_t number :
         {parts.format, 1U, parts.width, parts.height, 0U, 0U, 1U, static_cast<std::uint32_t>(count), parts.scheme})
        put(file, number);
    const auto description_at = static_cast<std::uint32_t>(80 + 24 * count);
    const auto values_at = static_cast<std::uint32_t>(description_at + description.size());
    put(file, description_at);
    put(file, static_cast<std::uint32_t>(description.size()));
    put(file, values_at);
    put(file, static_cast<std::uint32_t>(values.size()));
    put(file, std::uint64_t{0});
    put(file, std::uint64_t{0});
    std::string data;
    std::vector<std::uint64_t> begins(count);
    for (std::size_t i = count; i-- > 0;) {
        data.resize((data.size() + 15) / 16 * 16);
        begins[i] = values_at + values.size() + data.size();
        data += parts.levels[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
        put(file, begins[i]);
        put(file, std::uint64_t{parts.levels[i].size()});
        put(file, i < parts.unpacked.size() ? parts.unpacked[i] : std::uint64_t{parts.levels[i].size()});
    }
    return file + description + values + data;
}

std::string bc5Blocks(const RgbImage& image) {
    std::string blocks;
    for (std::uint32_t top = 0; top < image.height; top += 4) {
        for (std::uint32_t left = 0; left < image.width; left += 4) {
            for (std::size_t channel = 0; channel < 2; ++channel) {
                std::uint8_t values[16];
                for (std::uint32_t i = 0; i < 16; ++i) {
                    const std::size_t x = std::min(left + i % 4, image.width - 1);
                    const std::size_t y = std::min(top + i / 4, image.height - 1);
                    values[i] = image.rgb[3 * (y * image.width + x) + channel];
                }
                blocks += bc4Block(values);
            }
        }
    }
    return blocks;
}

std::string redAndGreen(const RgbImage& image) {
    std::string data;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        data += static_cast<char>(image.rgb[i]);
        data += static_cast<char>(image.rgb[i + 1]);
    }
    return data;
}

std::string bytesOfHex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return bytes;
}

std::string zstdOf(const std::string& data) {
    std::string packed(ZSTD_compressBound(data.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), data.data(), data.size(), 3));
    return packed;
}

std::string zlibOf(const std::string& data) {
    uLongf count = compressBound(data.size());
    std::string packed(count, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &count, reinterpret_cast<const Bytef*>(data.data()), data.size());
    packed.resize(count);
    return packed;
}

}  // namespace tspace::test
