// SPDX-License-Identifier: MIT
// Reads the golden files of the MikkTSpace reference as words. Their layout is described next to the files.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "core/base/numbers.h"

namespace tspace::test {

/// Returns whether `mikktspace` promises the reference's bits for a mesh with this value.
/// docs/concepts/methods/mikktspace.md excludes values that are not finite, and absolute values of at least 1.6e38. All
/// tests use this function.
inline bool hasPromisedBits(float value) { return std::fabs(value) < 1.6e38f; }

struct GoldenFile {
    static constexpr std::size_t kInputWords = 8;    ///< per corner: position, normal, UV
    static constexpr std::size_t kResultWords = 10;  ///< per corner: tangent, bitangent, magnitudes, orientation, sign

    float angular_threshold_deg = 180;
    std::uint32_t returned = 0;             ///< return value of the reference's function
    std::vector<std::uint32_t> face_sizes;  ///< corners per face; empty if the golden file is incomplete
    std::vector<std::uint32_t> inputs, results;

    GoldenFile() = default;
    explicit GoldenFile(const std::filesystem::path& path) {
        constexpr std::size_t kHeadWords = 5;
        std::ifstream file(path, std::ios::binary);
        std::vector<std::uint32_t> words(std::filesystem::file_size(path) / 4);
        file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
        convertLittleEndian({reinterpret_cast<std::uint8_t*>(words.data()), words.size() * 4}, 4);
        if (!file || words.size() < kHeadWords || words[0] != 0x31475354u) return;
        const std::size_t faces = words[1], corners = words[2];
        if (words.size() != kHeadWords + faces + corners * (kInputWords + kResultWords)) return;
        angular_threshold_deg = std::bit_cast<float>(words[3]);
        returned = words[4];
        auto at = words.begin() + kHeadWords;
        const auto take = [&](std::size_t count) {
            const auto begin = at;
            at += static_cast<std::ptrdiff_t>(count);
            return std::vector<std::uint32_t>(begin, at);
        };
        face_sizes = take(faces);
        inputs = take(corners * kInputWords);
        results = take(corners * kResultWords);
    }

    [[nodiscard]] bool hasPromisedBits() const {
        return std::all_of(inputs.begin(), inputs.end(),
                           [](std::uint32_t word) { return test::hasPromisedBits(std::bit_cast<float>(word)); });
    }
    [[nodiscard]] std::span<const std::uint32_t> input(std::size_t corner) const {
        return std::span(inputs).subspan(corner * kInputWords, kInputWords);
    }
    [[nodiscard]] std::span<const std::uint32_t> result(std::size_t corner) const {
        return std::span(results).subspan(corner * kResultWords, kResultWords);
    }
};

}  // namespace tspace::test
