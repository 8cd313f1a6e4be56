// SPDX-License-Identifier: MIT
// Signals to a mark that the work looks at now and then.
#include "interrupt.h"

#include <csignal>
#include <cstdlib>
#include <initializer_list>

namespace tspace::tool {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

extern "C" void markSignal(int signal) { caught_signal = signal; }

}  // namespace

void catchInterrupts() {
    struct sigaction action = {};
    action.sa_handler = markSignal;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old = {};
        // nohup and background jobs ask for signals to be ignored; that stays.
        if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
}

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() {
    std::signal(caught_signal, SIG_DFL);
    std::raise(caught_signal);
    std::_Exit(128 + caught_signal);
}

}  // namespace tspace::tool
