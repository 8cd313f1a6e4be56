// SPDX-License-Identifier: MIT
// FBX in binary: records in records, each with properties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tspace::import {

/// One value: a number, a text, or an array.
struct FbxProperty {
    char type = 0;                ///< as in the file: 'D' a double, 'd' an array of them, 'S' a text
    std::string_view bytes = {};  ///< behind the type; of a text and of raw bytes without their length

    [[nodiscard]] std::optional<double> number() const;  ///< of 'D'
    [[nodiscard]] std::string_view text() const { return type == 'S' ? bytes : std::string_view(); }
};

/// Doubles of a property of type 'd', which may be compressed. Nothing where it is broken, or claims more than its bytes can hold, or more
/// than an array of the format holds as it is.
std::optional<std::vector<double>> doublesOf(const FbxProperty& property);

/// A record, without those in it.
struct FbxRecord {
    std::string_view name = {};
    std::size_t length_field = 0;      ///< where the file has the length of the properties
    std::string_view properties = {};  ///< their bytes

    /// The next one from `at` on, which is moved behind it. Nothing at the end, and where they are broken.
    std::optional<FbxProperty> next(std::size_t& at) const;
};

class FbxRecords {
  public:
    /// Nothing of a file that is no binary FBX.
    explicit FbxRecords(std::string_view file);

    /// The next record; those in it follow. Nothing at the end, or where the file is broken: then isWhole() is false.
    std::optional<FbxRecord> next();
    [[nodiscard]] bool isWhole() const { return is_whole_; }
    /// Names of the records around the last one, and its own, from the root on.
    [[nodiscard]] std::span<const std::string_view> path() const { return path_; }

    /// Fields of numbers in the file: 4 bytes, and 8 from version 7500 on.
    [[nodiscard]] std::size_t fieldSize() const { return field_size_; }
    [[nodiscard]] std::uint64_t field(std::size_t at) const;
    /// Where the records so far have the number of the byte behind them.
    [[nodiscard]] const std::vector<std::size_t>& endFields() const { return end_fields_; }

  private:
    std::string_view file_;
    std::size_t at_ = 0, field_size_ = 0;
    bool is_whole_ = false;
    std::vector<std::string_view> path_ = {};
    std::vector<std::size_t> ends_ = {};  ///< of the records of the path
    std::vector<std::size_t> end_fields_ = {};
};

}  // namespace tspace::import
