// SPDX-License-Identifier: MIT
// The public entry points: checks, and the choice between the plans that group faces and those that do not.
#include "tspace/tangents.h"

#include <memory>
#include <utility>
#include <variant>

#include "core/border.h"
#include "core/parallel.h"
#include "tangents/estimators/group_estimates.h"
#include "tangents/indexed_plan.h"
#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/symmetric_frame.h"

namespace tspace {

struct TangentPlan::State {
    std::variant<IndexedPlan, mikk::EvaluationPlan> plan;
    Method method = Method::mikktspace;
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t output_count = 0;
    bool is_symmetric = false;
    Buffer<std::uint32_t> corner_vertices;  ///< for a symmetric frame, one per corner; empty: outputs are per vertex

    [[nodiscard]] TangentReport evaluate(const Pose& pose, const TangentOutput& out, const Execution& execution,
                                         Parallel& parallel) const {
        if (const auto* indexed = std::get_if<IndexedPlan>(&plan))
            return evaluateIndexed(*indexed, pose, out, execution, parallel);
        const auto& grouped = *std::get_if<mikk::EvaluationPlan>(&plan);
        return mikk::evaluateGroups(grouped, pose, {grouped.uvs.data(), grouped.uvs.size()}, out, execution, parallel);
    }
};

namespace {

bool isGrouped(Method method) {
    return method == Method::mikktspace || method == Method::uniform || method == Method::angle ||
           method == Method::area || method == Method::fast || method == Method::best;
}

Error checkOptions(const TangentOptions& options) {
    if (options.method > Method::best) {
        return makeError(ErrorCode::invalidOption, kNoElement, "unknown method %u",
                         static_cast<unsigned>(options.method));
    }
    if (options.pairing > Pairing::corrected) return {ErrorCode::invalidOption, "unknown pairing"};
    if (options.ngons > Ngons::skip) return {ErrorCode::invalidOption, "unknown treatment of n-gons"};
    if (options.domain > OutputDomain::vertex) return {ErrorCode::invalidOption, "unknown output domain"};
    if (options.refine > 2) return {ErrorCode::invalidOption, "refine is not 0, 1 or 2"};
    if (options.frame > FrameShape::symmetric) return {ErrorCode::invalidOption, "unknown shape of the frame"};
    if (options.frame == FrameShape::symmetric &&
        (options.method == Method::mikktspace || options.method == Method::basis)) {
        return {ErrorCode::invalidOption, "the symmetric frame is not for mikktspace and basis"};
    }
    if (options.domain == OutputDomain::vertex && options.method != Method::lengyel &&
        options.method != Method::basis) {
        return {ErrorCode::invalidOption, "only lengyel and basis have one result per vertex"};
    }
    return {ErrorCode::ok, {}};
}

/// For Parallel: estimators take several times as long as sums.
std::uint64_t work(Method method, std::uint64_t corners) {
    constexpr std::uint64_t kSlow = 4;
    return (estimators::isEstimated(method) ? kSlow : 1) * corners;
}

Error checkInput(const MeshView& mesh, const TangentOptions& options, Parallel& parallel) {
    if (Error e = checkOptions(options); e.code != ErrorCode::ok) return e;
    if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
    if (mesh.vertexCount() == 0) return {ErrorCode::ok, {}};
    if (mesh.normals.empty()) return {ErrorCode::missingAttribute, "tangents need normals, and the mesh has none"};
    if (mesh.uvs.empty() && options.method != Method::basis) {
        return {ErrorCode::missingAttribute, "this method needs UVs, and the mesh has none"};
    }
    if (isGrouped(options.method) && 3 * mikk::countTriangles(mesh, options.ngons) > mikk::kMaxHalfEdges) {
        return {ErrorCode::tooLarge, "more than 715827882 triangles"};
    }
    return {ErrorCode::ok, {}};
}

std::size_t outputCount(const MeshView& mesh, const TangentOptions& options) {
    return options.domain == OutputDomain::vertex ? mesh.vertexCount() : mesh.cornerCount();
}

Error checkOutput(const TangentOutput& out, std::size_t output_count) {
    if (Error e = checkSpan(out.tangents, output_count, "tangents"); e.code != ErrorCode::ok) return e;
    const auto optional = [&](const auto& span, const char* name) {
        return span.empty() ? Error{ErrorCode::ok, {}} : checkSpan(span, output_count, name);
    };
    if (Error e = optional(out.bitangents, "bitangents"); e.code != ErrorCode::ok) return e;
    if (Error e = optional(out.magnitudes_s, "magnitudes_s"); e.code != ErrorCode::ok) return e;
    return optional(out.magnitudes_t, "magnitudes_t");
}

TangentReport generateFrames(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                             Parallel& parallel) {
    if (isGrouped(options.method)) return mikk::generateGrouped(mesh, options, out, parallel);
    const IndexedPlan plan = planIndexed(mesh, options, parallel, PlanUse::once);
    return evaluateIndexed(plan, {mesh.positions, mesh.normals}, out, options.execution, parallel);
}

Error checkPose(const Pose& pose, std::size_t vertex_count) {
    if (pose.positions.count != vertex_count || pose.normals.count != vertex_count) {
        return makeError(ErrorCode::planMismatch, kNoElement,
                         "the pose has %zu positions and %zu normals, the plan needs %zu", pose.positions.count,
                         pose.normals.count, vertex_count);
    }
    if (Error e = checkSpan(pose.positions, vertex_count, "positions"); e.code != ErrorCode::ok) return e;
    return checkSpan(pose.normals, vertex_count, "normals");
}

}  // namespace

TangentPlan::TangentPlan(State* state) : state_(state) {}
TangentPlan::TangentPlan(TangentPlan&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}
TangentPlan& TangentPlan::operator=(TangentPlan&& other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}
TangentPlan::~TangentPlan() { delete state_; }

std::size_t TangentPlan::vertexCount() const { return state_->vertex_count; }
std::size_t TangentPlan::cornerCount() const { return state_->corner_count; }
std::size_t TangentPlan::outputCount() const { return state_->output_count; }
Method TangentPlan::method() const { return state_->method; }
std::size_t TangentPlan::memoryBytes() const {
    return std::visit([](const auto& plan) { return plan.memoryBytes(); }, state_->plan) +
           state_->corner_vertices.size() * sizeof(std::uint32_t);
}

Result<TangentReport> generateTangents(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out) {
    return atBorder([&]() -> Result<TangentReport> {
        Parallel parallel(options.execution, work(options.method, mesh.cornerCount()));
        if (Error e = checkInput(mesh, options, parallel); e.code != ErrorCode::ok) return e;
        if (Error e = checkOutput(out, outputCount(mesh, options)); e.code != ErrorCode::ok) return e;
        if (options.frame == FrameShape::gramSchmidt) return generateFrames(mesh, options, out, parallel);
        const NeededBitangents needed(out, options.execution.allocator);
        const TangentReport report = generateFrames(mesh, options, needed.out, parallel);
        const bool per_vertex = options.domain == OutputDomain::vertex;
        makeSymmetric(
            out.tangents, needed.out.bitangents,
            [&](std::size_t i) { return mesh.normals[per_vertex ? i : mesh.indices[i]]; }, parallel);
        return report;
    });
}

Result<TangentPlan> planTangents(const MeshView& mesh, const TangentOptions& options) {
    return atBorder([&]() -> Result<TangentPlan> {
        Parallel parallel(options.execution, work(options.method, mesh.cornerCount()));
        if (Error e = checkInput(mesh, options, parallel); e.code != ErrorCode::ok) return e;
        auto state = std::make_unique<TangentPlan::State>();
        state->method = options.method;
        state->vertex_count = mesh.vertexCount();
        state->corner_count = mesh.cornerCount();
        state->output_count = outputCount(mesh, options);
        if (isGrouped(options.method)) {
            state->plan = mikk::planGrouped(mesh, options, parallel);
        } else {
            state->plan = planIndexed(mesh, options, parallel);
        }
        state->is_symmetric = options.frame == FrameShape::symmetric;
        if (state->is_symmetric && options.domain == OutputDomain::corner) {
            state->corner_vertices = Buffer<std::uint32_t>(options.execution.allocator, mesh.cornerCount());
            for (std::size_t c = 0; c < mesh.cornerCount(); ++c) state->corner_vertices[c] = mesh.indices[c];
        }
        return TangentPlan(state.release());
    });
}

Result<TangentReport> evaluateTangents(const TangentPlan& plan, const Pose& pose, const TangentOutput& out,
                                       const Execution& execution) {
    return atBorder([&]() -> Result<TangentReport> {
        const TangentPlan::State& state = plan.state();
        if (Error e = checkPose(pose, state.vertex_count); e.code != ErrorCode::ok) return e;
        if (Error e = checkOutput(out, state.output_count); e.code != ErrorCode::ok) {
            if (e.code == ErrorCode::countMismatch) e.code = ErrorCode::planMismatch;
            return e;
        }
        Parallel parallel(execution, work(state.method, state.corner_count));
        if (!state.is_symmetric) return state.evaluate(pose, out, execution, parallel);
        const NeededBitangents needed(out, execution.allocator);
        const TangentReport report = state.evaluate(pose, needed.out, execution, parallel);
        const auto& vertices = state.corner_vertices;
        makeSymmetric(
            out.tangents, needed.out.bitangents,
            [&](std::size_t i) { return pose.normals[vertices.empty() ? i : vertices[i]]; }, parallel);
        return report;
    });
}

}  // namespace tspace
