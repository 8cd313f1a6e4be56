// SPDX-License-Identifier: MIT
// C API: vertex normals, and the winding of faces.
#include "tspace/normals.h"

#include "core/c_api/c_convert.h"
#include "tspace/normals.h"
#include "tspace/winding.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

constexpr std::uint32_t inC(NormalWeighting weighting) { return static_cast<std::uint32_t>(weighting); }
static_assert(TSPACE_NORMAL_WEIGHTING_FLAT == inC(NormalWeighting::flat));
static_assert(TSPACE_NORMAL_WEIGHTING_UNIFORM == inC(NormalWeighting::uniform));
static_assert(TSPACE_NORMAL_WEIGHTING_AREA == inC(NormalWeighting::area));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE == inC(NormalWeighting::angle));
static_assert(TSPACE_NORMAL_WEIGHTING_ANGLE_AREA == inC(NormalWeighting::angleArea));
static_assert(TSPACE_NORMAL_WEIGHTING_MAX == inC(NormalWeighting::max));
static_assert(TSPACE_NORMAL_WEIGHTING_BEST == inC(NormalWeighting::best));

}  // namespace

namespace tspace::c_api {

Error checkOptions(const tspace_NormalOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_NormalOptions options = orDefault(given);
    const bool has_defaults = options.weighting != TSPACE_NORMAL_WEIGHTING_FLAT || options.crease_angle_deg != 0 ||
                              options.weld_positions != 0 || options.refine != 0;
    constexpr const char* kFields = "weighting, crease_angle_deg, weld_positions and refine";
    return firstError([&] { return checkPrepared(has_defaults, "NormalOptions", kFields); },
                      [&] { return checkChoice(options.weighting, TSPACE_NORMAL_WEIGHTING_BEST, "weighting"); },
                      [&] { return checkChoice(options.smoothing_groups_are_masks, 1, "smoothing_groups_are_masks"); },
                      [&] { return checkChoice(options.weld_positions, 1, "weld_positions"); },
                      [&] { return checkConvention(options.convention); },
                      [&]() -> Error {
                          if (options.smoothing_groups != nullptr || options.smoothing_group_count == 0)
                              return {ErrorCode::ok};
                          return {ErrorCode::nullData, "smoothing_groups is null but smoothing_group_count is not 0"};
                      });
}

NormalOptions toOptions(const tspace_NormalOptions& options) {
    NormalOptions result;
    result.weighting = static_cast<NormalWeighting>(options.weighting);
    result.crease_angle_deg = options.crease_angle_deg;
    if (options.smoothing_groups != nullptr) {
        result.smoothing_groups = {options.smoothing_groups, options.smoothing_group_count};
    }
    result.smoothing_groups_are_masks = options.smoothing_groups_are_masks != 0;
    result.weld_positions = options.weld_positions != 0;
    result.convention = toConvention(options.convention);
    result.refine = options.refine;
    result.denoise = options.denoise;
    result.weld_distance = options.weld_distance;
    return result;
}

tspace_NormalReport toReport(const NormalReport& report) {
    tspace_NormalReport made;
    TSPACE_INIT(made);
    made.face_count = report.face_count;
    made.degenerate_face_count = report.degenerate_face_count;
    made.fallback_corner_count = report.fallback_corner_count;
    made.noise = report.noise;
    made.crease_angle_deg = report.crease_angle_deg;
    return made;
}

}  // namespace tspace::c_api

tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        const tspace_Execution* execution, tspace_NormalReport* report,
                                        tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<NormalReport> result =
            generateNormals(toMesh(*mesh), toOptions(orDefault(options)), toSpan<Vec3>(out), hooks.execution());
        if (!result) return result.error();
        give(toReport(*result), report);
        return Done{};
    });
}

tspace_ErrorCode tspace_measurePositionNoise(const tspace_Mesh* mesh, const tspace_Execution* execution,
                                             tspace_PositionNoise* noise, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkExecution(execution); },
                             [&] { return checkNeeded(noise, "noise"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<PositionNoise> result = measurePositionNoise(toMesh(*mesh), hooks.execution());
        if (!result) return result.error();
        tspace_PositionNoise made;
        TSPACE_INIT(made);
        made.sigma = result->sigma;
        made.kink_share = result->kink_share;
        made.noise = result->noise;
        made.mean_edge = result->mean_edge;
        give(made, noise);
        return Done{};
    });
}

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

// C API: the winding of faces.

Error checkOptions(const tspace_WindingOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_WindingOptions options = orDefault(given);
    const bool has_defaults =
        options.use_normals != 0 || options.weld_positions != 0 || toConvention(options.convention) != Convention{};
    constexpr const char* kFields = "use_normals, weld_positions and the convention";
    return firstError([&] { return checkPrepared(has_defaults, "WindingOptions", kFields); },
                      [&] { return checkChoice(options.use_normals, 1, "use_normals"); },
                      [&] { return checkChoice(options.weld_positions, 1, "weld_positions"); },
                      [&] { return checkConvention(options.convention); });
}

tspace_WindingReport toWindingReport(const WindingReport& report) {
    tspace_WindingReport made;
    TSPACE_INIT(made);
    made.face_count = report.face_count;
    made.turned_count = report.turned_count;
    made.conflict_count_before = report.conflict_count_before;
    made.conflict_count_after = report.conflict_count_after;
    made.component_count = report.component_count;
    made.turned_component_count = report.turned_component_count;
    made.by_normals_count = report.by_normals_count;
    made.by_volume_count = report.by_volume_count;
    made.by_nesting_count = report.by_nesting_count;
    made.by_winding_number_count = report.by_winding_number_count;
    made.by_majority_count = report.by_majority_count;
    made.small_count = report.small_count;
    made.one_sided_count = report.one_sided_count;
    return made;
}

}  // namespace

tspace_ErrorCode tspace_mendWinding(const tspace_Mesh* mesh, const tspace_WindingOptions* options, uint8_t* turned,
                                    size_t turned_count, const tspace_Execution* execution,
                                    tspace_WindingReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return c_api::checkMesh(mesh); }, [&] { return ::checkOptions(options); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_WindingOptions given = orDefault(options);
        const WindingOptions how{.convention = toConvention(given.convention),
                                 .use_normals = given.use_normals != 0,
                                 .weld_positions = given.weld_positions != 0,
                                 .weld_distance = given.weld_distance};
        const Hooks hooks(execution);
        const Result<WindingReport> result =
            mendWinding(toMesh(*mesh), how, {turned, turned_count, 1}, hooks.execution());
        if (!result) return result.error();
        give(::toWindingReport(*result), report);
        return Done{};
    });
}
