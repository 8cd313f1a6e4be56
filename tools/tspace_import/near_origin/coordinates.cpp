// SPDX-License-Identifier: MIT
#include "near_origin/coordinates.h"

#include <algorithm>
#include <string>

#include "number_text.h"

namespace tspace::import {

std::string_view nextWord(std::string_view text, std::size_t& at) {
    while (at < text.size() && isBlank(text[at])) ++at;
    const std::size_t begin = at;
    while (at < text.size() && !isBlank(text[at])) ++at;
    return text.substr(begin, at - begin);
}

void TextCoordinates::addList() {
    lists.emplace_back();
    places_.emplace_back();
}

void TextCoordinates::add(std::string_view word) {
    lists.back().values.push_back(readNumber(word));
    places_.back().push_back({static_cast<std::size_t>(word.data() - text_.data()), word.size()});
}

void TextCoordinates::endList() {
    if (!lists.back().values.empty() && lists.back().values.size() % 3 == 0) return;
    lists.pop_back();
    places_.pop_back();
}

std::vector<char> TextCoordinates::rewritten() {
    struct Number {
        Place place;
        double value;
    };
    std::vector<Number> numbers;
    for (std::size_t l = 0; l < lists.size(); ++l) {
        for (std::size_t i = 0; lists[l].is_moved && i < lists[l].values.size(); ++i)
            numbers.push_back({places_[l][i], lists[l].values[i]});
    }
    // Numbers are sorted by their position in the file, because a format may store z before x.
    const auto isBefore = [](const Number& a, const Number& b) { return a.place.begin < b.place.begin; };
    if (!std::is_sorted(numbers.begin(), numbers.end(), isBefore)) std::sort(numbers.begin(), numbers.end(), isBefore);
    std::vector<char> file;
    file.reserve(text_.size());
    std::size_t copied = 0;
    for (const Number& number : numbers) {
        file.insert(file.end(), &text_[copied], &text_[number.place.begin]);
        const std::string spelled = numberText(number.value);
        file.insert(file.end(), spelled.begin(), spelled.end());
        copied = number.place.begin + number.place.length;
    }
    file.insert(file.end(), text_.begin() + static_cast<std::ptrdiff_t>(copied), text_.end());
    return file;
}

}  // namespace tspace::import
