// SPDX-License-Identifier: MIT
#include "commands/generate/place_image.h"

#include <filesystem>

#include "images/image.h"
#include "model/io/uri.h"

namespace tspace::gltf {

void ImagePlacer::place(std::size_t image, Bytes&& bytes, bool keeps_old) {
    put(image, std::move(bytes), keeps_old, true);
}

std::size_t ImagePlacer::add(std::size_t like, Bytes&& bytes) {
    Json& images = document_.json["images"];
    Json copy = images[like];
    images.push_back(std::move(copy));
    const std::size_t image = images.size() - 1;
    put(image, std::move(bytes), true, false);
    return image;
}

void ImagePlacer::put(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all) {
    const char* type = mimeType(imageFormat(bytes));
    if (document_.json["images"][image].contains("bufferView")) {
        putInView(image, std::move(bytes), keeps_old, is_of_all);
    } else {
        Json& entry = document_.json["images"][image];
        const std::string uri = entry["uri"].text();
        if (uriKind(uri) == UriKind::data) {
            entry["uri"] = encodeDataUri(type, bytes);
        } else if (target_.container == Container::glb) {
            takeIn(image, std::move(bytes));
        } else {
            putInFile(image, uri, std::move(bytes), is_of_all);
        }
    }
    Json& entry = document_.json["images"][image];
    if (entry.contains("mimeType")) entry["mimeType"] = type;
    editor_.touch();
}

/// A GLB holds what is made for it, and so can go through a pipe.
void ImagePlacer::takeIn(std::size_t image, Bytes&& bytes) {
    const char* type = mimeType(imageFormat(bytes));
    const std::size_t view = editor_.storeBlob(std::move(bytes), std::nullopt);
    Json& entry = document_.json["images"][image];
    entry.erase("uri");
    entry["bufferView"] = view;
    entry["mimeType"] = type;
}

void ImagePlacer::putInView(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all) {
    const auto view = document_.json["images"][image]["bufferView"].get<std::size_t>();
    if (!keeps_old) editor_.letGoOfView(view);
    const auto known = views_.find(view);
    const std::size_t stored =
        known != views_.end() && is_of_all ? known->second : editor_.storeBlob(std::move(bytes), std::nullopt);
    if (is_of_all) views_[view] = stored;
    // Not through a reference from before: storing may move the members of the root.
    document_.json["images"][image]["bufferView"] = stored;
}

void ImagePlacer::putInFile(std::size_t image, const std::string& uri, Bytes&& bytes, bool is_of_all) {
    const auto known = files_.find(uri);
    const std::string name = known != files_.end() && is_of_all ? known->second : freeName(uri, bytes);
    if (is_of_all) files_[uri] = name;
    document_.json["images"][image]["uri"] = percentEncode(name);
    document_.new_files[name] = std::move(bytes);
}

/// A name beside the old one that no other file has, or one with these bytes.
std::string ImagePlacer::freeName(const std::string& uri, const Bytes& bytes) {
    namespace fs = std::filesystem;
    fs::path old = fs::path(Path(pathOfUri(uri))).lexically_normal();
    // What lies outside of the model's folder gets its new file inside.
    if (old.has_root_path() || *old.begin() == "..") old = old.filename();
    const bool becomes_png = imageFormat(bytes) == ImageFormat::png && lowerExtension(Path(old)) != ".png";
    for (int number = 1;; ++number) {
        std::string ending = ending_;
        if (number > 1) ending.append("-").append(std::to_string(number));
        fs::path changed = old.parent_path() / old.stem();
        changed += ending;
        changed += becomes_png ? fs::path(".png") : old.extension();
        const Path name = changed, file = folderOf(target_.path) / name.string();
        if (namesFile(document_, name.string())) continue;
        if (!isThere(file)) return name.string();
        std::error_code error;
        const bool may_be_same =
            fs::is_regular_file(fs::path(file), error) && fs::file_size(fs::path(file), error) == bytes.size();
        if (may_be_same && readFile(file) == bytes) return name.string();
    }
}

void noteInputFile(Document& document, std::size_t image) {
    const std::string place = join("/images", image);
    const Json& entry = rootArray(document, "images")[image];
    const std::string uri = readString(entry, "uri", place);
    if (uri.empty() || uriKind(uri) != UriKind::path) return;
    document.input_files.push_back(document.files.resolve(uri, join(place, "uri")).string());
}

}  // namespace tspace::gltf
