// SPDX-License-Identifier: MIT
// Validation of reports against their JSON Schemas in docs/schema.
#pragma once

#include <string>

namespace tspace::test {

/// Returns the faults of a document that names a tspace schema, one per line; empty if it is valid, or names no such
/// schema.
std::string reportFaults(const std::string& document);

}  // namespace tspace::test
