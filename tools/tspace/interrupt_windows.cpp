// SPDX-License-Identifier: MIT
// Ctrl-C to a mark that the work looks at now and then. The system itself sets the default again when it comes.
#include <csignal>
#include <cstdlib>
#include <initializer_list>

#include "interrupt.h"

namespace tspace::tool {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

extern "C" void markSignal(int signal) { caught_signal = signal; }

}  // namespace

void catchInterrupts() {
    for (const int signal : {SIGINT, SIGBREAK}) {
        if (std::signal(signal, markSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() { std::_Exit(128 + caught_signal); }

}  // namespace tspace::tool
