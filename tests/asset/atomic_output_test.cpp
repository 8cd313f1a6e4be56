// SPDX-License-Identifier: MIT
// All files or none.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <memory>

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

TEST(AtomicOutput, SaysThatThereIsNoRoomForPiecesThatAreMade) {
    struct Zeros final : ByteMaker {
        [[nodiscard]] std::size_t size() const override { return 10'000'000; }
        void make(std::size_t, std::span<std::uint8_t> to) const override {
            std::fill(to.begin(), to.end(), std::uint8_t{0});
        }
    };
    const TempFolder folder;
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    const rlimit small{1'000'000, old.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (const unsigned threads : {1u, 2u}) {
        AtomicOutput output;
        const std::vector<OutputPiece> pieces = {OutputPiece(std::make_shared<Zeros>())};
        EXPECT_EQ(errorOf([&] { output.add(folder.path("a"), pieces, {.thread_count = threads}); }).code,
                  ErrorCode::cannotWrite);
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(folder.entryCount(), 0u);
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
