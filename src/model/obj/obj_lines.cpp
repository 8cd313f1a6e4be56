// SPDX-License-Identifier: MIT
// A first pass over the text of an OBJ file, before the parser.
#include "model/obj/obj_lines.h"

#include <algorithm>
#include <string_view>

#include "model/io/file_error.h"

namespace tspace::obj {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// The next run of non-blank characters, taken off the front of `line`; empty at the end.
std::string_view takeToken(std::string_view& line) {
    std::size_t begin = 0;
    while (begin < line.size() && isBlank(line[begin])) ++begin;
    std::size_t end = begin;
    while (end < line.size() && !isBlank(line[end])) ++end;
    const std::string_view token = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return token;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::string lineName(std::uint32_t line) { return "line " + std::to_string(line); }

/// 0 for "off" and for anything that is no number.
std::uint32_t smoothingGroup(std::string_view rest) {
    std::uint32_t group = 0;
    for (const char c : takeToken(rest)) {
        if (!isDigit(c)) return 0;
        group = group * 10 + static_cast<std::uint32_t>(c - '0');  // wraps: still one number per spelling
    }
    return group;
}

void noteFace(std::string_view rest, std::uint32_t line, std::uint32_t smoothing_group, LineNotes& notes) {
    constexpr std::size_t kMostDigits = 9;  // fits a 32-bit int; no file can have more vertices than that
    std::size_t digits = 0;
    bool empty = true;
    for (const char c : rest) {
        empty = empty && isBlank(c);
        digits = isDigit(c) ? digits + 1 : 0;
        if (digits > kMostDigits) failFile(ErrorCode::invalidFile, "an index of a face is too large", lineName(line));
    }
    if (!empty) notes.faces.push_back({line, smoothing_group});
}

void noteNumbers(std::string_view rest, std::uint32_t line, bool is_position, LineNotes& notes) {
    std::size_t count = 0;
    for (std::string_view token = takeToken(rest); !token.empty(); token = takeToken(rest)) {
        if (token.front() == '#') break;
        ++count;
        std::string_view digits = token;
        if (digits.front() == '+' || digits.front() == '-') digits.remove_prefix(1);
        if (!digits.empty() && (isDigit(digits.front()) || digits.front() == '.')) continue;
        if (notes.unreadable_number_count++ == 0) notes.unreadable_number_line = line;
    }
    if (is_position && count >= 6) notes.has_vertex_colors = true;
}

/// Blanks a comment behind a face: the parser would read its words as indices.
void blankFaceComment(std::string& text, std::size_t begin, std::size_t end) {
    while (begin < end && isBlank(text[begin])) ++begin;
    if (begin + 1 >= end || text[begin] != 'f' || !isBlank(text[begin + 1])) return;
    // Not text.find(), which would search the rest of the file for each face.
    const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = text.begin() + static_cast<std::ptrdiff_t>(end);
    std::fill(std::find(first, last, '#'), last, ' ');
}

struct LineState {
    std::uint32_t line = 1;
    std::uint32_t smoothing_group = 0;
};

void noteLine(std::string_view line, LineState& state, LineNotes& notes) {
    const std::string_view keyword = takeToken(line);
    if (keyword.empty() || keyword.front() == '#' || line.empty()) return;
    if (keyword == "f") {
        noteFace(line, state.line, state.smoothing_group, notes);
    } else if (keyword == "v" || keyword == "vt" || keyword == "vn") {
        noteNumbers(line, state.line, keyword == "v", notes);
    } else if (keyword == "s") {
        state.smoothing_group = smoothingGroup(line);
        notes.has_smoothing_groups = true;
    } else if (keyword == "mtllib") {
        notes.material_libraries.emplace_back(trimmed(line));
    } else if (keyword == "l" || keyword == "p") {
        notes.has_lines_or_points = true;
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
        notes.has_free_form = true;
    }
}

}  // namespace

void makeLineEndsPlain(std::string& text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\0') text[i] = ' ';
        if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
    }
}

LineNotes prepareLines(std::string& text) {
    makeLineEndsPlain(text);
    LineNotes notes;
    LineState state;
    std::size_t begin = 0;
    std::uint32_t joined = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && text[i] != '\n') continue;
        std::size_t last = i;
        while (last > begin && isBlank(text[last - 1])) --last;
        if (i < text.size() && last > begin && text[last - 1] == '\\') {
            text[last - 1] = ' ';
            text[i] = ' ';
            ++joined;
            continue;
        }
        blankFaceComment(text, begin, i);
        noteLine(std::string_view(text).substr(begin, i - begin), state, notes);
        state.line += 1 + joined;
        joined = 0;
        begin = i + 1;
    }
    return notes;
}

}  // namespace tspace::obj
