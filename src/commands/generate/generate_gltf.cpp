// SPDX-License-Identifier: MIT
// The glTF pipeline: reads the model, decides what to do, computes pool by pool, stores the frames, and writes the
// output.
#include <algorithm>
#include <optional>
#include <utility>

#include "commands/generate/apply_frames.h"
#include "commands/generate/compute_pools.h"
#include "commands/generate/edit_attributes.h"
#include "commands/generate/flip_maps.h"
#include "commands/generate/generate_model.h"
#include "commands/generate/generate_plan.h"
#include "commands/generate/generate_steps.h"
#include "commands/generate/pack_frames.h"
#include "core/base/parallel.h"
#include "model/gltf/compression.h"
#include "model/gltf/container.h"
#include "model/gltf/load_document.h"
#include "model/gltf/packed_frames.h"
#include "model/gltf/vertex_numbers.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"

namespace tspace::gltf {
namespace {

/// Maximum number of corners per thread in pools that are computed together: enough to occupy all threads, and few
/// enough to limit the memory of results that wait to be stored.
constexpr std::size_t kCornersPerThread = 500'000;

void reportProgress(const GenerateOptions& options, const char* what, std::uint64_t done, std::uint64_t total) {
    if (options.progress) options.progress(what, done, total);
}

/// Returns how many of the pools are computed together; at least one. Results occupy memory until they are stored in
/// order: one pool needs 1.25 times its working memory, several pools twice the sum of theirs. Fails with tooLarge if
/// the first pool alone needs too much.
std::size_t countTogether(std::span<const PoolPlan> pools, const Document& document,
                          std::span<const Primitive> primitives, const Execution& execution) {
    document.memory->require(pools[0].workBytes() / 4 * 5, primitives[pools[0].primitives[0]].place());
    const unsigned width = Parallel(execution).width();
    const std::size_t most = width == 1 ? 0 : kCornersPerThread * width;
    std::size_t count = 0;
    std::uint64_t corners = 0, bytes = 0;
    while (count < pools.size() && (count == 0 || (corners + pools[count].corner_count <= most &&
                                                   document.memory->has(2 * (bytes + pools[count].workBytes()))))) {
        bytes += pools[count].workBytes();
        corners += pools[count++].corner_count;
    }
    return count;
}

/// Adds notes to primitives that get no bitangents, because bitangents are only written together with computed
/// tangents.
void noteMissingBitangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (reports[i].action != PrimitiveAction::kept || primitives[i].find("_BITANGENT")) continue;
        reports[i].notes.emplace_back(
            "its tangents were kept, so it got no bitangents; use --overwrite to compute tangents and bitangents "
            "together");
    }
}

/// A model that was read, and the output target.
struct Input {
    Model model;
    OutputTarget target = {};
    GenerateOptions options = {};  ///< options, adapted to this model
    bool is_converted = false;     ///< the output has a different container or format, even without edits
};

/// Fails if the model cannot be written to that output.
Input toInput(Model&& model, const Path& output, bool is_stream, const GenerateOptions& requested) {
    Document& document = model.document();
    Input input{std::move(model), outputTarget(document, output, is_stream), requested};
    // The tangent convention of other formats is unknown, so tangents are kept only if they are correct in glTF.
    if (document.imported && requested.selection.existing == ExistingTangents::keep)
        input.options.selection.existing = ExistingTangents::repair;
    input.is_converted = input.target.container != document.container || document.imported;
    checkRequiredExtensions(document);
    return input;
}

/// Storage of the geometry while the document is edited.
struct Storage {
    std::string new_file = {};  ///< buffer file for new data that have no better location
    bool is_unpacked = false;   ///< geometry was decompressed or unpacked
    bool lost_packing = false;  ///< packed frames with a wrong count were removed
};

/// Removes packed frames that will be replaced, and unpacks geometry that will be stored differently.
Storage prepareStorage(Input& input, std::vector<std::string>& warnings) {
    Document& document = input.model.document();
    Storage storage{.lost_packing = removeMiscounted(document, input.model.primitives(), input.options.storage.pack)};
    const Compression compression = input.options.storage.compression;
    if (compression != Compression::keep) convertContainer(document, input.target, true, warnings);
    storage.new_file = freeFileName(document, input.target, ".tspace.bin");
    storage.is_unpacked = unpackGeometry(document, compression, storage.new_file, warnings);
    if (storage.is_unpacked) input.model.wasEdited();
    return storage;
}

/// All decisions on a model, made before anything is computed or changed.
struct Decisions {
    GeneratePlan plan = {};
    MapFlips flips = {};
    std::optional<MapConversion> maps = {};  ///< converts the normal maps so that they look as with the old tangents
    std::vector<std::vector<std::size_t>> broken = {};  ///< primitives of each TANGENT whose values are repaired
    bool has_unreadable_tangents = false;

