// SPDX-License-Identifier: MIT
// Features missing in emscripten 3.1.6 with Debian's Clang 14. Included before everything else.
#pragma once

#include "../wasm/bit_cast.h"

extern "C" {

/// Variable through which a landing pad passes its number to the runtime, and receives the caught type. Clang 14
/// defines it as one variable for all threads, the runtime as one per thread; if it is defined as thread-local first,
/// Clang's code uses that definition. This requires exactly the unnamed type { i32, i8*, i32 }: the initial value
/// selects the member of the union that has it.
struct TspaceLandingPad {
    int number;
    union {
        int none;
        const char* table;
    };
    int selector;
};
[[gnu::weak, gnu::visibility("hidden")]] thread_local TspaceLandingPad __wasm_lpad_context = {
    .number = 0, .table = "", .selector = 0};

}  // extern "C"
