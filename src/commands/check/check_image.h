// SPDX-License-Identifier: MIT
// A normal map that is checked without a model.
#pragma once

#include <string>

#include "images/image.h"
#include "tspace/check.h"

namespace tspace {

/// Whether the input is an image: by the first bytes of `content` where it has data, else by the extension.
bool isImageInput(const std::string& input, ByteSpan content);

/// Judges the image by the tests of a model's normal maps, and by those for which an image alone is asked. Findings are not counted.
/// Throws FileError.
CheckReport checkImageFile(const std::string& input, const CheckOptions& options);

/// Describes a checked image (CheckReport::image) in a sentence without a full stop.
std::string imageText(const CheckReport& report);

}  // namespace tspace
