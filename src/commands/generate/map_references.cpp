// SPDX-License-Identifier: MIT

#include "commands/generate/map_references.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "images/image.h"
#include "model/gltf/material_needs.h"
#include "model/io/folder_rule.h"
#include "model/io/uri.h"

namespace tspace::gltf {

MapReferences::Slot MapReferences::slotOf(const MapUser& user) const {
    const bool is_coat = user.use->needed_by == "clearcoatNormalTexture";
    if (user.use->only_in_variant) return {user.use->material, is_coat};
    // The current material is read, because converting an earlier map may have given the primitive a copy of its
    // material.
    return {jsonOf(*user.primitive)["material"].get<std::size_t>(), is_coat};
}

Json& MapReferences::jsonOf(const Primitive& primitive) const {
    return document_.json["meshes"][primitive.mesh]["primitives"][primitive.index];
}

bool MapReferences::shows(const Primitive& primitive, std::size_t material) const {
    const Json* own = findMember(jsonOf(primitive), "material");
    if (own != nullptr && isNumber(*own, material)) return true;
    const std::vector<std::size_t> variants = variantMaterials(document_, primitive);
    return std::find(variants.begin(), variants.end(), material) != variants.end();
}

/// Returns whether a primitive that is not in `users` uses the material.
bool MapReferences::isShared(std::size_t material, std::span<const MapUser> users) const {
    return std::any_of(primitives_.begin(), primitives_.end(), [&](const Primitive& primitive) {
        const bool is_one =
            std::any_of(users.begin(), users.end(), [&](const MapUser& user) { return user.primitive == &primitive; });
        return !is_one && shows(primitive, material);
    });
}

Json& MapReferences::reference(const Slot& slot) const {
    Json& material = document_.json["materials"][slot.material];
    if (!slot.is_coat) return material["normalTexture"];
    return material["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"];
}

bool MapReferences::isUsedOnlyBy(std::size_t image, std::span<const MapUser> users) const {
    std::set<std::size_t> textures;
    Json& list = document_.json["textures"];
    for (std::size_t i = 0; i < list.size(); ++i) {
        std::size_t sources = 0;
        bool has_it = false;
        forSources(list[i], [&](Json& source) {
            ++sources;
            has_it = has_it || isNumber(source, image);
        });
        if (!has_it) continue;
        if (sources > 1) return false;
        textures.insert(i);
    }
    std::set<Slot> slots;
    for (const MapUser& user : users) slots.insert(slotOf(user));
    std::size_t references = 0;
    forTextureReferences(document_.json["materials"], [&](const std::string&, Json& reference) {
        const Json& index = reference["index"];
        if (index.is_number_unsigned() && textures.contains(index.get<std::size_t>())) ++references;
    });
    if (references != slots.size()) return false;
    return std::none_of(slots.begin(), slots.end(), [&](const Slot& slot) { return isShared(slot.material, users); });
}

void MapReferences::setSource(Json& texture, std::size_t image) {
    forSourceExtensions([&](const char* name) {
        if (findExtension(texture, name) != nullptr) texture["extensions"].erase(name);
    });
    const Json* left = findMember(texture, "extensions");
    if (left != nullptr && left->empty()) texture.erase("extensions");
    texture["source"] = image;
}

void MapReferences::makeOnlySource(std::size_t image) {
    for (Json& texture : document_.json["textures"]) {
        bool shows_it = false;
        forSources(texture, [&](Json& source) { shows_it = shows_it || isNumber(source, image); });
        if (shows_it) setSource(texture, image);
    }
    const Json& textures = rootArray(document_, "textures");
    forSourceExtensions([&](const char* name) {
        const auto has = [&](const Json& texture) { return findExtension(texture, name) != nullptr; };
        if (std::none_of(textures.begin(), textures.end(), has)) dropExtension(document_, name);
    });
}

std::string MapReferences::whyNotSeparate(std::span<const MapUser> users) const {
    const Json& used = rootArray(document_, "extensionsUsed");
    const bool has_pointers = std::any_of(used.begin(), used.end(), [](const Json& name) {
        return name.is_string() && name.text() == "KHR_animation_pointer";
    });
    for (const MapUser& user : users) {
        if (!isShared(slotOf(user).material, users)) continue;
        if (user.use->only_in_variant)
            return "other primitives need a different map but share its material, which is not copied, because a "
                   "material variant selects it";
        if (has_pointers)
            return "other primitives need a different map but share its material, which is not copied, because "
                   "KHR_animation_pointer may animate it";
    }
    return {};
}

void MapReferences::redirect(std::span<const MapUser> users, std::size_t to_image) {
    std::map<std::size_t, std::size_t> copies;    // original material -> copy
    std::map<std::size_t, std::size_t> textures;  // original texture -> copy that uses the new image
    const auto ownTexture = [&](std::size_t from) {
        const auto [own, is_new] = textures.try_emplace(from, document_.json["textures"].size());
        if (is_new) {
            Json copy = document_.json["textures"][from];
            setSource(copy, to_image);
            document_.json["textures"].push_back(std::move(copy));
        }
        return own->second;
    };
    // Sharing is determined before anything changes, because a copy reduces the number of users of the original.
    std::map<std::size_t, bool> is_shared;
    for (const MapUser& user : users) {
        const std::size_t material = slotOf(user).material;
        if (!is_shared.contains(material)) is_shared[material] = isShared(material, users);
    }
    std::set<Slot> done;
    for (const MapUser& user : users) {
        Slot slot = slotOf(user);
        if (copies.contains(slot.material) || is_shared[slot.material]) {
            const auto [copy, is_new] = copies.try_emplace(slot.material, document_.json["materials"].size());
            if (is_new) {
                Json material = document_.json["materials"][slot.material];
                document_.json["materials"].push_back(std::move(material));
                is_shared[copy->second] = false;
            }
            slot.material = copy->second;
            jsonOf(*user.primitive)["material"] = slot.material;
        }
        if (!done.insert(slot).second) continue;
        Json& index = reference(slot)["index"];
        index = ownTexture(index.get<std::size_t>());
    }
}

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

void ImagePlacer::put(std::size_t image, Bytes&& bytes, bool keeps_old, bool for_all_users) {
    const char* type = mimeType(imageFormat(bytes));
    if (document_.json["images"][image].contains("bufferView")) {
        putInView(image, std::move(bytes), keeps_old, for_all_users);
    } else {
        Json& entry = document_.json["images"][image];
        const std::string uri = entry["uri"].text();
        if (uriKind(uri) == UriKind::data) {
            entry["uri"] = encodeDataUri(type, bytes);
        } else if (target_.container == Container::glb) {
            embed(image, std::move(bytes));
        } else {
            putInFile(image, uri, std::move(bytes), for_all_users);
        }
    }
    Json& entry = document_.json["images"][image];
    if (entry.contains("mimeType")) entry["mimeType"] = type;
    editor_.touch();
}

/// Embeds the image in the GLB, so that the output needs no other file and can be a pipe.
void ImagePlacer::embed(std::size_t image, Bytes&& bytes) {
    const char* type = mimeType(imageFormat(bytes));
    const std::size_t view = editor_.storeBlob(std::move(bytes), std::nullopt);
    Json& entry = document_.json["images"][image];
    entry.erase("uri");
    entry["bufferView"] = view;
    entry["mimeType"] = type;
}

void ImagePlacer::putInView(std::size_t image, Bytes&& bytes, bool keeps_old, bool for_all_users) {
    const auto view = document_.json["images"][image]["bufferView"].get<std::size_t>();
    if (!keeps_old) editor_.releaseView(view);
    const auto known = views_.find(view);
    const std::size_t stored =
        known != views_.end() && for_all_users ? known->second : editor_.storeBlob(std::move(bytes), std::nullopt);
    if (for_all_users) views_[view] = stored;
    // The entry is looked up again, because storing the image may move the members of the root object.
    document_.json["images"][image]["bufferView"] = stored;
}

void ImagePlacer::putInFile(std::size_t image, const std::string& uri, Bytes&& bytes, bool for_all_users) {
    const auto known = files_.find(uri);
    const std::string name = known != files_.end() && for_all_users ? known->second : freeName(uri, bytes);
    if (for_all_users) files_[uri] = name;
    document_.json["images"][image]["uri"] = percentEncode(name);
    document_.new_files[name] = std::move(bytes);
}

/// Returns a file name derived from `uri` that no file has, or that a file with the same bytes has.
std::string ImagePlacer::freeName(const std::string& uri, const Bytes& bytes) {
    namespace fs = std::filesystem;
    fs::path old = Path(pathOfUri(uri));
    // Images outside the model's folder get their new file inside it.
    if (leadsAway(old) != nullptr) old = old.filename();
    const bool becomes_png = imageFormat(bytes) == ImageFormat::png && lowerExtension(Path(old)) != ".png";
    for (int number = 1;; ++number) {
        std::string ending = ending_;
        if (number > 1) ending.append("-").append(std::to_string(number));
        fs::path changed = old.parent_path() / old.stem();
        changed += ending;
        changed += becomes_png ? fs::path(".png") : old.extension();
        const Path name = changed, file = folderOf(target_.path) / name.string();
        if (referencesFile(document_, name.string())) continue;
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
