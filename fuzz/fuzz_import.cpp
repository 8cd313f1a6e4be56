// SPDX-License-Identifier: MIT
// Output of an importer that a hostile model controls: every command gets arbitrary messages and results from it.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.fbx", {.importer = TSPACE_HOSTILE_IMPORTER, .sync = false});
    return 0;
}
