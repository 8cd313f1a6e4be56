// SPDX-License-Identifier: MIT
// convertMapFile: reads the image and the meshes of both sides, applies limits and collects warnings. Also its options,
// and its report as JSON.
#include <charconv>
#include <optional>

#include "commands/compress_map/pack_texture.h"
#include "commands/convert_map/convert_map_report.h"
#include "commands/shared/axes_option.h"
#include "commands/shared/file_options.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/request.h"
#include "images/map_coverage.h"
#include "images/texture_vectors.h"
#include "maps/texels/shading.h"
#include "maps/texels/texture_sample.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/output_name.h"

namespace tspace {
namespace {

std::string angleText(double degrees) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, degrees, std::chars_format::general, 2);
    return {text, end.ptr};
}

/// The mesh of each side of the conversion, if that side needs one.
struct Meshes {
    std::optional<MapMesh> from = {}, to = {};
};

Meshes readMeshes(const std::string& input, const ConvertMapFileOptions& options) {
    const bool in_world = options.from == MapFileSpace::world || options.to == MapFileSpace::world;
    const MapMeshChoice choice{options.material, fileNameOf(input), in_world, options.tile, true};
    const auto read = [&](const std::string& model) {
        return readNamedMapMesh(model, choice, options.tangents, options.file, options.execution);
    };
    const bool from_tangent = options.from == MapFileSpace::tangent, to_tangent = options.to == MapFileSpace::tangent;
    const std::string& to_mesh = options.to_mesh.empty() ? options.mesh : options.to_mesh;
    Meshes meshes;
    if (!from_tangent && !to_tangent) {
        // Conversions between object and world space can use either model, because both have the same transform.
        if (options.from != options.to) meshes.from = read(options.mesh.empty() ? to_mesh : options.mesh);
        return meshes;
    }
    if (from_tangent && !options.mesh.empty()) meshes.from = read(options.mesh);
    // If both sides name one file, it is read once.
    if (to_tangent && !to_mesh.empty() && !(meshes.from && to_mesh == options.mesh)) meshes.to = read(to_mesh);
    return meshes;
}

/// Returns one side of the conversion. `mesh`: the mesh of this side, or the only mesh. `is_own`: the triangles of
/// `mesh` belong to this side.
MapSide mapSideOf(const MapMesh* mesh, bool is_own, MapFileSpace space, const MapReading& reading) {
    MapSide side{.space = space == MapFileSpace::tangent ? MapSpace::tangent : MapSpace::object, .reading = reading};
    if (mesh == nullptr) return side;
    if (space == MapFileSpace::tangent) side.reading.scale *= static_cast<float>(mesh->report.scale);
    if (!is_own) return side;
    side.uvs = mesh->corners.uvs;
    side.positions = mesh->corners.positions;
    if (space != MapFileSpace::tangent) return side;
    side.normals = mesh->corners.normals;
    side.tangents = mesh->corners.tangents;
    return side;
}

struct MapSides {
    MapSide from, to;
};

/// Returns the mean cosine, over the triangles, between the directions in the map, along the axes `axes`, and the
/// normals of the mesh.
double agreementOf(const FloatImage& image, const MapMesh& mesh, const MapReading& reading, const MapAxes& axes) {
    const TextureShape shape{image.width, image.height, mesh.wrap_u, mesh.wrap_v};
    const std::vector<Vec2>& uvs = mesh.corners.uvs;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < uvs.size(); i += 3) {
        const Vec2 middle{(uvs[i].x + uvs[i + 1].x + uvs[i + 2].x) / 3, (uvs[i].y + uvs[i + 1].y + uvs[i + 2].y) / 3};
        DVec3 direction = fromAxes(axes, decodeTexel(sampleBilinear(shape, image.texels, middle), reading)), normal{};
        for (std::size_t k = 0; k < 3; ++k) normal = normal + toDouble(mesh.corners.normals[i + k]);
        if (!normalize(direction) || !normalize(normal)) continue;
        sum += dot(direction, normal);
        ++count;
    }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// Returns the axes of the side that is not in tangent space. `warnings` receives a sentence if they were inferred from
