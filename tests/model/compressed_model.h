// SPDX-License-Identifier: MIT
// Tests that Draco and meshopt compression share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "gltf_builder.h"
#include "model/read/read_scene.h"
#include "model_compare.h"
#include "support/temp_folder.h"

namespace tspace::test {

struct CompressedRun {
    gltf::Document before, after;
    GenerateReport report;
};

/// Generates all tangents, checks everything that must be preserved, and runs again, which must change nothing.
inline CompressedRun generateAll(const Bytes& glb, GenerateOptions options = {},
                                 const std::string& output_name = "out.glb") {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", glb), output = folder.path(output_name).string();
    options.selection.all = true;
    options.selection.existing = ExistingTangents::replace;
    const auto report = generateFile(input, output, options);
    EXPECT_TRUE(report) << report.error().message << " at " << report.error().place;
    if (!report) return {};
    const Bytes first = readFile(output);
    const auto second = generateFile(output, output, options);
    EXPECT_TRUE(second && !second->changed);
    EXPECT_EQ(readFile(output), first);
    CompressedRun outcome{gltf::loadDocument(input, {}), gltf::loadDocument(output, {}), *report};
    if (options.storage.compression == Compression::keep) {
        for (const std::string& difference : differences(outcome.before, outcome.after, outcome.report))
            ADD_FAILURE() << difference;
    }
    return outcome;
}

/// Changes each byte of the model's buffer in three ways. Every run must either succeed or fail with a precise error.
template <class Model>
void expectOrderWhateverByteIsChanged(const Model& sound) {
    std::size_t refused = 0;
    const std::size_t byte_count = Model(sound).bytes().size();
    for (std::size_t at = 0; at < byte_count; ++at) {
        for (const unsigned bits : {0x01u, 0x80u, 0xffu}) {
            Model model = sound;
            model.bytes()[at] = static_cast<std::uint8_t>(model.bytes()[at] ^ bits);
            const TempFolder folder;
            const std::string input = folder.write("in.glb", model.glb());
            const auto report = generateFile(input, folder.path("out.glb").string(), {.selection = {.all = true}});
            if (report) continue;
            ++refused;
            EXPECT_EQ(report.error().code, ErrorCode::invalidFile) << report.error().message;
            EXPECT_FALSE(report.error().place.empty());
        }
    }
    EXPECT_GT(refused, 0u);
}

}  // namespace tspace::test
