// SPDX-License-Identifier: MIT
// FBX, as text and in binary: Vertices of meshes, which are doubles. Arrays of floats have nothing more to give.
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>

#include "core/base/numbers.h"
#include "near_origin/coordinates.h"
#include "near_origin/fbx_records.h"
#include "near_origin/fbx_text.h"
#include "number_text.h"

namespace tspace::import {

namespace {

bool isPath(std::span<const std::string_view> path, std::initializer_list<std::string_view> names) {
    return std::equal(path.begin(), path.end(), names.begin(), names.end());
}

bool isTranslation(std::string_view name) { return name == "Lcl Translation" || name == "GeometricTranslation"; }

/// In text "Model::name", in binary "name", two bytes and "Model".
std::string nameOfModel(std::string_view text) {
    constexpr std::string_view kMark = "Model::";
    if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
    return std::string(text.substr(0, text.find('\0')));
}

Coordinates readTextFbx(std::vector<char> bytes) {
    auto file = std::make_unique<TextCoordinates>(std::move(bytes));
    bool is_mesh = false, is_open = false;
    const auto close = [&] {
        if (is_open) file->endList();
        is_open = false;
    };
    forEachFbxValue(file->text(), [&](const FbxPath& path, std::size_t i, std::string_view value) {
        if (isPath(path, {"Objects", "Geometry"})) {
            // Shapes are differences.
            if (i == 2) is_mesh = value == "Mesh";
            close();
        } else if (is_mesh && isPath(path, {"Objects", "Geometry", "Vertices", "a"})) {
            if (i == 0) {
                close();
                file->addList();
                is_open = true;
            }
            file->add(value);
        }
    });
    close();
    return file;
}

std::vector<ExactPlace> placesInText(std::string_view text) {
    std::vector<ExactPlace> places;
    std::string name;
    std::array<double, 3> translation{};
    bool is_translation = false;
    forEachFbxValue(text, [&](const FbxPath& path, std::size_t i, std::string_view value) {
        if (isPath(path, {"Objects", "Model"}) && i == 1) name = nameOfModel(value);
        if (!isPath(path, {"Objects", "Model", "Properties70", "P"})) return;
        constexpr std::size_t kFirst = 4;
        if (i == 0) is_translation = isTranslation(value);
        if (!is_translation || i < kFirst || i >= kFirst + 3) return;
        translation[i - kFirst] = readNumber(value);
        if (i == kFirst + 2) places.push_back({{}, name, {translation[0], translation[1], translation[2]}});
    });
    return places;
}

class BinaryFbx : public FileCoordinates {
  public:
    explicit BinaryFbx(std::vector<char> bytes) : bytes_(std::move(bytes)) {
        const std::string_view file{bytes_.data(), bytes_.size()};
        FbxRecords records(file);
        bool is_mesh = false;
        while (const std::optional<FbxRecord> record = records.next()) {
            std::size_t at = 0;
            if (isPath(records.path(), {"Objects", "Geometry"})) {
                static_cast<void>(record->next(at));
                static_cast<void>(record->next(at));
                const std::optional<FbxProperty> kind = record->next(at);
                is_mesh = kind && kind->text() == "Mesh";
            } else if (is_mesh && isPath(records.path(), {"Objects", "Geometry", "Vertices"})) {
                const std::optional<FbxProperty> property = record->next(at);
                std::optional<std::vector<double>> values;
                if (property) values = doublesOf(*property);
                if (!values || values->empty() || values->size() % 3 != 0 || at != record->properties.size()) continue;
                lists.push_back({std::move(*values)});
                const auto begin = static_cast<std::size_t>(property->bytes.data() - file.data());
                arrays_.push_back({record->length_field, begin, property->bytes.size()});
            }
        }
        // Without all ends of records they cannot be moved.
        if (!records.isWhole()) lists.clear();
        field_size_ = records.fieldSize();
        end_fields_ = records.endFields();
    }

    std::vector<char> rewritten() override {
        std::vector<char> file;
        if (!moveNumbers()) return file;
        std::size_t copied = 0;
        for (std::size_t l = 0; l < lists.size(); ++l) {
            const Array& array = arrays_[l];
            if (!lists[l].is_moved) continue;
            file.insert(file.end(), &bytes_[copied], &bytes_[array.begin]);
            appendRaw(file, lists[l].values);
            copied = array.begin + array.size;
        }
        file.insert(file.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(copied), bytes_.end());
        return file;
    }

  private:
    /// The count, the encoding, the size and the bytes.
    struct Array {
        std::size_t length_field = 0;  ///< of the properties of its record
        std::size_t begin = 0, size = 0;
    };
    static constexpr std::size_t kHead = 12;

