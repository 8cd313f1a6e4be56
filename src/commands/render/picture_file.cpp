// SPDX-License-Identifier: MIT
#include "commands/render/picture_file.h"

#include <optional>

#include "images/float_image.h"
#include "model/io/file_error.h"

namespace tspace {

std::vector<std::uint8_t> encodePicture(const RgbImage& image) {
    std::optional<std::vector<std::uint8_t>> png = encodePng(image);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace writes no PNG");
    return *std::move(png);
}

}  // namespace tspace
