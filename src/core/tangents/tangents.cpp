// SPDX-License-Identifier: MIT
// Entry points of mikktspace/, then the public functions: validation, the symmetric frame, and the choice between plans
// with and without groups.
#include "core/tangents/mikktspace/evaluate.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/unit_normals.h"
#include "core/base/vec_math.h"
#include "core/frames/one_list.h"
#include "core/tangents/estimators/group_estimates.h"
#include "core/tangents/indexed_methods.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/groups.h"
#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/vertex_path.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mirrored_count.h"
#include "core/tangents/plan_parts.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

// Entry points of mikktspace/: generateGrouped computes a mesh in its own pose, planGrouped creates a plan for other
// poses.

namespace {

/// Sizes of scratch memory. Meshes of at most kSmallMesh corners allocate it from one block: many small allocations
/// would take a fifth of the time. Most meshes need kBytesPerCorner; blocks above kLargestBlock are not used, because
/// the system unmaps them after each call. The vertex path may need more memory, which comes from the caller's
/// allocator.
constexpr std::size_t kSmallMesh = 4096, kBytesPerCorner = 32, kLeastBlock = 4096, kLargestBlock = 98304,
                      kStackRoom = 8192;

/// Returns the memory of the tangents, which serves as scratch memory until they are written at the end.
std::span<std::byte> unwritten(const TangentOutput& out) {
    if (out.tangents.stride_bytes != sizeof(Vec4)) return {};
    return {reinterpret_cast<std::byte*>(out.tangents.data), out.tangents.count * sizeof(Vec4)};
}

/// Finds the last bucket of a finite mesh, for Pairing::reference. Returns an empty one for other meshes, for which the
/// reference's order is not reproduced.
LastBucket lastBucketOf(const WeldedMesh& welded, const Call<TangentOptions>& options, const Allocator* transient,
                        Parallel& parallel) {
    if (!isMikktspace(options.method) || options.pairing != Pairing::reference || !welded.nodes.all_finite) return {};
    return findLastBucket(welded, transient, options.execution.allocator, parallel);
}

/// Generates tangents with a plan for this call only: for angular thresholds, and if one-pass evaluation is not
/// compiled in.
TangentReport planAndEvaluate(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel) {
    const EvaluationPlan plan = planGrouped(mesh, options, parallel, PlanUse::once);
    return evaluateGroups(plan, {mesh.positions, mesh.normals}, mesh.uvs, out, options.execution, parallel);
}

TangentReport generateWith(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                           Parallel& parallel) {
    const bool may_separate = isMikktspace(options.method) && thresholdCosine(options.angular_threshold_deg) != -1.0f;
    if (may_separate && mesh.cornerCount() > kTermCorners) return planAndEvaluate(mesh, options, out, parallel);
    const Allocator* allocator = options.execution.allocator;
    const TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    ScratchBlock transient(allocator, unwritten(out));
    Nodes nodes = weld(mesh, triangles, allocator, parallel, transient.allocator());
    if (isSmall({mesh, triangles, nodes}, options.method)) {
        listVertices(nodes, allocator);
        return evaluateSmall({mesh, triangles, nodes}, options, out, transient.allocator(), parallel);
    }
    const LastBucket bucket = lastBucketOf({mesh, triangles, nodes}, options, transient.allocator(), parallel);
    listVertices(nodes, allocator);
    const NodeSetting setting{{mesh, triangles, nodes}, options, bucket};
    if (may_separate) return planAndEvaluate(mesh, options, out, parallel);
    return evaluateInOnePass(setting, out, transient, parallel);
}

}  // namespace

TangentReport generateGrouped(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel) {
    if (!kHasOnePass) return planAndEvaluate(mesh, options, out, parallel);
    const std::size_t corners = mesh.cornerCount();
    if (corners > kSmallMesh) return generateWith(mesh, options, out, parallel);
    const std::size_t bytes = std::min(kLeastBlock + corners * kBytesPerCorner, kLargestBlock);
    const Allocator* allocator = options.execution.allocator;
    alignas(kMemoryAlignment) std::byte room[kStackRoom];
    ScratchBlock scratch =
        bytes <= kStackRoom ? ScratchBlock(allocator, std::span(room)) : ScratchBlock(allocator, bytes);
    Call<TangentOptions> small = options;
    small.execution.allocator = scratch.allocator();
    return generateWith(mesh, small, out, parallel);
}

