// SPDX-License-Identifier: MIT
// Reads MTL libraries as glTF materials. Texture lines are completed first, because the parser misreads short ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/folder_rule.h"
#include "model/io/legacy_text.h"
#include "model/io/named_files.h"
#include "model/io/text_encoding.h"
#include "model/io/uri.h"
#include "model/obj/obj_reader.h"
#include "model/obj/tiny_obj_loader.h"

namespace tspace::obj {
namespace {

bool isDecimal(char c) { return c >= '0' && c <= '9'; }

/// Returns whether the word matches [+-] digits [. digits] [e [+-] digits], with a digit on at least one side of the
/// point.
bool isNumber(std::string_view word) {
    std::size_t i = 0;
    const auto skipSign = [&] { i += i < word.size() && (word[i] == '+' || word[i] == '-'); };
    const auto skipDigits = [&] {
        const std::size_t begin = i;
        while (i < word.size() && isDecimal(word[i])) ++i;
        return i - begin;
    };
    skipSign();
    std::size_t digits = skipDigits();
    if (i < word.size() && word[i] == '.') {
        ++i;
        digits += skipDigits();
    }
    if (digits == 0) return false;
    if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
        ++i;
        skipSign();
        if (skipDigits() == 0) return false;
    }
    return i == word.size();
}

struct Option {
    std::string_view name;
    std::size_t number_count;
    std::array<std::string_view, 3> defaults;
    bool moves_texture;
};
constexpr std::array<Option, 4> kOptions = {{{"-o", 3, {"0", "0", "0"}, true},
                                             {"-s", 3, {"1", "1", "1"}, true},
                                             {"-t", 3, {"0", "0", "0"}, true},
                                             {"-mm", 2, {"0", "1", ""}, false}}};

const Option* findOption(std::string_view word) {
    for (const Option& option : kOptions) {
        if (word == option.name) return &option;
    }
    return nullptr;
}

/// A word of a line, and the blanks before it.
struct Word {
    std::string_view blanks, text;
};

std::vector<Word> wordsOf(std::string_view line) {
    std::vector<Word> words;
    while (true) {
        const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        if (begin == end) return words;
        words.push_back({line.substr(0, begin), line.substr(begin, end - begin)});
        line.remove_prefix(end);
    }
}

/// Returns whether a line of an MTL file begins a new statement, or is empty or a comment.
bool isStatement(std::string_view line) {
    constexpr std::array<std::string_view, 21> kKeywords{"refl",      "aniso", "newmtl", "Ka", "Kd", "Ks",   "Ke",
                                                         "Km",        "Tf",    "Tr",     "d",  "Ns", "Ni",   "illum",
                                                         "sharpness", "bump",  "norm",   "Pr", "Pm", "disp", "decal"};
    const std::vector<Word> words = wordsOf(line);
    if (words.empty() || words[0].text.starts_with("#") || words[0].text.starts_with("map_")) return true;
    return std::find(kKeywords.begin(), kKeywords.end(), words[0].text) != kKeywords.end();
}

bool namesTexture(std::string_view keyword) {
    return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "disp" ||
           keyword == "decal" || keyword == "refl";
}

/// Appends the line with its options completed. Returns whether an option moves the texture.
bool appendLine(std::string_view line, std::string& out) {
    const std::vector<Word> words = wordsOf(line);
    if (words.empty() || !namesTexture(words[0].text)) {
        out.append(line);
        return false;
    }
    bool moves = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        out.append(words[i].blanks).append(words[i].text);
        const Option* option = i == 0 ? nullptr : findOption(words[i].text);
        if (option == nullptr) continue;
        for (std::size_t number = 0; number < option->number_count; ++number) {
            // The last word is the file name, even if it is a number.
            const bool is_given = i + 2 < words.size() && isNumber(words[i + 1].text);
            const std::string_view value = is_given ? words[++i].text : option->defaults[number];
            out.append(" ").append(value);
            moves = moves || (option->moves_texture && value != option->defaults[number]);
        }
    }
    return moves;
}

/// Joins lines that end with a backslash with the next line, as Blender does; the parser does not. A backslash before a
/// new statement is the end of a path.
void joinContinuedLines(std::string& text) {
    for (std::size_t at = text.find("\\\n"); at != std::string::npos; at = text.find("\\\n", at + 1)) {
        const std::size_t next = at + 2, end = std::min(text.find('\n', next), text.size());
        if (!isStatement(std::string_view(text).substr(next, end - next))) text[at] = text[at + 1] = ' ';
    }
}

}  // namespace

