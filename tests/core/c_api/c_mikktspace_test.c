/* SPDX-License-Identifier: MIT */
/* A program in C that uses the MikkTSpace interface, with the same include line as for the reference. */
#include "mikktspace.h"

#include "c_check.h"

static const float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

static int numFaces(const SMikkTSpaceContext* context) {
    (void)context;
    return 1;
}

static int numVertices(const SMikkTSpaceContext* context, const int face) {
    (void)context;
    (void)face;
    return 4;
}

static void position(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
    (void)context;
    (void)face;
    for (int k = 0; k < 3; ++k) out[k] = positions[vertex][k];
}

static void normal(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
    (void)context;
    (void)face;
    (void)vertex;
    out[0] = out[1] = 0;
    out[2] = 1;
}

static void texCoord(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
    (void)context;
    (void)face;
    out[0] = -positions[vertex][0];
    out[1] = positions[vertex][1];
}

static void setBasic(const SMikkTSpaceContext* context, const float tangent[], const float sign, const int face,
                     const int vertex) {
    CHECK(face == 0 && vertex >= 0 && vertex < 4);
    CHECK(tangent[0] == -1 && tangent[1] == 0 && tangent[2] == 0 && sign == -1);
    ++*(int*)context->m_pUserData;
}

int main(void) {
    int written = 0;
    SMikkTSpaceInterface calls = {numFaces, numVertices, position, normal, texCoord, setBasic, NULL};
    SMikkTSpaceContext context = {&calls, &written};
    const tbool done = genTangSpaceDefault(&context);
    CHECK(done);
    CHECK(written == 4);
    CHECK(genTangSpace(&context, 45.0f));
    CHECK(written == 8);
    return 0;
}
