// SPDX-License-Identifier: MIT
// Uses the installed C API for files.
#include <tspace/tspace_files.h>

#include <cstdio>

int main() {
    tspace_Model model;
    TSPACE_INIT(model);
    const uint8_t bytes[] = {'g', 'l', 'T', 'F'};
    model.data = bytes;
    model.size = sizeof(bytes);
    tspace_Error error;
    const tspace_ErrorCode code = tspace_inspectBytes(&model, "{\"memory-limit\": \"64M\"}", nullptr, &error);
    std::puts(error.message);
    return code == TSPACE_ERROR_INVALID_FILE ? 0 : 1;
}
