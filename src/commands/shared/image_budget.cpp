// SPDX-License-Identifier: MIT
#include "commands/shared/image_budget.h"

#include <algorithm>

namespace tspace {
namespace {

/// Returns the maximum number of pixels expected of a file of this size: 64 per byte, like isTooLarge. A PNG of one
/// color has up to 344 pixels per byte, so images of up to 2048 x 2048 may have 512. Any file may have 1024 x 1024
/// pixels.
std::uint64_t expectedPixels(std::uint64_t byte_count) {
    constexpr std::uint64_t kAnyFile = std::uint64_t{1} << 20, kOneColor = std::uint64_t{1} << 22;
    return std::max({kAnyFile, std::min(512 * byte_count, kOneColor), 64 * byte_count});
}

}  // namespace

std::shared_ptr<MemoryBudget> imageBudget(ByteSpan bytes, const FileOptions& file) {
    constexpr std::uint64_t kDecoderBytes = 24;  // bytes per pixel, an upper limit for all formats
    auto budget = std::make_shared<MemoryBudget>(file.memory_limit_bytes);
    budget->allow(bytes.size());
    budget->allow((kMapPixelBytes + kDecoderBytes) * expectedPixels(bytes.size()) / MemoryBudget::kPerByte);
    return budget;
}

std::uint64_t imageNeed(ByteSpan bytes, std::uint64_t pixel_bytes) {
    return bytes.size() + imageWorkBytes(bytes) + pixel_bytes * claimedSize(bytes).pixels();
}

}  // namespace tspace
