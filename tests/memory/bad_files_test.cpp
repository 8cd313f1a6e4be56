// SPDX-License-Identifier: MIT
// For every corrupt or malicious file collected by other projects, memory stays below the limit.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>

#include "expect_bounded.h"
#include "support/shared_data.h"

namespace tspace {
namespace {

namespace fs = std::filesystem;

/// Returns the size of a file plus the buffers and images that it references. Files that are not JSON reference none.
std::uint64_t bytesWithNamedFiles(const fs::path& model) {
    std::vector<fs::path> files = {model};
    std::ifstream stream(model, std::ios::binary);
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    for (const char* list : {"buffers", "images"}) {
        if (!json.is_object() || !json.contains(list) || !json[list].is_array()) continue;
        for (const nlohmann::json& entry : json[list]) {
            if (!entry.is_object() || !entry.contains("uri") || !entry["uri"].is_string()) continue;
            const fs::path named = model.parent_path() / entry["uri"].get<std::string>();
            std::error_code error;
            if (fs::is_regular_file(named, error)) files.push_back(named);
        }
    }
    return test::bytesOf(files);
}

TEST(MemoryCeiling, HoldsForEveryBadFile) {
    const fs::path folder = fs::path(TSPACE_SHARED_DIR) / "bad";
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is missing";
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb" && extension != ".obj" && extension != ".ply" &&
            extension != ".off")
            continue;
        ++count;
        test::expectBounded(entry.path(), bytesWithNamedFiles(entry.path()));
    }
    EXPECT_GT(count, 400u);
}

}  // namespace
}  // namespace tspace
