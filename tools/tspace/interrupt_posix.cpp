// SPDX-License-Identifier: MIT
// Signals set a flag that the work polls, or end the program.
#include "interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <initializer_list>

#include "model/io/atomic_output.h"

namespace tspace::tool {
namespace {

std::atomic<int> caught_signal = 0;
std::atomic<bool> marks_first = false;

[[noreturn]] void endBy(int signal) {
    struct sigaction action = {};
    action.sa_handler = SIG_DFL;
    sigaction(signal, &action, nullptr);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, signal);
    pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
    raise(signal);
    _exit(128 + signal);
}

extern "C" void takeSignal(int signal) {
    int none = 0;
    if (marks_first && signal != SIGPIPE && caught_signal.compare_exchange_strong(none, signal)) return;
    removeTemporaryFiles();
    endBy(signal);
}

}  // namespace

void tidyUpAtSignals() {
    struct sigaction action = {};
    action.sa_handler = takeSignal;
    sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) {
        struct sigaction old = {};
        // nohup and background jobs ask for signals to be ignored; that stays.
        if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
}

void catchInterrupts() { marks_first = true; }

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() {
    removeTemporaryFiles();
    endBy(caught_signal);
}

}  // namespace tspace::tool
