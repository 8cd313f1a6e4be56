/* SPDX-License-Identifier: MIT */
/* Tangents for a small mesh from C: generate, sanitize, split, print. */
#include <stdio.h>
#include <tspace/tspace.h>

enum { VERTICES = 6, CORNERS = 8, FLOATS = 8 };

/* Two quads side by side. The texture runs to the right on the first and is mirrored on the second, so the
 * two vertices between them need two tangents each. Interleaved: position, normal, uv. */
static const float vertices[VERTICES][FLOATS] = {
    {0, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 0, 1, 1, 0}, {2, 0, 0, 0, 0, 1, 0, 0},
    {0, 1, 0, 0, 0, 1, 0, 1}, {1, 1, 0, 0, 0, 1, 1, 1}, {2, 1, 0, 0, 0, 1, 0, 1},
};
static const uint16_t indices[CORNERS] = {0, 1, 4, 3, 1, 2, 5, 4};

static int fail(const tspace_Error* error) {
    fprintf(stderr, "%s: %s\n", tspace_errorName(error->code), error->message);
    return 1;
}

int main(void) {
    tspace_Error error;
    tspace_Mesh mesh;
    TSPACE_INIT(mesh); /* sets struct_size, zeroes the rest: zero is the default everywhere */
    mesh.positions = (tspace_ConstSpan){&vertices[0][0], VERTICES, sizeof(vertices[0])};
    mesh.normals = (tspace_ConstSpan){&vertices[0][3], VERTICES, sizeof(vertices[0])};
    mesh.uvs = (tspace_ConstSpan){&vertices[0][6], VERTICES, sizeof(vertices[0])};
    mesh.indices = (tspace_Indices){indices, CORNERS, TSPACE_INDEX_U16};
    mesh.face_size = 4;

    float tangents[CORNERS][4]; /* one per corner: x, y, z, sign */
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = (tspace_Span){&tangents[0][0], CORNERS, 0};
    tspace_TangentOptions options;
    TSPACE_INIT(options); /* method mikktspace */
    if (tspace_findConvention("gltf", &options.convention, &error) != TSPACE_OK) return fail(&error);
    if (tspace_generateTangents(&mesh, &options, &out, NULL, &error) != TSPACE_OK) return fail(&error);
    if (tspace_sanitizeTangents(&mesh, NULL, out.tangents, NULL, &error) != TSPACE_OK) return fail(&error);

    /* Corners that disagree get a vertex of their own. */
    tspace_CornerAttribute attribute = {&tangents[0][0], 0, 4, 0.0f};
    tspace_SplitResult* split = NULL;
    if (tspace_splitVertices(&mesh.indices, VERTICES, CORNERS, &attribute, 1, NULL, &split, &error) != TSPACE_OK)
        return fail(&error);
    for (size_t v = 0; v < split->vertex_count; ++v) {
        const float* t = tangents[split->source_corners[v]];
        printf("vertex %zu copies %u: tangent %g %g %g sign %g\n", v, (unsigned)split->source_vertices[v], t[0], t[1],
               t[2], t[3]);
    }
    printf("%d vertices became %zu\n", VERTICES, split->vertex_count);
    tspace_destroySplitResult(split);
    return 0;
}
