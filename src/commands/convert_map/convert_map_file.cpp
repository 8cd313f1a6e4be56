// SPDX-License-Identifier: MIT
// convertMapFile: the image, the meshes of both sides, limits, warnings.
#include <charconv>
#include <optional>

#include "commands/shared/map_image_file.h"
#include "maps/shading.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"

namespace tspace {

namespace {

std::string angleText(double degrees) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, degrees, std::chars_format::general, 2);
    return {text, end.ptr};
}

/// The mesh of each side that needs one.
struct Meshes {
    std::optional<MapMesh> from = {}, to = {};
};

Meshes readMeshes(const std::string& input, const ConvertMapFileOptions& options) {
    const bool in_world = options.from == MapFileSpace::world || options.to == MapFileSpace::world;
    const MapMeshChoice choice{options.material, fileNameOf(input), in_world, options.tile};
    const auto read = [&](const std::string& model) {
        return readNamedMapMesh(model, choice, options.tangents, options.file, options.execution);
    };
    const bool from_tangent = options.from == MapFileSpace::tangent, to_tangent = options.to == MapFileSpace::tangent;
    const std::string& to_mesh = options.to_mesh.empty() ? options.mesh : options.to_mesh;
    Meshes meshes;
    if (!from_tangent && !to_tangent) {
        // Either model has the transform between object and world space.
        if (options.from != options.to) meshes.from = read(options.mesh.empty() ? to_mesh : options.mesh);
        return meshes;
    }
    if (from_tangent && !options.mesh.empty()) meshes.from = read(options.mesh);
    // One mesh serves both sides where it is one file.
    if (to_tangent && !to_mesh.empty() && !(meshes.from && to_mesh == options.mesh)) meshes.to = read(to_mesh);
    return meshes;
}

/// `mesh`: that of this side, or the only one. `is_own`: its triangles are this side's.
MapSide mapSideOf(const MapMesh* mesh, bool is_own, MapFileSpace space, const MapReading& reading) {
    MapSide side{.space = space == MapFileSpace::tangent ? MapSpace::tangent : MapSpace::object, .reading = reading};
    if (mesh == nullptr) return side;
    if (space == MapFileSpace::tangent) side.reading.scale *= static_cast<float>(mesh->report.scale);
    if (!is_own) return side;
    side.uvs = mesh->uvs;
    side.positions = mesh->positions;
    if (space != MapFileSpace::tangent) return side;
    side.normals = mesh->normals;
    side.tangents = mesh->tangents;
    return side;
}

struct MapSides {
    MapSide from, to;
};

MapSides sidesOf(const Meshes& meshes, const ConvertMapFileOptions& options) {
    const MapMesh* const from = meshes.from ? &*meshes.from : nullptr;
    const MapMesh* const to = meshes.to ? &*meshes.to : nullptr;
    const MapMesh* const any = from != nullptr ? from : to;
    MapSides sides{mapSideOf(any, from != nullptr, options.from, options.from_reading),
                   mapSideOf(to != nullptr ? to : any, to != nullptr, options.to, options.to_reading)};
    if (any == nullptr) return sides;
    // Between object and world space the axes of the mesh lie in the world.
    if (options.from == MapFileSpace::object && options.to == MapFileSpace::world) sides.from.axes = any->axes;
    if (options.from == MapFileSpace::world && options.to == MapFileSpace::object) sides.to.axes = any->axes;
    return sides;
}

void addMapWarnings(const ConvertMapFileOptions& options, ConvertMapFileReport& report) {
    const ConvertMapReport& texels = report.texels;
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    if (texels.is_below_half_step) {
        warn("the change is " + angleText(texels.mean_change_deg) + " degrees in the mean, less than half a step of " +
             std::to_string(report.bits) + " bits (" + angleText(texels.half_step_deg) +
             " degrees): rounding undoes it" + (report.bits == 8 ? "; 16 bits keep it" : ""));
    }
    if (texels.overlapping > 0) {
        warn(std::to_string(texels.overlapping) + " texels are shown by several triangles; the first decides" +
             (report.from.materials.size() + report.to.materials.size() > 2 ? "; choose a material by its name" : ""));
    }
    if (texels.unmatched > 0) {
        warn(std::to_string(texels.unmatched) +
             " texels stay as they are, since only one of the meshes has triangles there");
    }
    if (texels.without_frame > 0) {
        warn(std::to_string(texels.without_frame) +
             " texels stay as they are, since their frames or values are broken");
    }
    if (texels.below_horizon > 0) {
        warn(std::to_string(texels.below_horizon) + " texels look below the horizon, which two channels cannot say");
    }
    const bool has_mesh = report.from.triangle_count + report.to.triangle_count > 0;
    if (has_mesh && texels.converted == 0) warn("no triangle of the mesh shows the map: nothing was converted");
    if (!options.to_mesh.empty() && texels.converted > 0 && texels.changed == 0) {
        warn("both meshes have the same frames: no texel changed");
    }
}

