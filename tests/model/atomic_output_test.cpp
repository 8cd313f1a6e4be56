// SPDX-License-Identifier: MIT
// Output files appear all together or not at all.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>

#include "gltf_builder.h"
#include "model/io/atomic_output.h"
#include "model/io/system_files.h"
#include "model/io/temporary_files.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

using test::errorOf;
using test::TempFolder;
using test::toBytes;

TEST(AtomicOutput, RenamesAllFilesAtOnce) {
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
    EXPECT_EQ(folder.entryCount(), 4u);  // two files and two folders, but no temporary files
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

TEST(AtomicOutput, UndoesRenamesIfALaterRenameFails) {
    const TempFolder folder;
    folder.write("last", std::string("old"));
    AtomicOutput output;
    output.add(folder.path("first"), toBytes("new"));
    output.add(folder.path("last"), toBytes("new"));
    output.add(folder.path("fresh"), toBytes("new"));
    // A folder with this name is created before the commit, so the rename of the first file, which is done last, must
    // fail.
    std::filesystem::create_directory(folder.path("first"));
    EXPECT_EQ(errorOf([&] { output.commit(); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(readFile(folder.path("last")), toBytes("old"));
    EXPECT_FALSE(std::filesystem::exists(folder.path("fresh")));
    EXPECT_TRUE(std::filesystem::is_directory(folder.path("first")));
}

TEST(AtomicOutput, ReportsAFullDiskForGeneratedPieces) {
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

/// Writing would replace the link by a file, so it is rejected.
TEST(AtomicOutput, RejectsALinkWithAMissingTarget) {
    const TempFolder folder;
    std::filesystem::create_symlink("nothing", folder.path("link"));
    AtomicOutput output;
    EXPECT_EQ(errorOf([&] { output.add(folder.path("link"), toBytes("new")); }).code, ErrorCode::cannotWrite);
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
    EXPECT_EQ(folder.entryCount(), 1u);
}

/// Returns the only temporary file in the folder.
std::filesystem::path temporaryFile(const TempFolder& folder) {
    for (const std::string& name : folder.files()) {
        if (name.ends_with(kTemporaryEnding)) return folder.path(name);
    }
    return {};
}

TEST(AtomicOutput, GivesATemporaryFileNoMorePermissionsThanTheTarget) {
    using std::filesystem::perms;
    const TempFolder folder;
    for (const perms kept :
         {perms::owner_read | perms::owner_write, perms::owner_read | perms::owner_write | perms::group_read,
          perms::owner_all | perms::group_all | perms::others_all}) {
        folder.write("a", std::string("old"));
        std::filesystem::permissions(folder.path("a"), kept);
        AtomicOutput output;
        output.add(folder.path("a"), toBytes("new"));
        const perms temporary = std::filesystem::status(temporaryFile(folder)).permissions();
        EXPECT_EQ(temporary & ~kept, perms::none);
        output.commit();
        EXPECT_EQ(std::filesystem::status(folder.path("a")).permissions(), kept);
    }
}

TEST(AtomicOutput, UsesUnpredictableTemporaryNames) {
    const TempFolder folder;
    std::set<std::string> names;
    for (int i = 0; i < 20; ++i) {
        AtomicOutput output;
        output.add(folder.path("a"), toBytes("new"));
        names.insert(temporaryFile(folder).filename().string());
    }
    EXPECT_EQ(names.size(), 20u);
    const std::string longest(255, 'a');
    EXPECT_LE(std::filesystem::path(temporaryName(folder.path(longest), kTemporaryEnding).string())
                  .filename()
                  .string()
                  .size(),
              255u);
    AtomicOutput output;
    output.add(folder.path(longest), toBytes("new"));
    output.commit();
    EXPECT_EQ(readFile(folder.path(longest)), toBytes("new"));
}

TEST(AtomicOutput, RejectsOutputsThatAreInputsOrEqual) {
    const TempFolder folder;
    folder.write("input", std::string("old"));
    std::filesystem::create_symlink("input", folder.path("link"));
    std::filesystem::create_hard_link(folder.path("input"), folder.path("hard"));
    std::filesystem::create_directory(folder.path("sub"));
    InputFiles inputs;
    inputs.add(folder.path("input"));
    for (const char* name : {"input", "link", "hard", "sub/../input"}) {
        AtomicOutput output({.inputs = &inputs});
        EXPECT_EQ(errorOf([&] { output.add(folder.path(name), toBytes("new")); }).code, ErrorCode::cannotWrite) << name;
    }
    AtomicOutput output;
    output.add(folder.path("a"), toBytes("new"));
    EXPECT_EQ(errorOf([&] { output.add(folder.path("sub/../a"), toBytes("new")); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(readFile(folder.path("input")), toBytes("old"));
}

TEST(AtomicOutput, ASharedFileKeepsTheContentOfTheFirstWriter) {
    const TempFolder folder;
    AtomicOutput first, same, other;
    first.add(folder.path("first"), toBytes("first"));
    first.addShared(folder.path("shared"), toBytes("shared"));
    same.add(folder.path("same"), toBytes("same"));
    same.addShared(folder.path("shared"), toBytes("shared"));
    other.add(folder.path("other"), toBytes("other"));
    other.addShared(folder.path("shared"), toBytes("another"));
    first.commit();
    same.commit();
    EXPECT_EQ(errorOf([&] { other.commit(); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(readFile(folder.path("shared")), toBytes("shared"));
    EXPECT_TRUE(std::filesystem::exists(folder.path("same")));
    EXPECT_FALSE(std::filesystem::exists(folder.path("other")));
}

TEST(AbandonedFiles, AreRestoredIfNoFileReplacedThem) {
    const TempFolder folder;
    // A process that ended while old files were set aside.
    const pid_t child = fork();
    if (child == 0) {
        folder.write("a", std::string("set aside"));
        renameFile(folder.path("a"), temporaryName(folder.path("a"), kBackupEnding));
        folder.write("b", std::string("set aside"));
        renameFile(folder.path("b"), temporaryName(folder.path("b"), kBackupEnding));
        folder.write("b", std::string("new"));
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(removeAbandonedFiles(folder.path().string(), false), 2u);
    EXPECT_EQ(folder.files(), (std::set<std::string>{"a", "b"}));
    EXPECT_EQ(folder.read("a"), "set aside");
    EXPECT_EQ(folder.read("b"), "new");
}

TEST(AtomicOutput, ReportsWhyItCannotWrite) {
    const TempFolder folder;
    folder.write("file", std::string("x"));
    AtomicOutput output;
    EXPECT_EQ(errorOf([&] { output.add(folder.path("file/below"), Bytes{1}); }).code, ErrorCode::cannotWrite);
    EXPECT_EQ(errorOf([&] { output.add(folder.path(), Bytes{1}); }).code, ErrorCode::cannotWrite);
}

}  // namespace
}  // namespace tspace
