/* SPDX-License-Identifier: MIT */
/* The interface of the MikkTSpace reference implementation, implemented by tspace with bit-identical results.
 *
 * A program that uses the reference puts the folder of this file on its include path and links tspace; its sources need
 * no changes. Programs that include "mikktspace/mikktspace.h" find that file in tspace's include folder. Names, order
 * and signatures are those of the reference (Morten S. Mikkelsen); the comments are tspace's. Only tspace_genTangSpace
 * is an addition.
 *
 * Differences from the reference: linear time and no recursion for any mesh; missing pointers make the call return 0
 * instead of crashing; each corner is read once. Callbacks are called from the calling thread only, all getters before
 * the first
 * setter. */
#ifndef TSPACE_COMPAT_MIKKTSPACE_H
#define TSPACE_COMPAT_MIKKTSPACE_H

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* 0 is false, all other values are true. */
typedef int tbool;

typedef struct SMikkTSpaceContext SMikkTSpaceContext;

/* Callbacks of the caller. Faces are numbered from 0 to m_getNumFaces - 1, the vertices of a face from 0 to
 * m_getNumVerticesOfFace - 1. The getters are required; each setter may be null. */
typedef struct SMikkTSpaceInterface {
    /* Returns the number of faces. */
    int (*m_getNumFaces)(const SMikkTSpaceContext* pContext);

    /* Returns the number of vertices of a face. Faces with 3 and 4 vertices are computed; others get no results. */
    int (*m_getNumVerticesOfFace)(const SMikkTSpaceContext* pContext, const int iFace);

    /* Write position (3 floats), normal (3) and texture coordinate (2) of one vertex of one face. Normals are used as
     * given. Equal vertices are found by value, so faces need not share an index. */
    void (*m_getPosition)(const SMikkTSpaceContext* pContext, float fvPosOut[], const int iFace, const int iVert);
    void (*m_getNormal)(const SMikkTSpaceContext* pContext, float fvNormOut[], const int iFace, const int iVert);
    void (*m_getTexCoord)(const SMikkTSpaceContext* pContext, float fvTexcOut[], const int iFace, const int iVert);

    /* Receives the unit tangent (3 floats) and sign of one vertex of one face. The bitangent for the pixel shader is
     * fSign * cross(normal, tangent). Results belong to (face, vertex) pairs: they do not fit an index list made before
     * the call. */
    void (*m_setTSpaceBasic)(const SMikkTSpaceContext* pContext, const float fvTangent[], const float fSign,
                             const int iFace, const int iVert);

    /* Receives all results: unit tangent and bitangent (3 floats each; not perpendicular in general), their lengths
     * before normalization, and whether texture and surface have the same orientation (then the sign is +1). Called
     * before m_setTSpaceBasic for each vertex. */
    void (*m_setTSpace)(const SMikkTSpaceContext* pContext, const float fvTangent[], const float fvBiTangent[],
                        const float fMagS, const float fMagT, const tbool bIsOrientationPreserving, const int iFace,
                        const int iVert);
} SMikkTSpaceInterface;

struct SMikkTSpaceContext {
    SMikkTSpaceInterface* m_pInterface; /* the callbacks */
    void* m_pUserData;                  /* pointer of the caller; not used by tspace */
};

/* Computes tangents with an angular threshold of 180 degrees, as every baker does. Returns 1. Returns 0, without
 * calling a setter, if there is no face with 3 or 4 vertices, a getter is missing, there are more than 2^31-1 corners,
 * or memory runs out. */
tbool genTangSpaceDefault(const SMikkTSpaceContext* pContext);

/* Like genTangSpaceDefault with a threshold in degrees: faces whose tangents differ by this or more are not averaged.
 * As in the reference, any float is accepted: only its cosine is used. */
tbool genTangSpace(const SMikkTSpaceContext* pContext, const float fAngularThreshold);

/* Like genTangSpace, with a number of threads and an allocator for all memory: tspace_Execution of tspace/tspace.h,
 * initialized by TSPACE_INIT; null: one thread and operator new. It does not affect the results. Also returns 0 for an
 * execution that was not initialized. */
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
