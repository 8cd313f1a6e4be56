/* SPDX-License-Identifier: MIT */
/* Tangents for a small mesh from C: one call, and its result. */
#include <stdio.h>
#include <tspace/tspace.h>

enum { VERTICES = 6, CORNERS = 12, FLOATS = 8 };

/* Two adjacent squares, as an interleaved vertex buffer: position, normal, UV. The texture runs to the right on the
 * first square and is mirrored on the second, so the two vertices between them need two tangents each. */
static const float vertices[VERTICES][FLOATS] = {
    {0, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 0, 1, 1, 0}, {2, 0, 0, 0, 0, 1, 0, 0},
    {0, 1, 0, 0, 0, 1, 0, 1}, {1, 1, 0, 0, 0, 1, 1, 1}, {2, 1, 0, 0, 0, 1, 0, 1},
};
static const uint16_t indices[CORNERS] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};

static int fail(const tspace_Error* error) {
    fprintf(stderr, "%s: %s\n", tspace_errorName(error->code), error->message);
    return 1;
}

int main(void) {
    tspace_Error error;
    tspace_Mesh mesh;
    TSPACE_INIT(mesh); /* sets struct_size and every default */
    mesh.positions = (tspace_ConstSpan){&vertices[0][0], VERTICES, sizeof(vertices[0])};
    mesh.normals = (tspace_ConstSpan){&vertices[0][3], VERTICES, sizeof(vertices[0])};
    mesh.uvs = (tspace_ConstSpan){&vertices[0][6], VERTICES, sizeof(vertices[0])};
    mesh.indices = (tspace_Indices){indices, CORNERS, TSPACE_INDEX_U16};

    tspace_TangentOptions tangents;
    TSPACE_INIT(tangents); /* method mikktspace */
    if (tspace_findConvention("gltf", &tangents.convention, &error) != TSPACE_OK) return fail(&error);
    tspace_IndexedFramesOptions options;
    TSPACE_INIT(options);
    options.tangents = &tangents;
    tspace_IndexedFrames* frames = NULL;
    if (tspace_makeIndexedFrames(&mesh, &options, NULL, &frames, &error) != TSPACE_OK) return fail(&error);

    /* A vertex whose corners need different tangents is split: the copies follow the vertices of the mesh. */
    for (size_t v = 0; v < frames->vertex_count; ++v) {
        const float* t = frames->tangents + 4 * v;
        printf("vertex %zu copies %u: tangent %g %g %g sign %g\n", v, (unsigned)frames->source_vertices[v], t[0], t[1],
               t[2], t[3]);
    }
    printf("%d vertices became %zu\n", VERTICES, frames->vertex_count);
    tspace_destroyIndexedFrames(frames);
    return 0;
}
