// SPDX-License-Identifier: MIT
#include "render/picture_file.h"

#include <optional>

#include "asset/file_error.h"
#include "maps/float_image.h"

namespace tspace {

std::vector<std::uint8_t> encodePicture(const RgbImage& image) {
    FloatImage values{.width = image.width, .height = image.height};
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        const std::uint8_t* c = image.rgb.data() + i;
        const auto value = [](std::uint8_t byte) { return static_cast<float>(byte) / 255; };
        values.texels.push_back({value(c[0]), value(c[1]), value(c[2])});
    }
    std::optional<std::vector<std::uint8_t>> png = encodePng(values, 8);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace writes no PNG");
    return *std::move(png);
}

}  // namespace tspace
