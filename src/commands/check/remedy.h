// SPDX-License-Identifier: MIT
// Remedies of findings: sentences, and the commands in them as structures.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tspace/check.h"

namespace tspace {

/// Sentences in which each "{}" is replaced by the next command.
struct Remedy {
    std::string text = {};
    std::vector<RemedyCommand> commands = {};
};

/// Parses a command from words of this program, never from file names: "generate --crease 60", "convert-map MAP -o
/// OUT.png". Words with a capital first letter are placeholders, and a word after an option is its value.
RemedyCommand toCommand(std::string_view words);

/// Adds an option; `value` is not a placeholder.
RemedyCommand withOption(RemedyCommand command, std::string name, std::string value = {});

/// Returns the usual remedy of a code (findingRemedy).
Remedy usualRemedy(FindingCode code);

/// Sets Finding::remedy and Finding::commands. Each "{}" of the text remains until formatRemedies, so that commands may
/// change.
void setRemedy(Finding& finding, Remedy remedy);
inline void setRemedy(Finding& finding, std::string text) { setRemedy(finding, Remedy{std::move(text), {}}); }

/// Replaces each "{}" in the remedies of findings by its command. Must be called once per finding.
void formatRemedies(std::span<Finding> findings);

}  // namespace tspace
