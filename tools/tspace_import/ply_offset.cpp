// SPDX-License-Identifier: MIT
#include "ply_offset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "core/mesh/surface/float_loss.h"
#include "number_text.h"

namespace tspace::import {

namespace {

enum class Format { ascii, little, big };

struct Header {
    Format format = Format::ascii;
    std::size_t end = 0;  ///< of the header, in bytes
    std::size_t vertex_count = 0;
    std::array<std::size_t, 3> places = {};  ///< of x, y and z in a vertex: numbers before it, or bytes
    std::size_t vertex_size = 0;             ///< numbers, or bytes
};

std::size_t sizeOf(const std::string& type) {
    static const std::map<std::string, std::size_t> sizes = {
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = sizes.find(type);
    return found == sizes.end() ? 0 : found->second;
}

/// Of the element that comes first, which must be the vertices.
bool addProperty(std::istringstream& words, unsigned& axes, Header& header) {
    std::string type, name;
    words >> type >> name;
    const std::size_t size = sizeOf(type);
    if (size == 0) return false;  // a list too
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
    constexpr std::size_t kMostBytes = 1 << 16;
    const std::string text(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kMostBytes)));
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

/// The middle of all vertices, rounded. `at`: vertex i.
template <class At>
DVec3 middleOf(std::size_t count, At&& at) {
    return roundMiddle([&](const auto& visit) {
        for (std::size_t i = 0; i < count; ++i) visit(at(i), at(i));
    });
}

double swapped(double value, Format format) {
    auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
    if ((format == Format::big) == (std::endian::native == std::endian::little))
        std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<double>(bytes);
}

std::optional<NearPly> moveBinary(std::vector<char> bytes, const Header& header) {
    if (header.vertex_count > (bytes.size() - header.end) / header.vertex_size) return {};
    const auto place = [&](std::size_t vertex, std::size_t axis) {
        return bytes.data() + header.end + vertex * header.vertex_size + header.places[axis];
    };
    const auto read = [&](std::size_t vertex, std::size_t axis) {
        double value;
        std::memcpy(&value, place(vertex, axis), sizeof value);
        return swapped(value, header.format);
    };
    const DVec3 offset = middleOf(header.vertex_count, [&](std::size_t i) {
        return DVec3{read(i, 0), read(i, 1), read(i, 2)};
    });
    const std::array<double, 3> taken = {offset.x, offset.y, offset.z};
    for (std::size_t i = 0; i < header.vertex_count; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value = swapped(read(i, axis) - taken[axis], header.format);
            std::memcpy(place(i, axis), &value, sizeof value);
        }
    }
    return NearPly{std::move(bytes), offset};
}

std::optional<NearPly> moveText(const std::vector<char>& bytes, const Header& header) {
    // Word by word: nothing says that a vertex has a line of its own.
    std::istringstream words(std::string(bytes.begin() + static_cast<std::ptrdiff_t>(header.end), bytes.end()));
    if (header.vertex_count > bytes.size() / (2 * header.vertex_size)) return {};
    std::vector<std::string> numbers(header.vertex_count * header.vertex_size);
    for (std::string& number : numbers) {
        if (!(words >> number)) return {};
    }
    const auto read = [&](std::size_t vertex, std::size_t axis) {
        return readNumber(numbers[vertex * header.vertex_size + header.places[axis]]);
    };
    const DVec3 offset = middleOf(header.vertex_count, [&](std::size_t i) {
        return DVec3{read(i, 0), read(i, 1), read(i, 2)};
    });
    const std::array<double, 3> taken = {offset.x, offset.y, offset.z};
    NearPly moved{.bytes = {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.end)}, .offset = offset};
    const auto append = [&](const std::string& text) {
        moved.bytes.insert(moved.bytes.end(), text.begin(), text.end());
    };
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::string number = numbers[i];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (header.places[axis] != i % header.vertex_size) continue;
            number = numberText(read(i / header.vertex_size, axis) - taken[axis]);
        }
        append(number + ((i + 1) % header.vertex_size == 0 ? "\n" : " "));
    }
    // The blanks behind the last number begin the rest: faces.
    std::string line;
    std::getline(words, line);
    if (line.find_first_not_of(" \t\r") != std::string::npos) append(line + "\n");
    append(std::string(std::istreambuf_iterator<char>(words), {}));
    return moved;
}

}  // namespace

std::optional<NearPly> nearOrigin(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
    const std::optional<Header> header = readHeader(bytes);
    if (!header) return {};
    return header->format == Format::ascii ? moveText(bytes, *header) : moveBinary(std::move(bytes), *header);
}

}  // namespace tspace::import
