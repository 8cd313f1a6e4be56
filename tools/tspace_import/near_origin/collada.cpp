// SPDX-License-Identifier: MIT
// COLLADA: the text of the arrays that positions are taken from.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "near_origin/coordinates.h"
#include "near_origin/xml_tags.h"
#include "number_text.h"

namespace tspace::import {

namespace {

/// A source of vectors: x is every `stride`th number, and so on.
struct Source {
    std::string_view array = {};  ///< id
    std::size_t stride = 1, first = 0, count = 0;
    std::array<std::size_t, 3> places = {};  ///< of X, Y and Z
    unsigned axes = 0;                       ///< bits of those that are there
    std::size_t parameter_count = 0;
};

/// What a file says about its sources and who uses them as positions.
struct Sources {
    std::map<std::string_view, std::string_view> numbers_of = {};  ///< text of arrays by id
    std::map<std::string_view, Source> by_id = {};
    std::vector<std::string_view> of_positions = {};  ///< ids, in the order of the file
};

std::size_t wholeNumber(std::string_view text, std::size_t otherwise) {
    const double number = text.empty() ? static_cast<double>(otherwise) : readNumber(text);
    constexpr double kMost = 4294967296.0;
    return number >= 0 && number < kMost ? static_cast<std::size_t>(number) : 0;
}

std::string_view withoutHash(std::string_view reference) {
    return reference.starts_with('#') ? reference.substr(1) : std::string_view();
}

Sources sourcesOf(std::string_view text) {
    Sources sources;
    std::string_view source;
    bool in_vertices = false;
    for (XmlTags tags(text); const std::optional<XmlTag> tag = tags.next();) {
        if (tag->name == "source" && !tag->attribute("id").empty()) {
            source = tag->attribute("id");
        } else if (tag->name == "float_array" && !tag->is_end) {
            sources.numbers_of[tag->attribute("id")] = tags.textUntilTag();
        } else if (tag->name == "accessor" && !tag->is_end) {
            sources.by_id[source] = {.array = withoutHash(tag->attribute("source")),
                                     .stride = wholeNumber(tag->attribute("stride"), 1),
                                     .first = wholeNumber(tag->attribute("offset"), 0),
                                     .count = wholeNumber(tag->attribute("count"), 0)};
        } else if (tag->name == "param" && !tag->is_end) {
            const auto found = sources.by_id.find(source);
            if (found == sources.by_id.end()) continue;
            const std::size_t axis = std::string_view("XYZ").find(tag->attribute("name"));
            if (tag->attribute("name").size() == 1 && axis != std::string_view::npos) {
                found->second.places[axis] = found->second.parameter_count;
                found->second.axes |= 1U << axis;
            }
            ++found->second.parameter_count;
        } else if (tag->name == "vertices") {
            in_vertices = !tag->is_end;
        } else if (tag->name == "input" && in_vertices && tag->attribute("semantic") == "POSITION") {
            sources.of_positions.push_back(withoutHash(tag->attribute("source")));
        }
    }
    return sources;
}

/// The words of an array that are coordinates, as a list.
void addVertices(TextCoordinates& file, const Source& source, std::string_view numbers) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < numbers.size();) {
        const std::string_view word = nextWord(numbers, at);
        if (!word.empty()) words.push_back(word);
    }
    const std::size_t last = source.first + *std::max_element(source.places.begin(), source.places.end());
    if (source.count == 0 || last >= words.size() || (words.size() - 1 - last) / source.stride < source.count - 1)
        return;
    file.addList();
    for (std::size_t i = 0; i < source.count; ++i) {
        for (const std::size_t place : source.places) file.add(words[source.first + i * source.stride + place]);
    }
    file.endList();
}

}  // namespace

Coordinates readCollada(std::vector<char> bytes) {
    auto file = std::make_unique<TextCoordinates>(std::move(bytes));
    const Sources sources = sourcesOf(file->text());
    std::set<std::string_view> done;
    for (const std::string_view id : sources.of_positions) {
        const auto source = sources.by_id.find(id);
        if (source == sources.by_id.end() || source->second.axes != 7) continue;
        if (source->second.stride < source->second.parameter_count) continue;
        const auto numbers = sources.numbers_of.find(source->second.array);
        if (numbers == sources.numbers_of.end() || !done.insert(numbers->first).second) continue;
        addVertices(*file, source->second, numbers->second);
    }
    return file;
}

std::vector<ExactPlace> placesInCollada(const std::vector<char>& bytes) {
    std::vector<ExactPlace> places;
    std::string_view id, name;
    for (XmlTags tags({bytes.data(), bytes.size()}); const std::optional<XmlTag> tag = tags.next();) {
        if (tag->is_end) continue;
        if (tag->name == "node") {
            id = tag->attribute("id");
            name = tag->attribute("name");
        }
        // x y z, or four rows of a matrix, whose last column is the translation.
        const std::size_t numbers = tag->name == "translate" ? 3 : tag->name == "matrix" ? 16 : 0;
        if (numbers == 0) continue;
        const std::string_view text = tags.textUntilTag();
        std::array<double, 3> translation{};
        std::size_t at = 0;
        for (std::size_t i = 0; i < numbers; ++i) {
            const std::string_view word = nextWord(text, at);
            if (numbers == 3) translation[i] = readNumber(word);
            if (numbers == 16 && i % 4 == 3 && i < 12) translation[i / 4] = readNumber(word);
        }
        places.push_back({std::string(id), std::string(name), {translation[0], translation[1], translation[2]}});
    }
    return places;
}

}  // namespace tspace::import
