// SPDX-License-Identifier: MIT
// C API: an indexed mesh with frames in one call.
#include "tspace/indexed_frames.h"

#include <memory>
#include <utility>

#include "core/c_api/c_convert.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

/// The struct of the C API, as the first base, and the memory that its pointers point into.
struct OwnedFrames : tspace_IndexedFrames {
    explicit OwnedFrames(IndexedFrames&& made)
        : tspace_IndexedFrames(),
          frames(std::move(made)),
          normals_made_of(toReport(frames.report.normals)),
          tangents_made_of(toReport(frames.report.tangents)),
          mended(toReport(frames.report.sanitize)) {
        indices = frames.indices.data();
        corner_count = frames.indices.size();
        source_vertices = frames.source_vertices.data();
        source_corners = frames.source_corners.data();
        normals = frames.normals.empty() ? nullptr : &frames.normals.front().x;
        tangents = frames.tangents.empty() ? nullptr : &frames.tangents.front().x;
        vertex_count = frames.vertexCount();
        normal_report = frames.report.normals_made ? &normals_made_of : nullptr;
        tangent_report = &tangents_made_of;
        sanitize_report = &mended;
    }
    OwnedFrames(const OwnedFrames&) = delete;
    OwnedFrames& operator=(const OwnedFrames&) = delete;

    IndexedFrames frames;
    tspace_NormalReport normals_made_of;
    tspace_TangentReport tangents_made_of;
    tspace_SanitizeReport mended;
};

Error checkOptions(const tspace_IndexedFramesOptions* given) {
    if (Error error = checkNeeded(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_IndexedFramesOptions options = orDefault(given);
    return firstError([&] { return c_api::checkOptions(options.tangents); },
                      [&] { return c_api::checkOptions(options.normals); },
                      [&] { return checkChoice(options.make_normals, 1, "make_normals"); },
                      [&] { return checkChoice(options.sanitize, 1, "sanitize"); },
                      [&] { return checkChoice(options.orthogonalize_all, 1, "orthogonalize_all"); });
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
        const tspace_IndexedFramesOptions given = orDefault(options);
        const Result<std::vector<CornerAttribute>> keep_apart =
            toAttributes(given.keep_apart, given.keep_apart_count, "keep_apart");
        if (!keep_apart) return keep_apart.error();
        const Hooks hooks(execution);
        IndexedFramesOptions converted;
        converted.tangents = toOptions(orDefault(given.tangents));
        converted.normals = toOptions(orDefault(given.normals));
        converted.make_normals = given.make_normals != 0;
        converted.sanitize = given.sanitize != 0;
        converted.orthogonalize_all = given.orthogonalize_all != 0;
        converted.keep_apart = *keep_apart;
        Result<IndexedFrames> made = makeIndexedFrames(toMesh(*mesh), converted, hooks.execution());
        if (!made) return made.error();
        *frames = std::make_unique<OwnedFrames>(std::move(*made)).release();
        return Done{};
    });
}

void tspace_destroyIndexedFrames(tspace_IndexedFrames* frames) noexcept { delete static_cast<OwnedFrames*>(frames); }
