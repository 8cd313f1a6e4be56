// SPDX-License-Identifier: MIT
// If tspace rejects a file of the Khronos validator's own tests, its error is one of the errors in the validator's
// report, at the same location.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"

namespace tspace {
namespace {

namespace fs = std::filesystem;

/// For each code of the validator: words of which tspace's message contains at least one.
using Words = std::vector<std::string>;
const std::map<std::string, Words> kReasons = {
    {"ACCESSOR_SMALL_BYTESTRIDE", {"overlap at a stride"}},
    {"ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", {"more sparse elements than elements"}},
    {"ACCESSOR_TOO_LONG", {"extend beyond its buffer view"}},
    {"ASSET_MIN_VERSION_GREATER_THAN_VERSION", {"requires glTF version"}},
    {"BUFFER_BYTE_LENGTH_MISMATCH", {"but its data has", "but the BIN chunk has"}},
    {"BUFFER_MISSING_GLB_DATA", {"the file has none"}},
    {"BUFFER_VIEW_TOO_LONG", {"extends beyond its buffer"}},
    {"GLB_CHUNK_TOO_BIG", {"extends beyond the end of the GLB"}},
    {"GLB_DUPLICATE_CHUNK", {"a second"}},
    {"GLB_EMPTY_CHUNK", {"chunk of the GLB is empty"}},
    {"GLB_INVALID_MAGIC", {"neither a GLB"}},
    {"GLB_INVALID_VERSION", {"the GLB has version"}},
    {"GLB_LENGTH_MISMATCH", {"but the file has"}},
    {"GLB_LENGTH_TOO_SMALL", {"too short for a JSON chunk"}},
    {"GLB_UNEXPECTED_BIN_CHUNK", {"not its second chunk"}},
    {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", {"but the file has"}},
    {"GLB_UNEXPECTED_END_OF_CHUNK_HEADER", {"header of a GLB chunk is truncated"}},
    {"GLB_UNEXPECTED_END_OF_HEADER", {"GLB header is truncated", "the file is empty"}},
    {"GLB_UNEXPECTED_FIRST_CHUNK", {"the first chunk of the GLB is not JSON"}},
    {"INVALID_JSON", {"syntax error", "the file is empty"}},
    {"INVALID_URI", {"data URI", "an empty scheme before its colon"}},
    {"IO_ERROR", {"does not exist"}},
    {"MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", {"but the primitive has"}},
    {"MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", {"but the primitive has"}},
    {"PATTERN_MISMATCH", {"requires glTF version"}},
    {"TYPE_MISMATCH", {"is not an object", "is not an array", "is not a string", "is not a number"}},
    {"UNDEFINED_PROPERTY", {"is missing"}},
    {"UNKNOWN_ASSET_MAJOR_VERSION", {"requires glTF version"}},
    {"UNRESOLVED_REFERENCE", {"there is no"}},
    {"VALUE_NOT_IN_RANGE", {"a number that is too large"}},
};

/// Files in which the validator finds no error, and words of the messages with which tspace rejects them.
const std::map<std::string, std::string> kRefusedBeyond = {
    {"base/asset/min_version_valid.gltf",
     "requires glTF version '2.1'"},  // newer than the versions that tspace supports
    {"base/root/named_objects.gltf", "the buffer of the buffer view has no data"},  // geometry that is not in the file
    {"base/root/unused_objects.gltf", "the buffer of the buffer view has no data"},
    {"base/buffer/non_relative_uri.gltf", "never loads"},  // a web address
};

bool hasWords(const std::string& message, const Words& words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& part) { return message.find(part) != std::string::npos; });
}

/// Returns whether one location equals or contains the other. Byte offsets are not compared, because one count includes
/// the header and the other does not. An error of a parser has no JSON pointer, so its location is not compared either.
bool isSamePlace(const std::string& ours, const std::string& theirs) {
    if (ours.empty() || theirs.empty() || ours[0] != '/' || theirs[0] != '/') return true;
    const auto isWithin = [](const std::string& inner, const std::string& outer) {
        return outer == "/" || inner == outer || inner.starts_with(outer + '/');
    };
    // Lengths and strides are members of views, to which accessors refer.
    const bool is_stride = ours.ends_with("/byteStride") && theirs.starts_with("/accessors/");
    return is_stride || isWithin(ours, theirs) || isWithin(theirs, ours);
}

/// Returns what is wrong with tspace's error; empty if it matches the report.
std::string faultOf(const Error& error, const nlohmann::json& report) {
    std::string seen;
    for (const nlohmann::json& message : report["issues"]["messages"]) {
        if (message["severity"] != 0) continue;
        const std::string code = message["code"], place = message.value("pointer", "");
        seen += code + ' ' + place + "; ";
        const auto row = kReasons.find(code);
        if (row != kReasons.end() && hasWords(error.message, row->second) && isSamePlace(error.place, place)) return {};
    }
    return "the validator says: " + seen;
}

TEST(ValidatorReasons, AreThoseOfRefusedFiles) {
    TSPACE_NEEDS_SHARED("bad/gltf-validator");
    const fs::path folder = test::shared("bad/gltf-validator");
    const test::TempFolder scratch;
    std::size_t refused = 0, beyond = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        GenerateOptions options{.selection = {.all = true}};
        options.selection.existing = ExistingTangents::replace;
        const auto report = generateFile(entry.path().string(), scratch.path("out" + extension).string(), options);
        if (report) continue;
        const Error& error = report.error();
        const std::string name = entry.path().lexically_relative(folder).string();
        const std::string what = name + ": " + error.message + " (at " + error.place + ")";
        EXPECT_NE(error.code, ErrorCode::internal) << what;
        if (const auto known = kRefusedBeyond.find(name); known != kRefusedBeyond.end()) {
            EXPECT_TRUE(hasWords(error.message, {known->second})) << what;
            ++beyond;
            continue;
        }
        ++refused;
        std::ifstream stream(fs::path(entry.path().string() + ".report.json"));
        if (!stream) stream = std::ifstream(fs::path(entry.path()).replace_extension(".report.json"));
        ASSERT_TRUE(stream) << name << " has no report";
        EXPECT_EQ(faultOf(error, nlohmann::json::parse(stream)), "") << what;
    }
    EXPECT_EQ(beyond, kRefusedBeyond.size());
    EXPECT_GT(refused, 50u);
}

}  // namespace
}  // namespace tspace
