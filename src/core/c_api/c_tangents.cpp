// SPDX-License-Identifier: MIT
// C API: tangents, plans and sanitize.
#include "tspace/tangents.h"

#include <memory>
#include <optional>
#include <utility>

#include "core/c_api/c_convert.h"
#include "tspace/sanitize.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

/// A plan with the hooks it was made with: it releases its memory through them.
struct tspace_TangentPlan {
    explicit tspace_TangentPlan(const tspace_Execution* execution) : hooks(execution) {}

    Hooks hooks;
    std::optional<TangentPlan> plan;
};

namespace {

static_assert(TSPACE_METHOD_MIKKTSPACE == static_cast<std::uint32_t>(Method::mikktspace));
static_assert(TSPACE_METHOD_LENGYEL == static_cast<std::uint32_t>(Method::lengyel));
static_assert(TSPACE_METHOD_UNIFORM == static_cast<std::uint32_t>(Method::uniform));
static_assert(TSPACE_METHOD_ANGLE == static_cast<std::uint32_t>(Method::angle));
static_assert(TSPACE_METHOD_AREA == static_cast<std::uint32_t>(Method::area));
static_assert(TSPACE_METHOD_FLAT == static_cast<std::uint32_t>(Method::flat));
static_assert(TSPACE_METHOD_BASIS == static_cast<std::uint32_t>(Method::basis));
static_assert(TSPACE_METHOD_FAST == static_cast<std::uint32_t>(Method::fast));
static_assert(TSPACE_METHOD_BEST == static_cast<std::uint32_t>(Method::best));
static_assert(TSPACE_PAIRING_CORRECTED == static_cast<std::uint32_t>(Pairing::corrected));
static_assert(TSPACE_NGONS_SKIP == static_cast<std::uint32_t>(Ngons::skip));
static_assert(TSPACE_FRAME_SYMMETRIC == static_cast<std::uint32_t>(FrameShape::symmetric));
static_assert(TSPACE_DOMAIN_VERTEX == static_cast<std::uint32_t>(OutputDomain::vertex));

}  // namespace

namespace tspace::c_api {

Error checkOptions(const tspace_TangentOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_TangentOptions options = orDefault(given);
    return firstError([&] { return checkChoice(options.method, TSPACE_METHOD_BEST, "method"); },
                      [&] { return checkChoice(options.pairing, TSPACE_PAIRING_CORRECTED, "pairing"); },
                      [&] { return checkChoice(options.ngons, TSPACE_NGONS_SKIP, "ngons"); },
                      [&] { return checkChoice(options.domain, TSPACE_DOMAIN_VERTEX, "domain"); },
                      [&] { return checkChoice(options.frame, TSPACE_FRAME_SYMMETRIC, "frame"); },
                      [&] { return checkConvention(options.convention); });
}

TangentOptions toOptions(const tspace_TangentOptions& options) {
    TangentOptions result;
    result.method = static_cast<Method>(options.method);
    result.angular_threshold_deg = options.angular_threshold_deg;
    result.pairing = static_cast<Pairing>(options.pairing);
    result.ngons = static_cast<Ngons>(options.ngons);
    result.domain = static_cast<OutputDomain>(options.domain);
    result.convention = toConvention(options.convention);
    result.frame = static_cast<FrameShape>(options.frame);
    result.refine = options.refine;
    return result;
}

tspace_TangentReport toReport(const TangentReport& from) {
    tspace_TangentReport made;
    TSPACE_INIT(made);
    made.reference_order_abandoned = from.reference_order_abandoned ? 1 : 0;
    made.triangle_count = from.triangle_count;
    made.degenerate_triangle_count = from.degenerate_triangle_count;
    made.degenerate_uv_count = from.degenerate_uv_count;
    made.mirrored_count = from.mirrored_count;
    made.skipped_face_count = from.skipped_face_count;
    made.group_count = from.group_count;
    made.default_corner_count = from.default_corner_count;
    made.not_finite_count = from.not_finite_count;
    return made;
}

tspace_SanitizeReport toReport(const SanitizeReport& from) {
    tspace_SanitizeReport made;
    TSPACE_INIT(made);
    made.not_finite_count = from.not_finite_count;
    made.zero_count = from.zero_count;
    made.not_unit_count = from.not_unit_count;
    made.parallel_count = from.parallel_count;
    made.placeholder_count = from.placeholder_count;
    made.bad_sign_count = from.bad_sign_count;
    made.mixed_sign_count = from.mixed_sign_count;
    made.orthogonalized_count = from.orthogonalized_count;
    made.normalized_count = from.normalized_count;
    made.from_neighbor_count = from.from_neighbor_count;
    made.from_basis_count = from.from_basis_count;
    made.bad_normal_count = from.bad_normal_count;
    made.mended_count = from.mendedCount();
    return made;
}

}  // namespace tspace::c_api

namespace {

TangentOutput toOutput(const tspace_TangentOutput& out) {
    return {toSpan<Vec4>(out.tangents), toSpan<Vec3>(out.bitangents), toSpan<float>(out.magnitudes_s),
            toSpan<float>(out.magnitudes_t)};
}

}  // namespace

const char* tspace_methodName(tspace_Method method) noexcept { return methodName(static_cast<Method>(method)); }

tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkNeeded(out, "out"); }, [&] { return checkExecution(execution); },
                             [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<TangentReport> result =
            generateTangents(toMesh(*mesh), toOptions(orDefault(options)), toOutput(*out), hooks.execution());
        if (!result) return result.error();
        give(toReport(*result), report);
        return Done{};
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
            planTangents(toMesh(*mesh), toOptions(orDefault(options)), made->hooks.execution());
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
        Error e = firstError([&] { return checkNeeded(pose, "pose"); }, [&] { return checkNeeded(out, "out"); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Pose converted{toSpan<Vec3>(pose->positions), toSpan<Vec3>(pose->normals)};
        const Result<TangentReport> result =
            evaluateTangents(*plan->plan, converted, toOutput(*out), hooks.execution());
        if (!result) return result.error();
        give(toReport(*result), report);
        return Done{};
    });
}

tspace_ErrorCode tspace_describeTangentPlan(const tspace_TangentPlan* plan, tspace_TangentPlanInfo* info,
                                            tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (plan == nullptr) return Error{ErrorCode::nullData, "plan is null"};
        if (Error e = checkNeeded(info, "info"); e.code != ErrorCode::ok) return e;
        tspace_TangentPlanInfo made;
        TSPACE_INIT(made);
        made.method = static_cast<tspace_Method>(plan->plan->method());
        made.vertex_count = plan->plan->vertexCount();
        made.corner_count = plan->plan->cornerCount();
        made.output_count = plan->plan->outputCount();
        made.memory_bytes = plan->plan->memoryBytes();
        give(made, info);
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
        const tspace_SanitizeOptions given = orDefault(options);
        e = checkChoice(given.orthogonalize_all, 1, "orthogonalize_all");
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<SanitizeReport> result =
            sanitizeTangents(toMesh(*mesh), {given.orthogonalize_all != 0}, toSpan<Vec4>(tangents), hooks.execution());
        if (!result) return result.error();
        give(toReport(*result), report);
        return Done{};
    });
}
