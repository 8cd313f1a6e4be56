// SPDX-License-Identifier: MIT
#include "near_origin/fbx_records.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "core/base/numbers.h"

namespace tspace::import {

namespace {

constexpr std::string_view kMagic = "Kaydara FBX Binary";
constexpr std::size_t kVersionAt = 23, kHeaderSize = 27;
constexpr std::uint32_t kWideVersion = 7500;

template <class Number>
Number numberAt(std::string_view bytes, std::size_t at) {
    return loadLittleEndian<Number>(reinterpret_cast<const std::uint8_t*>(bytes.data() + at));
}

/// Bytes of a number; 0: not a number.
std::size_t sizeOfNumber(char type) {
    switch (type) {
        case 'B':
        case 'C':
            return 1;
        case 'Y':
            return 2;
        case 'I':
        case 'F':
            return 4;
        case 'D':
        case 'L':
            return 8;
        default:
            return 0;
    }
}

}  // namespace

std::optional<double> FbxProperty::number() const {
    if (type != 'D' || bytes.size() != sizeof(double)) return {};
    return numberAt<double>(bytes, 0);
}

std::optional<std::vector<double>> doublesOf(const FbxProperty& property) {
    constexpr std::size_t kHead = 12;
    if (property.type != 'd' || property.bytes.size() < kHead) return {};
    const std::uint64_t size = std::uint64_t{numberAt<std::uint32_t>(property.bytes, 0)} * sizeof(double);
    const auto encoding = numberAt<std::uint32_t>(property.bytes, 4);
    const std::string_view data = property.bytes.substr(kHead);
    // Deflate makes at most 258 bytes of 2 bits.
    constexpr std::uint64_t kMostPerByte = 1032;
    if (size > std::numeric_limits<std::uint32_t>::max() || encoding > 1) return {};
    if (encoding == 0 ? size != data.size() : size > kMostPerByte * data.size()) return {};
    std::vector<double> values(static_cast<std::size_t>(size / sizeof(double)));
    const std::span<std::uint8_t> bytes{reinterpret_cast<std::uint8_t*>(values.data()), static_cast<std::size_t>(size)};
    if (encoding == 0) {
        std::copy(data.begin(), data.end(), bytes.begin());
    } else {
        uLongf inflated = size;
        const auto* const from = reinterpret_cast<const Bytef*>(data.data());
        if (uncompress(bytes.data(), &inflated, from, data.size()) != Z_OK || inflated != size) return {};
    }
    turnLittleEndian(bytes, sizeof(double));
    return values;
}

std::optional<FbxProperty> FbxRecord::next(std::size_t& at) const {
    if (at >= properties.size()) return {};
    FbxProperty property{.type = properties[at++]};
    const std::size_t left = properties.size() - at;
    std::size_t head = 0;
    std::uint64_t size = sizeOfNumber(property.type);
    if (property.type == 'S' || property.type == 'R') {
        head = 4;
        if (left < head) return {};
        size = numberAt<std::uint32_t>(properties, at);
    } else if (std::string_view("fdlibc").find(property.type) != std::string_view::npos) {
        constexpr std::size_t kArrayHead = 12, kBytesAt = 8;
        if (left < kArrayHead) return {};
        size = kArrayHead + std::uint64_t{numberAt<std::uint32_t>(properties, at + kBytesAt)};
    } else if (size == 0) {
        return {};
    }
    if (size > left - head) return {};
    property.bytes = properties.substr(at + head, static_cast<std::size_t>(size));
    at += head + static_cast<std::size_t>(size);
    return property;
}

FbxRecords::FbxRecords(std::string_view file) : file_(file), at_(kHeaderSize) {
    if (file.size() < kHeaderSize || !file.starts_with(kMagic)) return;
    field_size_ = numberAt<std::uint32_t>(file, kVersionAt) >= kWideVersion ? 8 : 4;
}

std::uint64_t FbxRecords::field(std::size_t at) const {
    return field_size_ == 8 ? numberAt<std::uint64_t>(file_, at) : numberAt<std::uint32_t>(file_, at);
}

std::optional<FbxRecord> FbxRecords::next() {
    if (field_size_ == 0 || is_whole_) return {};
    const std::size_t head = 3 * field_size_ + 1;
    for (;;) {
        while (!ends_.empty() && at_ == ends_.back()) {
            ends_.pop_back();
            path_.pop_back();
        }
        const std::size_t limit = ends_.empty() ? file_.size() : ends_.back();
        if (limit < at_ || limit - at_ < head) return {};
        const std::uint64_t end = field(at_), properties = field(at_ + 2 * field_size_);
        if (end == 0) {
            // A record of zeros ends a list.
            at_ += head;
            is_whole_ = ends_.empty();
            if (is_whole_) return {};
            continue;
        }
        const auto name_size = static_cast<unsigned char>(file_[at_ + head - 1]);
        const std::size_t begin = at_ + head;
        if (end > limit || end < begin || end - begin < name_size || end - begin - name_size < properties) return {};
        const FbxRecord record{.name = file_.substr(begin, name_size),
                               .length_field = at_ + 2 * field_size_,
                               .properties = file_.substr(begin + name_size, static_cast<std::size_t>(properties))};
        end_fields_.push_back(at_);
        at_ = begin + name_size + record.properties.size();
        path_.push_back(record.name);
        ends_.push_back(static_cast<std::size_t>(end));
        return record;
    }
}

}  // namespace tspace::import
