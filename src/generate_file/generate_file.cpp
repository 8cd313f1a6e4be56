// SPDX-License-Identifier: MIT
// generateFile: finds out what the input is and hands it to its reader.
#include "asset/file_io.h"
#include "generate_file/generate_gltf.h"
#include "generate_file/generate_obj.h"
#include "tspace/asset.h"

namespace tspace {

Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    if (options.all && options.strip) {
        return Error{ErrorCode::invalidOption, "tangents for all primitives, and none where they are not needed"};
    }
    if (options.pack && frameBytes(*options.pack) == 0)
        return Error{ErrorCode::invalidOption, "the format of packed frames is none of FrameFormat"};
    if (!options.pack && options.pack_drop != PackDrop::nothing)
        return Error{ErrorCode::invalidOption, "normals and tangents go only where frames are packed"};
    // An OBJ file has no magic word, so only its name tells it; everything else is read as glTF and refused
    // there.
    if (lowerExtension(input) == ".obj") return generateObj(input, output, options);
    return gltf::generateGltf(input, output, options);
}

}  // namespace tspace
