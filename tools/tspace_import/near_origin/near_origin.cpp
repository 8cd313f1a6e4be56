// SPDX-License-Identifier: MIT
#include "near_origin/near_origin.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/mesh/surface/float_loss.h"
#include "near_origin/coordinates.h"

namespace tspace::import {
namespace {

struct FormatReader {
    const char* extension;
    Coordinates (*coordinates)(std::vector<char>);
};

constexpr std::array kFormats = {FormatReader{".ply", readPly}, FormatReader{".stl", readStl}};

const FormatReader* formatOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::find_if(kFormats.begin(), kFormats.end(),
                                           [&](const FormatReader& format) { return extension == format.extension; });
    return found == kFormats.end() ? nullptr : found;
}

std::vector<char> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    if (!file || size < 0) return {};
    std::vector<char> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    file.read(bytes.data(), size);
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return bytes;
}

DVec3 vertexOf(const VertexList& list, std::size_t i) {
    return {list.values[3 * i], list.values[3 * i + 1], list.values[3 * i + 2]};
}

/// Returns the rounded center of the vertices of some lists, computed as in float_loss.h, so that a few outliers do not
/// affect it.
DVec3 middleOf(const std::vector<const VertexList*>& lists) {
    return roundMiddle([&](const auto& visit) {
        for (const VertexList* list : lists) {
            for (std::size_t i = 0; i < list->values.size() / 3; ++i) visit(vertexOf(*list, i), vertexOf(*list, i));
        }
    });
}

/// Returns whether the origin is more than four times as far from `middle` as the median vertex. For an origin at a
/// corner of a square or cube, this factor is about two; at a factor below four, an offset would gain only two bits.
bool isFar(const VertexList& list, const DVec3& middle) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < list.values.size() / 3; ++i) {
        const double distance = length(vertexOf(list, i) - middle);
        if (std::isfinite(distance)) distances.push_back(distance);
    }
    if (distances.empty()) return false;
    const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), median, distances.end());
    constexpr double kFar = 4;
    return length(middle) > kFar * *median;
}

/// Returns whether at least one value in twenty has more digits than a float, so that it lies between two floats. Only
/// values along axes that are far from the origin are examined. Values that were written from floats with few digits
/// are close to a float. `middles`: centers of the lists; empty: all axes are examined.
bool hasMoreThanFloats(const std::vector<const VertexList*>& lists, const std::vector<DVec3>& middles) {
    constexpr double kClose = 1.0 / 16, kFarthest = 1024;
    std::array<double, 3> axes{};
    for (const DVec3& middle : middles)
        axes = {std::max(axes[0], std::fabs(middle.x)), std::max(axes[1], std::fabs(middle.y)),
                std::max(axes[2], std::fabs(middle.z))};
    const double far = *std::max_element(axes.begin(), axes.end()) / kFarthest;
    std::size_t count = 0, between_count = 0;
    for (const VertexList* list : lists) {
        for (std::size_t i = 0; i < list->values.size(); ++i) {
            if (axes[i % 3] < far) continue;
            const double value = list->values[i];
            const auto rounded = static_cast<float>(value);
            const float size = std::fabs(rounded);
            const double step = double{std::nextafter(size, std::numeric_limits<float>::infinity())} - double{size};
            ++count;
            between_count += std::fabs(value - double{rounded}) > kClose * step;
        }
    }
    return between_count > 0 && 20 * between_count >= count;
}

}  // namespace

bool isReadInDouble(const std::string& path) { return formatOf(path) != nullptr; }

std::optional<NearFile> nearOrigin(const std::string& path) {
    const FormatReader* const format = formatOf(path);
    if (format == nullptr) return {};
    const Coordinates file = format->coordinates(bytesOf(path));
    if (file == nullptr) return {};
    std::vector<DVec3> middles, far_middles;
    std::vector<const VertexList*> all, far;
    for (const VertexList& list : file->lists) {
        all.push_back(&list);
        middles.push_back(middleOf({&list}));
        if (!isFar(list, middles.back())) continue;
        far.push_back(&list);
        far_middles.push_back(middles.back());
    }
    if (!hasMoreThanFloats(far.empty() ? all : far, far_middles)) return {};
    const DVec3 offset = far.size() == 1 ? far_middles[0] : middleOf(far);
    if (!(length(offset) > 0)) return NearFile{};
    for (std::size_t l = 0; l < file->lists.size(); ++l) {
        VertexList& list = file->lists[l];
        list.is_moved = length(middles[l] - offset) < length(middles[l]);
        for (std::size_t i = 0; list.is_moved && i < list.values.size(); i += 3) {
            list.values[i] -= offset.x;
            list.values[i + 1] -= offset.y;
            list.values[i + 2] -= offset.z;
        }
    }
    return NearFile{file->rewritten(), offset};
}

}  // namespace tspace::import
