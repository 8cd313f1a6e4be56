// SPDX-License-Identifier: MIT
// Calls the UTF-16 functions of Windows, because the encoding of the byte functions depends on the system settings.
#define _CRT_RAND_S  // NOLINT: makes the header declare rand_s
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "model/io/disk/stepped_writer.h"
#include "model/io/system_files.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

struct EndHandle {
    void operator()(HANDLE handle) const { CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, EndHandle>;

/// Opens a file or folder to query it; returns null if it does not exist.
Handle openForQuery(const fs::path& path) {
    const HANDLE handle = CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                      OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    return Handle(handle == INVALID_HANDLE_VALUE ? nullptr : handle);
}

/// Removes the \\?\ prefix of long paths, which std::filesystem does not parse.
fs::path withoutMark(std::wstring text) {
    constexpr std::wstring_view kLong = L"\\\\?\\", kShare = L"\\\\?\\UNC\\";
    if (text.starts_with(kShare)) return L"\\\\" + text.substr(kShare.size());
    if (text.starts_with(kLong)) text.erase(0, kLong.size());
    return text;
}

/// Returns the path with links resolved; empty if it cannot be determined.
fs::path finalPath(const fs::path& path) {
    const Handle file = openForQuery(path);
    if (!file) return {};
    std::wstring text(GetFinalPathNameByHandleW(file.get(), nullptr, 0, VOLUME_NAME_DOS), L'\0');
    const DWORD length =
        GetFinalPathNameByHandleW(file.get(), text.data(), static_cast<DWORD>(text.size()), VOLUME_NAME_DOS);
    if (length == 0 || length >= text.size()) return {};
    text.resize(length);
    return withoutMark(std::move(text));
}

}  // namespace

CFile openFile(const Path& path, const char* mode) {
    const std::wstring wide_mode(mode, mode + std::char_traits<char>::length(mode));
    return CFile(_wfopen(fs::path(path).c_str(), wide_mode.c_str()));
}

bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to) {
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
    constexpr std::size_t kMaxAtOnce = std::size_t{1} << 30;
    while (!to.empty()) {
        OVERLAPPED place = {};
        place.Offset = static_cast<DWORD>(begin);
        place.OffsetHigh = static_cast<DWORD>(std::uint64_t{begin} >> 32);
        DWORD count = 0;
        const auto wanted = static_cast<DWORD>(std::min(to.size(), kMaxAtOnce));
        if (ReadFile(handle, to.data(), wanted, &count, &place) == 0 || count == 0) return false;
        begin += count;
        to = to.subspan(count);
    }
    return true;
}

Path canonicalPath(const Path& path) {
    fs::path existing = fs::absolute(fs::path(path)).lexically_normal();
    if (!existing.has_filename()) existing = existing.parent_path();
    fs::path rest;
    while (true) {
        if (const fs::path final = finalPath(existing); !final.empty()) return rest.empty() ? final : final / rest;
        if (existing == existing.parent_path()) return rest.empty() ? existing : existing / rest;
        rest = rest.empty() ? existing.filename() : existing.filename() / rest;
        existing = existing.parent_path();
    }
}

std::string fileIdentity(const Path& path) {
    const Handle file = openForQuery(path);
    BY_HANDLE_FILE_INFORMATION found = {};
    if (!file || GetFileInformationByHandle(file.get(), &found) == 0) return {};
    return std::to_string(found.dwVolumeSerialNumber) + ":" + std::to_string(found.nFileIndexHigh) + ":" +
           std::to_string(found.nFileIndexLow);
}

PathKind kindOf(const Path& path) {
    std::error_code error;
    switch (fs::status(fs::path(path), error).type()) {
        case fs::file_type::not_found:
        case fs::file_type::none: return PathKind::nothing;
        case fs::file_type::regular: return PathKind::file;
        case fs::file_type::directory: return PathKind::folder;
        case fs::file_type::character:
        case fs::file_type::fifo: return PathKind::stream;
        default: return PathKind::other;
    }
}

int listFolder(const Path& folder, std::vector<FolderEntry>& entries) {
    std::error_code error, ignored;
    for (fs::directory_iterator entry(fs::path(folder), error), end; !error && entry != end; entry.increment(error)) {
        entries.push_back({.name = Path(entry->path().filename()).string(),
                           .kind = kindOf(entry->path()),
                           .is_link = entry->is_symlink(ignored)});
    }
    return error.default_error_condition().value();
}

bool isForeignLink(const Path&) { return false; }

CFile createFile(const Path& path, const Path&) {
    const int number =
        _wopen(fs::path(path).c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
    if (number < 0) return nullptr;
    CFile file(_fdopen(number, "wb"));
    if (!file) _close(number);
    return file;
}

// Windows files inherit their permissions from the folder.
void takePermissions(std::FILE*, const Path&) {}

bool syncFile(std::FILE* file) {
    return std::fflush(file) == 0 && FlushFileBuffers(reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)))) != 0;
}
// A process ends even while it waits for FlushFileBuffers, so syncFile() is sufficient.
void startFlush(std::FILE*, std::size_t, std::size_t) noexcept {}
void finishFlush(std::FILE*, std::size_t, std::size_t) noexcept {}
void syncFolder(const Path&) {}

int renameFile(const Path& from, const Path& to) noexcept try {
    std::error_code error;
    fs::rename(fs::path(from), fs::path(to), error);
    return error.default_error_condition().value();
} catch (...) {
    return ENOMEM;
}
int linkFile(const Path& from, const Path& to) noexcept try {
    std::error_code error;
    fs::create_hard_link(fs::path(from), fs::path(to), error);
    return error.default_error_condition().value();
} catch (...) {
    return ENOMEM;
}
int removePath(const Path& path) noexcept try {
    std::error_code error;
    fs::remove(fs::path(path), error);
    return error.default_error_condition().value();
} catch (...) {
    return ENOMEM;
}

std::uint64_t randomNumber() {
    unsigned low = 0, high = 0;
    rand_s(&low);
    rand_s(&high);
    return std::uint64_t{high} << 32 | low;
}

// Console handlers run on a separate thread, and interrupt no other thread.
HeldSignals::HeldSignals() = default;
HeldSignals::~HeldSignals() = default;

void waitBriefly() { Sleep(1); }

std::uint32_t processNumber() { return GetCurrentProcessId(); }

bool isRunning(std::uint32_t process) {
    const Handle handle(OpenProcess(SYNCHRONIZE, FALSE, process));
    if (!handle) return GetLastError() != ERROR_INVALID_PARAMETER;
    return WaitForSingleObject(handle.get(), 0) != WAIT_OBJECT_0;
}

std::string processSpace() {
    std::array<wchar_t, 256> name = {};
    auto length = static_cast<DWORD>(name.size());
    if (GetComputerNameExW(ComputerNamePhysicalDnsHostname, name.data(), &length) == 0) return {};
    return Path(fs::path(std::wstring(name.data(), length))).string();
}

Path ownProgram() {
    std::wstring text(MAX_PATH, L'\0');
    while (true) {
        const DWORD length = GetModuleFileNameW(nullptr, text.data(), static_cast<DWORD>(text.size()));
        if (length == 0) return {};
        if (length < text.size()) return fs::path(text.substr(0, length));
        text.resize(2 * text.size());
    }
}

}  // namespace tspace
