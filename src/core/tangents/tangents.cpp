// SPDX-License-Identifier: MIT
// Entry points of mikktspace/, then generateTangents: validation, and the choice between methods with and without
// groups.
#include "core/tangents/mikktspace/evaluate.h"

#include <algorithm>
#include <utility>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/frames/one_list.h"
#include "core/tangents/indexed_methods.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/groups.h"
#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/vertex_path.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/tangents_call.h"
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
    if (kIsMinimal) return planAndEvaluate(mesh, options, out, parallel);
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

Error checkOptions(const TangentOptions& options) {
    if (!kHasAllMethods && options.method != Method::mikktspace) {
        return {ErrorCode::invalidOption,
                "this build has no other method than mikktspace: it was compiled with TSPACE_MIKKTSPACE_ONLY"};
    }
    if (options.method > Method::best) {
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

}  // namespace

Error checkInput(const MeshView& mesh, const TangentOptions& options, Parallel& parallel) {
    if (Error e = checkOptions(options); e.code != ErrorCode::ok) return e;
    if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
    if (mesh.vertexCount() == 0) return {ErrorCode::ok, {}};
    if (mesh.normals.empty()) return {ErrorCode::missingAttribute, "tangents need normals, but the mesh has none"};
    if (mesh.uvs.empty() && options.method != Method::basis)
        return {ErrorCode::missingAttribute, "this method needs UVs, but the mesh has none"};
    if (isGrouped(options.method) && 3 * mikk::countTriangles(mesh, options.ngons) > mikk::kMaxHalfEdges)
        return {ErrorCode::tooLarge, "the mesh has more than 715827882 triangles"};
    return {ErrorCode::ok, {}};
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

void startHasTangent(const TangentOutput& out, Parallel& parallel) {
    parallel.forRanges(out.has_tangent.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out.has_tangent[i] = 1;
    });
}

namespace {

TangentReport generateFrames(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                             Parallel& parallel) {
    const auto generated = [&] {
        if constexpr (kHasAllMethods) {
            if (!isGrouped(options.method)) {
                const IndexedPlan plan = planIndexed(mesh, options, parallel, PlanUse::once);
                return evaluateIndexed(plan, {mesh.positions, mesh.normals}, out, options.execution, parallel);
            }
        }
        return mikk::generateGrouped(mesh, options, out, parallel);
    };
    return inConvention(generated(), options.method, positiveUvsAreMirrored(options.convention));
}

/// The attributes of each corner, for a mesh with several index lists: welding finds equal corners again.
struct CornerArrays {
    CornerArrays(const MeshView& mesh, const Allocator* allocator)
        : positions(gathered(mesh.positions, mesh.indices, mesh, allocator)),
          normals(gathered(mesh.normals, mesh.normal_indices, mesh, allocator)),
          uvs(gathered(mesh.uvs, mesh.uv_indices, mesh, allocator)), view{.positions = {positions.data(),
                                                                                        positions.size()},
                                                                          .normals = {normals.data(), normals.size()},
                                                                          .uvs = {uvs.data(), uvs.size()},
                                                                          .face_sizes = mesh.face_sizes,
                                                                          .face_size = mesh.face_size} {}

    template <class T>
    static Buffer<T> gathered(const StridedSpan<const T>& values, const IndexView& list, const MeshView& mesh,
                              const Allocator* allocator) {
        Buffer<T> result(allocator, values.empty() ? 0 : mesh.cornerCount());
        for (std::size_t c = 0; c < result.size(); ++c)
            result[c] = values[list.type == IndexType::none ? mesh.indices[c] : list[c]];
        return result;
    }

    Buffer<Vec3> positions, normals;
    Buffer<Vec2> uvs;
    MeshView view;
};

}  // namespace

Error checkDomain(const TangentOptions& options) {
    if (options.domain == OutputDomain::corner) return {ErrorCode::ok, {}};
    return {ErrorCode::invalidOption, "results per vertex need a mesh with a single index list"};
}

const char* methodName(Method method) {
    static constexpr const char* kNames[] = {"mikktspace", "lengyel", "uniform", "angle", "area",
                                             "flat",       "basis",   "fast",    "best"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Method::best) + 1);
    const auto number = static_cast<std::size_t>(method);
    return number < std::size(kNames) ? kNames[number] : "unknown";
}

Result<TangentReport> generateTangents(const MeshView& given, const TangentOptions& options, const TangentOutput& out,
                                       const Execution& execution) {
    return atBorder([&]() -> Result<TangentReport> {
        if (hasOwnLists(given)) {
            if (Error e = checkDomain(options); e.code != ErrorCode::ok) return e;
            const auto generate = [&](const MeshView& mesh) { return generateTangents(mesh, options, out, execution); };
            if constexpr (kHasAllMethods) return withOneList(given, execution, generate);
            if (Result<Done> valid = validate(given); !valid) return std::move(valid).error();
            return generate(CornerArrays(given, execution.allocator).view);
        }
        const Call<TangentOptions> call{options, execution};
        Parallel parallel(execution, tangentWork(options.method, given.cornerCount()));
        if (Error e = checkInput(given, options, parallel); e.code != ErrorCode::ok) return e;
        if (Error e = checkOutput(out, outputCount(given, options)); e.code != ErrorCode::ok) return e;
        startHasTangent(out, parallel);
        const UnitNormals normals(given.normals, options.normalize_normals, execution.allocator, parallel);
        const MeshView mesh = withNormals(given, normals);
        if (!kHasAllMethods || options.frame == FrameShape::gramSchmidt)
            return generateFrames(mesh, call, out, parallel);
        const NeededBitangents needed(out, execution.allocator);
        const TangentReport report = generateFrames(mesh, call, needed.out, parallel);
        const bool per_vertex = options.domain == OutputDomain::vertex;
        makeSymmetric(
            out.tangents, needed.out.bitangents,
            [&](std::size_t i) { return mesh.normals[per_vertex ? i : mesh.indices[i]]; }, parallel);
        return report;
    });
}

}  // namespace tspace
