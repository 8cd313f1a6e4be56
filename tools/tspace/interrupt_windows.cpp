// SPDX-License-Identifier: MIT
// Ctrl-C sets a flag that the work polls, or ends the program. Windows restores the default handler when it calls ours, which
// it does on a thread of its own.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <initializer_list>

#include "interrupt.h"
#include "model/io/atomic_output.h"

namespace tspace::tool {
namespace {

std::atomic<int> caught_signal = 0;
std::atomic<bool> marks_first = false;

extern "C" void takeSignal(int signal) {
    int none = 0;
    if (marks_first && caught_signal.compare_exchange_strong(none, signal)) {
        std::signal(signal, takeSignal);
        return;
    }
    removeTemporaryFiles();
    std::_Exit(128 + signal);
}

}  // namespace

void tidyUpAtSignals() {
    for (const int signal : {SIGINT, SIGBREAK}) {
        if (std::signal(signal, takeSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

void catchInterrupts() { marks_first = true; }

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() {
    removeTemporaryFiles();
    std::_Exit(128 + caught_signal);
}

}  // namespace tspace::tool
