// SPDX-License-Identifier: MIT
// Metal code that is compiled as C++ with the types of metal_shim: the hand-written shaders, and the output of
// spirv-cross for the other languages.
#include <gtest/gtest.h>

#include <iostream>

#include "cases.h"
#include "core/pack/frame_list.h"

// Included last because it defines macros.
#include <metal_stdlib>

namespace tspace::shaders {

namespace {

const std::uint32_t* words_of_case = nullptr;

namespace by_hand {
uint wordAt(uint at) { return words_of_case[at]; }
#include "tspace.metal"

#include "cases.metal"
}  // namespace by_hand
namespace from_glsl {
#include "spirv/glsl_as_metal.metal"
}
namespace from_hlsl {
#include "spirv/hlsl_as_metal.metal"
}

void runByHand(const Case& c, std::vector<float>& results) {
    words_of_case = c.buffer.data();
    for (std::size_t i = 0; i < c.count(); ++i) {
        float4 a, b;
        by_hand::runCase(c.number, static_cast<uint>(kHeaderWords + i * c.item_words), a, b);
        const float values[kResultFloats] = {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w};
        std::copy(values, values + kResultFloats, results.begin() + static_cast<std::ptrdiff_t>(i * kResultFloats));
    }
}

/// Runs a kernel on all items. Its structs contain an array of one element, which is how spirv-cross writes arrays of
/// unknown size.
template <class Words, class Results>
void runKernel(void (*run)(const Words&, Results&, uint3), const Case& c, std::vector<float>& results) {
    for (uint i = 0; i < c.count(); ++i) {
        run(reinterpret_cast<const Words&>(*c.buffer.data()), reinterpret_cast<Results&>(*results.data()), {i, 0, 0});
    }
}

/// Checks the results of all cases. The environment variable TSPACE_FRAMES overrides the number of frames.
void expectRight(void (*run)(const Case&, std::vector<float>&), long default_frames) {
    const auto frames = static_cast<std::size_t>(test::frameCount(default_frames));
    for (std::uint32_t number = 0; number < caseCount(); ++number) {
        const Case c = makeCase(number, frames);
        std::vector<float> results(c.expected.size());
        run(c, results);
        EXPECT_EQ(whatIsWrong(c, results), "");
        std::cout << c.name << ": " << c.count() << " items, differences up to " << worstDifference(c, results) << '\n';
    }
}

TEST(Metal, AsWrittenGivesTheFramesOfTheLibrary) { expectRight(runByHand, 1'000'000); }
TEST(Metal, MadeOfGlslGivesTheFramesOfTheLibrary) {
    expectRight([](const Case& c, std::vector<float>& results) { runKernel(from_glsl::main0, c, results); }, 100'000);
}
TEST(Metal, MadeOfHlslGivesTheFramesOfTheLibrary) {
    expectRight([](const Case& c, std::vector<float>& results) { runKernel(from_hlsl::main0, c, results); }, 100'000);
}

}  // namespace

}  // namespace tspace::shaders
