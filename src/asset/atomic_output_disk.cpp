// SPDX-License-Identifier: MIT
// Temporary files beside their targets, renamed together at the end.
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "asset/atomic_output.h"
#include "asset/system_files.h"
#include "asset/temporary_name.h"

namespace tspace {

namespace fs = std::filesystem;

void AtomicOutput::removeTemporaryFiles() {
    std::error_code ignored;
    for (const File& file : files_) fs::remove(fs::path(file.temporary), ignored);
    // Only empty folders go: remove() fails on others.
    for (auto folder = created_folders_.rbegin(); folder != created_folders_.rend(); ++folder)
        fs::remove(fs::path(*folder), ignored);
}

void AtomicOutput::addFile(const Path& requested_path, const std::function<int(const Sink&)>& writeTo) {
    // A link keeps being a link: what it points at is replaced.
    std::error_code error;
    const fs::path requested = requested_path;
    const fs::path target = fs::is_symlink(requested, error) ? fs::weakly_canonical(requested) : requested;
    if (fs::is_directory(target, error)) failToWrite(target, "it is a folder");
    std::vector<fs::path> missing;
    for (fs::path folder = folderOf(target); !folder.empty() && !fs::exists(folder, error);
         folder = folder.parent_path()) {
        missing.push_back(folder);
    }
    for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
        if (fs::create_directory(*folder, error)) created_folders_.push_back(*folder);
        if (error) failToWrite(target, "cannot make its folder: " + error.message());
    }
    const Path temporary = besideName(target, kTemporaryEnding);
    CFile file = openFile(temporary, "wb");
    if (!file) failToWrite(target, std::strerror(errno));
    files_.push_back({temporary, target});
    const int failure = writeTo([&file](std::span<const std::uint8_t> part) {
        return std::fwrite(part.data(), 1, part.size(), file.get()) == part.size();
    });
    if (failure != 0) failToWrite(target, std::strerror(failure));
    if (std::fclose(file.release()) != 0) failToWrite(target, std::strerror(errno));
    const fs::file_status old = fs::status(target, error);
    if (fs::exists(old)) fs::permissions(fs::path(temporary), old.permissions(), error);
}

void AtomicOutput::renameFiles() {
    // Old files are set aside first, so that a failure half-way can be taken back.
    struct Aside {
        fs::path old_name, new_name;
        bool renamed = false;
    };
    std::vector<Aside> aside(files_.size());
    std::error_code error, ignored;
    std::size_t done = 0;
    for (std::size_t i = files_.size(); i-- > 0 && !error; ++done) {
        const File& file = files_[i];
        if (fs::is_directory(fs::path(file.target), ignored)) {
            error = std::make_error_code(std::errc::is_a_directory);
            continue;
        }
        if (files_.size() > 1 && fs::exists(fs::path(file.target), ignored)) {
            aside[i] = {file.target, besideName(file.target, ".old"), false};
            fs::create_hard_link(aside[i].old_name, aside[i].new_name, error);
            // Not every file system has hard links.
            if (error) fs::rename(aside[i].old_name, aside[i].new_name, error);
            if (error) continue;
            aside[i].renamed = true;
        }
        fs::rename(fs::path(file.temporary), fs::path(file.target), error);
    }
    if (error) {
        const std::size_t failed = files_.size() - done;
        for (std::size_t i = failed; i < files_.size(); ++i) {
            if (aside[i].renamed) {
                fs::rename(aside[i].new_name, aside[i].old_name, ignored);
                // Where both names are still one file, renaming does nothing.
                fs::remove(aside[i].new_name, ignored);
            } else if (i != failed) {
                fs::remove(fs::path(files_[i].target), ignored);
            }
        }
        failToWrite(files_[failed].target, error.message());
    }
    for (const Aside& old : aside) {
        if (old.renamed) fs::remove(old.new_name, ignored);
    }
}

}  // namespace tspace
