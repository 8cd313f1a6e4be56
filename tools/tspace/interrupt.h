// SPDX-License-Identifier: MIT
// Signals that end the program: none leaves temporary files, and none waits for the work.
#pragma once

namespace tspace::tool {

/// Call it first. From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGPIPE end the program at once, at any moment of any
/// command: their handler removes the temporary files and ends the program by the same signal, as callers expect. Where
/// outputs are already in place, the first signal but SIGPIPE gives the program half a second to report them.
/// A file that grows too large (SIGXFSZ) is an error of writing.
void endCleanlyBySignals();

/// Whether a signal came when outputs were in place. Commands with several files then begin no other one.
bool wasInterrupted();
/// Ends the program by that signal, so that a calling shell or make sees it.
[[noreturn]] void endByInterrupt();

}  // namespace tspace::tool
