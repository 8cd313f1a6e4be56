// SPDX-License-Identifier: MIT
// textureErrorFile: compares a texture with its source map; its report as JSON.
#include <cmath>

#include "commands/map_error/map_error_report.h"
#include "commands/shared/map_image_file.h"
#include "images/texture_vectors.h"
#include "maps/texels/shading.h"
#include "model/io/file_error.h"
#include "textures/blocks/filtered_error.h"
#include "tspace/map_files.h"

namespace tspace {
namespace {

/// Reads the source. Errors contain its name, because errors of this call are printed with the name of the texture.
FloatImage readSource(const std::string& path, const FileOptions& file) {
    try {
        return readMapImage(path, {}, file);
    } catch (FileError& failure) {
        failure.error.message = "the source " + pathInQuotes(path) + ": " + failure.error.message;
        throw;
    }
}

std::string sizeText(const FloatImage& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

/// Adds warnings about properties of the texture that the measured errors do not show.
void addWarnings(const FloatImage& packed, std::vector<std::string>& warnings) {
    if (packed.texture.is_srgb)
        warnings.emplace_back(
            "the texture is declared as sRGB: it was read as linear, but renderers that follow the declaration tilt "
            "all normals");
    if (packed.texture.layout == MapLayout{} && isGrayImage(packed))
        warnings.emplace_back(
            "the channels of the texture are equal or nearly equal, so it is a height map or a single channel, not a "
            "normal map");
}

TextureErrorReport measure(const std::string& texture, const std::string& source, const TextureErrorOptions& options) {
    FloatImage packed = readMapImage(texture, {}, options.file), map = readSource(source, options.file);
    TextureErrorReport report{.width = packed.width, .height = packed.height, .format = packed.texture.name};
    if (packed.width != map.width || packed.height != map.height)
        failFile(ErrorCode::countMismatch, "the texture has " + sizeText(packed) + " texels, but the source has " +
                                               sizeText(map) +
                                               "; the first mip level must have the size of the source");
    addWarnings(packed, report.warnings);
    report.makes_z = options.two_channels || packed.texture.layout.z.channel == MapChannel::none;
    for (FloatImage* image : {&packed, &map}) {
        if (std::string how_read = readTextureVectors(*image); !how_read.empty())
            report.warnings.push_back(std::move(how_read));
    }
    NormalLevel truth{map.width, map.height, {}, {}};
    truth.normals.reserve(map.texels.size());
    for (const Vec3& texel : map.texels) {
        DVec3 vector = decodeTexel(texel, {});
        truth.normals.push_back(normalize(vector) ? toFloat(vector) : Vec3{0, 0, 1});
    }
    for (Vec3& texel : packed.texels) texel = toFloat(decodeTexel(texel, {}));
    Parallel parallel(options.execution);
    const FilteredError error = measureFiltered(truth, packed.texels, report.makes_z, parallel);
    report.mean_error_deg = error.mean_deg;
    report.p99_error_deg = error.p99_deg;
    report.max_error_deg = error.max_deg;
    report.max_error_x = error.max_x;
    report.max_error_y = error.max_y;
    return report;
}

}  // namespace

Result<TextureErrorReport> textureErrorFile(const std::string& texture, const std::string& source,
                                            const TextureErrorOptions& options) {
    return atFileBorder([&]() -> Result<TextureErrorReport> { return measure(texture, source, options); });
}

}  // namespace tspace

namespace tspace::report {

std::string textureErrorJson(const Outcome<TextureErrorReport>& outcome, const std::string& source,
                             ExitCode exit_code) {
    const Result<TextureErrorReport>& result = outcome.result;
    Json json = documentJson("tspace.texture-error/1", result.ok(), exit_code);
    json["map"] = outcome.input;
    json["source"] = source;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["format"] = result->format;
    json["makesZ"] = result->makes_z;
    json["meanErrorDeg"] = result->mean_error_deg;
    json["p99ErrorDeg"] = result->p99_error_deg;
    json["maxErrorDeg"] = result->max_error_deg;
    json["maxErrorX"] = result->max_error_x;
    json["maxErrorY"] = result->max_error_y;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