/// the image.
MapAxes axesOf(const FloatImage& image, const Meshes& meshes, const ConvertMapFileOptions& options,
               std::vector<std::string>& warnings) {
    const bool from_tangent = options.from == MapFileSpace::tangent, to_tangent = options.to == MapFileSpace::tangent;
    if (options.axes) {
        if (from_tangent == to_tangent)
            failFile(ErrorCode::invalidOption,
                     "--axes can only be used for conversions between tangent space and object or world space");
        return *options.axes;
    }
    if (from_tangent || !to_tangent) return {};
    const MapMesh* const mesh = meshes.to ? &*meshes.to : meshes.from ? &*meshes.from : nullptr;
    if (mesh == nullptr || mesh->corners.normals.size() != mesh->corners.uvs.size()) return {};
    constexpr double kFits = 0.5, kBetter = 0.2;
    const MapReading reading{.green = options.from_reading.green};
    const double up_y = agreementOf(image, *mesh, reading, {}), up_z = agreementOf(image, *mesh, reading, kMapAxesZUp);
    if (!(up_z > kFits && up_z > up_y + kBetter)) return {};
    warnings.push_back(
        "z points up in the map, as in Blender, so the map was read with the axes z-up; use --axes y-up to read it in "
        "the axes of the model");
    return kMapAxesZUp;
}

/// Returns both sides of the conversion. `axes`: axes per triangle, if they differ from those of the mesh; otherwise
/// empty.
MapSides sidesOf(const Meshes& meshes, const ConvertMapFileOptions& options, std::span<const MapAxes> axes) {
    const MapMesh* const from = meshes.from ? &*meshes.from : nullptr;
    const MapMesh* const to = meshes.to ? &*meshes.to : nullptr;
    const MapMesh* const any = from != nullptr ? from : to;
    MapSides sides{mapSideOf(any, from != nullptr, options.from, options.from_reading),
                   mapSideOf(to != nullptr ? to : any, to != nullptr, options.to, options.to_reading)};
    if (any == nullptr) return sides;
    if (options.from == MapFileSpace::tangent) sides.to.axes = axes;
    if (options.to == MapFileSpace::tangent) sides.from.axes = axes;
    // For conversions between object and world space, the object-space side uses the axes of the mesh in world space.
    if (options.from == MapFileSpace::object && options.to == MapFileSpace::world) sides.from.axes = any->axes;
    if (options.from == MapFileSpace::world && options.to == MapFileSpace::object) sides.to.axes = any->axes;
    return sides;
}

void addMapWarnings(const ConvertMapFileOptions& options, ConvertMapFileReport& report) {
    const ConvertMapReport& texels = report.texels;
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    if (texels.is_below_half_step) {
        warn("the mean change is " + angleText(texels.mean_change_deg) +
             " degrees, less than half a quantization step of " + std::to_string(report.bits) + " bits (" +
             angleText(texels.half_step_deg) + " degrees), so rounding cancels it" +
             (report.bits == 8 ? "; use 16 bits to keep it" : ""));
    }
    if (texels.overlapping > 0) {
        warn(std::to_string(texels.overlapping) +
             " texels are shared by several triangles; the first triangle was used" +
             (report.from.materials.size() + report.to.materials.size() > 2 ? "; select a material with --material"
                                                                            : ""));
    }
    if (texels.unmatched > 0) {
        warn(std::to_string(texels.unmatched) +
             " texels were not changed, because only one of the meshes has triangles there");
    }
    if (texels.without_frame > 0) {
        warn(std::to_string(texels.without_frame) +
             " texels were not changed, because their frames or values are invalid");
    }
    if (texels.below_horizon > 0) {
        warn(std::to_string(texels.below_horizon) +
             " texels point below the surface, which two channels cannot store; "
             "they were moved to the horizon (z = 0)");
    }
    const bool has_mesh = report.from.triangle_count + report.to.triangle_count > 0;
    if (has_mesh && texels.converted == 0) warn("the map was not converted, because no triangle of the mesh uses it");
    if (!options.to_mesh.empty() && texels.converted > 0 && texels.changed == 0)
        warn("no texel was changed, because both meshes have the same frames");
}

