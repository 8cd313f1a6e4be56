// SPDX-License-Identifier: MIT
// Export of the entry "tspace" that triangulates faces.
#include "core/frames/face_cutter.h"

#include "common.h"
#include "core/base/mesh_loops.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// `corners`: receives three corners per triangle. Same result as triangulate(), which would link more of the library;
/// the mesh has no index lists for normals and UVs.
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
