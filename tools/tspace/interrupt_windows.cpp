// SPDX-License-Identifier: MIT
// Ctrl-C removes temporary files and ends the program. Windows restores the default handler before it calls this one on
// a separate thread.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <initializer_list>

#include "interrupt.h"
#include "model/io/temporary_files.h"

namespace tspace::tool {
namespace {

std::atomic<int> caught_signal = 0;

extern "C" void takeSignal(int signal) {
    const bool is_first = caught_signal.exchange(signal) == 0;
    std::signal(signal, takeSignal);
    if (!removeTemporaryFiles(!is_first)) {
        constexpr int kPatience_ms = 500;
        for (int i = 0; i < kPatience_ms; ++i) waitBriefly();
        removeTemporaryFiles(true);
    }
    std::_Exit(128 + signal);
}

}  // namespace

void endCleanlyBySignals() {
    for (const int signal : {SIGINT, SIGBREAK}) {
        if (std::signal(signal, takeSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() {
    removeTemporaryFiles(true);
    std::_Exit(128 + caught_signal);
}

}  // namespace tspace::tool
