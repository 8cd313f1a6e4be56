/* SPDX-License-Identifier: MIT */
/* The C API in a C11 program: the header is self-contained, and every function is called with a mesh. */
#include "tspace/tspace.h"

#include "c_check.h"

void checkFrameFunctions(void);
void checkPackFunctions(void);

/* Two quads side by side, the second one with mirrored u. Per vertex: position, normal, UV. */
static const float vertices[6][8] = {
    {0, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 0, 1, 1, 0}, {2, 0, 0, 0, 0, 1, 0, 0},
    {0, 1, 0, 0, 0, 1, 0, 1}, {1, 1, 0, 0, 0, 1, 1, 1}, {2, 1, 0, 0, 0, 1, 0, 1},
};
static const uint8_t indices[8] = {0, 1, 4, 3, 1, 2, 5, 4};

static tspace_ConstSpan column(int first) {
    tspace_ConstSpan span = {&vertices[0][first], 6, sizeof(vertices[0])};
    return span;
}

static tspace_Mesh makeMesh(void) {
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = column(0);
    mesh.normals = column(3);
    mesh.uvs = column(6);
    mesh.indices.data = indices;
    mesh.indices.count = 8;
    mesh.indices.type = TSPACE_INDEX_U8;
    mesh.face_size = 4;
    return mesh;
}

static void checkVersion(void) {
    CHECK(tspace_version() == TSPACE_VERSION_NUMBER);
    CHECK(TSPACE_VERSION_NUMBER == TSPACE_VERSION_MAJOR * 10000 + TSPACE_VERSION_MINOR * 100 + TSPACE_VERSION_PATCH);
    CHECK(strlen(TSPACE_VERSION_STRING) >= 5);
}

static void checkMesh(void) {
    tspace_Mesh mesh = makeMesh();
    tspace_Error error;
    CHECK(tspace_validate(&mesh, &error) == TSPACE_OK);
    CHECK(error.code == TSPACE_OK && error.message[0] == 0 && error.element == TSPACE_NO_ELEMENT);
    CHECK(tspace_validate(&mesh, NULL) == TSPACE_OK);
    CHECK(tspace_cornerCount(&mesh) == 8);
    CHECK(tspace_faceCount(&mesh) == 2);
    CHECK(tspace_cornerCount(NULL) == 0 && tspace_faceCount(NULL) == 0);
}

static void checkConventions(void) {
    tspace_Convention convention;
    CHECK(tspace_findConvention("gltf", &convention, NULL) == TSPACE_OK);
    CHECK(convention.v_axis == TSPACE_V_DOWN && convention.green == TSPACE_GREEN_UP);
    CHECK(tspace_signFactor(convention) == -1.0f);
    CHECK(tspace_normalFactor(convention) == 1.0f);
    CHECK(tspace_findConvention("directx", &convention, NULL) == TSPACE_OK);
    CHECK(convention.handedness == TSPACE_HANDEDNESS_LEFT && convention.winding == TSPACE_WINDING_CLOCKWISE);
}

static void checkNormals(void) {
    tspace_Mesh mesh = makeMesh();
    float normals[8][3];
    tspace_Span out = {&normals[0][0], 8, 0};
    tspace_NormalReport report;
    TSPACE_INIT(report);
    CHECK(tspace_generateNormals(&mesh, NULL, out, NULL, &report, NULL) == TSPACE_OK);
    CHECK(report.face_count == 2 && report.degenerate_face_count == 0);
    for (int c = 0; c < 8; ++c) CHECK(normals[c][0] == 0 && normals[c][1] == 0 && normals[c][2] == 1);
}

