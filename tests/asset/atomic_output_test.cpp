// SPDX-License-Identifier: MIT
// All files or none.
#include <gtest/gtest.h>

#include "asset/atomic_output.h"
#include "gltf_builder.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

using test::errorOf;
using test::TempFolder;
using test::toBytes;

TEST(AtomicOutput, PutsAllFilesInPlaceAtOnce) {
    const TempFolder folder;
    folder.write("a", std::string("old"));
    AtomicOutput output;
    const Bytes one = toBytes("one"), two = toBytes("two");
    output.add(folder.path("a"), one);
    output.add(folder.path("new/deep/b"), {one, two});
    EXPECT_EQ(readFile(folder.path("a")), toBytes("old"));
    output.commit();
    EXPECT_EQ(readFile(folder.path("a")), one);
    EXPECT_EQ(readFile(folder.path("new/deep/b")), toBytes("onetwo"));
    EXPECT_EQ(output.byteCount(), 9u);
    EXPECT_EQ(folder.entryCount(), 4u);  // two files, two folders, nothing temporary
}

TEST(AtomicOutput, LeavesNothingWithoutCommit) {
    const TempFolder folder;
    folder.write("a", std::string("old"));
    {
        AtomicOutput output;
        output.add(folder.path("a"), toBytes("new"));
        output.add(folder.path("sub/b"), toBytes("new"));
    }
    EXPECT_EQ(readFile(folder.path("a")), toBytes("old"));
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(AtomicOutput, TakesBackWhatWasRenamedWhenALaterRenameFails) {
    const TempFolder folder;
    folder.write("last", std::string("old"));
    AtomicOutput output;
    output.add(folder.path("first"), toBytes("new"));
    output.add(folder.path("last"), toBytes("new"));
    output.add(folder.path("fresh"), toBytes("new"));
    // A folder of that name appears in between, so the rename of the first file (done at the end) cannot
    // work.
    std::filesystem::create_directory(folder.path("first"));
    EXPECT_EQ(errorOf([&] { output.commit(); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(readFile(folder.path("last")), toBytes("old"));
    EXPECT_FALSE(std::filesystem::exists(folder.path("fresh")));
    EXPECT_TRUE(std::filesystem::is_directory(folder.path("first")));
}

TEST(AtomicOutput, WritesThroughALink) {
    const TempFolder folder;
    folder.write("real", std::string("old"));
    std::filesystem::create_symlink("real", folder.path("link"));
    AtomicOutput output;
    output.add(folder.path("link"), toBytes("new"));
    output.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
    EXPECT_EQ(readFile(folder.path("real")), toBytes("new"));
}

TEST(AtomicOutput, SaysWhyItCannotWrite) {
    const TempFolder folder;
    folder.write("file", std::string("x"));
    AtomicOutput output;
    EXPECT_EQ(errorOf([&] { output.add(folder.path("file/below"), Bytes{1}); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(errorOf([&] { output.add(folder.path(), Bytes{1}); }).code, ErrorCode::cannotWrite);
}

}  // namespace
}  // namespace tspace
