// SPDX-License-Identifier: MIT
// One file, at once.
#include "text_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tspace::tool {

Result<Done> writeTextFile(const std::string& path, const std::string& text) {
    const std::string temporary = path + "." + std::to_string(::getpid()) + ".tmp";
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    bool is_written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    int failure = is_written ? 0 : errno;
    if (file != nullptr && std::fclose(file) != 0 && failure == 0) failure = errno;
    if (failure == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) failure = errno;
    if (failure == 0) return Done{};
    if (file != nullptr) std::remove(temporary.c_str());
    return Error{ErrorCode::cannotWrite, std::string("cannot write: ") + std::strerror(failure)};
}

}  // namespace tspace::tool
