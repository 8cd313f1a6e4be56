// SPDX-License-Identifier: MIT
// The glTF pipeline: load, plan, compute pool by pool, put the frames in, write.
#include "commands/generate/generate_gltf.h"
#include "model/read/load_document.h"

#include <algorithm>

#include "commands/generate/cancelled_signs.h"
#include "commands/generate/convert_maps.h"
#include "commands/generate/flip_maps.h"
#include "commands/generate/generate_warnings.h"
#include "commands/generate/mend_values.h"
#include "commands/generate/repair_plan.h"
#include "core/base/parallel.h"
#include "model/gltf/apply_frames.h"
#include "model/gltf/compression/recompress.h"
#include "model/gltf/compute_pools.h"
#include "model/gltf/container.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/plan_surroundings.h"
#include "model/gltf/read_packed.h"
#include "model/gltf/strip_tangents.h"
#include "model/gltf/vertex_numbers.h"
#include "model/gltf/write_packed.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// Pools are computed together up to this many corners for each thread: enough to do, and not too much that waits in
/// memory for its turn to be written.
constexpr std::size_t kCornersPerThread = 500'000;

void tell(const GenerateOptions& options, const char* what, std::uint64_t done, std::uint64_t total) {
    if (options.progress) options.progress(what, done, total);
}

/// How many of the pools, one at least, are computed together. What becomes of them waits in memory too, for those
/// before it to be stored: hence some more than the work itself, and twice as much for several. Fails with tooLarge
/// where the first alone is too much.
std::size_t countTogether(std::span<const Pool> pools, const Document& document, std::span<const Primitive> primitives,
                          const Execution& execution) {
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

/// Bitangents go with tangents that were computed; says where there are none.
void noteMissingBitangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (reports[i].action != PrimitiveAction::kept || primitives[i].find("_BITANGENT")) continue;
        reports[i].notes.emplace_back(
            "its tangents stay, so it gets no bitangents: those are computed only together "
            "(--overwrite)");
    }
}

GenerateReport generate(const std::string& input, const std::string& output_path, const GenerateOptions& requested) {
    GenerateReport report;
    InputFiles inputs;
    GenerateOptions options = requested;
    inputs.watch(options.file);
    tell(options, "reading", 0, 1);
    Document document = loadDocument(input, options.file, options.execution, options.progress);
    // Other formats leave open whose conventions their tangents follow: only those stay that are right in glTF.
    if (document.imported && options.existing == ExistingTangents::keep) options.existing = ExistingTangents::repair;
    const OutputTarget target = outputTarget(document, output_path, options.sink != nullptr);
    checkRequiredExtensions(document);
    report.warnings = document.warnings;
    std::copy_n(document.coordinate_offset.begin(), 3, report.coordinate_offset);
    std::vector<Primitive> primitives = readPrimitives(document);
    const bool removed = removeMiscounted(document, primitives, options.pack);
    const bool converted = target.container != document.container || document.imported;
    const bool keeps_compression = options.compression == Compression::keep;
    if (!keeps_compression) convertContainer(document, target, true, report.warnings);
    const std::string new_file = freeFileName(document, target, ".tspace.bin");
    const bool unpacked = unpackGeometry(document, options.compression, new_file, report.warnings);
    if (unpacked) primitives = readPrimitives(document);
    GeneratePlan plan = planGenerate(document, primitives, options);
    if (options.existing == ExistingTangents::repair) planRepair(document, primitives, options, plan);
    planSurroundings(document, primitives, options, plan);
    MapFlips flips;
    if (options.flip_green != FlipGreen::none || options.mend_maps)
        flips = planFlips(document, primitives, plan.reports, options);
    if (const std::string warning = warnOfCancelledSigns(document, primitives, plan, flips, options); !warning.empty())
        report.warnings.push_back(warning);
    std::optional<MapConversion> maps;
    if (options.convert_maps) maps.emplace(document, primitives, options);
    report.input_bytes = document.input_bytes;
    std::vector<std::vector<std::size_t>> broken;
    if (options.existing != ExistingTangents::keep) broken = findBrokenValues(document, primitives, plan);
    const bool is_unreadable = std::any_of(primitives.begin(), primitives.end(), [](const Primitive& primitive) {
        return !primitive.unreadable_tangents.empty();
    });
    const bool will_edit = !plan.pools.empty() || !flips.images.empty() || !flips.mended.empty() ||
                           options.pack.has_value() || !broken.empty() || is_unreadable;
    if (keeps_compression) convertContainer(document, target, will_edit, report.warnings);
    takeImagesIn(document, target, report.warnings);
    tell(options, "reading", 1, 1);

    Editor editor(document, new_file);
    if (removed) editor.touch();
    if (is_unreadable) removeUnreadableTangents(editor, primitives, plan);
    VertexNumbers numbers(document, editor);
    std::uint64_t total = 0, done = 0;
    for (const Pool& pool : plan.pools) total += pool.corner_count;
    PoolComputer computer(document, primitives, options);
    for (std::span<const Pool> rest = plan.pools; !rest.empty();) {
        tell(options, "computing tangents", done, total);
        const std::span<const Pool> pools = rest.first(countTogether(rest, document, primitives, options.execution));
        rest = rest.subspan(pools.size());
        std::vector<PoolElements> elements = computer.compute(pools, plan.reports);
        for (std::size_t i = 0; i < pools.size(); ++i) {
            if (!elements[i].warning.empty())
                report.warnings.push_back(primitives[pools[i].primitives[0]].place() + ": " + elements[i].warning);
            applyFrames(editor, document, primitives, pools[i], std::move(elements[i]), numbers, plan.reports);
            done += pools[i].corner_count;
        }
    }
    tell(options, "computing tangents", total, total);
    mendBrokenValues(editor, document, primitives, broken, plan.reports);
    if (is_unreadable) noteUnreadableTangents(primitives, plan.reports);
    for (std::string& warning : numbers.warnings()) report.warnings.push_back(std::move(warning));
    if (options.bitangents) noteMissingBitangents(primitives, plan.reports);
    noteStalePackedFrames(document, primitives, options, plan.reports);
    stripTangents(editor, primitives, plan.reports);
    if (maps) report.converted_maps = maps->run(editor, target, plan.reports);
    if (options.pack) writePackedFrames(editor, document, options, plan.reports);
    report.normal_maps = std::move(flips.reports);
    if (!flips.images.empty() || !flips.mended.empty()) applyFlips(document, editor, target, std::move(flips));
    editor.finish();
    const bool packed = packGeometry(document, options.compression, new_file);

    AtomicOutput files({.sink = options.sink,
                        .is_dry_run = options.dry_run,
                        .sync = options.file.sync,
                        .inputs = &inputs,
                        .replaces_inputs = target.in_place});
    tell(options, "writing", 0, 1);
    report.changed = editor.changed() || converted || unpacked || packed;
    if (report.changed) {
        writeDocument(document, target, files, report.warnings, options.execution);
    } else {
        writeUnchanged(document, target, files, report.warnings);
    }
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
    report.primitives = std::move(plan.reports);
    addWarnings(requested, report);
    tell(options, "writing", 1, 1);
    // Nothing that can fail comes after it.
    files.commit();
    return report;
}

}  // namespace

Result<GenerateReport> generateGltf(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    return atFileBorder([&]() -> Result<GenerateReport> { return generate(input, output, options); });
}

}  // namespace tspace::gltf