    [[nodiscard]] bool changeGeometryOrMaps() const {
        return !plan.pools.empty() || !flips.images.empty() || !flips.mended.empty() || !broken.empty() ||
               has_unreadable_tangents;
    }
};

/// Makes the plan first, then narrows it down to repairs; the other decisions depend on the plan. Frees decoded arrays
/// at the end: pools mostly read the file's bytes in place, and all decoded arrays together may be larger than the
/// file.
Decisions decide(Model& model, const GenerateOptions& options, const RecomputedNormals& recomputed,
                 std::vector<std::string>& warnings) {
    Decisions decisions{.plan = planGenerate(model.document(), model.primitives(), options, recomputed)};
    GeneratePlan& plan = decisions.plan;
    if (options.selection.existing == ExistingTangents::repair) planRepair(model, options, plan);
    planSurroundings(model, options, plan);
    if (options.maps.flip_green != FlipGreen::none || options.maps.mend)
        decisions.flips = planFlips(model, plan.reports, options);
    if (std::string warning = warnOfInvertedSigns(model, plan, decisions.flips, options); !warning.empty())
        warnings.push_back(std::move(warning));
    if (options.maps.convert) decisions.maps.emplace(model, options);
    if (options.selection.existing != ExistingTangents::keep) decisions.broken = findBrokenValues(model, plan);
    decisions.has_unreadable_tangents =
        std::any_of(model.primitives().begin(), model.primitives().end(),
                    [](const Primitive& primitive) { return !primitive.unreadable_tangents.empty(); });
    model.dropScene();
    return decisions;
}

/// Computes pools and stores their frames in turns, so that the frames of only a few pools need memory at a time.
void computeAndApply(Input& input, Decisions& decisions, Editor& editor, std::vector<std::string>& warnings) {
    Document& document = input.model.document();
    const std::span<const Primitive> primitives = input.model.primitives();
    GeneratePlan& plan = decisions.plan;
    VertexNumbers numbers(document, editor);
    std::uint64_t total = 0, done = 0;
    for (const PoolPlan& pool : plan.pools) total += pool.corner_count;
    PoolComputer computer(document, input.model.arrays(), primitives, input.options);
    for (std::span<const PoolPlan> rest = plan.pools; !rest.empty();) {
        reportProgress(input.options, "computing tangents", done, total);
        const std::span<const PoolPlan> pools =
            rest.first(countTogether(rest, document, primitives, input.options.execution));
        rest = rest.subspan(pools.size());
        std::vector<PoolElements> elements = computer.compute(pools, {done, total}, plan.reports);
        for (std::size_t i = 0; i < pools.size(); ++i) {
            if (!elements[i].warning.empty())
                warnings.push_back(primitives[pools[i].primitives[0]].place() + ": " + elements[i].warning);
            applyFrames(editor, document, primitives, pools[i], std::move(elements[i]), numbers, plan.reports);
            done += pools[i].corner_count;
        }
    }
    reportProgress(input.options, "computing tangents", total, total);
    // Invalid values are repaired after new frames have been stored (in other accessors), and before tangents are
    // removed: this determines the order of the notes.
    repairInvalidValues(editor, document, primitives, decisions.broken, plan.reports);
    for (std::string& warning : numbers.warnings()) warnings.push_back(std::move(warning));
}

/// Executes the decisions. Fills the report except for its files.
OptionEffects edit(Input& input, const Storage& storage, Decisions&& decisions, GenerateReport& report) {
    Document& document = input.model.document();
    const GenerateOptions& options = input.options;
    const std::span<const Primitive> primitives = input.model.primitives();
    std::vector<PrimitiveReport>& reports = decisions.plan.reports;
    Editor editor(document, storage.new_file);
    if (storage.lost_packing) editor.touch();
    if (decisions.has_unreadable_tangents) removeUnreadableTangents(editor, primitives, decisions.plan);
    computeAndApply(input, decisions, editor, report.warnings);
    if (decisions.has_unreadable_tangents) noteUnreadableTangents(primitives, reports);
    if (options.tangents.bitangents) noteMissingBitangents(primitives, reports);
    noteStalePackedFrames(document, primitives, options, reports);
    stripTangents(editor, primitives, reports);
    // The following steps read the new tangents.
    input.model.wasEdited();
    reportProgress(options, "writing", 0, 1);
    if (decisions.maps) report.converted_maps = decisions.maps->run(editor, input.target, reports);
    if (options.storage.pack) writePackedFrames(editor, document, options, reports);
    MapFlips& flips = decisions.flips;
    report.normal_maps = std::move(flips.reports);
    if (!flips.images.empty() || !flips.mended.empty()) applyFlips(document, editor, input.target, std::move(flips));
    editor.finish();
    reportProgress(options, "writing", 0, 1);
    const bool is_packed = packGeometry(document, options.storage.compression, storage.new_file);
    report.primitives = std::move(reports);
    report.changed = editor.changed() || input.is_converted || storage.is_unpacked || is_packed;
    return {.far_coordinates = document.keeps_far_coordinates,
            .texture_transforms = decisions.plan.has_texture_transforms,
            .compression = storage.is_unpacked || is_packed};
}

