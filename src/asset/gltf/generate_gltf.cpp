// SPDX-License-Identifier: MIT
// The glTF pipeline: load, plan, compute pool by pool, put the frames in, write.
#include "asset/gltf/generate_gltf.h"

#include <algorithm>

#include "asset/file_error.h"
#include "asset/gltf/apply_frames.h"
#include "asset/gltf/container.h"
#include "asset/gltf/generate_plan.h"
#include "generate/primitive.h"

namespace tspace::gltf {

namespace {

PoolFrames computePool(const Document& document, std::span<const Primitive> primitives, const Pool& pool,
                       const GenerateOptions& options, std::span<PrimitiveReport> reports) {
    const Primitive& first = primitives[pool.primitives[0]];
    VertexPool vertices;
    vertices.positions = readVec3(document, first, "POSITION");
    if (pool.has_normals) vertices.normals = readVec3(document, first, "NORMAL");
    if (pool.uses_uvs) vertices.uvs = readUvs(document, first, pool.uv_set);
    std::vector<PrimitiveGeometry> geometries;
    std::vector<PrimitiveReport> computed;
    for (const PoolGeometry& geometry : pool.geometries) {
        geometries.emplace_back().indices = readTriangleCorners(document, primitives[geometry.primitives[0]]);
        computed.push_back(reports[geometry.primitives[0]]);
    }
    PoolFrames frames = valueOrThrow(computeFrames(vertices, geometries, options, computed));
    if (frames.tangents.size() != frames.source_vertices.size()) {
        failFile(ErrorCode::internal, "no tangents were computed", first.place());
    }
    for (std::size_t i = 0; i < pool.geometries.size(); ++i) {
        for (const std::size_t number : pool.geometries[i].primitives) {
            reports[number].normals = computed[i].normals;
            reports[number].tangents = computed[i].tangents;
            reports[number].sanitize = computed[i].sanitize;
        }
    }
    return frames;
}

void tell(const GenerateOptions& options, const char* what, std::uint64_t done, std::uint64_t total) {
    if (options.progress) options.progress(what, done, total);
}

GenerateReport generate(const std::string& input, const std::string& output_path,
                        const GenerateOptions& options) {
    GenerateReport report;
    tell(options, "reading", 0, 1);
    Document document = loadDocument(input, options.file);
    const OutputTarget target = outputTarget(document, output_path);
    report.warnings = document.warnings;
    for (std::string& warning : checkRequiredExtensions(document))
        report.warnings.push_back(std::move(warning));
    const std::vector<Primitive> primitives = readPrimitives(document);
    GeneratePlan plan = planGenerate(document, primitives, options);
    report.input_bytes = document.input_bytes;
    const bool converted = target.container != document.container;
    convertContainer(document, target, !plan.pools.empty(), report.warnings);
    tell(options, "reading", 1, 1);

    Editor editor(document, freeFileName(document, target, ".tspace.bin"));
    std::uint64_t total = 0, done = 0;
    for (const Pool& pool : plan.pools) total += pool.corner_count;
    for (const Pool& pool : plan.pools) {
        tell(options, "computing tangents", done, total);
        const PoolFrames frames = computePool(document, primitives, pool, options, plan.reports);
        applyFrames(editor, document, primitives, pool, frames, plan.reports);
        done += pool.corner_count;
    }
    tell(options, "computing tangents", total, total);
    editor.finish();

    AtomicOutput files;
    tell(options, "writing", 0, 1);
    if (editor.changed() || converted) {
        writeDocument(document, target, files, report.warnings);
    } else {
        writeUnchanged(document, target, files, report.warnings);
    }
    files.commit();
    tell(options, "writing", 1, 1);
    report.changed = editor.changed() || converted;
    report.output_files = files.files();
    report.output_bytes = files.files().empty() ? document.input_bytes : files.byteCount();
    report.primitives = std::move(plan.reports);
    return report;
}

}  // namespace

Result<GenerateReport> generateGltf(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    return atFileBorder([&]() -> Result<GenerateReport> { return generate(input, output, options); });
}

}  // namespace tspace::gltf
