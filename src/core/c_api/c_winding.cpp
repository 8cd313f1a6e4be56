// SPDX-License-Identifier: MIT
// C API: the winding of faces.
#include "tspace/winding.h"

#include "core/c_api/c_convert.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

Error checkOptions(const tspace_WindingOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_WindingOptions options = orDefault(given);
    return firstError([&] { return checkChoice(options.use_normals, 1, "use_normals"); },
                      [&] { return checkChoice(options.weld_positions, 1, "weld_positions"); },
                      [&] { return checkConvention(options.convention); });
}

tspace_WindingReport toReport(const WindingReport& report) {
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
                                 .weld_positions = given.weld_positions != 0};
        const Hooks hooks(execution);
        const Result<WindingReport> result =
            mendWinding(toMesh(*mesh), how, {turned, turned_count, 1}, hooks.execution());
        if (!result) return result.error();
        give(::toReport(*result), report);
        return Done{};
    });
}