    [[nodiscard]] std::uint8_t* bytesAt(std::size_t at) { return reinterpret_cast<std::uint8_t*>(&bytes_[at]); }

    void addTo(std::size_t field, std::uint64_t bytes) {
        std::uint8_t* const at = bytesAt(field);
        if (field_size_ == 8) {
            storeLittleEndian(loadLittleEndian<std::uint64_t>(at) + bytes, at);
        } else {
            storeLittleEndian(static_cast<std::uint32_t>(loadLittleEndian<std::uint32_t>(at) + bytes), at);
        }
    }

    /// Arrays that are written raw are longer, or shorter, than they were: all that stands behind them moves, and with it the
    /// ends of records. Sums wrap around where they shrink. False where the fields are too short for it.
    bool moveNumbers() {
        std::vector<std::pair<std::size_t, std::uint64_t>> grown;  // behind which byte, by how much in all
        std::uint64_t sum = 0;
        for (std::size_t l = 0; l < lists.size(); ++l) {
            if (!lists[l].is_moved) continue;
            const std::uint64_t change = kHead + sizeof(double) * lists[l].values.size() - arrays_[l].size;
            addTo(arrays_[l].length_field, change);
            grown.emplace_back(arrays_[l].begin, sum += change);
        }
        if (field_size_ == 4 && bytes_.size() + sum > std::numeric_limits<std::uint32_t>::max()) return false;
        for (const std::size_t field : end_fields_) {
            const std::uint64_t end = field_size_ == 8 ? loadLittleEndian<std::uint64_t>(bytesAt(field))
                                                       : loadLittleEndian<std::uint32_t>(bytesAt(field));
            const auto behind =
                std::lower_bound(grown.begin(), grown.end(), std::pair<std::size_t, std::uint64_t>(end, 0));
            if (behind != grown.begin()) addTo(field, std::prev(behind)->second);
        }
        return true;
    }

    static void append(std::vector<char>& file, auto number) {
        std::array<std::uint8_t, sizeof number> bytes;
        storeLittleEndian(number, bytes.data());
        file.insert(file.end(), bytes.begin(), bytes.end());
    }

    static void appendRaw(std::vector<char>& file, const std::vector<double>& values) {
        append(file, static_cast<std::uint32_t>(values.size()));
        append(file, std::uint32_t{0});
        append(file, static_cast<std::uint32_t>(sizeof(double) * values.size()));
        for (const double value : values) append(file, value);
    }

    std::vector<char> bytes_;
    std::size_t field_size_ = 0;
    std::vector<std::size_t> end_fields_ = {};
    std::vector<Array> arrays_ = {};
};

std::vector<ExactPlace> placesInBinary(std::string_view file) {
    std::vector<ExactPlace> places;
    std::string name;
    FbxRecords records(file);
    while (const std::optional<FbxRecord> record = records.next()) {
        std::size_t at = 0;
        if (isPath(records.path(), {"Objects", "Model"})) {
            static_cast<void>(record->next(at));
            const std::optional<FbxProperty> text = record->next(at);
            name = text ? nameOfModel(text->text()) : std::string();
        }
        if (!isPath(records.path(), {"Objects", "Model", "Properties70", "P"})) continue;
        const std::optional<FbxProperty> key = record->next(at);
        if (!key || !isTranslation(key->text())) continue;
        for (int i = 0; i < 3; ++i) static_cast<void>(record->next(at));
        std::array<double, 3> translation{};
        bool is_whole = true;
        for (double& value : translation) {
            const std::optional<FbxProperty> property = record->next(at);
            const std::optional<double> number = property ? property->number() : std::nullopt;
            is_whole = is_whole && number;
            if (number) value = *number;
        }
        if (is_whole) places.push_back({{}, name, {translation[0], translation[1], translation[2]}});
    }
    return places;
}

bool isBinaryFbx(const std::vector<char>& bytes) { return FbxRecords({bytes.data(), bytes.size()}).fieldSize() != 0; }

}  // namespace

Coordinates readFbx(std::vector<char> bytes) {
    if (isBinaryFbx(bytes)) return std::make_unique<BinaryFbx>(std::move(bytes));
    return readTextFbx(std::move(bytes));
}

std::vector<ExactPlace> placesInFbx(const std::vector<char>& bytes) {
    return isBinaryFbx(bytes) ? placesInBinary({bytes.data(), bytes.size()})
                              : placesInText({bytes.data(), bytes.size()});
}

}  // namespace tspace::import
