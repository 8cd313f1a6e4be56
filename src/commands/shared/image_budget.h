// SPDX-License-Identifier: MIT
// The memory that working on one image file may take. Every call that reads a map decides here.
#pragma once

#include <cstdint>
#include <memory>

#include "images/float_image.h"
#include "images/image.h"
#include "model/io/memory_budget.h"
#include "tspace/file_options.h"

namespace tspace {

/// The user's limit; by default what an image file of this size may take.
std::shared_ptr<MemoryBudget> imageBudget(ByteSpan bytes, const FileOptions& file);

/// An estimate of the bytes that decoding takes, and then `pixel_bytes` for each pixel that the file claims.
std::uint64_t imageNeed(ByteSpan bytes, std::uint64_t pixel_bytes = kMapPixelBytes);

}  // namespace tspace
