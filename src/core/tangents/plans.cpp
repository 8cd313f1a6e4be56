// SPDX-License-Identifier: MIT
// Plans that the caller keeps: planTangents, evaluateTangents, and TangentPlan.
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/frames/one_list.h"
#include "core/tangents/plan_parts.h"
#include "core/tangents/tangents_call.h"

namespace tspace {

struct TangentPlan::State {
    std::variant<IndexedPlan, mikk::EvaluationPlan> plan;
    Method method = Method::mikktspace;
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t output_count = 0;
    bool is_symmetric = false;
    bool normalizes_normals = false;
    bool positive_is_mirrored = false;
    /// vertex of each corner, for a symmetric frame; empty: outputs are per vertex
    Buffer<std::uint32_t> corner_vertices;
    std::size_t normal_count = 0;  ///< number of normals in a pose
    /// Indices of the pose's position and normal for each vertex of the plan, for a mesh with several index lists.
    std::vector<std::uint32_t> source_vertices, source_normals;

    [[nodiscard]] TangentReport evaluate(const Pose& pose, const TangentOutput& out, const Execution& execution,
                                         Parallel& parallel) const {
        const auto counted = [&](const TangentReport& report) {
            return inConvention(report, method, positive_is_mirrored);
        };
        if (const auto* indexed = std::get_if<IndexedPlan>(&plan))
            return counted(evaluateIndexed(*indexed, pose, out, execution, parallel));
        const auto& grouped = *std::get_if<mikk::EvaluationPlan>(&plan);
        return counted(
            mikk::evaluateGroups(grouped, pose, {grouped.uvs.data(), grouped.uvs.size()}, out, execution, parallel));
    }

