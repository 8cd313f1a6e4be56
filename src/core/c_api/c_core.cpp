// SPDX-License-Identifier: MIT
// C API: version, errors, mesh validation and conventions.
#include <bit>

#include "core/c_api/c_convert.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

uint32_t tspace_version() noexcept { return TSPACE_VERSION_NUMBER; }

const char* tspace_errorName(tspace_ErrorCode code) noexcept { return errorName(static_cast<ErrorCode>(code)); }

size_t tspace_cornerCount(const tspace_Mesh* mesh) noexcept {
    return mesh == nullptr ? 0 : toMesh(*mesh).cornerCount();
}

size_t tspace_faceCount(const tspace_Mesh* mesh) noexcept { return mesh == nullptr ? 0 : toMesh(*mesh).faceCount(); }

tspace_ErrorCode tspace_validate(const tspace_Mesh* mesh, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (Error e = checkMesh(mesh); e.code != ErrorCode::ok) return e;
        return validate(toMesh(*mesh));
    });
}

tspace_ErrorCode tspace_findConvention(const char* name, tspace_Convention* out, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (name == nullptr || out == nullptr) return Error{ErrorCode::nullData, "name or out is null"};
        const Convention* convention = findConvention(name);
        if (convention == nullptr) {
            return makeError(ErrorCode::invalidOption, kNoElement, "there is no convention with the name \"%s\"", name);
        }
        *out = std::bit_cast<tspace_Convention>(*convention);
        return Done{};
    });
}

float tspace_signFactor(tspace_Convention convention) noexcept { return signFactor(toConvention(convention)); }

float tspace_normalFactor(tspace_Convention convention) noexcept { return normalFactor(toConvention(convention)); }
