// SPDX-License-Identifier: MIT
// C API: tangents of a mesh.
#include "tspace/tangents.h"

#include "core/c_api/c_fields.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace tspace::c_api {

Error checkOptions(const tspace_TangentOptions* given) {
    if (Error error = checkSized(given, "options"); error.code != ErrorCode::ok) return error;
    const tspace_TangentOptions options = givenOrDefault(given);
    const bool has_defaults = options.angular_threshold_deg != 0 || options.refine != 0;
    return firstError(
        [&] { return checkInitialized(has_defaults, "TangentOptions", "angular_threshold_deg and refine"); },
        [&] { return checkFields(options); });
}

TangentOptions toOptions(const tspace_TangentOptions& options) {
    TangentOptions result;
    copyFields(options, result);
    return result;
}

TangentOutput toOutput(const tspace_TangentOutput& given) {
    const tspace_TangentOutput out = givenOrDefault(&given);
    const tspace_ByteSpan& mask = out.has_tangent;
    return {toSpan<Vec4>(out.tangents),
            toSpan<Vec3>(out.bitangents),
            toSpan<float>(out.magnitudes_s),
            toSpan<float>(out.magnitudes_t),
            {mask.data, mask.count, mask.stride_bytes == 0 ? 1 : mask.stride_bytes}};
}

}  // namespace tspace::c_api

tspace_ErrorCode tspace_initTangentOptions(tspace_TangentOptions* options, uint32_t struct_size,
                                           tspace_Error* error) noexcept {
    return init(options, struct_size, "options", error);
}

const char* tspace_methodName(tspace_Method method) noexcept { return methodName(static_cast<Method>(method)); }

tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        Error e = firstError([&] { return checkMesh(mesh); }, [&] { return checkOptions(options); },
                             [&] { return checkRequired(out, "out"); }, [&] { return checkExecution(execution); },
                             [&] { return checkSized(report, "report"); });
        if (e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const Result<TangentReport> result =
            generateTangents(toMesh(*mesh), toOptions(givenOrDefault(options)), toOutput(*out), hooks.execution());
        if (!result) return result.error();
        writeReport(toReport(*result), report);
        return Done{};
    });
}
