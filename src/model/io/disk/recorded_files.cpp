// SPDX-License-Identifier: MIT
#include "model/io/recorded_files.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include "model/io/file_io.h"

namespace tspace {
namespace {

/// Recorded paths in the order in which they were added, each file once.
struct RecordedPaths {
    std::vector<std::string> paths = {};
    std::set<std::string> identities = {};

    void add(const std::string& path) {
        if (identities.insert(identityOf(path)).second) paths.push_back(path);
    }
};

struct Record {
    std::mutex mutex = {};
    std::atomic<bool> is_kept = false;
    RecordedPaths inputs = {}, outputs = {};
};

Record& record() {
    static Record all;
    return all;
}

}  // namespace

RecordedFiles::RecordedFiles() { record().is_kept = true; }

RecordedFiles::~RecordedFiles() {
    Record& all = record();
    const std::lock_guard lock(all.mutex);
    all.is_kept = false;
    all.inputs = all.outputs = {};
}

std::vector<std::string> RecordedFiles::inputs() const {
    const std::lock_guard lock(record().mutex);
    // A file that did not exist when it was recorded had a different identity then.
    std::set<std::string> written;
    for (const std::string& path : record().outputs.paths) written.insert(identityOf(path));
    std::vector<std::string> paths = record().inputs.paths;
    std::erase_if(paths, [&](const std::string& path) { return written.contains(identityOf(path)); });
    return paths;
}

std::vector<std::string> RecordedFiles::outputs() const {
    const std::lock_guard lock(record().mutex);
    return record().outputs.paths;
}

void recordInput(const std::string& path) {
    if (!record().is_kept) return;
    const std::lock_guard lock(record().mutex);
    record().inputs.add(path);
}

void recordOutput(const std::string& path) {
    if (!record().is_kept) return;
    const std::lock_guard lock(record().mutex);
    record().outputs.add(path);
}

}  // namespace tspace
