// SPDX-License-Identifier: MIT
// Memory limit for processing one image file, for all commands that read a map.
#pragma once

#include <cstdint>
#include <memory>

#include "images/float_image.h"
#include "images/image.h"
#include "model/io/memory_budget.h"
#include "tspace/file_options.h"

namespace tspace {

/// Returns a budget with the user's limit; by default the limit depends on the size of the file.
std::shared_ptr<MemoryBudget> imageBudget(ByteSpan bytes, const FileOptions& file);

/// Returns an estimate of the memory for decoding plus `pixel_bytes` for each pixel that the file header declares.
std::uint64_t imageNeed(ByteSpan bytes, std::uint64_t pixel_bytes = kMapPixelBytes);

}  // namespace tspace
