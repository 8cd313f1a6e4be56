// SPDX-License-Identifier: MIT
// generateFile: finds out what the input is and hands it to its reader.
#include "commands/generate/generate_gltf.h"
#include "commands/generate/generate_obj.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "tspace/asset.h"

namespace tspace {

namespace {

/// Why maps are not converted with these options; empty: they are, or are not to be.
std::string whyMapsStay(const std::string& input, const GenerateOptions& options) {
    if (!options.convert_maps) return {};
    if (options.overwrite_normals) return "maps are converted for new tangents, but not for new normals";
    if (options.flip_green != FlipGreen::none) return "maps are converted or inverted, one after the other";
    if (options.mend_maps) return "maps are mended or converted, one after the other";
    if (options.existing == ExistingTangents::repair)
        return "maps stay where tangents are repaired: what was wrong is to look right";
    if (options.texture_transform == TextureTransform::ignore)
        return "maps are converted for viewers that use tangents as they are, so texture transforms are applied";
    if (options.tangents.convention != conventions::gltf) return "maps are converted for the convention of glTF only";
    if (lowerExtension(input) == ".obj")
        return "OBJ files have no tangents that their maps fit; make a glTF file of it first, then compute its "
               "tangents anew";
    return {};
}

Result<GenerateReport> generateByFormat(const std::string& input, const std::string& output,
                                        const GenerateOptions& options) {
    if (options.all && options.strip) {
        return Error{ErrorCode::invalidOption, "tangents for all primitives, and none where they are not needed"};
    }
    if (options.pack && frameBytes(*options.pack) == 0)
        return Error{ErrorCode::invalidOption, "the format of packed frames is none of FrameFormat"};
    if (!options.pack && options.pack_drop != PackDrop::nothing)
        return Error{ErrorCode::invalidOption, "normals and tangents go only where frames are packed"};
    if (const std::string why = whyMapsStay(input, options); !why.empty()) return Error{ErrorCode::invalidOption, why};
    // An OBJ file has no magic word, so only its name tells it; everything else is read as glTF and refused
    // there.
    if (lowerExtension(input) == ".obj") return generateObj(input, output, options);
    return gltf::generateGltf(input, output, options);
}

}  // namespace

Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    return atFileBorder([&] { return generateByFormat(input, output, options); });
}

}  // namespace tspace
