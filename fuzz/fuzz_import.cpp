// SPDX-License-Identifier: MIT
// What an importer answers that a hostile model has taken over: any messages, any result, through every command.
#include "whole_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tspace::fuzz::runOnFile(data, size, "in.fbx", {.importer = TSPACE_HOSTILE_IMPORTER, .sync = false});
    return 0;
}
