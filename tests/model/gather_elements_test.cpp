// SPDX-License-Identifier: MIT
// Elements that are copied when they are written, or when somebody looks at them.
#include "model/gltf/gather_elements.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "gltf_builder.h"
#include "model/gltf/editor.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/load_document.h"
#include "model/io/atomic_output.h"
#include "support/temp_folder.h"

namespace tspace::gltf {
namespace {

using test::GltfBuilder;
using test::TempFolder;

RC_GTEST_PROP(GatheredBytes, MakesAnyPartOfTheCopies, ()) {
    const auto element_bytes = *rc::gen::inRange<std::size_t>(1, 18);
    const std::size_t stride = element_bytes + *rc::gen::inRange<std::size_t>(0, 5), count = 20;
    Bytes from(stride * count);
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
    SplitSources sources{.kept = *rc::gen::inRange<std::size_t>(0, count)};
    sources.copies = std::make_shared<const std::vector<std::uint32_t>>(
        *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, count)));
    Bytes expected;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const std::size_t source = i < sources.kept ? i : (*sources.copies)[i - sources.kept];
        const auto element = std::span(from).subspan(source * stride, element_bytes);
        expected.insert(expected.end(), element.begin(), element.end());
    }
    const GatheredBytes gathered(from.data(), stride, element_bytes, sources);
    RC_ASSERT(gathered.size() == expected.size());
    const auto begin = *rc::gen::inRange<std::size_t>(0, expected.size() + 1);
    Bytes part(*rc::gen::inRange<std::size_t>(0, expected.size() - begin + 1), 0);
    gathered.make(begin, part);
    RC_ASSERT(std::equal(part.begin(), part.end(), expected.begin() + static_cast<std::ptrdiff_t>(begin)));
}

/// Three plain accessors in the BIN chunk, of 1000 elements each.
Document threeAccessors() {
    GltfBuilder builder;
    for (int accessor = 0; accessor < 3; ++accessor) {
        std::vector<float> values(3000);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(i) + 0.25f * static_cast<float>(accessor);
        builder.addFloats(values, 3);
    }
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"_OTHER", 2}});
    Document document = parseDocument(builder.glb(), "model.glb", {});
    document.buffers[0].own = true;
    return document;
}

SplitSources someCopies() {
    return {.kept = 1000,
            .copies = std::make_shared<const std::vector<std::uint32_t>>(std::vector<std::uint32_t>(500, 3))};
}

TEST(GatherSplit, CopiesLaterWhatACopyAtOnceWouldHave) {
    const Document document = threeAccessors();
    const Accessor accessor = readAccessor(document, 1);
    ElementData later = gatherSplit(document, accessor, someCopies());
    ASSERT_NE(later.later, nullptr);
    std::vector<std::uint32_t> sources(1500, 3);
    for (std::uint32_t i = 0; i < 1000; ++i) sources[i] = i;
    const ElementData now = gatherElements(document, accessor, sources);
    EXPECT_EQ(later.byteCount(), now.bytes.size());
    later.makeNow();
    EXPECT_EQ(later.bytes, now.bytes);
}

TEST(GatherSplit, IsNotDeceivedByBytesThatChangeBeforeTheyAreCopied) {
    Document document = threeAccessors();
    const Accessor accessor = readAccessor(document, 1);
    ElementData expected = gatherSplit(document, accessor, someCopies());
    expected.makeNow();
    Editor editor(document, "new.bin");
    const std::size_t stored = editor.store(gatherSplit(document, accessor, someCopies()), {});
    ASSERT_TRUE(editor.canOverwrite(accessor));
    editor.overwrite(accessor, Bytes(12000, 0));
    EXPECT_EQ(copyElements(document, readAccessor(document, stored)), expected.bytes);
}

TEST(GatherSplit, IsWrittenAsItWouldBeRead) {
    for (const unsigned threads : {1u, 2u, 3u}) {
        Document document = threeAccessors();
        Editor editor(document, "new.bin");
        // More than is made at one time, between pieces that are there.
        for (int i = 0; i < 60; ++i)
            editor.store(gatherSplit(document, readAccessor(document, static_cast<std::size_t>(i) % 3), someCopies()),
                         {});
        const TempFolder folder;
        AtomicOutput output;
        output.add(folder.path("out"), document.buffers[0].bytes.pieces(), {.thread_count = threads});
        output.commit();
        EXPECT_EQ(output.byteCount(), document.buffers[0].bytes.size());
        EXPECT_EQ(readFile(folder.path("out")), document.buffers[0].bytes.joined()) << threads;
    }
}

TEST(GatherSplit, CopiesAtOnceWhatDoesNotLieInTheModelFile) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(9), 3);
    builder.addPrimitive({{"POSITION", 0}});
    const Document document = test::parse(builder);  // a data URI
    const SplitSources sources{.kept = 3, .copies = std::make_shared<const std::vector<std::uint32_t>>(1, 2u)};
    const ElementData data = gatherSplit(document, readAccessor(document, 0), sources);
    EXPECT_EQ(data.later, nullptr);
    EXPECT_EQ(data.bytes.size(), 48u);
}

}  // namespace
}  // namespace tspace::gltf
