// SPDX-License-Identifier: MIT
// Conditions for edits: which objects share bytes, and that closing gaps moves all other data correctly.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "gltf_builder.h"
#include "model/gltf/editor.h"
#include "model/gltf/references.h"

namespace tspace::gltf {
namespace {

using test::bytesOfValues;
using test::GltfBuilder;
using test::parse;

Extent strided(std::size_t begin, std::size_t stride, std::size_t element_bytes, std::size_t count) {
    return {0, 0, begin, begin + (count - 1) * stride + element_bytes, stride, element_bytes};
}

TEST(Overlaps, TellsInterleavedElementsApart) {
    EXPECT_FALSE(overlaps(strided(0, 32, 12, 10), strided(12, 32, 12, 10)));
    EXPECT_FALSE(overlaps(strided(24, 32, 8, 10), strided(0, 32, 24, 10)));
    EXPECT_TRUE(overlaps(strided(0, 32, 16, 10), strided(12, 32, 12, 10)));
    EXPECT_TRUE(overlaps(strided(12, 32, 12, 10), strided(0, 32, 16, 10)));
    EXPECT_TRUE(overlaps(strided(0, 32, 12, 10), strided(12, 28, 12, 10)));
    EXPECT_FALSE(overlaps(strided(0, 12, 12, 2), strided(24, 12, 12, 2)));
}

RC_GTEST_PROP(Overlaps, AgreesWithMarkingEveryByte, ()) {
    const auto stride = *rc::gen::inRange<std::size_t>(1, 20);
    const auto make = [&] {
        return strided(*rc::gen::inRange<std::size_t>(0, 60), stride, *rc::gen::inRange<std::size_t>(1, stride + 1),
                       *rc::gen::inRange<std::size_t>(1, 6));
    };
    const Extent a = make(), b = make();
    const auto reads = [](const Extent& extent, std::size_t byte) {
        return byte >= extent.begin && byte < extent.end &&
               (byte - extent.begin) % extent.stride < extent.element_bytes;
    };
    bool common = false;
    for (std::size_t byte = 0; byte < 300; ++byte) common = common || (reads(a, byte) && reads(b, byte));
    // Two interleaved accessors may have no common byte although their ranges overlap. Such an overlap may be reported,
    // but common bytes must be reported.
    RC_ASSERT(!common || overlaps(a, b));
}

RC_GTEST_PROP(CutVacated, KeepsEveryOtherAccessor, ()) {
    GltfBuilder builder;
    const auto count = *rc::gen::inRange<std::size_t>(1, 12);
    std::vector<Bytes> expected;
    for (std::size_t i = 0; i < count; ++i) {
        const auto length = *rc::gen::inRange<std::size_t>(1, 40);
        std::vector<float> values(length * 2);
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<float>(i * 1000 + k);
        builder.addFloats(values, 2);
        expected.push_back(bytesOfValues(values));
        if (i > 0 && *rc::gen::arbitrary<bool>()) {
            // Add a second accessor to the view, which starts within the first one.
            Json& accessors = builder.json()["accessors"];
            const auto split = *rc::gen::inRange<std::size_t>(0, length);
            Json second = accessors.back();
            second["byteOffset"] = split * 8;
            second["count"] = length - split;
            accessors.push_back(second);
            accessors[accessors.size() - 2]["count"] = split;
            const Bytes all = expected.back();
            const auto middle = all.begin() + static_cast<std::ptrdiff_t>(split * 8);
            expected.back() = Bytes(all.begin(), middle);
            expected.emplace_back(middle, all.end());
        }
    }
    Document document = parse(builder);
    document.buffers[0].own = true;
    std::vector<ByteRange> vacated;
    std::vector<bool> gone(expected.size(), false);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (!*rc::gen::arbitrary<bool>()) continue;
        const Accessor accessor = readAccessor(document, i);
        const Extent extent = extentOf(document, accessor);
        vacated.push_back({0, extent.begin, extent.end});
        // Like replacing a stored accessor: its entry refers to other bytes afterwards.
        document.json["accessors"][i] = {{"componentType", 5126}, {"count", 1}, {"type", "VEC2"}};
        gone[i] = true;
    }
    const std::size_t before = document.buffers[0].bytes.size();
    RC_ASSERT(test::errorOf([&] { cutVacated(document, vacated); }).message == "");
    RC_ASSERT(document.buffers[0].bytes.size() <= before);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (!gone[i]) RC_ASSERT(copyElements(document, readAccessor(document, i)) == expected[i]);
    }
    for (std::size_t i = 0; i < document.json["bufferViews"].size(); ++i) readBufferView(document, i);
}

TEST(CutVacated, ShrinksASharedView) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(64, 1.0f), 2);
    Json& accessors = builder.json()["accessors"];
    accessors[0]["count"] = 16;
    accessors.push_back(accessors[0]);
    accessors[1]["byteOffset"] = 128;
    Document document = parse(builder);
    document.buffers[0].own = true;
    document.json["accessors"][0].erase("bufferView");
    cutVacated(document, std::vector<ByteRange>{{0, 0, 128}});
    EXPECT_EQ(document.buffers[0].bytes.size(), 128u);
    EXPECT_EQ(document.json["accessors"][1]["byteOffset"], 0);
    EXPECT_EQ(document.json["bufferViews"][0]["byteLength"], 128);
}

TEST(Editor, OverwritesOnlyUnsharedBytes) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(8), 4);
    builder.addFloats(std::vector<float>(8), 4);
    builder.json()["accessors"].push_back(builder.json()["accessors"][1]);
    builder.json()["images"] = Json::array({Json{{"bufferView", builder.addView(Bytes(16, 0))}}});
    builder.addFloats(std::vector<float>(8), 4);
    builder.json()["bufferViews"].back()["extensions"] = {{"VENDOR_x", Json::object()}};
    Document document = parse(builder);
    EXPECT_FALSE(Editor(document, "new.bin").canOverwrite(readAccessor(document, 0))) << "not an own buffer";
    document.buffers[0].own = true;
    const Editor editor(document, "new.bin");
    EXPECT_TRUE(editor.canOverwrite(readAccessor(document, 0)));
    EXPECT_FALSE(editor.canOverwrite(readAccessor(document, 1))) << "accessor 2 reads the same bytes";
    EXPECT_FALSE(editor.canOverwrite(readAccessor(document, 3))) << "its view has an extension";
}

TEST(Editor, CountsReferencesFromEverywhere) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(9), 3);
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 0}})["targets"] = Json::array({Json{{"POSITION", 0}}});
    builder.json()["skins"] = Json::array({Json{{"inverseBindMatrices", 0}}});
    builder.json()["animations"] = Json::parse(R"([{"samplers":[{"input":0,"output":0}]}])");
    builder.json()["nodes"] =
        Json::parse(R"([{"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])");
    EXPECT_EQ(countAccessorUses(parse(builder)), (std::vector<std::size_t>{7}));
    EXPECT_EQ(countViewUses(parse(builder)), (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace tspace::gltf
