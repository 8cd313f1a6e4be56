// SPDX-License-Identifier: MIT
// Prints tables as Markdown (for pasting into the docs) and as JSON.
#pragma once

#include <string>

#include "study.h"

namespace tspace::accuracy {

/// Prints the targets of `fast` and `best` next to the measured values, and then every figure of every method.
void printTables(const Study& study);
/// Prints a table of normals on scans.
void printScans(const StudyOptions& options);
/// Prints tables of normals by kind of mesh: weightings, hard edges, noise.
void printKinds(const StudyOptions& options);
/// Writes all figures. `path`: a file, or "-" for stdout. Returns false if it cannot be written.
bool writeJson(const Study& study, const std::string& path);

}  // namespace tspace::accuracy
