// SPDX-License-Identifier: MIT
// A folder of models, and calls in which each allocation fails in turn.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "failures/failing_memory.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace::test {

inline std::array<char, 200> last_message = {};

template <class Value>
ErrorCode codeOf(const Result<Value>& result) {
    if (result) return ErrorCode::ok;
    std::snprintf(last_message.data(), last_message.size(), "%s", result.error().message.c_str());
    return result.error().code;
}

/// Returns whether the process refuses to call Embree, because an allocation inside Embree failed and its locks may
/// still be locked.
inline bool isEmbreeRefused() {
    return std::string_view(last_message.data()).starts_with("Embree ran out of memory earlier");
}

/// Calls call() while an allocation fails: the first one, then the second one etc., until a call succeeds because it
/// makes fewer allocations. Each number is tested twice: only this allocation fails, or all further ones fail too.
/// call() returns an ErrorCode; look(k) is called after each call().
template <class Call, class Look>
void failEachAllocation(const char* name, const Call& call, const Look& look) {
    for (const bool all_after : {false, true}) {
        constexpr long kMost = 200000;
        long k = 1, failures = 0;
        // The calls make up to 10,000 allocations. To save time, not every allocation beyond a limit is tested.
        for (; k < kMost; k += 1 + k / TSPACE_EVERY_ALLOCATION_UP_TO) {
            failAllocation(k, all_after);
            const ErrorCode code = call();
            const bool was_reached = stopFailing();
            if (code == ErrorCode::outOfMemory && isEmbreeRefused()) return look(k, code);
            if (!was_reached && code != ErrorCode::ok)
                FAIL() << name << ": " << errorName(code) << " without a failure";
            if (!was_reached) {
                look(k, code);
                break;
            }
            failures += code != ErrorCode::ok;
            // A call may succeed by skipping optional data. The only permitted error is a lack of memory, or an error
            // of Embree, which does not always know why it failed.
            const bool is_embree =
                code == ErrorCode::internal && std::string_view(last_message.data()).starts_with("Embree");
            ASSERT_TRUE(code == ErrorCode::ok || code == ErrorCode::outOfMemory || is_embree)
                << name << ", allocation " << k << ": " << errorName(code) << ": " << last_message.data();
            look(k, code);
            if (::testing::Test::HasFailure()) return;
        }
        EXPECT_LT(k, kMost) << name;
        // Calls with small meshes may make no allocation, because the memory that a thread keeps is enough.
        EXPECT_TRUE(failures > 0 || k == 1) << name << ": no allocation failed";
    }
}

inline constexpr const char* kObj =
    "mtllib folded.mtl\no folded\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\nusemtl skin\nf 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n";

class FailingMemory : public ::testing::Test {
  protected:
    FailingMemory() {
        folder_.write("folded.obj", kObj);
        folder_.write("folded.mtl", "newmtl skin\n");
        GenerateOptions all;
        all.selection.all = true;
        EXPECT_TRUE(generateFile(at("folded.obj"), at("plain.glb"), all));
        EXPECT_TRUE(generateFile(at("folded.obj"), at("plain.gltf"), all));
        all.tangents.compute.method = Method::angle;
        all.selection.existing = ExistingTangents::replace;
        EXPECT_TRUE(generateFile(at("plain.glb"), at("other.glb"), all));
    }
    /// Returns the path of a file in the folder. It allocates only for a new name: `name` itself is short enough to
    /// need no allocation.
    const std::string& at(const std::string& name) {
        const auto known = paths_.find(name);
        return known != paths_.end() ? known->second : paths_.emplace(name, folder_.path(name).string()).first->second;
    }

    /// Checks that the call changes and leaves no file, whichever allocation fails.
    template <class Call>
    void onlyReads(const char* name, const Call& call) {
        const std::set<std::string> files = folder_.files();
        const ErrorCode whole_code = call();
        if (whole_code == ErrorCode::outOfMemory && isEmbreeRefused()) return;
        ASSERT_EQ(whole_code, ErrorCode::ok) << name;
        failEachAllocation(name, call,
                           [&](long k, ErrorCode) { EXPECT_EQ(folder_.files(), files) << name << " " << k; });
    }
    /// Checks that the call writes only the file `output`, completely or not at all.
    template <class Call>
    void writesOne(const char* name, const std::string& output, const Call& call) {
        std::filesystem::remove(at(output));
        const ErrorCode whole_code = call();
        if (whole_code == ErrorCode::outOfMemory && isEmbreeRefused()) return;
        ASSERT_EQ(whole_code, ErrorCode::ok) << name;
        const std::string whole = folder_.read(output);
        const std::set<std::string> files = folder_.files();
        folder_.write(output, std::string("old"));
        failEachAllocation(name, call, [&](long k, ErrorCode code) {
            EXPECT_EQ(folder_.files(), files) << name << " " << k;
            EXPECT_TRUE(folder_.read(output) == (code == ErrorCode::ok ? whole : "old"))
                << name << " " << k << ": " << errorName(code) << ", " << folder_.read(output).size() << " bytes";
            folder_.write(output, std::string("old"));
        });
        folder_.write(output, whole);
    }

    TempFolder folder_;
    std::map<std::string, std::string> paths_;
};

}  // namespace tspace::test
