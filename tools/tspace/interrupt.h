// SPDX-License-Identifier: MIT
// Signals that end the program immediately, without leaving temporary files.
#pragma once

namespace tspace::tool {

/// Installs the signal handlers; must be called first. From then on, SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGPIPE end
/// the program at any moment of any command: the handler removes the temporary files, and ends the program with the
/// same signal, as callers expect. If outputs are already in place, the first signal except SIGPIPE gives the program
/// half a second to report them. A file that grows too large (SIGXFSZ) causes a write error.
void endCleanlyBySignals();

/// Returns whether a signal arrived when outputs were in place. Commands with several files then start no further file.
bool wasInterrupted();
/// Ends the program with the signal that arrived, so that a calling shell or make detects it.
[[noreturn]] void endByInterrupt();

}  // namespace tspace::tool
