// SPDX-License-Identifier: MIT
// The OBJ pipeline: converts an OBJ file and its normal maps to a glTF document.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "commands/generate/flip_maps.h"
#include "commands/generate/frames_call.h"
#include "commands/generate/generate_model.h"
#include "commands/generate/generate_steps.h"
#include "core/base/numbers.h"
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/primitive.h"
#include "core/mesh/pools/unit_lattice.h"
#include "model/gltf/packed_layout.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/output_name.h"
#include "model/obj/obj_primitives.h"
#include "model/obj/obj_reader.h"
#include "model/obj/obj_writer.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace::obj {
namespace {

// Normal maps of an OBJ file: converts height maps, and repairs and inverts normal maps.

void skipHeightMap(Material& material, const std::string& why, Model& model) {
    model.warnings.push_back("the height map '" + material.normal_texture.file +
                             "' was skipped, and no normal map was made from it: " + why);
    material.normal_texture = {};
    material.normal_scale = 1;
}

/// Converts a gray map_bump to a normal map; other images are already normal maps. `image`: index in the scene.
void convertHeightMap(const Scene& scene, std::size_t image, const GenerateOptions& options, Material& material,
                      Model& model, std::vector<NormalMapReport>& reports) {
    const auto number = static_cast<std::size_t>(&material - model.materials.data());
    const auto strength = static_cast<double>(material.normal_scale);
    ConvertedHeights made = normalMapFromHeights(scene, number, image, strength, options);
    if (!made.is_height_map) return;
    if (!made.remarks.empty())
        model.warnings.push_back("the height map '" + material.normal_texture.file + "': " + made.remarks);
    if (made.file.empty()) return skipHeightMap(material, made.why_not, model);
    model.memory->take(made.file.size(), "material");
    material.converted_normal_map = std::make_shared<const Bytes>(std::move(made.file));
    material.normal_scale = 1;
    const std::string tilt = shortNumber(made.mean_lean_deg) + " degrees on average";
    NormalMapReport& report = reports.emplace_back();
    report.image = static_cast<std::uint32_t>(image);
    report.name = material.normal_texture.file;
    report.mended = true;
    report.reason = "the image was a height map; white is " + shortNumber(strength) +
                    " model units high (-bm), and the normals are tilted by " + tilt;
    constexpr double kSteepDeg = 60;
    if (made.mean_lean_deg > kSteepDeg) {
        model.warnings.push_back("the normal map made from '" + material.normal_texture.file + "' is very steep (" +
                                 tilt + "); -bm is interpreted as the height of white above black, in model units");
    }
}

void convertHeights(const Scene& scene, const GenerateOptions& options, Model& model,
                    std::vector<NormalMapReport>& reports) {
    std::vector<bool> is_done(model.materials.size());
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (!use.may_be_heights || !use.image || is_done[use.material]) continue;
            is_done[use.material] = true;
            convertHeightMap(scene, *use.image, options, model.materials[use.material], model, reports);
        }
    }
}

/// Converts gray images that materials reference as `map_bump` to normal maps, using the frames of their faces and the
/// factor -bm as strength in model units. An image that cannot be converted is removed from its material, with a
/// warning in the model. Then repairs and inverts other maps, if requested; all tangents are new, so none of them has
/// signs that compensate for green pointing down. The primitives must have normals. Throws FileError.
std::vector<NormalMapReport> prepareMaps(std::span<const ObjPrimitive> primitives, const GenerateOptions& options,
                                         Model& model) {
    std::vector<NormalMapReport> reports;
    const bool is_asked = options.maps.flip_green != FlipGreen::none || options.maps.mend;
    const bool has_bumps = std::any_of(model.materials.begin(), model.materials.end(), [](const Material& material) {
        return material.normal_is_bump && material.normal_texture.used();
    });
    if (!is_asked && !has_bumps) return reports;
    const std::int64_t left = model.memory->left();
    const Scene scene = sceneOf(model, primitives, true);
    convertHeights(scene, options, model, reports);
    std::vector<JudgedMap> maps;
    if (is_asked) maps = judgeMaps(scene, std::vector<bool>(scene.primitives.size()), options);
    std::vector<const Texture*> textures(scene.images.size());
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            const Material& material = model.materials[use.material];
            if (material.normal_texture.used() && !material.converted_normal_map)
                textures[*use.image] = &material.normal_texture;
        }
    }
    std::vector<std::pair<std::string, Bytes>> made;
    for (JudgedMap& map : maps) {
        if (textures[map.image] == nullptr) continue;
        Bytes bytes;
        if (options.maps.mend) bytes = rewriteJudgedMap(scene, options, map);
        if (bytes.empty()) bytes = std::move(map.flipped);
        reports.push_back(std::move(map.report));
        if (!bytes.empty()) made.emplace_back(textures[map.image]->path(), std::move(bytes));
    }
    model.memory->restore(left);
    for (auto& [path, bytes] : made) {
        model.memory->take(bytes.size(), "material");
        model.flipped_maps[path] = std::move(bytes);
    }
    return reports;
}

}  // namespace
}  // namespace tspace::obj

