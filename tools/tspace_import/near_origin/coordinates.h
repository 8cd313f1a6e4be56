// SPDX-License-Identifier: MIT
// The coordinates of a file, and the file with others in their place. One reader for each format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "near_origin/near_origin.h"

namespace tspace::import {

/// The vertices of one geometry: x y z, in double.
struct VertexList {
    std::vector<double> values = {};
    bool is_moved = false;  ///< the values are no longer those of the file
};

class FileCoordinates {
  public:
    virtual ~FileCoordinates() = default;
    /// The file with the values of the lists that are moved.
    virtual std::vector<char> rewritten() = 0;

    std::vector<VertexList> lists = {};
};

/// Coordinates that stand in the file as text.
class TextCoordinates : public FileCoordinates {
  public:
    explicit TextCoordinates(std::vector<char> bytes) : text_(std::move(bytes)) {}

    [[nodiscard]] std::string_view text() const { return {text_.data(), text_.size()}; }
    void addList();
    /// A number of the last list. `word`: in text().
    void add(std::string_view word);
    /// Leaves out the last list unless its numbers make whole vertices.
    void endList();

    std::vector<char> rewritten() override;

  private:
    struct Place {
        std::size_t begin = 0, length = 0;
    };

    std::vector<char> text_;
    std::vector<std::vector<Place>> places_ = {};  ///< positions of the values of each list
};

/// Null if the reader finds none.
using Coordinates = std::unique_ptr<FileCoordinates>;

Coordinates readPly(std::vector<char> bytes);
Coordinates readStl(std::vector<char> bytes);

inline bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The next word between blanks from `at` on, which is moved behind it; empty at the end.
std::string_view nextWord(std::string_view text, std::size_t& at);

}  // namespace tspace::import