/// Flips triangles if requested. Returns whether any were flipped; in this case the container has been converted to
/// that of the output. `is_converted`: the container was already converted.
bool flipWrongTriangles(Input& input, const Storage& storage, std::span<const std::uint32_t> kept, bool is_converted,
                        WindingPlan& plan, std::vector<std::string>& warnings) {
    if (!input.options.mend_winding) return false;
    plan = planWinding(input.model, input.options, kept);
    if (!plan.flipsAny()) return false;
    Document& document = input.model.document();
    if (input.options.storage.compression == Compression::keep && !is_converted)
        convertContainer(document, input.target, true, warnings);
    flipTriangles(document, storage.new_file, input.model.primitives(), plan.flipped);
    input.model.wasEdited();
    return true;
}

/// Repairs attributes if requested: all, or those of primitives whose normals are recomputed, because vertices cannot
/// be split if an attribute has another number of elements. Returns whether any were repaired; in this case the
/// container has been converted to that of the output. Primitives that lost their normals get new ones.
bool repairFaults(Input& input, const Storage& storage, bool is_asked_for, RecomputedNormals& recomputed,
                  std::vector<std::string>& warnings) {
    const GenerateOptions& options = input.options;
    const bool repairs_all = is_asked_for || options.selection.existing == ExistingTangents::repair;
    if (!repairs_all && !options.normals.overwrite) return false;
    const std::span<const Primitive> primitives = input.model.primitives();
    Document& document = input.model.document();
    std::vector<bool> chosen;
    for (const Primitive& primitive : primitives)
        chosen.push_back(!primitive.attribute_faults.empty() && primitive.canRepairFaults() &&
                         (repairs_all || overwritesNormals(document, primitive, options)));
    if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) return false;
    if (options.storage.compression == Compression::keep) convertContainer(document, input.target, true, warnings);
    recomputed.lost = repairAttributes(document, storage.new_file, primitives, chosen, warnings);
    input.model.wasEdited();
    return true;
}

/// If tangents are repaired, scales normals that do not have unit length. Returns the number of primitives with such
/// normals.
std::size_t normalizeNormals(Input& input, const Storage& storage, std::vector<std::string>& warnings) {
    const std::vector<Primitive>& primitives = input.model.primitives();
    Document& document = input.model.document();
    const auto can_scale = [&](const Primitive& primitive) { return canScaleNormals(document, primitive); };
    if (input.options.selection.existing != ExistingTangents::repair) return 0;
    const auto count = static_cast<std::size_t>(std::count_if(primitives.begin(), primitives.end(), can_scale));
    if (count == 0) return 0;
    if (input.options.storage.compression == Compression::keep)
        convertContainer(document, input.target, true, warnings);
    writeUnitNormals(document, storage.new_file, primitives);
    input.model.wasEdited();
    return count;
}

/// Completes a warning about normals without unit length if the output has only unit normals. `numbers`: primitives
/// whose normals did not have unit length and were not repaired.
void noteUnitNormals(std::span<const std::size_t> numbers, const NormalsWarning& warning, GenerateReport& report) {
    const bool are_unit = std::all_of(numbers.begin(), numbers.end(),
                                      [&](std::size_t number) { return report.primitives[number].normals_generated; });
    if (are_unit) report.warnings[warning.number] = warning.facts + ". The normals in the output have unit length";
}

