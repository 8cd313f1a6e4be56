// SPDX-License-Identifier: MIT
// Writes the man pages and completions of tspace. Runs when tspace is built.
// usage: tspace_pages FOLDER DATE
//        tspace_pages --options      prints the options of the C API calls as JSON, for scripts/api
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string_view>

#include "command_table.h"
#include "pages/pages.h"

namespace {

bool write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
    using namespace tspace::tool;
    if (argc == 2 && std::string_view(argv[1]) == "--options") {
        std::cout << optionsJson();
        return 0;
    }
    if (argc != 3) {
        std::cerr << "usage: tspace_pages FOLDER DATE, or tspace_pages --options\n";
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const std::string date = argv[2];
    const ToolTable tool = toolTable();
    bool written = true;
    for (const Command& command : tool.commands) {
        const std::string name = "tspace-" + command.name + ".1";
        written &= write(folder / "man/man1" / name, manPage(tool, command, date));
    }
    written &= write(folder / "share/bash-completion/completions/tspace", bashCompletion(tool));
    written &= write(folder / "share/zsh/site-functions/_tspace", zshCompletion(tool));
    written &= write(folder / "share/fish/vendor_completions.d/tspace.fish", fishCompletion(tool));
    // Written last, because the build checks its modification time.
    written &= write(folder / "man/man1/tspace.1", manPage(tool, date));
    if (!written) std::cerr << "tspace_pages: cannot write below " << folder << "\n";
    return written ? 0 : 4;
}
