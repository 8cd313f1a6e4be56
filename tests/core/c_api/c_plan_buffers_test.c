/* SPDX-License-Identifier: MIT */
/* A plan as words, from C: what the header and the arrays of a quad contain, with and without normals, and errors. */
#include <math.h>
#include <string.h>

#include "tspace/tspace.h"

#include "c_check.h"

enum { VERTEX_COUNT = 4, CORNER_COUNT = 6 };
/* Places in the header. */
enum {
    VERSION,
    METHOD,
    FLAGS,
    WEIGHTING,
    RESULT_COUNT,
    ENTRY_COUNT,
    TRIANGLE_COUNT,
    TRIANGLE_WORDS,
    RESULTS,
    ENTRIES,
    TRIANGLES
};
/* Of FLAGS, and of the second word of a result. */
enum { MAKES_NORMALS = 1, RESULTS_ARE_CORNERS = 8, COUNT_MASK = 0x0fffffff };

static const float positions[3 * VERTEX_COUNT] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const float normals[3 * VERTEX_COUNT] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
static const float uvs[2 * VERTEX_COUNT] = {0, 0, 1, 0, 1, 1, 0, 1};
static const uint32_t indices[CORNER_COUNT] = {0, 1, 2, 0, 2, 3};

static float number(uint32_t word) {
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* The tangent of a result, as a shader computes it on this mesh, where all weights of a result are equal. */
static void evaluate(const uint32_t* words, size_t result, float tangent[4]) {
    const uint32_t* row = words + words[RESULTS] + 3 * result;
    double sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < (row[1] & COUNT_MASK); ++i) {
        const uint32_t entry = words[words[ENTRIES] + row[0] + i];
        const uint32_t* triangle = words + words[TRIANGLES] + words[TRIANGLE_WORDS] * ((entry & 0x3fffffffu) / 4);
        for (int k = 0; k < 3; ++k) {
            const float origin = positions[3 * triangle[0] + k];
            sum[k] += number(triangle[3]) * (positions[3 * triangle[1] + k] - origin) -
                      number(triangle[4]) * (positions[3 * triangle[2] + k] - origin);
        }
    }
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int k = 0; k < 3; ++k) tangent[k] = (float)(sum[k] / length);
    tangent[3] = (row[1] & 0x80000000u) != 0 ? -1.0f : 1.0f;
}

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

    /* Without options: one result per corner, normals come with a pose. */
    tspace_PlanBuffers* buffers = NULL;
    tspace_Error error;
    CHECK(tspace_planBuffers(plan, NULL, NULL, &buffers, &error) == TSPACE_OK);
    const uint32_t* words = buffers->words;
    CHECK(words[VERSION] == 1 && words[METHOD] == TSPACE_METHOD_MIKKTSPACE && words[FLAGS] == RESULTS_ARE_CORNERS);
    CHECK(words[RESULT_COUNT] == CORNER_COUNT && buffers->result_count == CORNER_COUNT && words[TRIANGLE_COUNT] == 2);
    CHECK(buffers->word_count == words[TRIANGLES] + (size_t)words[TRIANGLE_WORDS] * words[TRIANGLE_COUNT]);
    float expected[4 * CORNER_COUNT], found[4];
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = (tspace_Span){expected, CORNER_COUNT, 0};
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = mesh.positions;
    pose.normals = mesh.normals;
    CHECK(tspace_evaluateTangents(plan, &pose, &out, NULL, NULL, NULL) == TSPACE_OK);
    for (int c = 0; c < CORNER_COUNT; ++c) {
        evaluate(words, c, found);
        CHECK(memcmp(found, expected + 4 * c, sizeof found) == 0);
    }
    tspace_destroyPlanBuffers(buffers);

    /* A result per vertex, with normals. */
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
    CHECK(buffers->result_count == VERTEX_COUNT && buffers->words[FLAGS] == MAKES_NORMALS);
    CHECK(buffers->words[WEIGHTING] == TSPACE_NORMAL_WEIGHTING_AREA);
    for (int v = 0; v < VERTEX_COUNT; ++v) {
        evaluate(buffers->words, v, found);
        CHECK(memcmp(found, expected + 4 * source_corners[v], sizeof found) == 0);
    }
    tspace_destroyPlanBuffers(buffers);

    /* Errors leave no buffers. */
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
