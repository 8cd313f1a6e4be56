// SPDX-License-Identifier: MIT
// Ctrl-C: the file in work is given up cleanly, so that nothing half-written stays behind.
#pragma once

namespace tspace::tool {

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a mark; a second one of the same kind ends the
/// program at once.
void catchInterrupts();
bool wasInterrupted();
/// Ends the program by the signal that was caught, so that a calling shell or make sees it.
[[noreturn]] void endByInterrupt();

}  // namespace tspace::tool