EvaluationPlan planGrouped(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel, PlanUse use) {
    const Allocator* allocator = options.execution.allocator;
    TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    Nodes nodes = weld(mesh, triangles, allocator, parallel);
    const LastBucket bucket = lastBucketOf({mesh, triangles, nodes}, options, allocator, parallel);
    listVertices(nodes, allocator);
    const Buffer<std::uint32_t> all = numbersBelow(nodes.count, allocator);
    const NodeSetting setting{{mesh, triangles, nodes}, options, bucket};
    EvaluationPlan plan = planChosen({setting, {all.data(), all.size()}, true, use, parallel});
    plan.skipped_corners = std::move(triangles.skipped_corners);
    plan.report.triangle_count = triangles.count;
    plan.report.skipped_face_count = triangles.skipped_face_count;
    plan.report.reference_order_abandoned |= bucket.abandoned;
    return plan;
}

}  // namespace tspace::mikk

namespace tspace {

namespace {

/// FrameShape::symmetric: the orthonormal frame closest to dP/du and dP/dv, with equal weights. Returns the tangent of
/// that frame, or `tangent` if one of the three vectors has no direction.
/// Based on: Löwdin, "On the Non-Orthogonality Problem", 1950 (symmetric orthogonalization), here for two unit vectors.
Vec3 symmetricTangent(const Vec3& tangent, const Vec3& bitangent, const Vec3& normal) {
    DVec3 n = toDouble(normal);
    if (!normalize(n)) return tangent;
    const auto across = [&](const Vec3& v) { return toDouble(v) - dot(n, toDouble(v)) * n; };
    DVec3 t = across(tangent), b = across(bitangent);
    if (!normalize(t) || !normalize(b)) return tangent;
    // This is perpendicular to the bitangent, on the tangent's side: the opposite direction would belong to the
    // opposite orientation of the UVs or of N.
    DVec3 p = cross(b, n);
    if (dot(p, t) < 0) p = -1.0 * p;
    DVec3 sum = t + p;
    return normalize(sum) ? toFloat(sum) : tangent;
}

/// Rotates each tangent, in the plane perpendicular to its normal, half of the way to the direction perpendicular to
/// the bitangent: cross(N, T) and T then both deviate by half of the UVs' shear, while T alone was exact before.
/// normalOf(i): the normal of entry i. An entry without tangent, bitangent or normal is unchanged.
template <class NormalOf>
void makeSymmetric(const StridedSpan<Vec4>& tangents, const StridedSpan<Vec3>& bitangents, const NormalOf& normalOf,
                   Parallel& parallel) {
    parallel.forRanges(tangents.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec4& tangent = tangents[i];
            const Vec3 turned = symmetricTangent(xyz(tangent), bitangents[i], normalOf(i));
            tangent = {turned.x, turned.y, turned.z, tangent.w};
        }
    });
}

/// Memory for bitangents that the caller did not request, but that the symmetric frame needs.
struct NeededBitangents {
    Buffer<Vec3> own;
    TangentOutput out;

    NeededBitangents(const TangentOutput& wanted, const Allocator* allocator) : out(wanted) {
        if (!wanted.bitangents.empty()) return;
        own = Buffer<Vec3>(allocator, wanted.tangents.count);
        out.bitangents = {own.data(), own.size()};
    }
};

}  // namespace

namespace {

/// Adapts the report to the convention: methods count triangles with negative UV area as mirrored.
TangentReport inConvention(TangentReport report, Method method, bool positive_is_mirrored) {
    if (positive_is_mirrored) report.mirrored_count = notMirroredCount(report, method);
    return report;
}

}  // namespace

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

Error checkOptions(const TangentOptions& options) {
    if (options.method > kLastMethod) {
        return makeError(ErrorCode::invalidOption, kNoElement, "method is %u, which is not a value of Method",
                         static_cast<unsigned>(options.method));
    }
    if (options.convention.v_axis == VAxis::unset) {
        return {ErrorCode::invalidOption,
                "the convention is not set, but signs depend on it: use the preset \"gltf\" for glTF, or \"opengl\" "
                "for signs as MikkTSpace returns them"};
    }
    if (options.convention.v_axis > VAxis::down)
        return {ErrorCode::invalidOption, "the v axis of the convention is not a value of VAxis"};
    if (options.pairing > Pairing::corrected) return {ErrorCode::invalidOption, "pairing is not a value of Pairing"};
    if (options.ngons > Ngons::skip) return {ErrorCode::invalidOption, "ngons is not a value of Ngons"};
    if (options.domain > OutputDomain::vertex)
        return {ErrorCode::invalidOption, "domain is not a value of OutputDomain"};
    if (options.refine > 2) return {ErrorCode::invalidOption, "refine must be 0, 1 or 2"};
    if (options.frame > FrameShape::symmetric) return {ErrorCode::invalidOption, "frame is not a value of FrameShape"};
    if (options.frame == FrameShape::symmetric &&
        (options.method == Method::mikktspace || options.method == Method::basis)) {
        return {ErrorCode::invalidOption,
                "the symmetric frame cannot be combined with the methods mikktspace and basis"};
    }
    if (options.domain == OutputDomain::vertex && options.method != Method::lengyel &&
        options.method != Method::basis) {
        return {ErrorCode::invalidOption, "only the methods lengyel and basis support one result per vertex"};
    }
    return {ErrorCode::ok, {}};
}

