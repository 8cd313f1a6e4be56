/* SPDX-License-Identifier: MIT */
/* Tangents of many meshes by one call from C: reports, an error per job, and the error code of the call. */
#include "tspace/tspace.h"

#include "c_check.h"

enum { JOB_COUNT = 3, CORNER_COUNT = 3 };

int main(void) {
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    const float uvs[6] = {0, 0, 1, 0, 0, 1};
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = (tspace_ConstSpan){positions, CORNER_COUNT, 0};
    mesh.normals = (tspace_ConstSpan){normals, CORNER_COUNT, 0};
    mesh.uvs = (tspace_ConstSpan){uvs, CORNER_COUNT, 0};
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    CHECK(tspace_findConvention("opengl", &options.convention, NULL) == TSPACE_OK);

    float tangents[JOB_COUNT][4 * CORNER_COUNT];
    tspace_TangentOutput outputs[JOB_COUNT];
    tspace_TangentReport reports[JOB_COUNT];
    tspace_Error errors[JOB_COUNT], error;
    tspace_MeshJob jobs[JOB_COUNT];
    for (int i = 0; i < JOB_COUNT; ++i) {
        TSPACE_INIT(outputs[i]);
        TSPACE_INIT(reports[i]);
        outputs[i].tangents = (tspace_Span){tangents[i], CORNER_COUNT, 0};
        jobs[i] = (tspace_MeshJob){&mesh, &options, &outputs[i], &reports[i], &errors[i]};
    }
    CHECK(tspace_generateTangentsOfMeshes(jobs, JOB_COUNT, NULL, &error) == TSPACE_OK);
    for (int i = 0; i < JOB_COUNT; ++i) {
        CHECK(errors[i].code == TSPACE_OK && reports[i].triangle_count == 1);
        CHECK(tangents[i][0] == 1 && tangents[i][1] == 0 && tangents[i][2] == 0 && tangents[i][3] == 1);
    }

    /* A job without a mesh, and one whose output is too short; the last job has neither report nor error. */
    jobs[1].mesh = NULL;
    outputs[2].tangents.count = 1;
    jobs[2].report = NULL;
    jobs[2].error = NULL;
    tangents[0][0] = 0;
    CHECK(tspace_generateTangentsOfMeshes(jobs, JOB_COUNT, NULL, &error) == TSPACE_ERROR_NULL_DATA);
    CHECK(error.code == TSPACE_ERROR_NULL_DATA && error.element == 1);
    CHECK(errors[0].code == TSPACE_OK && errors[1].code == TSPACE_ERROR_NULL_DATA);
    CHECK(tangents[0][0] == 1);
    CHECK(tspace_generateTangentsOfMeshes(jobs + 2, 1, NULL, NULL) == TSPACE_ERROR_COUNT_MISMATCH);

    CHECK(tspace_generateTangentsOfMeshes(NULL, 0, NULL, &error) == TSPACE_OK);
    CHECK(tspace_generateTangentsOfMeshes(NULL, 1, NULL, &error) == TSPACE_ERROR_NULL_DATA);
    return 0;
}
