// SPDX-License-Identifier: MIT
// The files that a model names, for Assimp.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tspace::import {

/// Opens the model, and what lies in its folder or below, by the rule for the URIs of glTF (src/model/io/folder_rule.h): no ".."
/// in a name, and no link that leads out. Others are not there.
class ModelFiles : public Assimp::DefaultIOSystem {
  public:
    /// `anywhere` lifts the rule. `refused` gets what is there and was not read, fit for a message. `instead`: where not null,
    /// what is read in place of the model.
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
