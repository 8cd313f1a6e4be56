// SPDX-License-Identifier: MIT
// Handles signals: removes temporary files and ends the program.
#include "interrupt.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <initializer_list>

#include "model/io/temporary_files.h"

namespace tspace::tool {
namespace {

std::atomic<int> caught_signal = 0;

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

/// Raises SIGALRM in half a second. Returns false if the system does not support the timer.
bool startTimer() {
    constexpr itimerval kHalfSecond = {.it_interval = {}, .it_value = {.tv_sec = 0, .tv_usec = 500000}};
    return setitimer(ITIMER_REAL, &kHalfSecond, nullptr) == 0;
}

extern "C" void takeSignal(int signal) {
    // SIGALRM marks the end of the half second, or another process sent it.
    const bool may_wait = signal != SIGPIPE && signal != SIGALRM && caught_signal == 0;
    if (!removeTemporaryFiles(!may_wait)) {
        caught_signal = signal;
        if (startTimer()) return;
        removeTemporaryFiles(true);
    }
    endBy(caught_signal != 0 ? caught_signal.load() : signal);
}

}  // namespace

void endCleanlyBySignals() {
    struct sigaction action = {};
    action.sa_handler = takeSignal;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM}) {
        struct sigaction old = {};
        // Signals that the caller ignores (nohup, background jobs) stay ignored, except SIGALRM, which the timer needs.
        if (sigaction(signal, nullptr, &old) == 0 && (old.sa_handler != SIG_IGN || signal == SIGALRM))
            sigaction(signal, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
}

bool wasInterrupted() { return caught_signal != 0; }

void endByInterrupt() {
    removeTemporaryFiles(true);
    endBy(caught_signal);
}

}  // namespace tspace::tool
