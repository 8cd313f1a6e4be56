/* SPDX-License-Identifier: MIT */
/* The interface of the MikkTSpace reference implementation, answered by tspace with the same bits.
 *
 * A program that uses the reference puts the folder of this file on its include path and links tspace; its
 * sources stay as they are. Programs that include "mikktspace/mikktspace.h" find that file in tspace's include
 * folder. Names, order and signatures are those of the reference (Morten S. Mikkelsen), the explanations are
 * tspace's. tspace_genTangSpace alone is an addition.
 *
 * Differences, all on the safe side: linear time and no recursion whatever the mesh; missing pointers give 0
 * instead of a crash; each corner is read once. Callbacks are called from the calling thread only, all getters
 * before the first setter.
 */
#ifndef TSPACE_COMPAT_MIKKTSPACE_H
#define TSPACE_COMPAT_MIKKTSPACE_H

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* 0 is false, everything else true. */
typedef int tbool;

typedef struct SMikkTSpaceContext SMikkTSpaceContext;

/* What the caller provides. Faces are numbered from 0 to m_getNumFaces - 1, the vertices of a face from 0 to
 * m_getNumVerticesOfFace - 1. The getters are required; each setter may be null. */
typedef struct SMikkTSpaceInterface {
    /* Number of faces. */
    int (*m_getNumFaces)(const SMikkTSpaceContext* pContext);

    /* Number of vertices of a face. Faces of 3 and 4 are computed; others get no results. */
    int (*m_getNumVerticesOfFace)(const SMikkTSpaceContext* pContext, const int iFace);

    /* Writes position (3 floats), normal (3) and texture coordinate (2) of one vertex of one face. Normals
     * are used as given. Equal vertices are found by value, so faces need not share an index. */
    void (*m_getPosition)(const SMikkTSpaceContext* pContext, float fvPosOut[], const int iFace, const int iVert);
    void (*m_getNormal)(const SMikkTSpaceContext* pContext, float fvNormOut[], const int iFace, const int iVert);
    void (*m_getTexCoord)(const SMikkTSpaceContext* pContext, float fvTexcOut[], const int iFace, const int iVert);

    /* Takes the unit tangent (3 floats) and sign of one vertex of one face. The bitangent for the pixel
     * shader is fSign * cross(normal, tangent). Results belong to (face, vertex) pairs: an index list made
     * before does not fit them. */
    void (*m_setTSpaceBasic)(const SMikkTSpaceContext* pContext, const float fvTangent[], const float fSign,
                             const int iFace, const int iVert);

    /* Takes everything: unit tangent and bitangent (3 floats each; not perpendicular in general), their
     * lengths before normalisation, and whether texture and surface have the same orientation (then the sign
     * is +1). Called before m_setTSpaceBasic for each vertex. */
    void (*m_setTSpace)(const SMikkTSpaceContext* pContext, const float fvTangent[], const float fvBiTangent[],
                        const float fMagS, const float fMagT, const tbool bIsOrientationPreserving, const int iFace,
                        const int iVert);
} SMikkTSpaceInterface;

struct SMikkTSpaceContext {
    SMikkTSpaceInterface* m_pInterface; /* the callbacks */
    void* m_pUserData;                  /* the caller's; never looked at */
};

/* Computes tangents with an angular threshold of 180 degrees, as every baker does.
 * Returns 1; or 0, without a call to a setter, when there is no face of 3 or 4 vertices, when a getter is
 * missing, when there are more than 2^31-1 corners, or when memory runs out. */
tbool genTangSpaceDefault(const SMikkTSpaceContext* pContext);

/* The same with a threshold in degrees: faces whose tangents differ by this or more are not averaged. Any
 * float is taken, as by the reference: only its cosine counts. */
tbool genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold);

/* genTangSpace with a number of threads and an allocator for all of its memory: tspace_Execution of
 * tspace/tspace.h, prepared by TSPACE_INIT; null: one thread and operator new. It changes no bit. Also 0 for an
 * execution that was not prepared. */
struct tspace_Execution;
tbool tspace_genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold,
                          const struct tspace_Execution* execution);

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
