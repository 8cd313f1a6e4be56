// SPDX-License-Identifier: MIT
// Remedies of findings: sentences, and the commands in them as values.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tspace/check.h"

namespace tspace {

/// Sentences in which each "{}" stands for the next command.
struct Remedy {
    std::string text = {};
    std::vector<RemedyCommand> commands = {};
};

/// A command out of words that this program wrote, not out of names of files: "generate --crease 60", "convert-map MAP -o
/// OUT.png". Words that begin with a capital are placeholders, and a word behind an option is its value.
RemedyCommand toCommand(std::string_view words);

/// Adds an option; `value` is no placeholder.
RemedyCommand withOption(RemedyCommand command, std::string name, std::string value = {});

/// The usual remedy of a code (findingRemedy).
Remedy usualRemedy(FindingCode code);

/// Fills in Finding::remedy and Finding::commands. The "{}" of the text stay until spellRemedies, so that commands may change.
void setRemedy(Finding& finding, Remedy remedy);
inline void setRemedy(Finding& finding, std::string text) { setRemedy(finding, Remedy{std::move(text), {}}); }

/// Writes the commands of findings into their remedies. Once for each finding.
void spellRemedies(std::span<Finding> findings);

}  // namespace tspace
