// SPDX-License-Identifier: MIT
// generateFile and generateModel: find out what the input is and hand it to its reader.
#include "commands/generate/generate_model.h"
#include "commands/generate/generate_obj.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
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

void checkOptions(const std::string& input, const GenerateOptions& options) {
    const auto refuse = [](const std::string& why) { failFile(ErrorCode::invalidOption, why); };
    if (options.all && options.strip) refuse("tangents for all primitives, and none where they are not needed");
    if (options.pack && frameBytes(*options.pack) == 0) refuse("the format of packed frames is none of FrameFormat");
    if (!options.pack && options.pack_drop != PackDrop::nothing)
        refuse("normals and tangents go only where frames are packed");
    if (const std::string why = whyMapsStay(input, options); !why.empty()) refuse(why);
}

/// An OBJ file has no magic word, so only its name tells it; everything else is read as glTF and refused there.
bool isObj(const std::string& input) { return lowerExtension(input) == ".obj"; }

/// What is made of OBJ is a file first: its writer makes no document.
gltf::GeneratedModel generateFromObj(const std::string& input, GenerateOptions options) {
    Bytes glb;
    options.sink = [&](std::span<const std::uint8_t> bytes) {
        glb.insert(glb.end(), bytes.begin(), bytes.end());
        return true;
    };
    GenerateReport report = valueOrThrow(generateObj(input, "model.glb", options));
    report.input_files.clear();
    report.output_files.clear();
    report.output_bytes = 0;
    return {gltf::Model(gltf::parseDocument(std::move(glb), input, options.file)), std::move(report)};
}

}  // namespace

Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    return atFileBorder([&]() -> Result<GenerateReport> {
        checkOptions(input, options);
        return isObj(input) ? generateObj(input, output, options) : gltf::generateGltf(input, output, options);
    });
}

gltf::GeneratedModel generateModel(const std::string& input, const GenerateOptions& options, bool with_images) {
    checkOptions(input, options);
    if (isObj(input)) return generateFromObj(input, options);
    gltf::Model model(gltf::loadDocument(input, options.file, options.execution, options.progress));
    return gltf::generateModel(std::move(model), options, with_images);
}

}  // namespace tspace
