// SPDX-License-Identifier: MIT
// --memory-limit: valid files that need more memory than their size justifies, and limits set by users.
#include <gtest/gtest.h>

#include <cstdlib>

#include "measured_run.h"
#include "model/gltf_builder.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

using test::GltfBuilder;
using test::MeasuredRun;
using test::TempFolder;

/// Writes a model of four vertices, drawn as a strip of a million triangles with 1-byte indices.
std::string writeLongStrip(const TempFolder& folder) {
    constexpr int kU8 = 5121, kTriangleStrip = 5;
    GltfBuilder builder;
    test::Json& primitive =
        builder.addPrimitive({{"POSITION", builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}, 3)},
                              {"NORMAL", builder.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)},
                              {"TEXCOORD_0", builder.addFloats({0, 0, 1, 0, 0, 1, 1, 1}, 2)}});
    std::vector<std::uint8_t> indices(1'000'000);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint8_t>(i % 4);
    primitive["mode"] = kTriangleStrip;
    primitive["indices"] = builder.addAccessor(indices, kU8, "SCALAR", indices.size());
    return folder.write("strip.glb", std::span<const std::uint8_t>(builder.glb()));
}

/// Runs commands on the long strip. `limit`: value of --memory-limit; if it is empty, the option is not passed.
class LongStrip : public testing::Test {
  protected:
    MeasuredRun run(const std::string& command, const std::string& limit = "") {
        std::vector<std::string> arguments = {command, path_};
        if (command == "generate") arguments.insert(arguments.end(), {"--all", "-o", folder_.path("out.glb").string()});
        if (!limit.empty()) arguments.insert(arguments.end(), {"--memory-limit", limit});
        return test::runMeasured(arguments, folder_.path("messages"));
    }
    [[nodiscard]] std::string message() const { return folder_.read("messages"); }
    [[nodiscard]] bool says(const std::string& text) const { return message().find(text) != std::string::npos; }

  private:
    TempFolder folder_ = {};
    std::string path_ = writeLongStrip(folder_);
};

TEST_F(LongStrip, IsRejectedWithTheOptionThatAcceptsIt) {
    EXPECT_EQ(run("generate").exit_code, 3);
    EXPECT_TRUE(says("use --memory-limit to raise it")) << message();
    EXPECT_EQ(run("generate", "100M").exit_code, 3);
    EXPECT_TRUE(says("--memory-limit is 100 MB")) << message();
    EXPECT_EQ(run("generate", "1G").exit_code, 0) << message();
    EXPECT_EQ(run("generate", "none").exit_code, 0) << message();
}

TEST_F(LongStrip, UsesNoMoreThanTheLimit) {
    for (const std::string command : {"generate", "check", "identify", "inspect"}) {
        for (const std::uint64_t limit : {100, 500}) {
            const MeasuredRun measured = run(command, std::to_string(limit) + "M");
            EXPECT_TRUE(measured.exit_code == 0 || measured.exit_code == 1 || measured.exit_code == 3) << message();
            EXPECT_LE(measured.peak_bytes, limit << 20) << command;
        }
    }
}

/// A user who passes the limit from the error message needs only a few attempts, although later steps may need more
/// memory than the first message says.
TEST_F(LongStrip, IsAcceptedWithTheLimitFromTheMessage) {
    int exit_code = run("generate").exit_code;
    for (int tries = 0; exit_code == 3 && tries < 4; ++tries) {
        const std::string about = "needs about ", line = message();
        ASSERT_NE(line.find(about), std::string::npos) << line;
        exit_code =
            run("generate", std::to_string(std::atoi(line.c_str() + line.find(about) + about.size())) + "M").exit_code;
    }
    EXPECT_EQ(exit_code, 0) << message();
}

}  // namespace
}  // namespace tspace