ImageFormat outputFormat(const std::string& output, const ConvertMapFileOptions& options) {
    const std::string extension = lowerExtension(output);
    const ImageFormat format = extension == ".exr" ? ImageFormat::exr : ImageFormat::png;
    if (!options.sink && extension != ".png" && extension != ".exr")
        failFile(ErrorCode::unsupportedFile,
                 "the output " + pathInQuotes(output) + " ends neither in .png nor in .exr");
    if (const char* why_not = whyNotRead(format))
        failFile(ErrorCode::unsupportedFile, "the output cannot be written: " + std::string(why_not));
    return format;
}

unsigned outputBits(ImageFormat format, unsigned bits) {
    const bool is_exr = format == ImageFormat::exr;
    if (bits == 0) return is_exr ? 32 : 16;
    if (!is_exr && bits != 8 && bits != 16) failFile(ErrorCode::invalidOption, "a PNG has 8 or 16 bits");
    if (is_exr && bits != 16 && bits != 32) failFile(ErrorCode::invalidOption, "an EXR has 16 or 32 bits");
    return bits;
}

/// Reads the image by its layout. Returns the texels as they were, where that is another than the default.
std::vector<Vec3> applyLayout(const MapLayout& layout, FloatImage& image) {
    if (layout == MapLayout{}) return {};
    const bool takes_alpha = layout.x.channel == MapChannel::alpha || layout.y.channel == MapChannel::alpha ||
                             layout.z.channel == MapChannel::alpha;
    if (takes_alpha && image.alpha.empty())
        failFile(ErrorCode::invalidOption, "a vector is to be read from alpha, which the image does not have");
    std::vector<Vec3> before = image.texels;
    for (std::size_t i = 0; i < before.size(); ++i)
        image.texels[i] = readTexel(before[i], image.alpha.empty() ? 1 : image.alpha[i], layout);
    if (takes_alpha) image.alpha.clear();
    return before;
}

/// Changes by the layout count too. `is_alone`: no mesh turns vectors, so that angles are known.
void countLayout(std::span<const Vec3> before, std::span<const Vec3> after, bool is_alone, ConvertMapReport& texels) {
    texels.changed = 0;
    double sum = 0, most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        texels.changed += before[i] == after[i] ? 0 : 1;
        const double change = degreesBetween(decodeTexel(before[i], {}), decodeTexel(after[i], {}));
        sum += change;
        most = std::max(most, change);
    }
    texels.is_below_half_step = false;
    if (!is_alone) return;
    texels.mean_change_deg = sum / static_cast<double>(before.size());
    texels.max_change_deg = most;
}

ConvertMapFileReport convert(const std::string& input, const std::string& output,
                             const ConvertMapFileOptions& requested) {
    InputFiles inputs;
    ConvertMapFileOptions options = requested;
    inputs.watch(options.file);
    if (options.content.data() == nullptr) inputs.add(input);
    const ImageFormat format = outputFormat(output, options);
    const unsigned bits = outputBits(format, options.bits);
    FloatImage image = readMapImage(input, options.content, options.file);
    const std::string how_read = options.layout == MapLayout{} ? readTextureVectors(image) : std::string();
    const std::vector<Vec3> before = applyLayout(options.layout, image);
    const Meshes meshes = readMeshes(input, options);
    const MapMesh* const from = meshes.from ? &*meshes.from : nullptr;
    const MapMesh* const to = meshes.to ? &*meshes.to : nullptr;
    const MapMesh* const any = from != nullptr ? from : to;
    ConvertMapFileReport report;
    report.width = image.width;
    report.height = image.height;
    report.bits_before = image.bits;
    report.bits = bits;
    if (from != nullptr) report.from = from->report;
    if (to != nullptr) report.to = to->report;
    const MapImage map{.width = image.width,
                       .height = image.height,
                       .texels = image.texels,
                       .wrap_u = any == nullptr ? TextureWrap::repeat : any->wrap_u,
                       .wrap_v = any == nullptr ? TextureWrap::repeat : any->wrap_v};
    const ConvertMapOptions chosen{.bits = format == ImageFormat::png ? bits : 32, .padding = options.padding};
    const MapSides sides = sidesOf(meshes, options);
    report.texels =
        valueOrThrow(convertMap(map, sides.from, sides.to, chosen, image.texels, options.execution, options.progress));
    if (!before.empty()) countLayout(before, image.texels, any == nullptr, report.texels);
    if (!how_read.empty()) report.warnings.push_back(how_read);
    if (image.not_finite > 0)
        report.warnings.push_back(std::to_string(image.not_finite) +
                                  " texels of the image are not finite; they become grey, which has no direction");
    addMapWarnings(options, report);
    writeMapImage(image, format, bits, output,
                  {.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.file.sync, .inputs = &inputs});
    return report;
}

}  // namespace

Result<ConvertMapFileReport> convertMapFile(const std::string& input, const std::string& output,
                                            const ConvertMapFileOptions& options) {
    return atFileBorder([&]() -> Result<ConvertMapFileReport> { return convert(input, output, options); });
}

}  // namespace tspace
