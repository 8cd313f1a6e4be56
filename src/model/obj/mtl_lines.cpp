// SPDX-License-Identifier: MIT
// Word by word through the lines that name a texture; all others are copied.
#include "model/obj/mtl_lines.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace tspace::obj {
namespace {

bool isDecimal(char c) { return c >= '0' && c <= '9'; }

/// [+-] digits [. digits] [e [+-] digits], with a digit on one side of the point.
bool isNumber(std::string_view word) {
    std::size_t i = 0;
    const auto skipSign = [&] { i += i < word.size() && (word[i] == '+' || word[i] == '-'); };
    const auto skipDigits = [&] {
        const std::size_t begin = i;
        while (i < word.size() && isDecimal(word[i])) ++i;
        return i - begin;
    };
    skipSign();
    std::size_t digits = skipDigits();
    if (i < word.size() && word[i] == '.') {
        ++i;
        digits += skipDigits();
    }
    if (digits == 0) return false;
    if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
        ++i;
        skipSign();
        if (skipDigits() == 0) return false;
    }
    return i == word.size();
}

struct Option {
    std::string_view name;
    std::size_t number_count;
    std::array<std::string_view, 3> defaults;
    bool moves_texture;
};
constexpr std::array<Option, 4> kOptions = {{{"-o", 3, {"0", "0", "0"}, true},
                                             {"-s", 3, {"1", "1", "1"}, true},
                                             {"-t", 3, {"0", "0", "0"}, true},
                                             {"-mm", 2, {"0", "1", ""}, false}}};

const Option* findOption(std::string_view word) {
    for (const Option& option : kOptions) {
        if (word == option.name) return &option;
    }
    return nullptr;
}

/// A word, and the blanks before it.
struct Word {
    std::string_view blanks, text;
};

std::vector<Word> wordsOf(std::string_view line) {
    std::vector<Word> words;
    while (true) {
        const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        if (begin == end) return words;
        words.push_back({line.substr(0, begin), line.substr(begin, end - begin)});
        line.remove_prefix(end);
    }
}

bool namesTexture(std::string_view keyword) {
    return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "disp" ||
           keyword == "decal" || keyword == "refl";
}

/// Appends the line with complete options. True when one of them moves the texture.
bool appendLine(std::string_view line, std::string& out) {
    const std::vector<Word> words = wordsOf(line);
    if (words.empty() || !namesTexture(words[0].text)) {
        out.append(line);
        return false;
    }
    bool moves = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        out.append(words[i].blanks).append(words[i].text);
        const Option* option = i == 0 ? nullptr : findOption(words[i].text);
        if (option == nullptr) continue;
        for (std::size_t number = 0; number < option->number_count; ++number) {
            // The last word is the file, also when its name is a number.
            const bool is_given = i + 2 < words.size() && isNumber(words[i + 1].text);
            const std::string_view value = is_given ? words[++i].text : option->defaults[number];
            out.append(" ").append(value);
            moves = moves || (option->moves_texture && value != option->defaults[number]);
        }
    }
    return moves;
}

}  // namespace

std::size_t completeTextureOptions(std::string& text) {
    std::string result;
    result.reserve(text.size());
    std::size_t moved = 0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        moved += appendLine(std::string_view(text).substr(begin, end - begin), result);
        if (end < text.size()) result.push_back('\n');
        begin = end + 1;
    }
    text = std::move(result);
    return moved;
}

}  // namespace tspace::obj