/// Completes the texture options -o, -s, -t and -mm, which take up to three numbers (-mm: two). If a line has fewer
/// numbers, the parser would interpret the file name as the next number, so missing numbers are inserted. Returns the
/// number of lines that move, scale or perturb a texture with -o, -s or -t.
std::size_t completeTextureOptions(std::string& text) {
    std::string result;
    result.reserve(text.size());
    std::size_t moved = 0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        moved += appendLine(std::string_view(text).substr(begin, end - begin), result);
        if (end < text.size()) result.push_back('\n');
        begin = end + 1;
    }
    text = std::move(result);
    return moved;
}
namespace {

namespace fs = std::filesystem;

/// Returns a path from an MTL or OBJ file without the blanks and quotes around it.
std::string unquoted(std::string text) {
    text.erase(0, std::min(text.find_first_not_of(" \t"), text.size()));
    text.erase(text.find_last_not_of(" \t") + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    return text;
}

float inUnitRange(double number, float otherwise) {
    const auto value = static_cast<float>(number);
    return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
}

Vec3 color(const double rgb[3]) { return {inUnitRange(rgb[0], 1), inUnitRange(rgb[1], 1), inUnitRange(rgb[2], 1)}; }

/// Converts a Blinn-Phong exponent to roughness: alpha = sqrt(2 / (n + 2)), roughness = sqrt(alpha) (Walter et al.
/// 2007; glTF squares its roughness).
float roughnessOf(const tinyobj::material_t& source) {
    if (source.roughness > 0) return inUnitRange(source.roughness, 1);
    const auto shininess = static_cast<float>(source.shininess);
    if (!(shininess > 0)) return 1;
    return inUnitRange(std::sqrt(std::sqrt(2.0f / (shininess + 2.0f))), 1);
}

/// Splits a line into words.
std::vector<std::string> splitWords(const std::string& names) {
    constexpr const char* kBlanks = " \t\n\v\f\r";
    std::vector<std::string> result;
    for (std::size_t begin = 0, end = 0; (begin = names.find_first_not_of(kBlanks, end)) != std::string::npos;) {
        end = std::min(names.find_first_of(kBlanks, begin), names.size());
        result.push_back(names.substr(begin, end - begin));
    }
    return result;
}

/// Returns the names of the materials that specify Kd. The parser makes materials without Kd black; tspace makes them
/// white.
std::set<std::string> materialsWithDiffuse(const std::string& text) {
    std::set<std::string> names;
    std::string name;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const std::vector<std::string> words = splitWords(line);
        const std::string keyword = words.empty() ? "" : words.front();
        if (keyword == "newmtl") {
            name = line.substr(std::min(line.find(keyword) + keyword.size() + 1, line.size()));
            name.erase(name.find_last_not_of(" \t") + 1);
        }
        if (keyword == "Kd") names.insert(name);
    }
    return names;
}

/// Finds files that an OBJ file or a material library references.
class FileFinder {
  public:
    FileFinder(const NamedFiles& files, Path folder, std::vector<std::string>& warnings)
        : files_(files), folder_(std::move(folder)), warnings_(warnings) {}

    /// Returns a path in the folder, resolved like a URI, if that file exists. If the text has a comment (" # ..."),
    /// which other readers take as a part of the name, the name without it is tried too. If no file exists, returns the
    /// path without quotes and with slashes as separators.
    std::string find(const std::string& text) {
        if (const std::optional<std::string> path = existing(text)) return *path;
        constexpr int kMostTries = 8;
        int tries = 0;
        for (std::size_t at = text.rfind('#'); at != std::string::npos && at > 0 && tries < kMostTries;
             at = text.rfind('#', at - 1), ++tries) {
            if (text[at - 1] != ' ' && text[at - 1] != '\t') continue;
            const std::optional<std::string> path = existing(text.substr(0, at));
            if (!path) continue;
            if (warned_paths_.insert(text).second)
                warnings_.push_back("the path " + inQuotes(unquoted(text), 200) +
                                    " does not exist, so the text from '#' on was taken as a comment, and " +
                                    inQuotes(*path, 200) +
                                    " was read; remove that text, because '#' begins a comment only at the start of a "
                                    "line in MTL files, and other programs may not find the file");
            return *path;
        }
        return withSlashes(unquoted(text));
    }

  private:
    /// Returns the path of a file that exists. Of an absolute path, the file name alone is tried too, because such
    /// paths nearly always come from another computer.
    std::optional<std::string> existing(const std::string& text) {
        std::string slashed = unquoted(text);
        const std::string plain = withSlashes(slashed);
        if (isThere(plain)) return plain;
        // withSlashes() keeps backslashes that may be the second byte of a character. Because the encoding is unknown,
        // they may also be separators.
        std::replace(slashed.begin(), slashed.end(), '\\', '/');
        if (slashed != plain && isThere(slashed)) return slashed;
        const fs::path path = Path(plain);
        if (!path.has_root_path() && !startsAtDrive(path)) return {};
        std::string name = Path(path.filename()).string();
        if (name.empty() || !isThere(name)) return {};
        if (warned_paths_.insert(plain).second)
            warnings_.push_back("the path " + inQuotes(plain, 200) + " is absolute; the file " + inQuotes(name, 200) +
                                " in the folder of the file that references it is read instead");
        return name;
    }
    [[nodiscard]] bool isThere(const std::string& path) const {
        bool is_there = false;
        if (path.empty() || files_.areNone()) return false;
        tryFile([&] {
            const Path file = files_.resolve(folder_, percentEncode(path), "material");
            is_there = files_.kindOf(file) == NamedFiles::Kind::file;
        });
        return is_there;
    }

