// SPDX-License-Identifier: MIT
// The one place where the parser of the tinyobjloader package is compiled, so that the sanitizers see into
// it.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
