// SPDX-License-Identifier: MIT
// Access to the files that a model references, for Assimp.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tspace::import {

/// Opens the model and files in its folder or below, according to the rule for glTF URIs (src/model/io/folder_rule.h):
/// no ".." in a name, and no link that leaves the folder. Other files appear not to exist.
class ModelFiles : public Assimp::DefaultIOSystem {
  public:
    /// Parameters: `anywhere` disables the rule. `refused` receives existing files that were not read, formatted for
    /// messages. `instead`: if not null, these bytes replace the model.
    ModelFiles(const std::string& model, bool anywhere, std::vector<std::string>& refused,
               const std::vector<char>* instead = nullptr);

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

  private:
    [[nodiscard]] std::string find(const std::filesystem::path& name) const;

    std::filesystem::path model_, folder_;
    bool anywhere_;
    std::vector<std::string>& refused_;
    const std::vector<char>* instead_;
};

}  // namespace tspace::import
