// SPDX-License-Identifier: MIT
#include "commands/bake/bake_outputs.h"

#include <set>
#include <utility>

#include "maps/uv_coverage.h"

namespace tspace {
namespace {

/// Where the extension of a path begins, or its end.
std::size_t extensionOf(const std::string& path) {
    const std::size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
    const bool has_extension = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    return has_extension ? dot : path.size();
}

/// The name of a material with all letters replaced that a file name should not have.
std::string fileWord(const std::string& name) {
    std::string word;
    for (const char letter : name) {
        const bool is_plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                              (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
        word += is_plain ? letter : '_';
    }
    return word.empty() ? "material" : word;
}

/// What the images of a low poly are called, and the pictures beside them.
std::vector<std::string> outputsOf(const std::string& output, const BakeFileOptions& options,
                                   const std::vector<std::string>& words) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& path) {
        if (path.empty()) return;
        for (const std::string& word : words) names.push_back(withWord(path, word));
    };
    if (options.layers.has_normal) add(output);
    for (const MapLayer layer : options.layers.layers) add(withLayer(output, layer));
    add(options.misses);
    add(options.heat);
    if (!options.out_mesh.empty()) names.push_back(options.out_mesh);
    return names;
}

}  // namespace

std::string withWord(const std::string& path, const std::string& word) {
    if (path.empty() || word.empty()) return path;
    const std::size_t at = extensionOf(path);
    return path.substr(0, at) + "." + word + path.substr(at);
}

std::string withLayer(const std::string& path, MapLayer layer) {
    const std::size_t at = extensionOf(path);
    return path.substr(0, at) + "_" + layerName(layer) + path.substr(at);
}

std::vector<std::string> imageWords(const LowModel& low) {
    if (low.images.size() < 2) return std::vector<std::string>(low.images.size());
    std::vector<std::string> words;
    std::set<std::string> known;
    for (const LowModel::Image& image : low.images) {
        const std::string word = fileWord(image.material);
        std::string fresh = word;
        for (int i = 2; !known.insert(fresh).second; ++i) fresh = word + "_" + std::to_string(i);
        words.push_back(std::move(fresh));
    }
    return words;
}

std::string tileWord(const std::string& image, std::uint32_t tile) {
    return image.empty() ? std::to_string(tile) : image + "." + std::to_string(tile);
}

std::vector<std::string> plainOutputs(const std::string& output, const BakeFileOptions& options) {
    return outputsOf(output, options, {""});
}

std::vector<std::string> outputsFor(const std::string& low, const std::string& output, const BakeFileOptions& options) {
    const LowModel model = readLowImages(low, options);
    std::vector<std::string> words = imageWords(model);
    if (!options.udim) return outputsOf(output, options, words);
    std::set<std::string> of_tiles;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const LowPart& part = model.images[i].part;
        for (std::size_t triangle = 0; triangle < part.triangleCount(); ++triangle) {
            if (const std::uint32_t tile = tileOf(&part.corners.uvs[3 * triangle]); tile != 0)
                of_tiles.insert(tileWord(words[i], tile));
        }
    }
    return outputsOf(output, options, {of_tiles.begin(), of_tiles.end()});
}

std::vector<std::string> withoutWords(const std::string& path) {
    const std::size_t end = extensionOf(path);
    const std::string extension = path.substr(end);
    std::vector<std::string> names;
    for (std::string stem = path.substr(0, end); extensionOf(stem) != stem.size();) {
        stem.resize(extensionOf(stem));
        names.push_back(stem + extension);
    }
    return names;
}

}  // namespace tspace
