// SPDX-License-Identifier: MIT
// Runs a compute shader on a Vulkan device, preferably a software device.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tspace::shaders {

class VulkanCompute {
  public:
    /// Opens a device. Returns null, and the reason in `why`, if there is none.
    static std::unique_ptr<VulkanCompute> open(std::string& why);
    virtual ~VulkanCompute() = default;

    [[nodiscard]] virtual std::string device() const = 0;
    /// Runs the entry point main of `spirv`, whose local size is 64, on `items` items. Buffer 0 contains the words;
    /// buffer 1 receives as many floats as `results` has. Returns an empty string, or a description of what failed.
    virtual std::string run(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> words,
                            std::size_t items, std::vector<float>& results) = 0;
    /// Runs `entry` of `spirv` with `groups` work groups. Each array is a storage buffer, from which written data is
    /// copied back. No array may be empty. Returns an empty string, or a description of what failed.
    virtual std::string runBuffers(std::span<const std::uint32_t> spirv, const char* entry, std::uint32_t groups,
                                   std::span<std::vector<std::uint32_t>> arrays) = 0;
};

}  // namespace tspace::shaders
