// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <io.h>
#include <windows.h>
// This header depends on the headers above, so it must follow them.
#include <shellapi.h>

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "model/io/path.h"
#include "system.h"

namespace tspace::tool {
namespace {

bool isIn(std::string_view set, char c) {
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (i + 2 < set.size() && set[i + 1] == '-') {
            if (set[i] <= c && c <= set[i + 2]) return true;
            i += 2;
        } else if (set[i] == c) {
            return true;
        }
    }
    return false;
}

/// Returns whether the first element of a nonempty pattern matches the character, and removes that element.
bool takeOne(std::string_view& pattern, char c) {
    // A closing bracket may be the first character of a set.
    const std::size_t first = pattern.size() > 1 && (pattern[1] == '!' || pattern[1] == '^') ? 2 : 1;
    const std::size_t end = pattern.front() == '[' ? pattern.find(']', first + 1) : std::string_view::npos;
    bool fits = pattern.front() == '?' || pattern.front() == c;
    if (end != std::string_view::npos) fits = isIn(pattern.substr(first, end - first), c) == (first == 1);
    pattern.remove_prefix(end == std::string_view::npos ? 1 : end + 1);
    return fits;
}

/// Sets binary mode for all standard streams, makes stderr unbuffered, and enables UTF-8 and colors on a terminal.
void prepareStreams() {
    for (std::FILE* file : {stdin, stdout, stderr}) _setmode(_fileno(file), _O_BINARY);
    std::setvbuf(stderr, nullptr, _IONBF, 0);
    SetConsoleOutputCP(CP_UTF8);
    for (const DWORD number : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) {
        DWORD mode = 0;
        const HANDLE handle = GetStdHandle(number);
        if (GetConsoleMode(handle, &mode) != 0) SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
}

}  // namespace

// Nothing to do: Windows uses handles, which are never reused for other files.
void openStandardStreams() {}

std::vector<char*> commandLine(int argc, char** argv) {
    prepareStreams();
    int count = 0;
    wchar_t** wide = CommandLineToArgvW(GetCommandLineW(), &count);
    if (wide == nullptr) return {argv, argv + argc};
    static std::vector<std::string> words;
    for (int i = 0; i < count; ++i) {
        const std::u8string text = std::filesystem::path(wide[i]).u8string();
        words.emplace_back(text.begin(), text.end());
    }
    LocalFree(wide);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    return pointers;
}

bool isTerminal(std::FILE* file) {
    // Only consoles have a mode; other character devices such as NUL do not.
    DWORD mode = 0;
    return GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file))), &mode) != 0;
}

std::size_t terminalColumns(std::FILE* file) {
    CONSOLE_SCREEN_BUFFER_INFO info = {};
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
    if (GetConsoleScreenBufferInfo(handle, &info) == 0) return 0;
    return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

bool terminalHasColors() {
    DWORD mode = 0;
    return GetConsoleMode(GetStdHandle(STD_OUTPUT_HANDLE), &mode) != 0 &&
           (mode & ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool matchesName(const std::string& pattern_text, const std::string& name_text) {
    std::string_view pattern = pattern_text, name = name_text;
    if (name.starts_with('.') && !pattern.starts_with('.')) return false;
    // State of backtracking: the pattern after the last *, and the text after its match. The * matches one more
    // character if the rest fails.
    std::string_view after_star, left;
    bool has_star = false;
    while (!name.empty() || !pattern.empty()) {
        if (pattern.starts_with('*')) {
            pattern.remove_prefix(1);
            after_star = pattern;
            left = name;
            has_star = true;
        } else if (!name.empty() && !pattern.empty() && takeOne(pattern, name.front())) {
            name.remove_prefix(1);
        } else if (has_star && !left.empty()) {
            left.remove_prefix(1);
            name = left;
            pattern = after_star;
        } else {
            return false;
        }
    }
    return true;
}

std::tm utcTime(std::time_t time) {
    std::tm utc = {};
    gmtime_s(&utc, &time);
    return utc;
}

}  // namespace tspace::tool
