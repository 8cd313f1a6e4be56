// SPDX-License-Identifier: MIT
// All measurements, as a list of records that tables and plots query.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "damage.h"
#include "measure.h"

namespace tspace::accuracy {

/// Result for one mesh and one method.
struct Record {
    std::string surface, tessellation, damage, method;
    bool held_out = false;
    int cells = 0;
    double share = 0;              ///< amount of damage
    Spread inside = {}, all = {};  ///< errors of tangents
    double border = 0;             ///< mean error of tangents at the border of the chart and at the fold
    double fold_gap = 0;
    double shading = 0;
    double from_mikktspace = 0;       ///< mean angle between the shading of this method and of `mikktspace`
    double bitangent = 0, cross = 0;  ///< mean errors of stored bitangents and of sign * cross(N, T)

    [[nodiscard]] bool isIrregular() const { return tessellation == "irregular" || tessellation == "random"; }
};

/// Like Record, for vertex normals; `method` is the weighting.
struct NormalRecord {
    std::string surface, tessellation, damage, method;
    bool held_out = false;
    int cells = 0;
    double share = 0;
    Spread inside = {}, all = {};
    double flat_shading = 0;  ///< shading error with a flat map
    double bent_shading = 0;  ///< shading error with a bumpy map, and tangents by `best` from these normals

    [[nodiscard]] bool isIrregular() const { return tessellation == "irregular" || tessellation == "random"; }
};

struct StudyOptions {
    bool quick = false;
    std::uint64_t seed = 1;
    bool held_out = true;
};

struct Study {
    StudyOptions options = {};
    std::vector<Record> records = {};
    std::vector<NormalRecord> normals = {};
    /// Names in the order of the table; `floor` is the last of the methods.
    std::vector<std::string> methods = {}, weightings = {};
};

Study runStudy(const StudyOptions& options);

/// Returns the geometric mean, so that difficult surfaces do not dominate. Errors below a millionth of a degree count
/// as a millionth. Returns NaN if there are no values.
double geometricMean(const std::vector<double>& values);

template <class RecordType>
std::vector<double> collect(const std::vector<RecordType>& records,
                            const std::function<bool(const RecordType&)>& wanted,
                            const std::function<double(const RecordType&)>& value) {
    std::vector<double> values;
    for (const RecordType& record : records) {
        if (wanted(record)) values.push_back(value(record));
    }
    return values;
}

}  // namespace tspace::accuracy
