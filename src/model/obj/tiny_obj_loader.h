// SPDX-License-Identifier: MIT
// The parser of the tinyobjloader package on text in memory.
#pragma once

// Coordinates of maps do not fit into floats.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <string>
#include <vector>

namespace tspace::obj {

/// Calls back for the lines of an OBJ file, which is not changed. It opens no other file.
bool parseObj(std::string& text, const tinyobj::callback_t& callbacks, void* user);

std::vector<tinyobj::material_t> parseMtl(std::string& text);

}  // namespace tspace::obj
