// SPDX-License-Identifier: MIT
// A study as tables for people (Markdown, so that they can go into a page) and as JSON.
#pragma once

#include <string>

#include "study.h"

namespace tspace::accuracy {

/// What is asked of `fast` and `best`, beside what was measured, and then every figure of every method.
void printTables(const Study& study);
/// A table of normals on scans.
void printScans(const StudyOptions& options);
/// Tables of normals by what meshes come from: weightings, hard edges, noise.
void printKinds(const StudyOptions& options);
/// All figures. `path`: a file, or "-" for stdout. False when it cannot be written.
bool writeJson(const Study& study, const std::string& path);

}  // namespace tspace::accuracy
