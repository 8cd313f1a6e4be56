// SPDX-License-Identifier: MIT
// A handler of signals may neither wait for a mutex nor take memory. It waits until nobody is at work on the list, which
// no signal interrupts, and then the list is its own.
#include "model/io/temporary_files.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

namespace tspace {

namespace {

std::mutex mutex;
std::atomic<bool> is_in_work = false, is_ending = false;

/// Never deleted: a signal may come while the program ends. Null: there was none yet.
std::vector<Path>* files = nullptr;

}  // namespace

TemporaryFilesInWork::TemporaryFilesInWork() {
    mutex.lock();
    is_in_work = true;
    if (!is_ending) return;
    is_in_work = false;
    while (true) waitBriefly();
}

TemporaryFilesInWork::~TemporaryFilesInWork() {
    is_in_work = false;
    mutex.unlock();
}

void TemporaryFilesInWork::add(const Path& path) {
    if (files == nullptr) files = new std::vector<Path>;
    files->push_back(path);
}

void TemporaryFilesInWork::forget(const Path& path) noexcept {
    if (files == nullptr) return;
    const auto found =
        std::find_if(files->begin(), files->end(), [&](const Path& known) { return known.string() == path.string(); });
    if (found == files->end()) return;
    std::swap(*found, files->back());
    files->pop_back();
}

void removeTemporaryFiles() {
    is_ending = true;
    // Renaming a few files takes no longer, or the disk does not answer.
    constexpr int kPatience_ms = 5000;
    for (int waited = 0; is_in_work; ++waited) {
        if (waited == kPatience_ms) return;
        waitBriefly();
    }
    if (files == nullptr) return;
    for (const Path& path : *files) removePath(path);
}

}  // namespace tspace
