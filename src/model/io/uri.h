// SPDX-License-Identifier: MIT
// URIs, and the files that a model names by them.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "model/io/file_io.h"
#include "model/io/path.h"
#include "tspace/asset.h"

namespace tspace {

// URIs as model files use them: data URIs, and paths relative to the model's folder, which are the only ones
// that are followed unless the caller allows more.

enum class UriKind { data, path, otherScheme };

UriKind uriKind(std::string_view uri);

struct DataUri {
    std::string mime_type = {};
    Bytes bytes = {};
};

/// Decodes a data URI, base64 or percent-encoded. Fails with invalidFile at `place`.
DataUri decodeDataUri(std::string_view uri, const std::string& place);

std::string encodeBase64(const Bytes& bytes);

std::string encodeDataUri(std::string_view mime_type, const Bytes& bytes);

/// %41 -> A. A percent sign that starts no valid escape stays as it is, because file names contain them.
std::string percentDecode(std::string_view text);

/// Escapes what may not stand in the path of a URI.
std::string percentEncode(std::string_view path);

/// The path that a relative URI stands for: escapes decoded, and Windows' separators, which some exporters write, as
/// slashes, without "." and with ".." only at the front.
std::string pathOfUri(std::string_view uri);

/// pathOfUri with checks. Fails with forbiddenPath when the path is absolute (also at a drive of Windows), has a scheme or
/// leads out of the folder; `allow_external` lifts all of these but the scheme.
std::string checkedPathOfUri(std::string_view uri, bool allow_external, const std::string& place);

/// How messages on refused paths end: the option that lifts the rule.
inline constexpr const char* kFollowed = " (--allow-external follows it)";

/// Fails with forbiddenPath. `why`: the fault, a predicate of the URI.
[[noreturn]] void refuseUri(std::string_view uri, const std::string& why, const std::string& place);

/// The file that `uri` names in a folder on the disk. Fails as checkedPathOfUri, and with forbiddenPath when a symbolic
/// link leads out of `folder`, unless `allow_external`; with invalidFile where no file can have that name, as one that is
/// longer than the system takes.
Path resolveUri(const Path& folder, std::string_view uri, bool allow_external, const std::string& place);

// The files that a model names: in its folder, or given by the caller's callback for a model in memory.

class NamedFiles {
  public:
    enum class Kind { file, folder, missing };

    NamedFiles() = default;
    /// `model`: the path of the model or, with FileOptions::content, its name.
    NamedFiles(const Path& model, const FileOptions& options);

    /// Whether the model is in memory.
    [[nodiscard]] bool areInMemory() const { return is_in_memory_; }
    /// Whether no file can be read: the model is in memory, and the caller gave no callback.
    [[nodiscard]] bool areNone() const { return is_in_memory_ && !find_file_; }
    /// The folder of the model; empty where it is in memory.
    [[nodiscard]] const Path& folder() const { return folder_; }

    /// The path of the file that `uri` names, for the other functions. Fails as resolveUri; with invalidFile if areNone().
    [[nodiscard]] Path resolve(std::string_view uri, const std::string& place) const {
        return resolve(folder_, uri, place);
    }
    /// resolve() for a URI in a file of another folder.
    [[nodiscard]] Path resolve(const Path& folder, std::string_view uri, const std::string& place) const;

    [[nodiscard]] Kind kindOf(const Path& file) const;
    /// Why the file that `uri` names cannot be read; empty: it is there. Not if areNone().
    [[nodiscard]] std::string whyNotRead(std::string_view uri, const std::string& place) const;
    /// Reports a named file that is not read, or not yet.
    void note(const Path& file) const;
    /// Fails as readFile.
    [[nodiscard]] Bytes read(const Path& file, const std::string& place = {}) const;

  private:
    [[nodiscard]] Result<std::span<const std::uint8_t>> find(const Path& file) const;

    Path folder_ = {};
    FindFile find_file_ = {};
    std::function<void(const std::string&)> opened_ = {}, named_ = {};
    bool is_in_memory_ = false;
    bool allow_external_ = false;
};

}  // namespace tspace
