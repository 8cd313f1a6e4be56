// SPDX-License-Identifier: MIT
// Texture lines of MTL files, made ready for the parser.
#pragma once

#include <cstddef>
#include <string>

namespace tspace::obj {

/// The options -o, -s, -t and -mm of a texture take up to three numbers (-mm: two). Where a line has fewer, the parser
/// would take the name of the file for the next one; here the missing ones are written out. Returns how many lines
/// move, scale or stir a texture by -o, -s or -t.
std::size_t completeTextureOptions(std::string& text);

}  // namespace tspace::obj
