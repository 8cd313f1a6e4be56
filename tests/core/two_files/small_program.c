/* SPDX-License-Identifier: MIT */
/* Uses the two files of tspace in C. Prints the bits of the tangents of all methods on a bumpy plane with a mirrored
 * half, and those of normals, packed frames and an indexed mesh. */
#include <math.h>
#include <stdio.h>

#include "tspace.h"

enum { SIDE = 24, VERTICES = SIDE * SIDE, CORNERS = 6 * (SIDE - 1) * (SIDE - 1) };

static float positions[VERTICES][3], normals[VERTICES][3], uvs[VERTICES][2], tangents[CORNERS][4],
    made_normals[CORNERS][3];
static uint16_t indices[CORNERS];
static unsigned char words[4 * CORNERS];

static uint64_t hashOf(const void* data, size_t bytes) {
    uint64_t hash = 1469598103934665603u;
    for (size_t i = 0; i < bytes; ++i) hash = (hash ^ ((const unsigned char*)data)[i]) * 1099511628211u;
    return hash;
}

static void makeMesh(tspace_Mesh* mesh) {
    size_t corner = 0;
    for (int y = 0; y < SIDE; ++y) {
        for (int x = 0; x < SIDE; ++x) {
            const int v = y * SIDE + x, bump = (x * 7 + y * 5) % 11;
            positions[v][0] = (float)x, positions[v][1] = (float)y, positions[v][2] = (float)bump / 16;
            normals[v][0] = (float)(bump % 3 - 1) / 8, normals[v][1] = (float)(bump % 5 - 2) / 8, normals[v][2] = 1;
            uvs[v][0] = (float)(x < SIDE / 2 ? x : SIDE - x) / SIDE, uvs[v][1] = (float)y / SIDE;
            if (x == SIDE - 1 || y == SIDE - 1) continue;
            const int quad[6] = {v, v + 1, v + SIDE + 1, v, v + SIDE + 1, v + SIDE};
            for (int k = 0; k < 6; ++k) indices[corner++] = (uint16_t)quad[k];
        }
    }
    TSPACE_INIT(*mesh);
    mesh->positions = (tspace_ConstSpan){&positions[0][0], VERTICES, 0};
    mesh->normals = (tspace_ConstSpan){&normals[0][0], VERTICES, 0};
    mesh->uvs = (tspace_ConstSpan){&uvs[0][0], VERTICES, 0};
    mesh->indices = (tspace_Indices){indices, CORNERS, TSPACE_INDEX_U16};
}

#define CHECK(call)                                                                  \
    do {                                                                             \
        if ((call) != TSPACE_OK) return printf("%s: %s\n", #call, error.message), 1; \
    } while (0)

int main(void) {
    tspace_Error error;
    tspace_Mesh mesh;
    makeMesh(&mesh);
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    CHECK(tspace_findConvention("gltf", &options.convention, &error));
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = (tspace_Span){&tangents[0][0], CORNERS, 0};
    for (tspace_Method method = TSPACE_METHOD_MIKKTSPACE; method <= TSPACE_METHOD_BEST; ++method) {
        options.method = method;
        CHECK(tspace_generateTangents(&mesh, &options, &out, NULL, NULL, &error));
        printf("method %u: %016llx\n", (unsigned)method, (unsigned long long)hashOf(tangents, sizeof tangents));
    }
    const tspace_Span at_corners = {&made_normals[0][0], CORNERS, 0};
    CHECK(tspace_generateNormals(&mesh, NULL, at_corners, NULL, NULL, &error));
    printf("normals: %016llx\n", (unsigned long long)hashOf(made_normals, sizeof made_normals));
    CHECK(tspace_packFrames((tspace_ConstSpan){&made_normals[0][0], CORNERS, 0},
                            (tspace_ConstSpan){&tangents[0][0], CORNERS, 0}, TSPACE_FRAME_FORMAT_FRAME32, words,
                            sizeof words, NULL, &error));
    printf("frame32: %016llx\n", (unsigned long long)hashOf(words, sizeof words));
    tspace_IndexedFramesOptions frames_options;
    TSPACE_INIT(frames_options);
    frames_options.tangents = &options;
    tspace_IndexedFrames* frames = NULL;
    CHECK(tspace_makeIndexedFrames(&mesh, &frames_options, NULL, &frames, &error));
    printf("indices: %016llx\n", (unsigned long long)hashOf(frames->indices, sizeof(uint32_t) * frames->corner_count));
    tspace_destroyIndexedFrames(frames);
    return 0;
}
