// SPDX-License-Identifier: MIT
// One file, at once.
#include "text_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "asset/system_files.h"

namespace tspace::tool {

Result<Done> writeTextFile(const std::string& path, const std::string& text) {
    namespace fs = std::filesystem;
    const Path temporary = path + "." + std::to_string(processNumber()) + ".tmp";
    CFile file = openFile(temporary, "wb");
    const bool is_open = file != nullptr;
    const bool is_written = is_open && std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
    int failure = is_written ? 0 : errno;
    if (is_open && std::fclose(file.release()) != 0 && failure == 0) failure = errno;
    std::error_code error(failure, std::generic_category());
    if (!error) fs::rename(fs::path(temporary), fs::path(Path(path)), error);
    if (!error) return Done{};
    std::error_code ignored;
    if (is_open) fs::remove(fs::path(temporary), ignored);
    return Error{ErrorCode::cannotWrite, "cannot write: " + error.message()};
}

}  // namespace tspace::tool
