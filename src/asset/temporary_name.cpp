// SPDX-License-Identifier: MIT
// A process number means something only where it was given: on one machine, since its last start, among the processes
// that see each other. All that is in the name.
#include "asset/temporary_name.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "asset/system_files.h"
#include "core/hash.h"
#include "tspace/asset.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

/// Sixteen digits for where this process lives.
std::string machineTag() {
    const std::string text = processSpace();
    std::uint64_t hash = text.size();
    for (const char c : text) hash = foldHash(hash, static_cast<unsigned char>(c));
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 15];
    return digits;
}

const std::string& machineMark() {
    static const std::string mark = ".tspace-" + machineTag() + "-";
    return mark;
}

bool isNumber(std::string_view text) {
    constexpr std::size_t kMostDigits = 10;
    return !text.empty() && text.size() <= kMostDigits &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether besideName() gave this name to a temporary file in a process of this machine that is gone.
bool isAbandoned(std::string_view name) {
    const std::string_view ending = kTemporaryEnding;
    const std::size_t at = name.rfind(machineMark());
    if (at == std::string_view::npos || at == 0 || !name.ends_with(ending)) return false;
    name.remove_suffix(ending.size());
    name.remove_prefix(std::min(name.size(), at + machineMark().size()));
    const std::size_t dash = name.find('-');
    if (dash == std::string_view::npos || !isNumber(name.substr(0, dash)) || !isNumber(name.substr(dash + 1)))
        return false;
    const std::uint64_t process = std::strtoull(std::string(name.substr(0, dash)).c_str(), nullptr, 10);
    return process <= UINT32_MAX && !isRunning(static_cast<std::uint32_t>(process));
}

}  // namespace

Path besideName(const Path& target, const char* ending) {
    static std::atomic<unsigned> next_number = 0;
    return target.string() + machineMark() + std::to_string(processNumber()) + "-" + std::to_string(next_number++) +
           ending;
}

std::uint64_t removeAbandonedFiles(const std::string& folder) {
    std::uint64_t count = 0;
    std::error_code error;
    const fs::recursive_directory_iterator end;
    for (fs::recursive_directory_iterator entry(fs::path(Path(folder)), fs::directory_options::skip_permission_denied,
                                                error);
         !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        // Not a link: what one points at belongs to somebody else.
        const bool is_file = entry->symlink_status(ignored).type() == fs::file_type::regular;
        if (is_file && isAbandoned(Path(entry->path().filename()).string()))
            count += fs::remove(entry->path(), ignored);
    }
    return count;
}

}  // namespace tspace