Error checkInput(const MeshView& mesh, const TangentOptions& options, Parallel& parallel) {
    if (Error e = checkOptions(options); e.code != ErrorCode::ok) return e;
    if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
    if (mesh.vertexCount() == 0) return {ErrorCode::ok, {}};
    if (mesh.normals.empty()) return {ErrorCode::missingAttribute, "tangents need normals, but the mesh has none"};
    if (mesh.uvs.empty() && options.method != Method::basis) {
        return {ErrorCode::missingAttribute, "this method needs UVs, but the mesh has none"};
    }
    if (isGrouped(options.method) && 3 * mikk::countTriangles(mesh, options.ngons) > mikk::kMaxHalfEdges) {
        return {ErrorCode::tooLarge, "the mesh has more than 715827882 triangles"};
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
    if (Error e = optional(out.magnitudes_t, "magnitudes_t"); e.code != ErrorCode::ok) return e;
    return optional(out.has_tangent, "has_tangent");
}

/// Initializes has_tangent to 1: methods clear the entries of outputs without a contributing face.
void startHasTangent(const TangentOutput& out, Parallel& parallel) {
    parallel.forRanges(out.has_tangent.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out.has_tangent[i] = 1;
    });
}

TangentReport generateFrames(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                             Parallel& parallel) {
    const auto generated = [&] {
        if (isGrouped(options.method)) return mikk::generateGrouped(mesh, options, out, parallel);
        const IndexedPlan plan = planIndexed(mesh, options, parallel, PlanUse::once);
        return evaluateIndexed(plan, {mesh.positions, mesh.normals}, out, options.execution, parallel);
    };
    return inConvention(generated(), options.method, positiveUvsAreMirrored(options.convention));
}

MeshView withNormals(MeshView mesh, const UnitNormals& normals) {
    mesh.normals = normals.view();
    return mesh;
}

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

/// Checks the domain for a mesh with several index lists. Its vertices are combinations that the caller does not know,
/// so results per vertex are not possible.
Error checkDomain(const TangentOptions& options) {
    if (options.domain == OutputDomain::corner) return {ErrorCode::ok, {}};
    return {ErrorCode::invalidOption, "results per vertex need a mesh with a single index list"};
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

const char* methodName(Method method) {
    static constexpr const char* kNames[] = {"mikktspace", "lengyel", "uniform", "angle", "area",
                                             "flat",       "basis",   "fast",    "best"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Method::best) + 1);
    const auto number = static_cast<std::size_t>(method);
    return number < std::size(kNames) ? kNames[number] : "unknown";
}

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

Result<TangentReport> generateTangents(const MeshView& given, const TangentOptions& options, const TangentOutput& out,
                                       const Execution& execution) {
    return atBorder([&]() -> Result<TangentReport> {
        if (hasOwnLists(given)) {
            if (Error e = checkDomain(options); e.code != ErrorCode::ok) return e;
            return withOneList(given, execution, [&](const MeshView& with_one_list) {
                return generateTangents(with_one_list, options, out, execution);
            });
        }
        const Call<TangentOptions> call{options, execution};
        Parallel parallel(execution, tangentWork(options.method, given.cornerCount()));
        if (Error e = checkInput(given, options, parallel); e.code != ErrorCode::ok) return e;
        if (Error e = checkOutput(out, outputCount(given, options)); e.code != ErrorCode::ok) return e;
        startHasTangent(out, parallel);
        const UnitNormals normals(given.normals, options.normalize_normals, execution.allocator, parallel);
        const MeshView mesh = withNormals(given, normals);
        if (options.frame == FrameShape::gramSchmidt) return generateFrames(mesh, call, out, parallel);
        const NeededBitangents needed(out, execution.allocator);
        const TangentReport report = generateFrames(mesh, call, needed.out, parallel);
        const bool per_vertex = options.domain == OutputDomain::vertex;
        makeSymmetric(
            out.tangents, needed.out.bitangents,
            [&](std::size_t i) { return mesh.normals[per_vertex ? i : mesh.indices[i]]; }, parallel);
        return report;
    });
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
