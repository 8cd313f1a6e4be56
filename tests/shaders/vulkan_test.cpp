// SPDX-License-Identifier: MIT
// Compares the shaders on a Vulkan device (lavapipe if installed) with the C++ decoder and geometry.
#include <gtest/gtest.h>

#include <iostream>

#include "cases.h"
#include "core/pack/frame_list.h"
#include "read_spirv.h"
#include "vulkan_compute.h"

namespace tspace::shaders {

namespace {

/// Returns the number of frames per format. It is smaller for generated code. The environment variable TSPACE_FRAMES
/// overrides it. Functions other than decoders get a tenth of it.
std::size_t framesFor(const std::string& language) {
    const bool is_as_written = language.find("_as_") == std::string::npos;
    return static_cast<std::size_t>(test::frameCount(is_as_written ? 1'000'000 : 100'000));
}

/// Name of the language from which the SPIR-V was compiled, and of the languages to which it was converted.
class ShaderLanguage : public testing::TestWithParam<const char*> {};

TEST_P(ShaderLanguage, GivesTheFramesOfTheLibrary) {
    std::string why;
    const std::unique_ptr<VulkanCompute> vulkan = VulkanCompute::open(why);
    if (vulkan == nullptr) GTEST_SKIP() << why << " (scripts/setup installs mesa-vulkan-drivers)";
    std::cout << vulkan->device() << '\n';
    const std::vector<std::uint32_t> spirv = readSpirv(GetParam());
    ASSERT_FALSE(spirv.empty()) << GetParam();
    for (std::uint32_t number = 0; number < caseCount(); ++number) {
        const Case c = makeCase(number, framesFor(GetParam()));
        std::vector<float> results(c.expected.size());
        ASSERT_EQ(vulkan->run(spirv, c.buffer, c.count(), results), "") << c.name;
        EXPECT_EQ(whatIsWrong(c, results), "");
        std::cout << c.name << ": " << c.count() << " items, differences up to " << worstDifference(c, results) << '\n';
    }
}

INSTANTIATE_TEST_SUITE_P(Spirv, ShaderLanguage, testing::Values(TSPACE_SPIRV_NAMES),
                         [](const auto& language) { return std::string(language.param); });

}  // namespace

}  // namespace tspace::shaders
