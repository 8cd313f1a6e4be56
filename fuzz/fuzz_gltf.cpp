// SPDX-License-Identifier: MIT
// Whole glTF files: JSON with buffers in data URIs.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.gltf");
    return 0;
}
