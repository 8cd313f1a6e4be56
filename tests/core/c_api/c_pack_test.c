/* SPDX-License-Identifier: MIT */
/* Packed frames from C. */
#include "tspace/tspace.h"

#include "c_check.h"

static const float normals[] = {0, 0, 1, 1, 0, 0};
static const float tangents[] = {1, 0, 0, -1, 0, 2, 0, 1};

static tspace_ErrorCode pack(tspace_FrameFormat format, void* out, size_t out_bytes, tspace_PackReport* report) {
    const tspace_ConstSpan n = {normals, 2, 0}, t = {tangents, 2, 0};
    return tspace_packFrames(n, t, format, out, out_bytes, report, NULL);
}

static void checkRoundTrip(tspace_FrameFormat format) {
    unsigned char bytes[32];
    const size_t size = 2 * tspace_frameBytes(format);
    tspace_PackReport report;
    TSPACE_INIT(report);
    CHECK(pack(format, bytes, size, &report) == TSPACE_OK);
    CHECK(report.not_unit_count == 1 && report.mended_count == 1);
    CHECK(pack(format, bytes, size, NULL) == TSPACE_OK);

    float n[6], t[8];
    const tspace_Span n_out = {n, 2, 0}, t_out = {t, 2, 0};
    CHECK(tspace_unpackFrames(bytes, size, format, n_out, t_out, NULL) == TSPACE_OK);
    CHECK(n[2] > 0.9999f && n[3] > 0.9999f && t[0] > 0.9999f && t[5] > 0.9999f);
    CHECK(t[3] == -1 && t[7] == 1);
    CHECK(tspace_unpackFrames(bytes, size - 1, format, n_out, t_out, NULL) == TSPACE_ERROR_COUNT_MISMATCH);
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
    for (tspace_FrameFormat format = 0; format <= TSPACE_FRAME_FORMAT_GLTF_SNORM16; ++format) checkRoundTrip(format);
    checkErrors();
}
