// SPDX-License-Identifier: MIT
// C API: vertex normals, and the winding of faces.
#include "tspace/normals.h"

#include "core/c_api/c_fields.h"
#include "tspace/winding.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace tspace::c_api {

Error checkOptions(const tspace_NormalOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_NormalOptions options = givenOrDefault(given);
    const bool has_defaults = options.weighting != TSPACE_NORMAL_WEIGHTING_FLAT || options.crease_angle_deg != 0 ||
                              options.weld_positions != 0 || options.refine != 0;
    constexpr const char* kFields = "weighting, crease_angle_deg, weld_positions and refine";
    return firstError([&] { return checkInitialized(has_defaults, "NormalOptions", kFields); },
                      [&] { return checkFields(options); },
                      [&]() -> Error {
                          if (options.smoothing_groups != nullptr || options.smoothing_group_count == 0)
                              return {ErrorCode::ok};
                          return {ErrorCode::nullData, "smoothing_groups is null, but smoothing_group_count is not 0"};
                      });
}

NormalOptions toOptions(const tspace_NormalOptions& options) {
    NormalOptions result;
    copyFields(options, result);
    if (options.smoothing_groups != nullptr)
        result.smoothing_groups = {options.smoothing_groups, options.smoothing_group_count};
    return result;
}

}  // namespace tspace::c_api

tspace_ErrorCode tspace_initNormalOptions(tspace_NormalOptions* options, uint32_t struct_size,
                                          tspace_Error* error) noexcept {
    return init(options, struct_size, "options", error);
}

tspace_ErrorCode tspace_initWindingOptions(tspace_WindingOptions* options, uint32_t struct_size,
                                           tspace_Error* error) noexcept {
    return init(options, struct_size, "options", error);
}

tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        const tspace_Execution* execution, tspace_NormalReport* report,
                                        tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<NormalReport> result =
            generateNormals(toMesh(*mesh), toOptions(givenOrDefault(options)), toSpan<Vec3>(out), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}

tspace_ErrorCode tspace_measurePositionNoise(const tspace_Mesh* mesh, const tspace_Execution* execution,
                                             tspace_PositionNoise* noise, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkExecution(execution); },
                             [&] { return checkRequired(noise, "noise"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<PositionNoise> result = measurePositionNoise(toMesh(*mesh), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), noise);
        return Done{};
    });
}

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

// C API: the winding of faces.

Error checkOptions(const tspace_WindingOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_WindingOptions options = givenOrDefault(given);
    const bool has_defaults =
        options.use_normals != 0 || options.weld_positions != 0 || toConvention(options.convention) != Convention{};
    constexpr const char* kFields = "use_normals, weld_positions and the convention";
    return firstError([&] { return checkInitialized(has_defaults, "WindingOptions", kFields); },
                      [&] { return checkFields(options); });
}

}  // namespace

tspace_ErrorCode tspace_mendWinding(const tspace_Mesh* mesh, const tspace_WindingOptions* options, uint8_t* turned,
                                    size_t turned_count, const tspace_Execution* execution,
                                    tspace_WindingReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return c_api::checkMesh(mesh); }, [&] { return ::checkOptions(options); },
                             [&] { return checkExecution(execution); }, [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const tspace_WindingOptions given = givenOrDefault(options);
        WindingOptions how;
        copyFields(given, how);
        const Hooks hooks(execution);
        const Result<WindingReport> result =
            mendWinding(toMesh(*mesh), how, {turned, turned_count, 1}, hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}
