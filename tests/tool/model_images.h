// SPDX-License-Identifier: MIT
// Reads and replaces images of glTF files without the library.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace tspace::test {

/// Supports .glb, .vrm and .gltf files whose images are in the binary chunk, in separate files or in data URIs.
class ModelImages {
  public:
    explicit ModelImages(const std::filesystem::path& path) : folder_(path.parent_path()) {
        const std::string bytes = readFile(path);
        if (bytes.rfind("glTF", 0) != 0) {
            json_ = nlohmann::json::parse(bytes);
            return;
        }
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, 4);
        json_ = nlohmann::json::parse(bytes.substr(20, length));
        rest_ = bytes.substr(20 + length);
        is_binary_ = true;
    }

    /// Returns the index of the image to which the texture reference at a JSON pointer refers.
    [[nodiscard]] std::size_t imageAt(const std::string& pointer) const {
        const nlohmann::json& reference = json_.at(nlohmann::json::json_pointer(pointer));
        const nlohmann::json& texture = json_["textures"][reference["index"].get<std::size_t>()];
        if (texture.contains("extensions")) {
            for (const auto& [name, extension] : texture["extensions"].items()) {
                if (extension.contains("source")) return extension["source"];
            }
        }
        return texture["source"];
    }

    [[nodiscard]] std::string read(std::size_t image) const {
        const nlohmann::json& entry = json_["images"][image];
        if (entry.contains("uri")) return resource(entry["uri"]);
        const nlohmann::json& view = json_["bufferViews"][entry["bufferView"].get<std::size_t>()];
        const nlohmann::json& buffer = json_["buffers"][view["buffer"].get<std::size_t>()];
        const std::string bytes = buffer.contains("uri") ? resource(buffer["uri"]) : rest_.substr(8);
        return bytes.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
    }

    /// Replaces an image by a PNG for all textures that use it.
    void replace(std::size_t image, const std::string& png) {
        json_["images"][image] = {{"uri", "data:image/png;base64," + base64Of(png)}};
        for (nlohmann::json& texture : json_["textures"]) {
            if (!texture.contains("extensions")) continue;
            for (const auto& [name, extension] : texture["extensions"].items()) {
                if (extension.value("source", json_["images"].size()) == image) texture["source"] = image;
            }
            if (texture.value("source", json_["images"].size()) == image) texture.erase("extensions");
        }
    }

    [[nodiscard]] std::string file() const {
        std::string text = json_.dump();
        if (!is_binary_) return text;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string bytes = "glTF";
        const auto put = [&](std::size_t number) {
            const auto word = static_cast<std::uint32_t>(number);
            bytes.append(reinterpret_cast<const char*>(&word), 4);
        };
        put(2);
        put(20 + text.size() + rest_.size());
        put(text.size());
        return bytes + "JSON" + text + rest_;
    }

    /// Copies the files that the model references into a folder.
    void copyFiles(const std::filesystem::path& to) const {
        for (const char* list : {"buffers", "images"}) {
            if (!json_.contains(list)) continue;
            for (const nlohmann::json& entry : json_[list]) {
                const std::string uri = entry.value("uri", std::string());
                if (uri.empty() || uri.rfind("data:", 0) == 0 || !std::filesystem::exists(folder_ / uri)) continue;
                std::filesystem::create_directories((to / uri).parent_path());
                std::filesystem::copy_file(folder_ / uri, to / uri, std::filesystem::copy_options::overwrite_existing);
            }
        }
    }

  private:
    static constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

    static std::string readFile(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    static std::string base64Of(const std::string& bytes) {
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            std::uint32_t word = 0;
            for (std::size_t k = 0; k < 3; ++k)
                word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
            for (std::size_t k = 0; k < 4; ++k)
                text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63] : '=';
        }
        return text;
    }

    static std::string fromBase64(const std::string& text) {
        std::string bytes;
        std::uint32_t word = 0;
        unsigned bits = 0;
        for (const char c : text) {
            const char* digit = std::strchr(kDigits, c);
            if (c == '=' || digit == nullptr) break;
            word = word << 6 | static_cast<std::uint32_t>(digit - kDigits);
            if ((bits += 6) < 8) continue;
            bits -= 8;
            bytes += static_cast<char>(word >> bits & 255);
        }
        return bytes;
    }

    [[nodiscard]] std::string resource(const std::string& uri) const {
        if (uri.rfind("data:", 0) == 0) return fromBase64(uri.substr(uri.find(',') + 1));
        return readFile(folder_ / uri);
    }

    std::filesystem::path folder_;
    nlohmann::json json_ = {};
    std::string rest_ = {};  ///< the chunks that follow the JSON in a GLB
    bool is_binary_ = false;
};

}  // namespace tspace::test
