// SPDX-License-Identifier: MIT
// Reports against their JSON Schemas in docs/schema.
#pragma once

#include <string>

namespace tspace::test {

/// What is wrong with a document that names a schema of tspace, a line each; empty: nothing, or it is no such document.
std::string reportFaults(const std::string& document);

}  // namespace tspace::test
