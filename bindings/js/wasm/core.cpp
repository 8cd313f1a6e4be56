// SPDX-License-Identifier: MIT
// The module of the entry "tspace".
#include "common.h"
#include "tspace/indexed_frames.h"
#include "tspace/plan_buffers.h"

using namespace tspace;
using namespace tspace::js;

namespace {
TangentOptions tangent_options;  // of the next call
}  // namespace

extern "C" {

TSPACE_JS_EXPORT(setTangentOptions)
void setTangentOptions(std::uint32_t method, float threshold_deg, std::uint32_t pairing, std::uint32_t ngons,
                       std::uint32_t convention, std::uint32_t frame, std::uint32_t refine, bool normalize_normals) {
    tangent_options = {.method = static_cast<Method>(method),
                       .convention = conventionOf(convention),
                       .ngons = static_cast<Ngons>(ngons),
                       .frame = static_cast<FrameShape>(frame),
                       .normalize_normals = normalize_normals,
                       .angular_threshold_deg = threshold_deg,
                       .pairing = static_cast<Pairing>(pairing),
                       .refine = refine};
}

/// `out`: receives four floats per corner; `has_tangent`: receives a byte per corner, or null.
TSPACE_JS_EXPORT(generateTangents) std::uint32_t generate(float* out, std::uint8_t* has_tangent) {
    auto result = generateTangents(mesh(), tangent_options, outputOf(out, has_tangent, mesh().cornerCount()));
    if (result) keep(*result);
    return codeOf(result);
}

/// `plan`: receives the plan, to be destroyed with destroyPlan.
TSPACE_JS_EXPORT(makePlan) std::uint32_t makePlan(TangentPlan** plan) {
    auto result = planTangents(mesh(), tangent_options);
    if (result) *plan = new TangentPlan(*std::move(result));
    return codeOf(result);
}

/// Evaluates a plan with the positions and normals passed to setMesh.
TSPACE_JS_EXPORT(evaluatePlan) std::uint32_t evaluate(const TangentPlan* plan, float* out, std::uint8_t* has_tangent) {
    const Pose pose{mesh().positions, mesh().normals};
    auto result = evaluateTangents(*plan, pose, outputOf(out, has_tangent, plan->outputCount()));
    if (result) keep(*result);
    return codeOf(result);
}

TSPACE_JS_EXPORT(planBytes) std::size_t planBytes(const TangentPlan* plan) { return plan->memoryBytes(); }
TSPACE_JS_EXPORT(destroyPlan) void destroyPlan(TangentPlan* plan) { delete plan; }

/// `makes_normals`: the shader computes normals of the mesh passed to setMesh. `result`: receives a pointer and the
/// number of words, to be freed.
TSPACE_JS_EXPORT(planBuffers)
std::uint32_t buffers(const TangentPlan* plan, const std::uint32_t* indices, std::size_t index_count,
                      const std::uint32_t* source_corners, std::size_t source_corner_count, bool makes_normals,
                      std::uint32_t* result) {
    PlanBufferOptions options{.indices = {indices, index_count},
                              .source_corners = {source_corners, source_corner_count}};
    if (makes_normals) options.mesh = mesh();
    options.normals = normalOptions();
    auto made = planBuffers(*plan, options);
    if (!made) return codeOf(made);
    giveArray(made->words, result);
    return 0;
}

/// `result`: receives ten words, a pointer and a count for indices, source vertices, source corners, normals and
/// tangents, to be freed individually. The report contains the 9 numbers of tangents, then the 13 of sanitize and the 5
/// of normals.
TSPACE_JS_EXPORT(makeIndexedFrames)
std::uint32_t frames(bool make_normals, bool sanitize, bool orthogonalize_all, std::uint32_t* result) {
    IndexedFramesOptions options;
    options.tangents = tangent_options;
    options.normals = normalOptions();
    options.make_normals = make_normals;
    options.sanitize = sanitize;
    options.orthogonalize_all = orthogonalize_all;
    auto made = makeIndexedFrames(mesh(), options);
    if (!made) return codeOf(made);
    giveArray(made->indices, result);
    giveArray(made->source_vertices, result + 2);
    giveArray(made->source_corners, result + 4);
    giveArray(made->normals, result + 6);
    giveArray(made->tangents, result + 8);
    keep(made->report.normals, keep(made->report.sanitize, keep(made->report.tangents)));
    return 0;
}

}  // extern "C"