static void checkTangents(float tangents[8][4]) {
    tspace_Mesh mesh = makeMesh();
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents.data = &tangents[0][0];
    out.tangents.count = 8;
    tspace_TangentReport report;
    TSPACE_INIT(report);
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    CHECK(options.angular_threshold_deg == 180.0f && options.refine == 1);
    CHECK(tspace_generateTangents(&mesh, &options, &out, NULL, &report, NULL) == TSPACE_ERROR_INVALID_OPTION);
    CHECK(tspace_findConvention("opengl", &options.convention, NULL) == TSPACE_OK);
    CHECK(tspace_generateTangents(&mesh, &options, &out, NULL, &report, NULL) == TSPACE_OK);
    CHECK(report.triangle_count == 4 && report.mirrored_count == 2);
    for (int c = 0; c < 8; ++c) {
        const float sign = c < 4 ? 1.0f : -1.0f;
        CHECK(tangents[c][0] == sign && tangents[c][1] == 0 && tangents[c][2] == 0 && tangents[c][3] == sign);
    }

    tspace_TangentPlan* plan = NULL;
    CHECK(tspace_planTangents(&mesh, &options, NULL, &plan, NULL) == TSPACE_OK);
    tspace_TangentPlanInfo info;
    TSPACE_INIT(info);
    CHECK(tspace_describeTangentPlan(plan, &info, NULL) == TSPACE_OK);
    CHECK(info.method == TSPACE_METHOD_MIKKTSPACE && info.vertex_count == 6 && info.corner_count == 8);
    CHECK(info.memory_bytes > 0);
    float again[8][4] = {{0}};
    out.tangents.data = &again[0][0];
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = mesh.positions;
    pose.normals = mesh.normals;
    CHECK(tspace_evaluateTangents(plan, &pose, &out, NULL, &report, NULL) == TSPACE_OK);
    CHECK(memcmp(again, tangents, sizeof(again)) == 0);
    tspace_destroyTangentPlan(plan);
    tspace_destroyTangentPlan(NULL);
}

static void checkSanitize(float tangents[8][4]) {
    tspace_Mesh mesh = makeMesh();
    tangents[2][0] = 0.0f; /* zero: must be repaired */
    tspace_Span span = {&tangents[0][0], 8, 0};
    tspace_SanitizeReport report;
    TSPACE_INIT(report);
    CHECK(tspace_sanitizeTangents(&mesh, NULL, span, NULL, &report, NULL) == TSPACE_OK);
    CHECK(report.zero_count == 1 && report.mended_count == 1 && report.from_neighbor_count == 1);
    CHECK(tangents[2][0] == 1.0f && tangents[2][3] == 1.0f);
}

static void checkSplit(float tangents[8][4]) {
    tspace_Mesh mesh = makeMesh();
    tspace_CornerAttribute attribute = {&tangents[0][0], 0, 4, 0.0f};
    tspace_SplitResult* split = NULL;
    CHECK(tspace_splitVertices(&mesh.indices, 6, 8, &attribute, 1, NULL, &split, NULL) == TSPACE_OK);
    CHECK(split->vertex_count == 8 && split->corner_count == 8);
    CHECK(split->source_vertices[5] == 5 && split->source_vertices[6] == 1 && split->source_vertices[7] == 4);
    CHECK(split->source_corners[6] == 4 && split->indices[4] == 6);
    tspace_destroySplitResult(split);
    tspace_destroySplitResult(NULL);
}

static void checkTriangulate(void) {
    tspace_Mesh mesh = makeMesh();
    tspace_Triangulation* cut = NULL;
    CHECK(tspace_triangulate(&mesh, &cut, NULL) == TSPACE_OK);
    CHECK(cut->triangle_count == 4);
    CHECK(cut->faces[0] == 0 && cut->faces[1] == 0 && cut->faces[2] == 1 && cut->faces[3] == 1);
    for (size_t i = 0; i < 12; ++i) CHECK(cut->corners[i] / 4 == cut->faces[i / 3]);
    tspace_destroyTriangulation(cut);
    tspace_destroyTriangulation(NULL);
}

int main(void) {
    float tangents[8][4];
    checkVersion();
    checkMesh();
    checkConventions();
    checkNormals();
    checkTangents(tangents);
    checkSanitize(tangents);
    checkSplit(tangents);
    checkTriangulate();
    checkFrameFunctions();
    checkPackFunctions();
    CHECK(strcmp(tspace_errorName(TSPACE_ERROR_INDEX_OUT_OF_RANGE), "indexOutOfRange") == 0);
    CHECK(strcmp(tspace_errorName(12345), "unknown") == 0);
    CHECK(strcmp(tspace_methodName(TSPACE_METHOD_LENGYEL), "lengyel") == 0);
    CHECK(strcmp(tspace_methodName(12345), "unknown") == 0);
    return 0;
}
