// SPDX-License-Identifier: MIT
// Whole files: the binary container, then all behind it.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.glb");
    return 0;
}
