// SPDX-License-Identifier: MIT
// Files that several tests of the tool write to a folder, and images that the tests read from it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "images/float_image.h"
#include "images/images.h"
#include "model/io/temporary_files.h"
#include "tool/run_tool.h"

namespace tspace::test {

/// Decodes a file, which must be an image.
inline FloatImage imageIn(const TempFolder& folder, const std::string& name) {
    std::string why;
    const std::string file = folder.read(name);
    const std::optional<FloatImage> image = decodeFloatImage(bytesOf(file), 1 << 22, why);
    EXPECT_TRUE(image) << name << ": " << why;
    return image.value_or(FloatImage{});
}

/// Returns the findings of check on a file.
inline nlohmann::json findingsIn(const TempFolder& folder, const std::string& file) {
    const nlohmann::json json = nlohmann::json::parse(runTool(folder, "check --json " + file).out, nullptr, false);
    const bool is_read = json.is_object() && json["files"][0].contains("findings");
    return is_read ? json["files"][0]["findings"] : nlohmann::json::array({"not read"});
}

/// Writes `name` and folded.obj. In `name`, check finds one error, signsInverted, because its tangents have the signs
/// of another convention than glTF's. In folded.obj it finds two notes, normalsMissing and tangentsMissing.
inline void writeInverted(const TempFolder& folder, const std::string& name) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q --convention opengl -o '" + name + "'").exit_code, 0);
}

/// Writes the temporary file that a run on `target` would have left if it had been killed.
inline void leaveTemporaryFile(const TempFolder& folder, const std::string& target) {
    const pid_t child = fork();
    if (child == 0) {
        folder.write(target, "half");
        std::error_code ignored;
        const std::filesystem::path file = folder.path(target);
        std::filesystem::rename(file, temporaryName(Path(file.string()), kTemporaryEnding).string(), ignored);
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
}

}  // namespace tspace::test