/// Fails if the models are not one surface with one UV map, or if texels would need several directions.
void checkConversion(const ConvertMapReport& texels) {
    constexpr std::uint64_t kOneOf = 10, kOneOfShared = 100;
    const std::uint64_t shown = texels.converted + texels.unmatched + texels.without_frame,
                        wrong = texels.unmatched + texels.apart;
    if (kOneOf * wrong > shown) {
        failFile(ErrorCode::invalidFile,
                 std::string("the models do not have the same surface and UVs: of ") + std::to_string(shown) +
                     " texels inside triangles, " + std::to_string(texels.apart) +
                     " have a different position on the other model, and " + std::to_string(texels.unmatched) +
                     " are in none of its triangles; use bake to transfer a map between different UVs");
    }
    if (kOneOfShared * texels.conflicting > texels.converted) {
        failFile(ErrorCode::invalidFile,
                 std::to_string(texels.conflicting) + " of " + std::to_string(texels.converted) +
                     " texels are shared by triangles that face different directions, as on mirrored halves, but a map "
                     "in object or world space has one direction per texel; select a part with --material, or give "
                     "each half its own texels");
    }
}

ImageFormat outputFormat(const std::string& output, const ConvertMapFileOptions& options) {
    const std::string extension = lowerExtension(output);
    const ImageFormat format = extension == ".exr" ? ImageFormat::exr : ImageFormat::png;
    const bool is_tga = !options.sink && isTgaName(output);
    if (!options.sink && extension != ".png" && extension != ".exr" && !is_tga)
        failEnding(output, {".png", ".exr", ".tga", ".ktx2", ".dds"});
    if (is_tga && options.bits > 8) failFile(ErrorCode::invalidOption, "a TGA must have 8 bits per channel");
    if (const char* why_not = whyNotRead(format))
        failFile(ErrorCode::unsupportedFile, "the output cannot be written: " + std::string(why_not));
    return format;
}

unsigned outputBits(ImageFormat format, unsigned bits) {
    const bool is_exr = format == ImageFormat::exr;
    if (bits == 0) return is_exr ? 32 : 16;
    if (!is_exr && bits != 8 && bits != 16)
        failFile(ErrorCode::invalidOption, "a PNG must have 8 or 16 bits per channel");
    if (is_exr && bits != 16 && bits != 32)
        failFile(ErrorCode::invalidOption, "an EXR must have 16 or 32 bits per channel");
    return bits;
}

/// Converts the image from its channel layout to that of glTF. Returns the original texels, or an empty vector if the
/// layout is already that of glTF.
std::vector<Vec3> applyLayout(const MapLayout& layout, FloatImage& image) {
    if (layout == MapLayout{}) return {};
    if (readsAlpha(layout) && image.alpha.empty())
        failFile(ErrorCode::invalidOption, "--channels reads the alpha channel, but the image has none");
    std::vector<Vec3> before = image.texels;
    readTexels(layout, image);
    return before;
}

/// Counts texels changed by the layout. `is_alone`: no mesh transforms the vectors, so the angles can be measured.
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
    const bool is_texture = !options.sink && isTextureName(output);
    const ImageFormat format = is_texture ? ImageFormat::ktx2 : outputFormat(output, options);
    const bool is_tga = !options.sink && isTgaName(output);
    if (options.dds_header != DdsHeader::dx10 && (options.sink || lowerExtension(output) != ".dds"))
        failFile(ErrorCode::invalidOption, "--dds-header can only be used with outputs that end in .dds");
    const unsigned bits = is_texture ? 16 : outputBits(format, is_tga ? 8 : options.bits);
    FloatImage image = readMapImage(input, options.content, options.file);
    const std::string how_read = options.layout == MapLayout{} ? readTextureVectors(image) : takeRemarks(image);
    const std::vector<Vec3> before = applyLayout(options.layout, image);
    std::vector<std::string> alpha_text;
    std::vector<float> coverage;
    if (is_texture) coverage = takeCoverage(options.alpha, image, alpha_text);
    if (!is_texture && options.alpha != MapAlpha::automatic)
        alpha_text.emplace_back("--alpha applies only to outputs with mip levels (.ktx2 and .dds)");
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
    for (const MapMesh* const mesh : {from, to}) {
        if (mesh != nullptr)
            report.warnings.insert(report.warnings.end(), mesh->warnings.begin(), mesh->warnings.end());
    }
    const MapImage map{.width = image.width,
                       .height = image.height,
                       .texels = image.texels,
                       .wrap_u = any == nullptr ? TextureWrap::repeat : any->wrap_u,
                       .wrap_v = any == nullptr ? TextureWrap::repeat : any->wrap_v};
    const ConvertMapOptions chosen{
        .bits = format == ImageFormat::png ? bits : 32, .lengths = options.lengths, .padding = options.padding};
    const MapAxes axes = axesOf(image, meshes, options, report.warnings);
    const std::vector<MapAxes> of_triangles(any == nullptr || axes == MapAxes{} ? 0 : any->corners.uvs.size() / 3,
                                            axes);
    const MapSides sides = sidesOf(meshes, options, of_triangles);
    if (is_texture && sides.to.space == MapSpace::object)
        failFile(ErrorCode::invalidOption,
                 "two-channel textures can only store normals in tangent space; write a .png or .exr");
    report.texels =
        valueOrThrow(convertMap(map, sides.from, sides.to, chosen, image.texels, options.execution, options.progress));
    checkConversion(report.texels);
    if (!before.empty()) countLayout(before, image.texels, any == nullptr, report.texels);
    if (!how_read.empty()) report.warnings.push_back(how_read);
    report.warnings.insert(report.warnings.end(), alpha_text.begin(), alpha_text.end());
    addMapWarnings(options, report);
    if (is_texture) {
        if (options.bits != 0) report.warnings.emplace_back("--bits has no effect on BC5");
        AtomicOutput files({.is_dry_run = options.dry_run, .sync = options.file.sync, .inputs = &inputs});
        const std::vector<std::uint8_t> file = packTexture(output, image.width, image.height, image.texels,
                                                           options.execution, std::move(coverage), options.dds_header);
        files.add(output, std::span<const std::uint8_t>(file));
        files.commit();
        return report;
    }
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

