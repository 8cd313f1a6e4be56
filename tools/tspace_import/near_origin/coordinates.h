// SPDX-License-Identifier: MIT
// Reads the coordinates of a file, and writes the file with other coordinates. There is one reader per format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "near_origin/near_origin.h"

namespace tspace::import {

/// Vertices of one geometry: x y z, in double precision.
struct VertexList {
    std::vector<double> values = {};
    bool is_moved = false;  ///< the values differ from those in the file
};

class FileCoordinates {
  public:
    virtual ~FileCoordinates() = default;
    /// Returns the bytes of the file with the coordinates of all moved vertex lists replaced.
    virtual std::vector<char> rewritten() = 0;

    std::vector<VertexList> lists = {};
};

/// Coordinates stored in the file as text.
class TextCoordinates : public FileCoordinates {
  public:
    explicit TextCoordinates(std::vector<char> bytes) : text_(std::move(bytes)) {}

    [[nodiscard]] std::string_view text() const { return {text_.data(), text_.size()}; }
    void addList();
    /// Adds a number to the last list. `word`: part of text().
    void add(std::string_view word);
    /// Removes the last list unless its numbers form complete vertices.
    void endList();

    std::vector<char> rewritten() override;

  private:
    struct Place {
        std::size_t begin = 0, length = 0;
    };

    std::vector<char> text_;
    std::vector<std::vector<Place>> places_ = {};  ///< positions of the values of each list
};

/// Coordinates of a file; null if the reader finds none.
using Coordinates = std::unique_ptr<FileCoordinates>;

Coordinates readPly(std::vector<char> bytes);
Coordinates readStl(std::vector<char> bytes);

inline bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Returns the next word between blanks, starting at `at`, which is moved after it; empty at the end.
std::string_view nextWord(std::string_view text, std::size_t& at);

}  // namespace tspace::import
