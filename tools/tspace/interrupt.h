// SPDX-License-Identifier: MIT
// Signals that end the program: none leaves temporary files.
#pragma once

namespace tspace::tool {

/// Call it first. From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGPIPE take the temporary files away before they end the
/// program, as they do without us. A file that grows too large is an error of writing.
void tidyUpAtSignals();

/// From now on the first signal but SIGPIPE only sets a mark, and the file in work is given up cleanly; a second one ends
/// the program at once.
void catchInterrupts();
bool wasInterrupted();
/// Ends the program by the signal that was caught, so that a calling shell or make sees it.
[[noreturn]] void endByInterrupt();

}  // namespace tspace::tool
