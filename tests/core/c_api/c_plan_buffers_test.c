/* SPDX-License-Identifier: MIT */
/* Errors of writing a plan as words from C. The words are tested by c_cases_test. */
#include <string.h>

#include "tspace/tspace.h"

#include "c_check.h"

enum { VERTEX_COUNT = 4, CORNER_COUNT = 6 };

static const float positions[3 * VERTEX_COUNT] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const float normals[3 * VERTEX_COUNT] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
static const float uvs[2 * VERTEX_COUNT] = {0, 0, 1, 0, 1, 1, 0, 1};
static const uint32_t indices[CORNER_COUNT] = {0, 1, 2, 0, 2, 3};

int main(void) {
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = (tspace_ConstSpan){positions, VERTEX_COUNT, 0};
    mesh.normals = (tspace_ConstSpan){normals, VERTEX_COUNT, 0};
    mesh.uvs = (tspace_ConstSpan){uvs, VERTEX_COUNT, 0};
    mesh.indices = (tspace_Indices){indices, CORNER_COUNT, TSPACE_INDEX_U32};
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    CHECK(tspace_findConvention("opengl", &options.convention, NULL) == TSPACE_OK);
    tspace_TangentPlan* plan = NULL;
    CHECK(tspace_planTangents(&mesh, &options, NULL, &plan, NULL) == TSPACE_OK);

    tspace_PlanBuffers* buffers = NULL;
    tspace_Error error;
    const uint32_t source_corners[VERTEX_COUNT] = {0, 1, 2, 5};
    tspace_NormalOptions normal_options;
    TSPACE_INIT(normal_options);
    normal_options.weighting = TSPACE_NORMAL_WEIGHTING_AREA;
    tspace_PlanBufferOptions given;
    TSPACE_INIT(given);
    given.indices = indices;
    given.index_count = CORNER_COUNT;
    given.source_corners = source_corners;
    given.source_corner_count = VERTEX_COUNT;
    given.mesh = &mesh;
    given.normals = &normal_options;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_OK);
    tspace_destroyPlanBuffers(buffers);

    /* A call with an error sets the buffers to NULL. */
    CHECK(tspace_planBuffers(NULL, NULL, NULL, &buffers, &error) == TSPACE_ERROR_NULL_DATA && buffers == NULL);
    CHECK(tspace_planBuffers(plan, NULL, NULL, NULL, &error) == TSPACE_ERROR_NULL_DATA);
    given.source_corners = NULL;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_ERROR_NULL_DATA && buffers == NULL);
    CHECK(strcmp(error.message, "source_corners is null but its count is not 0") == 0);
    given.source_corner_count = 0;
    given.index_count = 3;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_ERROR_COUNT_MISMATCH);
    given.index_count = CORNER_COUNT;
    normal_options.weighting = TSPACE_NORMAL_WEIGHTING_BEST;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_ERROR_INVALID_OPTION);
    normal_options.weighting = 99;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_ERROR_INVALID_OPTION);
    given.struct_size = 3;
    CHECK(tspace_planBuffers(plan, &given, NULL, &buffers, &error) == TSPACE_ERROR_INVALID_OPTION && buffers == NULL);
    tspace_destroyPlanBuffers(NULL);
    tspace_destroyTangentPlan(plan);
    return 0;
}
