// SPDX-License-Identifier: MIT
// What emscripten 3.1.6 with Debian's Clang 14 lacks. Included before everything else.
#pragma once

#include "../wasm/bit_cast.h"

extern "C" {

/// Where a landing pad tells the runtime which one it is, and is told what was caught. Clang 14 writes it as one variable for all
/// threads, and the runtime as one for each; where it is defined as that before, Clang's code follows. That takes exactly the type
/// { i32, i8*, i32 } without a name: of the union's members, the initial value chooses.
struct TspaceLandingPad {
    int number;
    union {
        int none;
        const char* table;
    };
    int selector;
};
[[gnu::weak, gnu::visibility("hidden")]] thread_local TspaceLandingPad __wasm_lpad_context = {.number = 0, .table = "", .selector = 0};

}  // extern "C"