    /// Calls evaluate(), and applies the requested frame shape.
    [[nodiscard]] TangentReport evaluateFrames(const Pose& pose, const TangentOutput& out, const Execution& execution,
                                               Parallel& parallel) const {
        if (!is_symmetric) return evaluate(pose, out, execution, parallel);
        const NeededBitangents needed(out, execution.allocator);
        const TangentReport report = evaluate(pose, needed.out, execution, parallel);
        makeSymmetric(
            out.tangents, needed.out.bitangents,
            [&](std::size_t i) { return pose.normals[corner_vertices.empty() ? i : corner_vertices[i]]; }, parallel);
        return report;
    }
};

namespace {

Error checkPose(const Pose& pose, std::size_t vertex_count, std::size_t normal_count) {
    if (pose.positions.count != vertex_count || pose.normals.count != normal_count) {
        return makeError(ErrorCode::planMismatch, kNoElement,
                         "the pose has %zu positions and %zu normals, but the plan needs %zu and %zu",
                         pose.positions.count, pose.normals.count, vertex_count, normal_count);
    }
    if (Error e = checkSpan(pose.positions, vertex_count, "positions"); e.code != ErrorCode::ok) return e;
    return checkSpan(pose.normals, normal_count, "normals");
}

Buffer<Vec3> gathered(const StridedSpan<const Vec3>& values, const std::vector<std::uint32_t>& sources,
                      const Allocator* allocator) {
    Buffer<Vec3> result(allocator, sources.size());
    gather<Vec3>(values, sources, result.data());
    return result;
}

Result<std::unique_ptr<TangentPlan::State>> makePlan(const MeshView& given, const Call<TangentOptions>& options) {
    Parallel parallel(options.execution, tangentWork(options.method, given.cornerCount()));
    if (Error e = checkInput(given, options, parallel); e.code != ErrorCode::ok) return e;
    const UnitNormals normals(given.normals, options.normalize_normals, options.execution.allocator, parallel);
    const MeshView mesh = withNormals(given, normals);
    auto state = std::make_unique<TangentPlan::State>();
    state->method = options.method;
    state->normalizes_normals = options.normalize_normals;
    state->positive_is_mirrored = positiveUvsAreMirrored(options.convention);
    state->vertex_count = state->normal_count = mesh.vertexCount();
    state->corner_count = mesh.cornerCount();
    state->output_count = outputCount(mesh, options);
    if (isGrouped(options.method))
        state->plan = mikk::planGrouped(mesh, options, parallel);
    else
        state->plan = planIndexed(mesh, options, parallel);
    state->is_symmetric = options.frame == FrameShape::symmetric;
    if (state->is_symmetric && options.domain == OutputDomain::corner) {
        state->corner_vertices = Buffer<std::uint32_t>(options.execution.allocator, mesh.cornerCount());
        for (std::size_t c = 0; c < mesh.cornerCount(); ++c) state->corner_vertices[c] = mesh.indices[c];
    }
    return state;
}

/// Creates the plan of a mesh with several index lists: the plan of the equivalent mesh with one list, and the sources
/// of its vertices.
Result<std::unique_ptr<TangentPlan::State>> planLists(const MeshView& mesh, const Call<TangentOptions>& options) {
    if (Error e = checkDomain(options); e.code != ErrorCode::ok) return e;
    if (Result<Done> valid = validate(mesh); !valid) return std::move(valid).error();
    OneListMesh made;
    if (Result<Done> done = useOneList(mesh, options.execution, made); !done) return std::move(done).error();
    Result<std::unique_ptr<TangentPlan::State>> state = makePlan(made.view, options);
    if (!state) return state;
    (*state)->vertex_count = mesh.vertexCount();
    (*state)->normal_count = mesh.normals.count;
    (*state)->source_vertices = std::move(made.source_vertices);
    (*state)->source_normals = std::move(made.source_normals);
    return state;
}

}  // namespace

TangentPlan::TangentPlan(State* state) : state_(state) {}
TangentPlan::TangentPlan(TangentPlan&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}
TangentPlan& TangentPlan::operator=(TangentPlan&& other) noexcept {
    TangentPlan taken(std::move(other));
    std::swap(state_, taken.state_);
    return *this;
}
TangentPlan::~TangentPlan() { delete state_; }

const TangentPlan::State& TangentPlan::state() const {
    static const State kMovedFrom;
    return state_ == nullptr ? kMovedFrom : *state_;
}

PlanParts partsOf(const TangentPlan& plan) {
    const TangentPlan::State& state = plan.state();
    return {std::get_if<mikk::EvaluationPlan>(&state.plan), std::get_if<IndexedPlan>(&state.plan), state.is_symmetric,
            state.normalizes_normals, !state.source_vertices.empty()};
}

std::size_t TangentPlan::vertexCount() const { return state().vertex_count; }
std::size_t TangentPlan::cornerCount() const { return state().corner_count; }
std::size_t TangentPlan::outputCount() const { return state().output_count; }
Method TangentPlan::method() const { return state().method; }
std::size_t TangentPlan::memoryBytes() const {
    const std::size_t indices =
        state().corner_vertices.size() + state().source_vertices.size() + state().source_normals.size();
    return std::visit([](const auto& plan) { return plan.memoryBytes(); }, state().plan) +
           indices * sizeof(std::uint32_t);
}

Result<TangentPlan> planTangents(const MeshView& mesh, const TangentOptions& options, const Execution& execution) {
    return atBorder([&]() -> Result<TangentPlan> {
        const Call<TangentOptions> call{options, execution};
        Result<std::unique_ptr<TangentPlan::State>> state =
            hasOwnLists(mesh) ? planLists(mesh, call) : makePlan(mesh, call);
        if (!state) return std::move(state).error();
        return TangentPlan((*state).release());
    });
}

Result<TangentReport> evaluateTangents(const TangentPlan& plan, const Pose& pose, const TangentOutput& out,
                                       const Execution& execution) {
    return atBorder([&]() -> Result<TangentReport> {
        const TangentPlan::State& state = plan.state();
        if (Error e = checkPose(pose, state.vertex_count, state.normal_count); e.code != ErrorCode::ok) return e;
        if (Error e = checkOutput(out, state.output_count); e.code != ErrorCode::ok) {
            if (e.code == ErrorCode::countMismatch) e.code = ErrorCode::planMismatch;
            return e;
        }
        Parallel parallel(execution, tangentWork(state.method, state.corner_count));
        startHasTangent(out, parallel);
        const UnitNormals unit(pose.normals, state.normalizes_normals, execution.allocator, parallel);
        if (state.source_vertices.empty())
            return state.evaluateFrames({pose.positions, unit.view()}, out, execution, parallel);
        const Buffer<Vec3> positions = gathered(pose.positions, state.source_vertices, execution.allocator);
        const Buffer<Vec3> normals = gathered(unit.view(), state.source_normals, execution.allocator);
        const Pose with_one_list{{positions.data(), positions.size()}, {normals.data(), normals.size()}};
        return state.evaluateFrames(with_one_list, out, execution, parallel);
    });
}

}  // namespace tspace
