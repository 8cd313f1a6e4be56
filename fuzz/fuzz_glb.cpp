// SPDX-License-Identifier: MIT
// Whole GLB files: the binary container and its contents.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.glb");
    return 0;
}
