// SPDX-License-Identifier: MIT
// Man pages and shell completions: the programs can read them, and they contain the same options as --help.
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

const std::string kPages = TSPACE_PAGES;
const std::string kBash = kPages + "/share/bash-completion/completions/tspace";
const std::string kZsh = kPages + "/share/zsh/site-functions/_tspace";
const std::string kFish = kPages + "/share/fish/vendor_completions.d/tspace.fish";

bool isThere(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

/// Returns the exit code of a shell command, and its output on stdout and stderr.
std::pair<int, std::string> outputOf(const TempFolder& folder, const std::string& command) {
    const TempFolder scratch;
    const std::string file = (scratch.path() / "out").string();
    const int status =
        std::system(("cd '" + folder.path().string() + "' && { " + command + "; } > " + file + " 2>&1").c_str());
    return {WEXITSTATUS(status), scratch.read("out")};
}

/// Returns the completions that bash offers for the last of the words.
std::set<std::string> offered(const TempFolder& folder, const std::string& words) {
    const std::string script = "source " + kBash + "; COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _tspace; printf '%s\n' \"${COMPREPLY[@]}\"";
    folder.write("complete.sh", script);
    std::istringstream lines(outputOf(folder, "bash complete.sh").second);
    std::filesystem::remove(folder.path("complete.sh"));
    std::set<std::string> words_offered;
    for (std::string line; std::getline(lines, line);) words_offered.insert(line);
    return words_offered;
}

using Words = std::set<std::string>;

TEST(BashCompletion, KnowsCommandsOptionsAndValues) {
    const TempFolder folder;
    EXPECT_EQ(offered(folder, "tspace i"), (Words{"identify", "inspect"}));
    EXPECT_EQ(offered(folder, "tspace --v"), (Words{"--version"}));
    EXPECT_EQ(offered(folder, "tspace generate --over"), (Words{"--overwrite", "--overwrite-normals"}));
    EXPECT_EQ(offered(folder, "tspace check --sev"), (Words{"--severity"}));
    EXPECT_EQ(offered(folder, "tspace generate --method mi"), (Words{"mikktspace"}));
    EXPECT_EQ(offered(folder, "tspace generate --method = mi"), (Words{"mikktspace"}));
    EXPECT_EQ(offered(folder, "tspace generate --format = ''").size(), 3U);
    EXPECT_EQ(offered(folder, "tspace check --ignore signsI"), (Words{"signsInverted"}));
    EXPECT_EQ(offered(folder, "tspace check --ignore signsMixed,signsI"), (Words{"signsMixed,signsInverted"}));
    EXPECT_EQ(offered(folder, "tspace help gen"), (Words{"generate"}));
    EXPECT_EQ(offered(folder, "tspace inspect --jobs ''"), (Words{""}));
}

TEST(BashCompletion, OffersFilesForFileArguments) {
    const TempFolder folder;
    folder.write("model one.glb", "x");
    folder.write("models/a.glb", "x");
    for (const char* line : {"tspace generate mod", "tspace generate -o mod", "tspace generate --manifest mod",
                             "tspace check --sarif mod", "tspace diff a.glb mod"}) {
        EXPECT_EQ(offered(folder, line), (Words{"model one.glb", "models"})) << line;
    }
}

TEST(Completions, KnowEveryOptionOfHelp) {
    const TempFolder folder;
    const std::string zsh = outputOf(folder, "cat " + kZsh).second, fish = outputOf(folder, "cat " + kFish).second;
    for (const std::string command : {"generate", "inspect", "check", "diff", "identify", "help"}) {
        const auto names = optionsInHelp(command);
        ASSERT_FALSE(names.empty()) << command;
        const auto in_bash = offered(folder, "tspace " + command + " --");
        for (const std::string& name : names) {
            EXPECT_EQ(in_bash.count(name), 1U) << command << " " << name;
            EXPECT_NE(zsh.find(name), std::string::npos) << name;
            EXPECT_NE(fish.find("__fish_seen_subcommand_from " + command + "'"), std::string::npos) << command;
            EXPECT_NE(fish.find(" -l " + name.substr(2) + " "), std::string::npos) << name;
        }
    }
}

TEST(Completions, HaveTheSyntaxOfTheirShells) {
    const TempFolder folder;
    EXPECT_EQ(outputOf(folder, "bash -n " + kBash), (std::pair<int, std::string>{0, ""}));
    if (!isThere("zsh") || !isThere("fish")) GTEST_SKIP() << "zsh or fish is missing";
    EXPECT_EQ(outputOf(folder, "zsh -n " + kZsh), (std::pair<int, std::string>{0, ""}));
    EXPECT_EQ(outputOf(folder, "fish -n " + kFish), (std::pair<int, std::string>{0, ""}));
    const std::string complete = "fish -c \"source " + kFish + "; complete -C 'tspace generate --method mi'\"";
    EXPECT_EQ(outputOf(folder, complete).second.substr(0, 10), "mikktspace");
}

TEST(ManPages, AreReadWithoutAWarning) {
    if (!isThere("groff")) GTEST_SKIP() << "groff is missing";
    const TempFolder folder;
    std::vector<std::string> pages;
    for (const auto& page : std::filesystem::directory_iterator(kPages + "/man/man1")) pages.push_back(page.path());
    EXPECT_GE(pages.size(), 16U);
    for (const std::string& file : pages) {
        // mandoc would also require a date, but it is rarely installed.
        EXPECT_EQ(outputOf(folder, "grep -qE '^[.]TH [^ ]+ 1 [0-9]{4}-[0-9]{2}-[0-9]{2} ' " + file).first, 0) << file;
        const auto [code, warnings] = outputOf(folder, "groff -man -ww -Tutf8 -rLL=80n " + file + " > page");
        EXPECT_EQ(code, 0) << file;
        EXPECT_EQ(warnings, "") << file;
        EXPECT_GT(folder.read("page").size(), 500U) << file;
        if (isThere("mandoc")) {
            EXPECT_EQ(outputOf(folder, "mandoc -T lint -W warning " + file).second, "");
        }
    }
    const std::string text =
        outputOf(folder, "groff -man -Tascii -P-c " + kPages + "/man/man1/tspace-generate.1 | sed 's/.\x08//g'").second;
    for (const std::string& name : optionsInHelp("generate")) EXPECT_NE(text.find(name), std::string::npos) << name;
    for (const char* part : {"SYNOPSIS", "tspace generate", "EXIT STATUS", "SEE ALSO", "tspace-check(1)"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace tspace::test
