// SPDX-License-Identifier: MIT
// Whole Wavefront OBJ files.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.obj");
    return 0;
}
