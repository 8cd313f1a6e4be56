// SPDX-License-Identifier: MIT
// Checks of a normal map without a model.
#pragma once

#include <string>

#include "images/image.h"
#include "tspace/check.h"

namespace tspace {

/// Returns whether the input is an image: decided by the first bytes of `content` if it has data, otherwise by the
/// extension.
bool isImageInput(const std::string& input, ByteSpan content);

/// Checks the image like a normal map of a model, and with further tests for single images. Does not set the counts of
/// findings. Throws FileError.
CheckReport checkImageFile(const std::string& input, const CheckOptions& options);

/// Describes a checked image (CheckReport::image) in a sentence without a trailing period.
std::string imageText(const CheckReport& report);

}  // namespace tspace
