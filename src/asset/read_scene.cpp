// SPDX-License-Identifier: MIT
// Chooses the reader by the name of the file.
#include "asset/file_io.h"
#include "asset/scene.h"

namespace tspace {

Scene readScene(const std::string& input, const FileOptions& options, bool with_images) {
    // An OBJ file has no magic word, so only its name tells it.
    const bool is_obj = lowerExtension(input) == ".obj";
    return is_obj ? obj::readObjScene(input, options, with_images) : gltf::readGltfScene(input, options, with_images);
}

}  // namespace tspace
