// SPDX-License-Identifier: MIT
#include "model_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstdint>
#include <system_error>

#include "model/io/folder_rule.h"

namespace tspace::import {

namespace fs = std::filesystem;

ModelFiles::ModelFiles(const std::string& model, bool anywhere, std::vector<std::string>& refused,
                       const std::vector<char>* instead)
    : model_(model), folder_(model_.parent_path()), anywhere_(anywhere), refused_(refused), instead_(instead) {}

/// Returns the path of a file on the disk if the rule allows it; empty if it does not exist. Assimp prefixes most names
/// with the folder; other names are also relative to it.
std::string ModelFiles::find(const fs::path& name) const {
    const fs::path file = folder_ / name;
    std::error_code failed;
    if (fs::status(file, failed).type() != fs::file_type::regular) return {};
    if (anywhere_ || file == model_) return file.string();
    fs::path below;
    const auto folder_end = std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end());
    for (auto part = folder_end.second; part != file.end(); ++part) below /= *part;
    const bool is_named_below = folder_end.first == folder_.end() && leadsAway(below) == nullptr;
    if (is_named_below && isBelow(fs::weakly_canonical(folder_, failed), fs::weakly_canonical(file, failed)) && !failed)
        return file.string();
    constexpr std::size_t kMaxNamed = 8;
    const std::string refused = file.filename().string();
    if (refused_.size() < kMaxNamed && std::find(refused_.begin(), refused_.end(), refused) == refused_.end())
        refused_.push_back(refused);
    return {};
}

bool ModelFiles::Exists(const char* file) const { return !find(file).empty(); }

Assimp::IOStream* ModelFiles::Open(const char* file, const char* mode) {
    const std::string found = find(file);
    if (instead_ != nullptr && found == model_.string() && *mode == 'r')
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(instead_->data()), instead_->size());
    return found.empty() || *mode != 'r' ? nullptr : DefaultIOSystem::Open(found.c_str(), mode);
}

}  // namespace tspace::import
