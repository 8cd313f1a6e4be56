// SPDX-License-Identifier: MIT
// C API: tangents of many meshes; plans, and their buffers.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/c_api/c_fields.h"
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
