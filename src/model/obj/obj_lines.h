// SPDX-License-Identifier: MIT
// A first pass over the text of an OBJ file: makes it safe for the parser, and collects what the parser does not report.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tspace::obj {

/// One `f` line that has corners.
struct FaceLine {
    std::uint32_t line = 0;  ///< from 1
    std::uint32_t smoothing_group = 0;
};

struct LineNotes {
    std::vector<FaceLine> faces = {};                  ///< in file order: the parser reports exactly these
    std::vector<std::string> material_libraries = {};  ///< what follows `mtllib`, in file order
    bool has_smoothing_groups = false;
    std::uint64_t unreadable_number_count = 0;  ///< in v, vt, vn lines: not a number, or NaN or infinity by name
    std::uint32_t unreadable_number_line = 0;   ///< the first of them
    bool has_vertex_colors = false;
    bool has_lines_or_points = false;
    bool has_free_form = false;  ///< curves and surfaces
};

/// Turns all line ends into \n, and blanks NUL bytes and a byte order mark.
void makeLineEndsPlain(std::string& text);

/// makeLineEndsPlain; also joins lines that end in a backslash (their line end becomes spaces) and blanks
/// comments behind faces. Fails with invalidFile on an index with more than 9 digits, which the parser would
/// wrap around silently. Linear.
LineNotes prepareLines(std::string& text);

}  // namespace tspace::obj
