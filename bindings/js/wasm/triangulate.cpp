// SPDX-License-Identifier: MIT
// The export of the entry "tspace" that cuts faces into triangles.
#include "core/frames/triangulate.h"

#include "common.h"
#include "core/base/mesh_loops.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// `corners`: three for each triangle. As triangulate() does, which would bring more of the library with it; the mesh has no lists
/// of normals and UVs.
TSPACE_JS_EXPORT(triangulate) std::uint32_t triangulateFaces(std::uint32_t* corners) {
    if (Result<Done> valid = validate(mesh()); !valid) return codeOf(valid);
    FaceCutter cutter(mesh());
    forEachFace(mesh(), [&](std::size_t, std::size_t first, std::uint32_t size) {
        if (size < 3) return;
        cutter.cut(first, size, corners);
        corners += 3 * (size - 2);
    });
    return 0;
}

}  // extern "C"
