// SPDX-License-Identifier: MIT
// A low poly with the maps that were baked for it as its normal textures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/io/atomic_output.h"
#include "model/io/file_io.h"
#include "model/scene/scene.h"
#include "tspace/bake_file.h"

namespace tspace {

/// A primitive, and the UVs that its map is read with.
struct MappedPrimitive {
    std::uint32_t mesh = 0, primitive = 0;
    bool had_map = false;  ///< its material has a normal map already, with these UVs
    std::size_t uv_set = 0;
    UvTransform transform = {};
};

/// A baked image, and the primitives that read it.
struct ModelMap {
    std::string path = {};  ///< the file that holds it
    Bytes png = {};
    std::vector<MappedPrimitive> primitives = {};
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

struct ModelWithMaps {
    std::string source = {};  ///< what the model was read from: the files that it names lie beside it
    Bytes glb = {};           ///< the model with the frames that were baked for
    std::string output = {};  ///< .glb or .gltf
    std::vector<ModelMap> maps = {};
};

/// Adds the model with its maps, and the maps themselves, to `files`. A GLB holds them; a .gltf names them where they lie in
/// its folder or below, and holds them otherwise. Maps that were there go where nothing else shows them. Throws FileError.
void addModelWithMaps(ModelWithMaps&& model, const FileOptions& options, AtomicOutput& files,
                      std::vector<std::string>& warnings);

}  // namespace tspace
