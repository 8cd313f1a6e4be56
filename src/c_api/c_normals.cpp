// SPDX-License-Identifier: MIT
// C API: vertex normals.
#include "tspace/normals.h"

#include "c_api/c_convert.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

// In C 0 is the default weighting, so the others come one later than in C++.
constexpr std::uint32_t inC(NormalWeighting weighting) { return static_cast<std::uint32_t>(weighting) + 1; }
static_assert(TSPACE_NORMAL_WEIGHTING_FLAT == inC(NormalWeighting::flat));
static_assert(TSPACE_NORMAL_WEIGHTING_UNIFORM == inC(NormalWeighting::uniform));
static_assert(TSPACE_NORMAL_WEIGHTING_AREA == inC(NormalWeighting::area));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE == inC(NormalWeighting::angle));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE_AREA == inC(NormalWeighting::angleArea));
static_assert(TSPACE_NORMAL_WEIGHTING_MAX == inC(NormalWeighting::max));
static_assert(TSPACE_NORMAL_WEIGHTING_BEST == inC(NormalWeighting::best));

Error checkOptions(const tspace_NormalOptions* given) {
    if (given == nullptr) return {ErrorCode::ok};
    const tspace_NormalOptions& options = *given;
    return firstError([&] { return checkSized(given, "options"); },
                      [&] { return checkChoice(options.weighting, TSPACE_NORMAL_WEIGHTING_BEST, "weighting"); },
                      [&] { return checkChoice(options.smoothing_groups_are_masks, 1, "smoothing_groups_are_masks"); },
                      [&] { return checkChoice(options.keep_positions_apart, 1, "keep_positions_apart"); },
                      [&] { return checkChoice(options.refine, TSPACE_REFINE_NONE, "refine"); },
                      [&] { return checkConvention(options.convention); },
                      [&] { return checkExecution(options.execution); },
                      [&]() -> Error {
                          if (options.smoothing_groups != nullptr || options.smoothing_group_count == 0)
                              return {ErrorCode::ok};
                          return {ErrorCode::nullData, "smoothing_groups is null but smoothing_group_count is not 0"};
                      });
}

/// All but the execution, whose hooks need a place that lives longer.
NormalOptions toOptions(const tspace_NormalOptions& options) {
    NormalOptions result;
    if (options.weighting != TSPACE_NORMAL_WEIGHTING_DEFAULT) {
        result.weighting = static_cast<NormalWeighting>(options.weighting - 1);
    }
    if (options.crease_angle_deg != 0.0f) result.crease_angle_deg = options.crease_angle_deg;
    if (options.smoothing_groups != nullptr) {
        result.smoothing_groups = {options.smoothing_groups, options.smoothing_group_count};
    }
    result.smoothing_groups_are_masks = options.smoothing_groups_are_masks != 0;
    result.weld_positions = options.keep_positions_apart == 0;
    result.convention = toConvention(options.convention);
    result.refine = toRefine(options.refine);
    return result;
}

}  // namespace

tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        tspace_NormalReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_NormalOptions given = orDefault(options);
        const Hooks hooks(given.execution);
        NormalOptions converted = toOptions(given);
        converted.execution = hooks.execution();
        const Result<NormalReport> result = generateNormals(toMesh(*mesh), converted, toSpan<Vec3>(out));
        if (!result) return result.error();
        if (report != nullptr) {
            TSPACE_INIT(*report);
            report->face_count = result->face_count;
            report->degenerate_face_count = result->degenerate_face_count;
            report->fallback_corner_count = result->fallback_corner_count;
        }
        return Done{};
    });
}
