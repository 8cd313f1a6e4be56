// SPDX-License-Identifier: MIT
// Calls the parser of the tinyobjloader package with text in memory.
#pragma once

// The parser reads doubles, because coordinates of geographic maps exceed the precision of floats.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <string>
#include <vector>

namespace tspace::obj {

/// Calls the callbacks for the lines of an OBJ file, which is not changed. Opens no other file.
bool parseObj(std::string& text, const tinyobj::callback_t& callbacks, void* user);

std::vector<tinyobj::material_t> parseMtl(std::string& text);

}  // namespace tspace::obj
