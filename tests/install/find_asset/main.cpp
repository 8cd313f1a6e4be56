// SPDX-License-Identifier: MIT
// Uses one function of the installed library for files, which is enough to link it.
#include <tspace/inspect.h>

int main() {
    const auto result = tspace::inspectFile("there-is-no-such-file.glb");
    return !result && result.error().code == tspace::ErrorCode::cannotRead ? 0 : 1;
}
