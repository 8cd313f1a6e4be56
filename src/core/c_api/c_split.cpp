// SPDX-License-Identifier: MIT
// C API: split and triangulate, whose results the library owns until the caller destroys them.
#include "tspace/split.h"

#include <memory>
#include <utility>
#include <vector>

#include "core/c_api/c_convert.h"
#include "tspace/triangulate.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

namespace {

static_assert(TSPACE_NO_CORNER == kNoCorner);

/// The struct of the C API, as the first base, and the memory that its pointers point into.
struct OwnedSplit : tspace_SplitResult {
    SplitResult result;
};

struct OwnedTriangulation : tspace_Triangulation {
    Triangulation result;
};

}  // namespace

namespace tspace::c_api {

Result<std::vector<CornerAttribute>> toAttributes(const tspace_CornerAttribute* attributes, std::size_t count,
                                                  const char* name) {
    std::vector<CornerAttribute> result;
    if (count == 0) return result;
    if (attributes == nullptr)
        return makeError(ErrorCode::nullData, kNoElement, "%s is null but %s_count is not 0", name, name);
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const tspace_CornerAttribute& given = attributes[i];
        const std::size_t tight = sizeof(float) * given.component_count;
        result.push_back(
            {given.data, given.stride_bytes == 0 ? tight : given.stride_bytes, given.component_count, given.tolerance});
    }
    return result;
}

}  // namespace tspace::c_api

tspace_ErrorCode tspace_splitVertices(const tspace_Indices* indices, size_t vertex_count, size_t corner_count,
                                      const tspace_CornerAttribute* attributes, size_t attribute_count,
                                      const tspace_Execution* execution, tspace_SplitResult** result,
                                      tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (result == nullptr) return Error{ErrorCode::nullData, "result is null"};
        *result = nullptr;
        const Result<std::vector<CornerAttribute>> converted = toAttributes(attributes, attribute_count, "attribute");
        if (!converted) return converted.error();
        if (Error e = checkExecution(execution); e.code != ErrorCode::ok) return e;
        const Hooks hooks(execution);
        const IndexView view = indices == nullptr ? IndexView() : toIndices(*indices);
        Result<SplitResult> split = splitVertices(view, vertex_count, corner_count, *converted, hooks.execution());
        if (!split) return split.error();
        auto owned = std::make_unique<OwnedSplit>();
        owned->result = std::move(*split);
        owned->indices = owned->result.indices.data();
        owned->corner_count = owned->result.indices.size();
        owned->source_vertices = owned->result.source_vertices.data();
        owned->source_corners = owned->result.source_corners.data();
        owned->vertex_count = owned->result.vertexCount();
        *result = owned.release();
        return Done{};
    });
}

void tspace_destroySplitResult(tspace_SplitResult* result) noexcept { delete static_cast<OwnedSplit*>(result); }

tspace_ErrorCode tspace_triangulate(const tspace_Mesh* mesh, tspace_Triangulation** result,
                                    tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (result == nullptr) return Error{ErrorCode::nullData, "result is null"};
        *result = nullptr;
        if (Error e = checkMesh(mesh); e.code != ErrorCode::ok) return e;
        Result<Triangulation> cut = triangulate(toMesh(*mesh));
        if (!cut) return cut.error();
        auto owned = std::make_unique<OwnedTriangulation>();
        owned->result = std::move(*cut);
        owned->corners = owned->result.corners.data();
        owned->faces = owned->result.faces.data();
        owned->triangle_count = owned->result.faces.size();
        *result = owned.release();
        return Done{};
    });
}

void tspace_destroyTriangulation(tspace_Triangulation* result) noexcept {
    delete static_cast<OwnedTriangulation*>(result);
}
