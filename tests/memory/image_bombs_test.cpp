// SPDX-License-Identifier: MIT
// Images that declare or contain far more pixels than their file size justifies. `check` decodes normal maps.
#include <gtest/gtest.h>

#include <algorithm>

#include "expect_bounded.h"
#include "images/image.h"
#include "images/images.h"
#include "images/textures.h"
#include "model/gltf_builder.h"
#include "tspace/check.h"

namespace tspace {
namespace {

using test::GltfBuilder;
using test::Json;
using test::TempFolder;

/// Tests a triangle with `count` materials, each with a normal map of its own that has the same bytes.
void expectImageBounded(const std::string& image, int count, bool says_so) {
    const TempFolder folder;
    GltfBuilder builder;
    const std::size_t view = builder.addView(Bytes(image.begin(), image.end()));
    const Json attributes = {{"POSITION", builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3)},
                             {"NORMAL", builder.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)},
                             {"TEXCOORD_0", builder.addFloats({0, 0, 1, 0, 0, 1}, 2)}};
    for (int i = 0; i < count; ++i) {
        builder.json()["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
        builder.json()["textures"].push_back({{"source", i}});
        builder.json()["materials"].push_back({{"normalTexture", {{"index", i}}}});
        builder.addPrimitive(attributes)["material"] = i;
    }
    const std::string path = folder.write("model.glb", std::span<const std::uint8_t>(builder.glb()));
    test::expectBounded(path, std::filesystem::file_size(path));
    if (!says_so) return;
    const Result<CheckReport> report = checkFile(path);
    ASSERT_TRUE(report);
    EXPECT_TRUE(std::any_of(report->findings.begin(), report->findings.end(),
                            [](const Finding& finding) { return finding.code == FindingCode::normalMapUnreadable; }));
}

RgbImage flatImage(std::uint32_t size) {
    return {size, size, std::vector<std::uint8_t>(std::size_t{3} * size * size, 128)};
}

/// Returns the file with another size in its header.
std::string claiming(std::string file, std::size_t width_at, std::size_t bytes_each, std::uint32_t width,
                     std::uint32_t height) {
    for (std::size_t i = 0; i < bytes_each; ++i) {
        file[width_at + i] = static_cast<char>(width >> (8 * (bytes_each - 1 - i)));
        file[width_at + bytes_each + i] = static_cast<char>(height >> (8 * (bytes_each - 1 - i)));
    }
    return file;
}

TEST(MemoryCeiling, HoldsForPngThatClaimsFourBillionPixels) {
    // The changed header has a wrong checksum: decoders check sizes first, or reject the file.
    expectImageBounded(claiming(test::pngFile(flatImage(16)), 16, 4, 65535, 65535), 1, true);
    expectImageBounded(claiming(test::pngFile(flatImage(16)), 16, 4, 0xffffffffu, 0xffffffffu), 1, true);
}

TEST(MemoryCeiling, HoldsForJpegThatClaimsFourBillionPixels) {
    std::string file = test::jpegFile(flatImage(16), 90);
    const std::size_t frame = file.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    expectImageBounded(claiming(file, frame + 5, 2, 65535, 65535), 1, true);
    expectImageBounded(claiming(file, frame + 5, 2, 4000, 4000), 1, true);
}

TEST(MemoryCeiling, HoldsForManyFlatImagesOfManyPixels) {
    expectImageBounded(test::pngFile(flatImage(2048)), 100, false);
    expectImageBounded(test::jpegFile(flatImage(2048), 50), 100, false);
}

/// Returns one byte, repeated `count` times, compressed with Zstandard (RFC 8878). The uncompressed data is not stored,
/// because the memory of this process is measured too.
std::string zstdRun(char byte, std::size_t count) {
    constexpr std::size_t kMostOfBlock = std::size_t{1} << 17;
    const auto put = [](std::string& to, std::size_t number, int bytes) {
        for (int i = 0; i < bytes; ++i) to += static_cast<char>(number >> 8 * i & 255);
    };
    std::string frame("\x28\xb5\x2f\xfd\xa0", 5);  // frame header: a single segment, and a content size of four bytes
    put(frame, count, 4);
    for (std::size_t left = count; left > 0;) {
        const std::size_t size = std::min(left, kMostOfBlock);
        left -= size;
        constexpr std::size_t kRun = 1;
        put(frame, (left == 0 ? 1U : 0U) | kRun << 1 | size << 3, 3);
        frame += byte;
    }
    return frame;
}

TEST(MemoryCeiling, HoldsForTexturesThatUnpackToManyPixels) {
    // 16 million pixels of one color in a few kilobytes. A second file declares four times as many.
    constexpr std::size_t kBytes = std::size_t{2} << 24;
    test::Ktx2Parts parts{.format = 16, .width = 4096, .height = 4096, .levels = {zstdRun('\x80', kBytes)}};
    parts.unpacked = {kBytes};
    parts.scheme = 2;
    expectImageBounded(test::ktx2File(parts), 20, false);
    parts.width = parts.height = 8192;
    parts.unpacked = {4 * kBytes};
    expectImageBounded(test::ktx2File(parts), 1, true);
    expectImageBounded(test::ddsFile(83, 1 << 16, 1 << 16, std::string(64, 'x')), 1, true);
}

TEST(MemoryCeiling, StillDecodesValidNormalMaps) {
    const RgbImage map = test::normalMapOf(1024, test::bumps);
    for (const std::string& image : {test::pngFile(map), test::jpegFile(map, 90)}) {
        const TempFolder folder;
        expectImageBounded(image, 2, false);
        std::string why;
        EXPECT_LT(imageWorkBytes(test::bytesOf(image)), std::uint64_t{16} << 20);
        EXPECT_GE(imageWorkBytes(test::bytesOf(image)), std::uint64_t{3} << 20);
    }
}

}  // namespace
}  // namespace tspace
