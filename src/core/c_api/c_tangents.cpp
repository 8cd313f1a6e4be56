// SPDX-License-Identifier: MIT
// C API: tangents, plans, their buffers, and sanitize; an indexed mesh with frames in one call; split and triangulate.
#include "tspace/tangents.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/c_api/c_fields.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/plan_buffers.h"
#include "tspace/tangents.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

/// A plan with the callbacks it was created with, through which it releases its memory.
struct tspace_TangentPlan {
    explicit tspace_TangentPlan(const tspace_Execution* execution) : hooks(execution) {}

    Hooks hooks;
    std::optional<TangentPlan> plan;
};

namespace tspace::c_api {

Error checkOptions(const tspace_TangentOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_TangentOptions options = givenOrDefault(given);
    const bool has_defaults = options.angular_threshold_deg != 0 || options.refine != 0;
    return firstError(
        [&] { return checkInitialized(has_defaults, "TangentOptions", "angular_threshold_deg and refine"); },
        [&] { return checkFields(options); });
}

TangentOptions toOptions(const tspace_TangentOptions& options) {
    TangentOptions result;
    copyFields(options, result);
    return result;
}

}  // namespace tspace::c_api

namespace {

TangentOutput toOutput(const tspace_TangentOutput& given) {
    const tspace_TangentOutput out = givenOrDefault(&given);
    const tspace_ByteSpan& mask = out.has_tangent;
    return {toSpan<Vec4>(out.tangents),
            toSpan<Vec3>(out.bitangents),
            toSpan<float>(out.magnitudes_s),
            toSpan<float>(out.magnitudes_t),
            {mask.data, mask.count, mask.stride_bytes == 0 ? 1 : mask.stride_bytes}};
}

}  // namespace

const char* tspace_methodName(tspace_Method method) noexcept { return methodName(static_cast<Method>(method)); }

tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkRequired(out, "out"); }, [&] { return checkExecution(execution); },
                             [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<TangentReport> result =
            generateTangents(toMesh(*mesh), toOptions(givenOrDefault(options)), toOutput(*out), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}

tspace_ErrorCode tspace_generateTangentsOfMeshes(const tspace_MeshJob* jobs, size_t job_count,
                                                 const tspace_Execution* execution, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (jobs == nullptr && job_count != 0) return Error{ErrorCode::nullData, "jobs is null"};
        if (Error e = checkExecution(execution); e.code != ErrorCode::ok) return e;
        // A job that cannot be converted is replaced by an empty one, and its error is reported afterwards.
        std::vector<MeshJob> converted(job_count);
        std::vector<Error> errors(job_count, Error{ErrorCode::ok});
        for (std::size_t i = 0; i < job_count; ++i) {
            const tspace_MeshJob& job = jobs[i];
            errors[i] = firstError([&] { return checkMesh(job.mesh); }, [&] { return checkOptions(job.options); },
                                   [&] { return checkRequired(job.out, "out"); },
                                   [&] { return checkSized(job.report, "report"); });
            if (errors[i].code == ErrorCode::ok)
                converted[i] = {toMesh(*job.mesh), toOptions(givenOrDefault(job.options)), toOutput(*job.out)};
        }
        const Hooks hooks(execution);
        const auto results = generateTangents(converted, hooks.execution());
        if (!results) return results.error();
        Result<Done> first = Done{};
        for (std::size_t i = job_count; i-- > 0;) {
            const Result<TangentReport>& result = (*results)[i];
            Error& failure = errors[i];
            if (failure.code == ErrorCode::ok && !result) failure = result.error();
            finish(failure, jobs[i].error);
            if (failure.code == ErrorCode::ok) {
                writeReport(toReport(*result), jobs[i].report);
            } else {
                failure.element = i;
                first = std::move(failure);
            }
        }
        return first;
    });
}

tspace_ErrorCode tspace_planTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                     const tspace_Execution* execution, tspace_TangentPlan** plan,
                                     tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (plan == nullptr) return Error{ErrorCode::nullData, "plan is null"};
        *plan = nullptr;
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkExecution(execution); });
        if (e.code != ErrorCode::ok) return e;
        auto made = std::make_unique<tspace_TangentPlan>(execution);
        Result<TangentPlan> result =
            planTangents(toMesh(*mesh), toOptions(givenOrDefault(options)), made->hooks.execution());
        if (!result) return result.error();
        made->plan.emplace(std::move(*result));
        *plan = made.release();
        return Done{};
    });
}

