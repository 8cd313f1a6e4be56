// SPDX-License-Identifier: MIT
// C API: sanitize; an indexed mesh with frames in one call; split and triangulate.
#include <memory>
#include <utility>
#include <vector>

#include "core/c_api/c_fields.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

tspace_ErrorCode tspace_initSanitizeOptions(tspace_SanitizeOptions* options, uint32_t struct_size,
                                            tspace_Error* error) noexcept {
    return init(options, struct_size, "options", error);
}

tspace_ErrorCode tspace_initIndexedFramesOptions(tspace_IndexedFramesOptions* options, uint32_t struct_size,
                                                 tspace_Error* error) noexcept {
    return init(options, struct_size, "options", error);
}

tspace_ErrorCode tspace_sanitizeTangents(const tspace_Mesh* mesh, const tspace_SanitizeOptions* options,
                                         tspace_Span tangents, const tspace_Execution* execution,
                                         tspace_SanitizeReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkSized(options, "options"); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_SanitizeOptions given = givenOrDefault(options);
        e = checkFields(given);
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<SanitizeReport> result =
            sanitizeTangents(toMesh(*mesh), {given.orthogonalize_all != 0}, toSpan<Vec4>(tangents), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}

namespace {

// C API: an indexed mesh with frames in one call.

/// Struct of the C API (the first base class), followed by the memory that its pointers refer to.
struct OwnedFrames : tspace_IndexedFrames {
    explicit OwnedFrames(IndexedFrames&& made)
        : tspace_IndexedFrames(), frames(std::move(made)), own_normal_report(toReport(frames.report.normals)),
          own_tangent_report(toReport(frames.report.tangents)), own_sanitize_report(toReport(frames.report.sanitize)) {
        indices = frames.indices.data();
        corner_count = frames.indices.size();
        source_vertices = frames.source_vertices.data();
        source_corners = frames.source_corners.data();
        normals = frames.normals.empty() ? nullptr : &frames.normals.front().x;
        tangents = frames.tangents.empty() ? nullptr : &frames.tangents.front().x;
        vertex_count = frames.vertexCount();
        normal_report = frames.report.normals_made ? &own_normal_report : nullptr;
        tangent_report = &own_tangent_report;
        sanitize_report = &own_sanitize_report;
    }
    OwnedFrames(const OwnedFrames&) = delete;
    OwnedFrames& operator=(const OwnedFrames&) = delete;

    IndexedFrames frames;
    tspace_NormalReport own_normal_report;
    tspace_TangentReport own_tangent_report;
    tspace_SanitizeReport own_sanitize_report;
};

Error checkOptions(const tspace_IndexedFramesOptions* given) {
    if (Error error = checkRequired(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_IndexedFramesOptions options = givenOrDefault(given);
    return firstError([&] { return c_api::checkOptions(options.tangents); },
                      [&] { return c_api::checkOptions(options.normals); }, [&] { return checkFields(options); });
}

}  // namespace

tspace_ErrorCode tspace_makeIndexedFrames(const tspace_Mesh* mesh, const tspace_IndexedFramesOptions* options,
                                          const tspace_Execution* execution, tspace_IndexedFrames** frames,
                                          tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (frames == nullptr) return Error{ErrorCode::nullData, "frames is null"};
        *frames = nullptr;
        const Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                                   [&] { return checkExecution(execution); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_IndexedFramesOptions given = givenOrDefault(options);
        const Result<std::vector<CornerAttribute>> keep_apart =
            toAttributes(given.keep_apart, given.keep_apart_count, "keep_apart");
        if (!keep_apart) return keep_apart.error();
        const Hooks hooks(execution);
        IndexedFramesOptions converted;
        copyFields(given, converted);
        converted.tangents = toOptions(givenOrDefault(given.tangents));
        converted.normals = toOptions(givenOrDefault(given.normals));
        converted.keep_apart = *keep_apart;
        Result<IndexedFrames> made = makeIndexedFrames(toMesh(*mesh), converted, hooks.execution());
        if (!made) return made.error();
        *frames = std::make_unique<OwnedFrames>(std::move(*made)).release();
        return Done{};
    });
}

void tspace_destroyIndexedFrames(tspace_IndexedFrames* frames) noexcept { delete static_cast<OwnedFrames*>(frames); }

namespace {

// C API: split and triangulate, whose results the library owns until the caller destroys them.

/// Struct of the C API (the first base class), followed by the memory that its pointers refer to.
struct OwnedSplit : tspace_SplitResult {
    SplitResult result;
};

struct OwnedTriangulation : tspace_Triangulation {
    Triangulation result;
};

}  // namespace

namespace tspace::c_api {

Result<std::vector<CornerAttribute>> toAttributes(const tspace_CornerAttribute* attributes, std::size_t count,
                                                  const char* name) {
    std::vector<CornerAttribute> result;
    if (count == 0) return result;
    if (attributes == nullptr)
        return makeError(ErrorCode::nullData, kNoElement, "%s is null, but %s_count is not 0", name, name);
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const tspace_CornerAttribute& given = attributes[i];
        const std::size_t tight = sizeof(float) * given.component_count;
        result.push_back(
            {given.data, given.stride_bytes == 0 ? tight : given.stride_bytes, given.component_count, given.tolerance});
    }
    return result;
}

}  // namespace tspace::c_api

tspace_ErrorCode tspace_splitVertices(const tspace_Indices* indices, size_t vertex_count, size_t corner_count,
                                      const tspace_CornerAttribute* attributes, size_t attribute_count,
                                      const tspace_Execution* execution, tspace_SplitResult** result,
                                      tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (result == nullptr) return Error{ErrorCode::nullData, "result is null"};
        *result = nullptr;
        const Result<std::vector<CornerAttribute>> converted = toAttributes(attributes, attribute_count, "attribute");
        if (!converted) return converted.error();
        if (Error e = checkExecution(execution); e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const IndexView view = indices == nullptr ? IndexView() : toIndices(*indices);
        Result<SplitResult> split = splitVertices(view, vertex_count, corner_count, *converted, hooks.execution());
        if (!split) return split.error();
        auto owned = std::make_unique<OwnedSplit>();
        owned->result = std::move(*split);
        owned->indices = owned->result.indices.data();
        owned->corner_count = owned->result.indices.size();
        owned->source_vertices = owned->result.source_vertices.data();
        owned->source_corners = owned->result.source_corners.data();
        owned->vertex_count = owned->result.vertexCount();
        *result = owned.release();
        return Done{};
    });
}

void tspace_destroySplitResult(tspace_SplitResult* result) noexcept { delete static_cast<OwnedSplit*>(result); }

tspace_ErrorCode tspace_triangulate(const tspace_Mesh* mesh, tspace_Triangulation** result,
                                    tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (result == nullptr) return Error{ErrorCode::nullData, "result is null"};
        *result = nullptr;
        if (Error e = checkMesh(mesh); e.code != ErrorCode::ok) return e;
        Result<Triangulation> cut = triangulate(toMesh(*mesh));
        if (!cut) return cut.error();
        auto owned = std::make_unique<OwnedTriangulation>();
        owned->result = std::move(*cut);
        owned->corners = owned->result.corners.data();
        owned->faces = owned->result.faces.data();
        owned->triangle_count = owned->result.faces.size();
        *result = owned.release();
        return Done{};
    });
}

void tspace_destroyTriangulation(tspace_Triangulation* result) noexcept {
    delete static_cast<OwnedTriangulation*>(result);
}