namespace tspace::report {

std::string convertMapJson(const Outcome<ConvertMapFileReport>& outcome, ExitCode exit_code) {
    const Result<ConvertMapFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.convert-map/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["bits"] = result->bits;
    json["from"] = mapMeshJson(result->from);
    json["to"] = mapMeshJson(result->to);
    const ConvertMapReport& texels = result->texels;
    json["converted"] = texels.converted;
    json["changed"] = texels.changed;
    json["background"] = texels.background;
    json["withoutFrame"] = texels.without_frame;
    json["belowHorizon"] = texels.below_horizon;
    json["overlapping"] = texels.overlapping;
    json["conflicting"] = texels.conflicting;
    json["unmatched"] = texels.unmatched;
    json["apart"] = texels.apart;
    json["degenerateUvs"] = texels.degenerate_uv_count;
    json["badUvs"] = texels.bad_uv_count;
    json["meanChangeDeg"] = texels.mean_change_deg;
    json["maxChangeDeg"] = texels.max_change_deg;
    json["halfStepDeg"] = texels.half_step_deg;
    json["belowHalfStep"] = texels.is_below_half_step;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report

namespace tspace::options {
namespace {

constexpr Named<MapFileSpace> kSpaces[] = {
    {"tangent", MapFileSpace::tangent},
    {"object", MapFileSpace::object},
    {"world", MapFileSpace::world},
};
constexpr Named<BitangentPlace> kBitangents[] = {
    {"pixel", BitangentPlace::perPixel},
    {"vertex", BitangentPlace::perVertex},
};
constexpr Named<unsigned> kBitCounts[] = {{"8", 8}, {"16", 16}, {"32", 32}};

}  // namespace

OptionList convertMapOptions(ConvertMapFileOptions& options) {
    OptionList list;
    const auto addFile = adder(list, kInputAndOutput), add = adder(list, "Map");
    addFile(fileOption("--mesh", "FILE", options.mesh,
                       "The model that the map was made for. Its tangents are used; missing ones are computed.",
                       InputKind::model));
    addFile(fileOption("--to-mesh", "FILE", options.to_mesh,
                       "Model that will use the map. It must have the same surface and UVs; tangents, normals, splits "
                       "and triangulation may differ. Default: the model of --mesh.",
                       InputKind::model));
    addFile(materialOfMapOption(options.material));
    addFile(number("--tile", options.tile, 9999,
                   "UDIM tile of the map (1001, ...): use only the triangles in this tile. 0: all triangles."));
    addFile(dryRunOption(options.dry_run));
    addAllowExternal(list, options.file);
    add(choice("--from", "SPACE", kSpaces, options.from,
               "Space of the input vectors: tangent, object (the coordinates of the mesh), or world (the coordinates "
               "of the scene, after the node's transform)."));
    add(choice("--to", "SPACE", kSpaces, options.to,
               "Space of the output vectors: tangent, object (the coordinates of the mesh), or world (the coordinates "
               "of the scene)."));
    add(axesOption([&options](const MapAxes& axes) { options.axes = axes; }));
    add(readingOption(
        "--from-convention", options.from_reading,
        "Program that the map was made for: gltf, opengl, directx, unreal, unity, blender, godot or three."));
    add(readingOption(
        "--to-convention", options.to_reading,
        "Program that will use the output: gltf, opengl, directx, unreal, unity, blender, godot or three."));
    add(choice("--from-bitangent", "WHERE", kBitangents, options.from_reading.bitangent,
               "Bitangents that the map was made for. vertex: computed per vertex and interpolated; pixel: computed "
               "per pixel. Default: as in the program of --from-convention; for gltf: pixel."))
        .default_text.clear();
    add(choice("--to-bitangent", "WHERE", kBitangents, options.to_reading.bitangent,
               "Bitangents that the output is made for. vertex: computed per vertex and interpolated; pixel: computed "
               "per pixel. Default: as in the program of --to-convention; for gltf: pixel."))
        .default_text.clear();
    add(option(
        "--channels", "LETTERS", [&options](const std::string& value) { return takeChannels(value, options.layout); },
        "Channels of IN that store x, y and z: bgr if red and blue are exchanged. With two letters z is "
        "reconstructed from x and y: rg for maps whose blue is unused, ag for DXT5nm. A capital letter inverts a "
        "channel. Default: rgb."));
    add(setting("--srgb", options.layout.curve, MapCurve::srgb,
                "Undo an sRGB encoding: the values of IN were stored as colors, with the sRGB curve."));
    Option& linearized = add(setting("--linearized", options.layout.curve, MapCurve::linearized,
                                     "Reapply the sRGB curve: the values of IN were decoded as sRGB by mistake."));
    linearized.old_names = {"--linearised"};
    linearized.excludes = {"--srgb"};
    add(option(
        "--flip-red", "", [](const std::string&) { return std::string(); },
        "Invert the red channel of the output, for maps with inverted x."));
    add(option(
        "--flip-green", "", [](const std::string&) { return std::string(); },
        "Invert the green channel of the output, relative to --to-convention."));
    add(choice("--bits", "BITS", kBitCounts, options.bits,
               "Bits per channel of the output: 8 or 16 in a PNG; 16 (half) or 32 (float) in an EXR. Default: the most "
               "that the format supports."));
    add(lengthsOption(options.lengths));
    add(alphaOption(options.alpha));
    add(ddsHeaderOption(options.dds_header));
    add(number("--padding", options.padding, 65536,
               "Width of the padding around UV islands that is converted too, in texels. 0: only texels that filtering "
               "reads. Texels farther away are background and are not changed."));
    addMakingAMap(list, options.tangents.method, options.execution, options.file);
    return list;
}

std::string finish(const Given& given, ConvertMapFileOptions& options) {
    // Options for conventions are applied before the others, whatever their order on the command line.
    for (const Given::Item& item : given.items) {
        const std::string& name = item.option->name();
        if (name == "--from-bitangent" || name == "--to-bitangent") item.option->take(item.value);
    }
    if (given.has("--flip-red")) options.layout.x.is_inverted = !options.layout.x.is_inverted;
    if (given.has("--flip-green"))
        options.to_reading.green = options.to_reading.green == Green::up ? Green::down : Green::up;
    if (!options.to_mesh.empty() && options.mesh.empty() && options.from == MapFileSpace::tangent)
        return "--to-mesh needs --mesh, the model that the map was made for";
    const bool same_kind = options.from == options.to;
    if (!same_kind && options.mesh.empty() && options.to_mesh.empty())
        return "converting between spaces needs the frames of a model; use --mesh";
    const bool same_frames = options.from_reading.bitangent == options.to_reading.bitangent &&
                             options.from_reading.unit_vectors == options.to_reading.unit_vectors;
    if (options.from == MapFileSpace::tangent && same_kind && !same_frames && options.mesh.empty())
        return "these conventions interpolate frames differently, so the frames of a model are needed; use --mesh";
    return {};
}

}  // namespace tspace::options
