// SPDX-License-Identifier: MIT
#include "render/picture_file.h"

#include <optional>

#include "asset/file_error.h"
#include "maps/float_image.h"

namespace tspace {

std::vector<std::uint8_t> encodePicture(const RgbImage& image) {
    std::optional<std::vector<std::uint8_t>> png = encodePng(image);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace writes no PNG");
    return *std::move(png);
}

}  // namespace tspace
