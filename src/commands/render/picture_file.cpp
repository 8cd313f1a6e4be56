// SPDX-License-Identifier: MIT
#include "commands/render/picture_file.h"

#include <optional>

#include "model/io/file_error.h"
#include "images/float_image.h"

namespace tspace {

std::vector<std::uint8_t> encodePicture(const RgbImage& image) {
    std::optional<std::vector<std::uint8_t>> png = encodePng(image);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace writes no PNG");
    return *std::move(png);
}

}  // namespace tspace
