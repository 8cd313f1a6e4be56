// SPDX-License-Identifier: MIT
// Reads PLY files that are text or contain doubles, if vertices are the first element, with x, y and z as single
// numbers.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>

#include "near_origin/coordinates.h"

namespace tspace::import {
namespace {

enum class Format { ascii, little, big };

struct Header {
    Format format = Format::ascii;
    std::size_t end = 0;  ///< size of the header, in bytes
    std::size_t vertex_count = 0;
    /// Positions of x, y and z within a vertex: number of preceding values (text) or bytes (binary).
    std::array<std::size_t, 3> places = {};
    std::size_t vertex_size = 0;  ///< size of a vertex: number of values (text) or bytes (binary)
};

std::size_t sizeOfType(const std::string& type) {
    static const std::map<std::string, std::size_t> sizes = {
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = sizes.find(type);
    return found == sizes.end() ? 0 : found->second;
}

/// Reads a property of the first element, which must be the vertices.
bool addProperty(std::istringstream& words, unsigned& axes, Header& header) {
    std::string type, name;
    words >> type >> name;
    const std::size_t size = sizeOfType(type);
    if (size == 0) return false;  // unknown types and lists have size 0
    const std::size_t axis = name.size() == 1 ? std::string("xyz").find(name) : std::string::npos;
    if (axis != std::string::npos) {
        if (header.format != Format::ascii && size != sizeof(double)) return false;
        header.places[axis] = header.vertex_size;
        axes |= 1U << axis;
    }
    header.vertex_size += header.format == Format::ascii ? 1 : size;
    return true;
}

std::optional<Header> readHeader(const std::vector<char>& bytes) {
    constexpr std::size_t kMaxBytes = 1 << 16;
    const std::string text(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kMaxBytes)));
    const std::size_t end = text.find("end_header");
    const std::size_t line_end = end == std::string::npos ? end : text.find('\n', end);
    if (line_end == std::string::npos) return {};
    Header header{.end = line_end + 1};
    std::istringstream lines(text.substr(0, end));
    unsigned axes = 0, elements = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word, name;
        words >> word;
        if (word == "format") {
            words >> name;
            if (name == "binary_little_endian") header.format = Format::little;
            if (name == "binary_big_endian") header.format = Format::big;
        } else if (word == "element" && elements++ == 0) {
            words >> name >> header.vertex_count;
            if (name != "vertex") return {};
        } else if (word == "property" && elements == 1) {
            if (!addProperty(words, axes, header)) return {};
        }
    }
    if (axes != 7 || header.vertex_count == 0) return {};
    return header;
}

double swapped(double value, Format format) {
    auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
    if ((format == Format::big) == (std::endian::native == std::endian::little))
        std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<double>(bytes);
}

class BinaryPly : public FileCoordinates {
  public:
    BinaryPly(std::vector<char> bytes, const Header& header) : bytes_(std::move(bytes)), header_(header) {
        lists.resize(1);
        lists[0].values.reserve(3 * header_.vertex_count);
        for (std::size_t i = 0; i < 3 * header_.vertex_count; ++i) {
            double value;
            std::memcpy(&value, place(i), sizeof value);
            lists[0].values.push_back(swapped(value, header_.format));
        }
    }

    std::vector<char> rewritten() override {
        for (std::size_t i = 0; lists[0].is_moved && i < lists[0].values.size(); ++i) {
            const double value = swapped(lists[0].values[i], header_.format);
            std::memcpy(place(i), &value, sizeof value);
        }
        return std::move(bytes_);
    }

  private:
    char* place(std::size_t i) {
        return bytes_.data() + header_.end + i / 3 * header_.vertex_size + header_.places[i % 3];
    }

    std::vector<char> bytes_;
    Header header_;
};

Coordinates readTextPly(std::vector<char> bytes, const Header& header) {
    if (header.vertex_count > bytes.size() / (2 * header.vertex_size)) return {};
    auto file = std::make_unique<TextCoordinates>(std::move(bytes));
    // The text is read word by word, because several vertices may share a line.
    std::size_t at = header.end;
    std::vector<std::string_view> vertex(header.vertex_size);
    file->addList();
    for (std::size_t i = 0; i < header.vertex_count; ++i) {
        for (std::string_view& word : vertex) word = nextWord(file->text(), at);
        if (vertex.back().empty()) return {};
        for (const std::size_t place : header.places) file->add(vertex[place]);
    }
    return file;
}

}  // namespace

Coordinates readPly(std::vector<char> bytes) {
    const std::optional<Header> header = readHeader(bytes);
    if (!header) return {};
    if (header->format == Format::ascii) return readTextPly(std::move(bytes), *header);
    if (header->vertex_count > (bytes.size() - header->end) / header->vertex_size) return {};
    return std::make_unique<BinaryPly>(std::move(bytes), *header);
}

}  // namespace tspace::import
