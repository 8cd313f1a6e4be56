// SPDX-License-Identifier: MIT
// Reading whole files.
#include "model/io/file_io.h"

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

TEST(ReadFile, GivesTheSameBytesWithAnyThreadCount) {
    const test::TempFolder folder;
    constexpr std::size_t kMega = std::size_t{1} << 20;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, 4 * kMega - 1, 4 * kMega, 9 * kMega + 5}) {
        Bytes written(size);
        std::uint32_t state = 1;
        for (std::uint8_t& byte : written)
            byte = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
        const std::string path = folder.write("a", written);
        for (const unsigned threads : {1u, 2u, 5u}) {
            EXPECT_TRUE(readFile(path, {}, {.thread_count = threads}) == written)
                << size << " bytes, " << threads << " threads";
        }
    }
}

TEST(ReadFile, TakesOnlyFiles) {
    const test::TempFolder folder;
    for (const auto& path : {folder.path("missing"), folder.path()}) {
        EXPECT_EQ(test::errorOf([&] { readFile(path, {}, {.thread_count = 2}); }).code, ErrorCode::cannotRead);
        EXPECT_EQ(test::errorOf([&] { readFile(path, "/buffers/0"); }).code, ErrorCode::invalidFile);
    }
}

}  // namespace
}  // namespace tspace
