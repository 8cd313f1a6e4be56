// SPDX-License-Identifier: MIT
// Validation of reports against their JSON Schemas in docs/schema.
#pragma once

#include <string>

namespace tspace::test {

/// Returns the faults of a document that names one of tspace's schemas, one per line. Returns an empty string if it is
/// valid or names no such schema.
std::string reportFaults(const std::string& document);

}  // namespace tspace::test