/// Runs all steps between reading and writing.
OptionEffects generate(Input& input, bool with_images, const GenerateStep& step, GenerateReport& report) {
    Document& document = input.model.document();
    std::vector<std::size_t> scaled, invalid;
    for (std::size_t i = 0; i < input.model.primitives().size(); ++i) {
        const Primitive& primitive = input.model.primitives()[i];
        const bool is_repaired =
            input.options.selection.existing == ExistingTangents::repair && canScaleNormals(document, primitive);
        if (primitive.normal_scales != nullptr && !is_repaired) scaled.push_back(i);
        if (usesInvalidNormals(document, primitive)) invalid.push_back(i);
    }
    report.warnings = document.warnings;
    const std::optional<NormalsWarning> scaled_normals = document.scaled_normals,
                                        invalid_normals = document.invalid_normals;
    std::copy_n(document.coordinate_offset.begin(), 3, report.coordinate_offset);
    const Storage storage = prepareStorage(input, report.warnings);
    RecomputedNormals recomputed = step.normals;
    const bool was_repaired = repairFaults(input, storage, step.repairs_attributes, recomputed, report.warnings);
    const std::size_t scaled_count = normalizeNormals(input, storage, report.warnings);
    const bool were_repaired = scaled_count != 0;
    reportProgress(input.options, "reading", 1, 1);
    WindingPlan winding;
    const bool was_turned =
        flipWrongTriangles(input, storage, step.wound_meshes, were_repaired || was_repaired, winding, report.warnings);
    report.windings = std::move(winding.reports);
    reportProgress(input.options, "reading", 1, 1);
    Decisions decisions = decide(input.model, input.options, recomputed, report.warnings);
    report.input_bytes = document.input_bytes;
    if (input.options.storage.compression == Compression::keep && !was_turned && !were_repaired && !was_repaired) {
        const bool will_edit = decisions.changeGeometryOrMaps() || input.options.storage.pack.has_value();
        convertContainer(document, input.target, will_edit, report.warnings);
    }
    // Images are embedded after the decisions on maps, which find images by their names.
    if (with_images) embedImagesInGlb(document, input.target, report.warnings);
    reportProgress(input.options, "reading", 1, 1);
    const bool has_unreadable_tangents = decisions.has_unreadable_tangents;
    OptionEffects effects = edit(input, storage, std::move(decisions), report);
    effects.attributes_repaired = was_repaired || has_unreadable_tangents;
    effects.normals_scaled_count = scaled_count;
    report.changed = report.changed || was_turned || were_repaired || was_repaired;
    if (scaled_normals) noteUnitNormals(scaled, *scaled_normals, report);
    if (invalid_normals) noteUnitNormals(invalid, *invalid_normals, report);
    countFlipped(winding, report.primitives);
    return effects;
}

/// Adds the file names to the report.
void reportFiles(const std::string& input, const Document& document, const AtomicOutput& files,
                 GenerateReport& report) {
    report.input_files = {input};
    for (const std::vector<std::string>& more : {document.input_files, files.sources()}) {
        for (const std::string& file : more) {
            const bool is_known =
                std::find(report.input_files.begin(), report.input_files.end(), file) != report.input_files.end();
            if (!is_known) report.input_files.push_back(file);
        }
    }
    report.output_files = files.files();
    report.output_bytes = files.files().empty() ? document.input_bytes : files.byteCount();
}

GenerateReport generateToFile(const std::string& path, const std::string& output, const GenerateOptions& requested,
                              const GenerateStep* step) {
    GenerateReport report;
    InputFiles inputs;
    GenerateOptions options = requested;
    inputs.watch(options.file);
    reportProgress(options, "reading", 0, 1);
    Input input = toInput(Model(loadDocument(path, options.file, options.execution, options.progress)), output,
                          options.sink != nullptr, options);
    const OptionEffects effects = generate(input, true, step != nullptr ? *step : GenerateStep{}, report);
    writeGenerated(path, input.model.document(), input.target, requested, effects, inputs, step != nullptr, report);
    return report;
}

}  // namespace

void writeGenerated(const std::string& input, Document& document, const OutputTarget& target,
                    const GenerateOptions& options, const OptionEffects& effects, const InputFiles& inputs,
                    bool is_step, GenerateReport& report) {
    AtomicOutput files({.sink = options.sink,
                        .is_dry_run = options.dry_run,
                        .sync = options.file.sync,
                        .inputs = &inputs,
                        .replaces_inputs = target.in_place});
    reportProgress(options, "writing", 0, 1);
    if (report.changed) {
        writeDocument(document, target, files, report.warnings, options.execution);
    } else {
        writeUnchanged(document, target, files, report.warnings);
    }
    reportProgress(options, "writing", 1, 1);
    reportFiles(input, document, files, report);
    addWarnings(options, effects, is_step, report);
    reportProgress(options, "writing", 1, 1);
    // No step that can fail may follow.
    files.commit();
}

GeneratedModel generateModel(Model&& model, const GenerateOptions& options, bool with_images,
                             const GenerateStep& step) {
    Input input = toInput(std::move(model), "model.glb", true, options);
    GenerateReport report;
    const OptionEffects effects = generate(input, with_images, step, report);
    input.model.reload();
    return {std::move(input.model), std::move(report), effects.attributes_repaired, effects.normals_scaled_count};
}

Result<GenerateReport> generateGltf(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep* step) {
    return atFileBorder([&]() -> Result<GenerateReport> { return generateToFile(input, output, options, step); });
}

}  // namespace tspace::gltf