tspace_ErrorCode tspace_evaluateTangents(const tspace_TangentPlan* plan, const tspace_Pose* pose,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (plan == nullptr) return Error{ErrorCode::nullData, "plan is null"};
        Error e = firstError([&] { return checkRequired(pose, "pose"); }, [&] { return checkRequired(out, "out"); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Pose converted{toSpan<Vec3>(pose->positions), toSpan<Vec3>(pose->normals)};
        const Result<TangentReport> result =
            evaluateTangents(*plan->plan, converted, toOutput(*out), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}

tspace_ErrorCode tspace_describeTangentPlan(const tspace_TangentPlan* plan, tspace_TangentPlanInfo* info,
                                            tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (plan == nullptr) return Error{ErrorCode::nullData, "plan is null"};
        if (Error e = checkRequired(info, "info"); e.code != ErrorCode::ok) return e;
        tspace_TangentPlanInfo made;
        TSPACE_INIT(made);
        made.method = static_cast<tspace_Method>(plan->plan->method());
        made.vertex_count = plan->plan->vertexCount();
        made.corner_count = plan->plan->cornerCount();
        made.output_count = plan->plan->outputCount();
        made.memory_bytes = plan->plan->memoryBytes();
        writeReport(made, info);
        return Done{};
    });
}

void tspace_destroyTangentPlan(tspace_TangentPlan* plan) noexcept { delete plan; }

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

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

// C API: an indexed mesh with frames in one call.

/// Struct of the C API (the first base class), followed by the memory that its pointers refer to.
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

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

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

namespace {

// C API: a plan as words for compute shaders.

/// Struct of the C API (the first base class), followed by the memory that its pointer refers to.
struct OwnedPlanBuffers : tspace_PlanBuffers {
    PlanBuffers buffers;
};

/// Converts an array of the C API, which may be null if it has no entries.
Result<std::span<const std::uint32_t>> toNumbers(const std::uint32_t* data, std::size_t count, const char* name) {
    if (data == nullptr && count != 0)
        return makeError(ErrorCode::nullData, kNoElement, "%s is null but its count is not 0", name);
    return std::span{data, count};
}

Error checkBufferOptions(const tspace_PlanBufferOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_PlanBufferOptions options = givenOrDefault(given);
    return firstError(
        [&] {
            return options.mesh == nullptr ? Error{ErrorCode::ok, {}} : checkMesh(options.mesh);
        },
        [&] { return c_api::checkOptions(options.normals); });
}

}  // namespace

tspace_ErrorCode tspace_planBuffers(const tspace_TangentPlan* plan, const tspace_PlanBufferOptions* options,
                                    const tspace_Execution* execution, tspace_PlanBuffers** buffers,
                                    tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (buffers == nullptr) return Error{ErrorCode::nullData, "buffers is null"};
        *buffers = nullptr;
        if (plan == nullptr) return Error{ErrorCode::nullData, "plan is null"};
        const Error e =
            firstError([&] { return checkBufferOptions(options); }, [&] { return checkExecution(execution); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_PlanBufferOptions given = givenOrDefault(options);
        const auto indices = toNumbers(given.indices, given.index_count, "indices");
        if (!indices) return indices.error();
        const auto source_corners = toNumbers(given.source_corners, given.source_corner_count, "source_corners");
        if (!source_corners) return source_corners.error();
        PlanBufferOptions converted{.indices = *indices, .source_corners = *source_corners};
        if (given.mesh != nullptr) converted.mesh = toMesh(*given.mesh);
        converted.normals = toOptions(givenOrDefault(given.normals));
        const Hooks hooks(execution);
        Result<PlanBuffers> made = planBuffers(*plan->plan, converted, hooks.execution());
        if (!made) return made.error();
        auto owned = std::make_unique<OwnedPlanBuffers>();
        owned->buffers = std::move(*made);
        owned->words = owned->buffers.words.data();
        owned->word_count = owned->buffers.words.size();
        owned->result_count = owned->buffers[PlanBuffers::result_count];
        *buffers = owned.release();
        return Done{};
    });
}

void tspace_destroyPlanBuffers(tspace_PlanBuffers* buffers) noexcept { delete static_cast<OwnedPlanBuffers*>(buffers); }