    const NamedFiles& files_;
    Path folder_;
    std::vector<std::string>& warnings_;
    std::set<std::string> warned_paths_ = {};
};

Material toMaterial(const tinyobj::material_t& source, FileFinder& finder, const Path& folder, bool has_diffuse) {
    Material material{.name = source.name, .found = true};
    material.base_color_texture = {finder.find(source.diffuse_texname), folder};
    // With a texture, Kd is ignored: exporters write arbitrary values, even black.
    if (has_diffuse && !material.base_color_texture.used()) material.base_color = color(source.diffuse);
    material.opacity = inUnitRange(source.dissolve, 1);
    material.emission = color(source.emission);
    material.metallic = inUnitRange(source.metallic, 0);
    material.roughness = roughnessOf(source);
    const bool has_norm = !source.normal_texname.empty();
    material.normal_texture = {finder.find(has_norm ? source.normal_texname : source.bump_texname), folder};
    material.normal_is_bump = !has_norm && !source.bump_texname.empty();
    const auto scale = static_cast<float>((has_norm ? source.normal_texopt : source.bump_texopt).bump_multiplier);
    if (std::isfinite(scale)) material.normal_scale = scale;
    return material;
}

std::uint64_t countOf(const std::string& word, const std::string& text) {
    std::uint64_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++count;
    return count;
}

/// Reads a library; each file is read once. Returns false if the file does not exist. Fails with forbiddenPath.
bool readLibrary(const std::string& name, Model& model, std::vector<Material>& materials) {
    if (model.files.areNone()) return false;
    FileFinder libraries(model.files, model.files.folder(), model.warnings);
    const Path path = model.files.resolve(percentEncode(libraries.find(name)), "mtllib");
    if (model.files.kindOf(path) != NamedFiles::Kind::file) return false;
    const auto& known = model.input_files;
    if (std::find(known.begin(), known.end(), path.string()) != known.end()) return true;
    const Bytes bytes = model.files.read(path, "mtllib");
    model.input_bytes += bytes.size();
    model.input_files.push_back(path.string());
    model.memory->allow(bytes.size());
    std::string text(bytes.begin(), bytes.end());
    narrowText(text, inQuotes(Path(fs::path(path).filename()).string(), 200) + ": ");
    makeLineEndsPlain(text);
    if (!isUtf8(text))
        model.warnings.push_back("material library " + inQuotes(Path(fs::path(path).filename()).string(), 200) + ": " +
                                 kNotUtf8);
    joinContinuedLines(text);
    if (completeTextureOptions(text) != 0) {
        model.warnings.push_back("the material library '" + Path(fs::path(path).filename()).string() +
                                 "' uses texture offsets, scales or turbulence (-o, -s, -t), which are ignored");
    }

    // The memory is charged before the parser allocates a large object for each material.
    model.memory->take(countOf("newmtl", text) * (2 * sizeof(tinyobj::material_t) + sizeof(Material)), "mtllib");
    const std::vector<tinyobj::material_t> sources = parseMtl(text);
    const std::set<std::string> with_diffuse = materialsWithDiffuse(text);
    const Path folder = folderOf(path);
    FileFinder finder(model.files, folder, model.warnings);
    for (const tinyobj::material_t& source : sources)
        materials.push_back(toMaterial(source, finder, folder, with_diffuse.count(source.name) != 0));
    return true;
}

/// Returns whether the whole line is the name of one file.
bool isOneFile(const std::string& line, const NamedFiles& files) {
    bool is_there = false;
    tryFile([&] {
        const Path path = files.resolve(percentEncode(withSlashes(unquoted(line))), "mtllib");
        is_there = files.kindOf(path) != NamedFiles::Kind::missing;
    });
    return is_there;
}

}  // namespace

std::vector<Material> readMaterials(const std::vector<std::string>& names, Model& model) {
    std::vector<Material> materials;
    const auto read = [&](const std::string& name) {
        bool is_there = true;
        const std::optional<Error> failure = tryFile([&] { is_there = readLibrary(name, model, materials); });
        if (failure) model.warnings.push_back("material library ignored: " + failure->message);
        return is_there;
    };
    std::vector<std::string> seen;
    for (const std::string& line : names) {
        if (line.empty() || std::find(seen.begin(), seen.end(), line) != seen.end()) continue;
        seen.push_back(line);
        const std::vector<std::string> words = splitWords(line);
        // File names may contain spaces, but a line may also list several files.
        if (words.size() == 1 || isOneFile(line, model.files)) {
            if (!read(line)) model.warnings.push_back("cannot find the material library '" + line + "'");
            continue;
        }
        for (const std::string& word : words) {
            if (word.front() == '#' && !isOneFile(word, model.files)) break;  // a comment
            if (!read(word)) model.warnings.push_back("cannot find the material library '" + word + "'");
        }
    }
    return materials;
}

}  // namespace tspace::obj