namespace tspace {
namespace {

using namespace obj;

void checkOutput(const std::string& output) {
    if (!isGltfName(output) && !isGlbOutput(output)) failEnding(output, {".glb", ".vrm", ".gltf"});
}

/// Sets action and reason. Returns true if tangents are to be computed.
bool decide(const Material& material, const ObjPrimitive& primitive, const GenerateOptions& options,
            PrimitiveReport& report) {
    const bool needed = material.normal_texture.used();
    if (!needed && !options.selection.all) {
        report.action = PrimitiveAction::notNeeded;
        report.reason =
            material.found ? "the material has no normal map" : "the faces have no material, or no MTL file defines it";
    } else if (!primitive.has_uvs && options.tangents.compute.method != Method::basis) {
        report.action = PrimitiveAction::impossible;
        report.reason = "the faces have no texture coordinates";
    } else {
        report.action = PrimitiveAction::generated;
        report.reason = needed ? "the material has the normal map '" + material.normal_texture.file + "'"
                               : "requested for all primitives";
        if (primitive.has_uvs) report.uv_set = 0;
        return true;
    }
    return false;
}

/// Computes the frames and triangulates polygons.
void makeObjFrames(const GenerateOptions& options, FinishedPrimitive& finished, PrimitiveReport& report) {
    OwnedMesh& mesh = finished.mesh;
    const PrimitiveGeometry polygons{.indices = std::move(mesh.indices), .face_sizes = std::move(mesh.face_sizes)};
    FramesOptions frames_options = framesOptions(options);
    frames_options.execution = options.execution;
    frames_options.progress = options.progress;
    FramesReport computed;
    PoolFrames frames = valueOrThrow(computeFrames(mesh, {&polygons, 1}, frames_options, {&computed, 1}));
    copyReport(computed, report);
    report.triangle_count = computed.triangle_count;
    report.vertices_before = computed.vertices_before;
    report.vertices_after = computed.vertices_after;
    report.bitangents_generated = computed.bitangents_generated;
    mesh = {.positions = gather(std::span<const Vec3>(mesh.positions), frames.source_vertices),
            .normals = gather(std::span<const Vec3>(mesh.normals), frames.source_vertices),
            .tangents = std::move(frames.tangents),
            .uvs = gather(std::span<const Vec2>(mesh.uvs), frames.source_vertices),
            .indices = std::move(frames.indices.front())};
    finished.bitangents = std::move(frames.bitangents);
}

void cutPolygons(OwnedMesh& mesh, PrimitiveReport& report) {
    mesh.indices = triangleCorners(mesh);
    mesh.face_sizes = {};
    report.triangle_count = mesh.indices.size() / 3;
    report.vertices_before = report.vertices_after = mesh.positions.size();
}

/// Packs the frames after rounding them to the format in which they are written, and removes the attributes that
/// PackDrop selects.
void packWritten(const GenerateOptions& options, FinishedPrimitive& finished, PrimitiveReport& report) {
    OwnedMesh& mesh = finished.mesh;
    if (mesh.tangents.empty()) {
        const bool can_have = report.action == PrimitiveAction::notNeeded;
        report.notes.emplace_back(std::string("its frames were not packed: it has no TANGENT") +
                                  (can_have ? "; use --all to add it" : ""));
        return;
    }
    roundUnits(std::span(mesh.tangents), finished.tangent_format);
    const gltf::PackedLayout& layout = gltf::packedLayout(*options.storage.pack);
    const Bytes words = gltf::packWords(layout.format, mesh.normals, mesh.tangents, options.execution, report.packing);
    for (const gltf::PackedPart& part : layout.parts)
        finished.packed.push_back({part, takePart(words, layout.format, part)});
    report.frames_packed = true;
    report.tangents_dropped = options.storage.pack_drop != PackDrop::nothing;
    report.normals_dropped = options.storage.pack_drop == PackDrop::all;
    if (report.tangents_dropped) mesh.tangents.clear();
    if (report.normals_dropped) mesh.normals.clear();
}

void reportProgress(const GenerateOptions& options, const char* what, std::uint64_t done, std::uint64_t total) {
    if (options.progress) options.progress(what, done, total);
}

/// Returns the primitive with all computed attributes. `replaced`: it had normals, which were recomputed.
FinishedPrimitive finish(const Model& model, const ObjPrimitive& primitive, bool replaced,
                         const GenerateOptions& options, PrimitiveReport& report) {
    const Material& material = model.materials[primitive.material];
    report.mesh = primitive.shape;
    report.mesh_name = model.shape_names[primitive.shape];
    report.material_name = material.name;
    FinishedPrimitive finished{
        .shape = primitive.shape, .material = primitive.material, .mesh = buildMesh(model, primitive)};
    OwnedMesh& mesh = finished.mesh;
    reportProgress(options, "computing tangents", 0, 0);
    // Normals are rounded before tangents are computed, because tangents must match the written normals.
    if (primitive.normals_generated) roundUnits(mesh.normals, options.storage.format);
    if (decide(material, primitive, options, report)) {
        makeObjFrames(options, finished, report);
    } else {
        cutPolygons(mesh, report);
    }
    reportProgress(options, "computing tangents", 0, 0);
    report.normals_generated = primitive.normals_generated;
    report.normals_replaced = replaced;
    if (primitive.normals_generated) {
        FramesReport faults;  // morph_sign_flip_count stays 0, because OBJ has no morph targets
        countFaults(mesh.positions, mesh.normals, {&mesh.indices, 1}, options.normals.compute.weld_distance,
                    {&faults, 1});
        copyReportOfKept(faults, report);
    }
    if (primitive.normals_generated) finished.normal_format = options.storage.format;
    finished.tangent_format = options.storage.format;
    if (options.storage.pack) packWritten(options, finished, report);
    return finished;
}

/// A glTF document that was created from an OBJ file, and the options that had an effect.
struct ConvertedObj {
    gltf::Document document = {};
    OptionEffects effects = {};
};

void checkCompression(const GenerateOptions& options) {
    if (options.storage.compression == Compression::meshopt || options.storage.compression == Compression::draco) {
        failFile(ErrorCode::invalidOption,
                 "the output of an OBJ file cannot be compressed in the same run; compress the result in a second run");
    }
}

/// Generates the document. Fills the report, except for the values that the writer adds. `input`: path of the model.
ConvertedObj generate(Model&& model, const std::string& input, const std::string& output,
                      const GenerateOptions& options, GenerateReport& report) {
    reportProgress(options, "reading", 1, 1);
    std::vector<std::uint8_t> flipped;
    if (options.mend_winding) flipped = fixObjWinding(model, options, report);
    reportProgress(options, "reading", 1, 1);
    std::vector<ObjPrimitive> primitives = collectPrimitives(model);
    reportProgress(options, "computing normals", 0, 0);
    std::vector<bool> had_normals;
    for (const ObjPrimitive& primitive : primitives) had_normals.push_back(hasSomeNormals(model, primitive));
    if (options.normals.overwrite) {
        for (Corner& corner : model.corners) corner.normal = kNone;
    }
    NormalReport normals = valueOrThrow(completeNormals(model, primitives, options));

    report.normal_maps = prepareMaps(primitives, options, model);
    std::vector<FinishedPrimitive> finished;
    std::vector<std::uint32_t> next_in_mesh(model.shape_names.size(), 0);
    for (const ObjPrimitive& primitive : primitives) {
        reportProgress(options, "computing tangents", finished.size(), primitives.size());
        PrimitiveReport& entry = report.primitives.emplace_back();
        entry.source_list = entry.split_list = static_cast<std::uint32_t>(finished.size());
        const bool replaced = options.normals.overwrite && had_normals[finished.size()];
        finished.push_back(finish(model, primitive, replaced, options, entry));
        for (const std::uint32_t face : primitive.faces) {
            if (!flipped.empty() && flipped[face] != 0) listFlipped(face, entry);
        }
        entry.primitive = next_in_mesh[primitive.shape]++;
        // Normals are computed for the whole file at once: the first primitive with computed normals reports the
        // counts.
        if (primitive.normals_generated) entry.normals = std::exchange(normals, {});
    }
    reportProgress(options, "writing", 0, 1);
    report.changed = true;
    report.input_bytes = model.input_bytes;
    report.warnings = model.warnings;
    report.coordinate_offset[0] = model.offset.x;
    report.coordinate_offset[1] = model.offset.y;
    report.coordinate_offset[2] = model.offset.z;
    const bool keeps_offset = model.keeps_offset;
    ConvertedObj made{toDocument(std::move(model), finished, output, report.warnings),
                      {.far_coordinates = keeps_offset}};
    made.document.path = input;
    made.document.options = options.file;
    return made;
}

GenerateReport generateToFile(const std::string& input, const std::string& output, const GenerateOptions& requested,
                              bool is_step) {
    checkOutput(output);
    if (requested.sink && !isGlbName(output))
        failFile(ErrorCode::invalidOption,
                 "only a GLB can be written to a stream or to memory; write a GLB, or name an output file");
    GenerateReport report;
    InputFiles inputs;
    GenerateOptions options = requested;
    inputs.watch(options.file);
    checkCompression(options);
    reportProgress(options, "reading", 0, 0);
    ConvertedObj made = generate(readModel(input, options.file), input, output, options, report);
    // All referenced files are in the destination folder, so none is copied.
    const gltf::OutputTarget target{.path = output, .container = made.document.container, .same_folder = true};
    gltf::writeGenerated(input, made.document, target, requested, made.effects, inputs, is_step, report);
    return report;
}

}  // namespace

Result<GenerateReport> generateObj(const std::string& input, const std::string& output, const GenerateOptions& options,
                                   const GenerateStep* step) {
    return atFileBorder(
        [&]() -> Result<GenerateReport> { return generateToFile(input, output, options, step != nullptr); });
}

gltf::GeneratedModel generateObjModel(obj::Model&& input, const std::string& path, const GenerateOptions& options,
                                      const GenerateStep& step) {
    checkCompression(options);
    GenerateReport report;
    gltf::Model model(generate(std::move(input), path, step.output, options, report).document);
    model.reload();
    return {std::move(model), std::move(report)};
}

}  // namespace tspace
