/* SPDX-License-Identifier: MIT */
/* Errors of packing and unpacking frames from C. Their results are tested by c_cases_test. */
#include "tspace/tspace.h"

#include "c_check.h"

static const float normals[] = {0, 0, 1, 1, 0, 0};
static const float tangents[] = {1, 0, 0, -1, 0, 2, 0, 1};

static tspace_ErrorCode pack(tspace_FrameFormat format, void* out, size_t out_bytes, tspace_PackReport* report) {
    const tspace_ConstSpan n = {normals, 2, 0}, t = {tangents, 2, 0};
    return tspace_packFrames(n, t, format, out, out_bytes, report, NULL);
}

static void checkErrors(void) {
    unsigned char bytes[8];
    tspace_PackReport unsized = {0};
    CHECK(pack(9, bytes, 8, NULL) == TSPACE_ERROR_INVALID_OPTION);
    CHECK(pack(TSPACE_FRAME_FORMAT_FRAME32, bytes, 7, NULL) == TSPACE_ERROR_COUNT_MISMATCH);
    CHECK(pack(TSPACE_FRAME_FORMAT_FRAME32, NULL, 8, NULL) == TSPACE_ERROR_NULL_DATA);
    CHECK(pack(TSPACE_FRAME_FORMAT_FRAME32, bytes, 8, &unsized) == TSPACE_ERROR_INVALID_OPTION);
}

void checkPackFunctions(void);
void checkPackFunctions(void) {
    CHECK(tspace_frameBytes(TSPACE_FRAME_FORMAT_FRAME48) == 6 && tspace_frameBytes(9) == 0);
    const tspace_FrameErrorBound bound = tspace_frameErrorBound(TSPACE_FRAME_FORMAT_OCT32);
    CHECK(bound.normal_deg == 0.15 && bound.tangent_deg == 0.165 && tspace_frameErrorBound(9).normal_deg == 0);
    checkErrors();
}
