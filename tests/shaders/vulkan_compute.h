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
    /// Returns null and the reason if there is no device.
    static std::unique_ptr<VulkanCompute> open(std::string& why);
    virtual ~VulkanCompute() = default;

    [[nodiscard]] virtual std::string device() const = 0;
    /// Dispatches main of `spirv`, with local size 64, for `items`: buffer 0 contains the words, buffer 1 receives as
    /// many floats as `results` has. Returns an empty string, or what failed.
    virtual std::string run(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> words,
                            std::size_t items, std::vector<float>& results) = 0;
    /// Dispatches `entry` of `spirv` with the given number of groups, with one storage buffer per array, which receives
    /// the written data. No array may be empty. Returns an empty string, or what failed.
    virtual std::string runBuffers(std::span<const std::uint32_t> spirv, const char* entry, std::uint32_t groups,
                                   std::span<std::vector<std::uint32_t>> arrays) = 0;
};

}  // namespace tspace::shaders
