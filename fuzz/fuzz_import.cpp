// SPDX-License-Identifier: MIT
// Output of an importer that is under control of a hostile model: arbitrary messages and results, through every
// command.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.fbx", {.importer = TSPACE_HOSTILE_IMPORTER, .sync = false});
    return 0;
}
