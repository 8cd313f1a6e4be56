// SPDX-License-Identifier: MIT
#include "commands/bake/match_meshes.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/text_encoding.h"
#include "tspace/maps.h"

namespace tspace {
namespace {

bool isSeparator(char letter) { return letter == '_' || letter == '-' || letter == '.' || letter == ' '; }

bool isDigits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char letter) { return letter >= '0' && letter <= '9'; });
}

/// Returns "body" for "Body_low", "BODY_HP", "Body_high_001", "Body_high_buckle" and similar names. After "low" only a
/// number is allowed, since other words may distinguish low polys; one low poly may have several high polys.
std::string nameStem(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    for (const std::string_view mark : {"low", "lp", "high", "hp"}) {
        const std::size_t at = name.rfind(mark);
        if (at == std::string::npos || at < 2 || !isSeparator(name[at - 1])) continue;
        const std::string_view rest = std::string_view(name).substr(at + mark.size());
        const bool is_low = mark[0] == 'l';
        if (rest.empty() || (isSeparator(rest[0]) && (!is_low || isDigits(rest.substr(1)))))
            return name.substr(0, at - 1);
    }
    return name;
}

struct Names {
    std::string node = {}, mesh = {};

    [[nodiscard]] const std::string& shown() const { return node.empty() ? mesh : node; }
};

Names namesOf(const DrawnScene& drawn, std::size_t placement) {
    const ScenePlacement& at = drawn.placements[placement];
    return {at.node_name, drawn.scene.primitives[at.primitive].mesh_name};
}

/// Returns the names of the first placement of each primitive.
std::vector<Names> firstNames(const DrawnScene& drawn) {
    std::vector<std::optional<Names>> names(drawn.scene.primitives.size());
    for (std::size_t i = 0; i < drawn.placements.size(); ++i) {
        auto& of_primitive = names[drawn.placements[i].primitive];
        if (!of_primitive) of_primitive = namesOf(drawn, i);
    }
    std::vector<Names> result;
    for (std::size_t i = 0; i < names.size(); ++i)
        result.push_back(names[i].value_or(Names{{}, drawn.scene.primitives[i].mesh_name}));
    return result;
}

using Pairs = std::map<std::string, std::string>;  ///< maps a name in the high poly to a name in the low poly

/// Reads lines "LOW = HIGH". Empty lines and lines that begin with # are ignored.
Pairs readPairs(const std::string& path, const FileOptions& file) {
    if (file.opened) file.opened(path);
    const Bytes bytes = readFile(path);
    const auto trimmed = [](std::string_view text) {
        const auto isBlank = [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; };
        while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
        while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
        return text;
    };
    Pairs pairs;
    std::string_view rest =
        narrowText({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, pathInQuotes(path) + ": ");
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.empty() || line[0] == '#') continue;
        const std::size_t equals = line.find('=');
        const std::string_view low = trimmed(line.substr(0, std::min(equals, line.size())));
        const std::string_view high = equals < line.size() ? trimmed(line.substr(equals + 1)) : std::string_view();
        if (low.empty() || high.empty())
            failFile(ErrorCode::invalidFile,
                     pathInQuotes(path) + ", line " + std::to_string(number) + ": expected LOW = HIGH");
        pairs[std::string(high)] = std::string(low);
    }
    return pairs;
}

/// Returns a list such as "'a', 'b' and 3 more".
std::string listOf(const std::set<std::string>& names) {
    constexpr std::size_t kShown = 5;
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : names) {
        if (++count > kShown) break;
        text += (text.empty() ? "" : ", ") + inQuotes(name);
    }
    if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
    return text;
}

class Matching {
  public:
    Matching(const DrawnScene& low, const DrawnScene& high, const Pairs* pairs)
        : low_(low), high_(high), pairs_(pairs), low_names_(firstNames(low)) {}

    MeshMatch run() {
        numberLow();
        std::set<std::uint32_t> met;
        for (std::size_t i = 0; i < high_.placements.size(); ++i) {
            match_.high.push_back(groupOf(namesOf(high_, i)));
            if (isDrawn(high_, high_.placements[i].primitive) && match_.high.back() != kEveryGroup)
                met.insert(match_.high.back());
        }
        match_.is_used = !met.empty() && (by_node_.size() > 1 || pairs_ != nullptr);
        if (!match_.is_used) return std::move(match_);
        std::set<std::string> lonely_low, lonely_high;
        for (std::size_t i = 0; i < match_.low.size(); ++i) {
            if (met.count(match_.low[i]) != 0) continue;
            match_.low[i] = kEveryGroup;
            if (isDrawn(low_, i)) lonely_low.insert(low_names_[i].shown());
        }
        for (std::size_t i = 0; i < match_.high.size(); ++i) {
            if (match_.high[i] == kEveryGroup && isDrawn(high_, high_.placements[i].primitive))
                lonely_high.insert(namesOf(high_, i).shown());
        }
        if (!lonely_low.empty())
            match_.warnings.push_back("no high-poly mesh matches these low-poly meshes: " + listOf(lonely_low) +
                                      "; they were baked from the whole high poly");
        if (!lonely_high.empty())
            match_.warnings.push_back("no low-poly mesh matches these high-poly meshes: " + listOf(lonely_high) +
                                      "; they were baked onto all low-poly meshes");
        return std::move(match_);
    }

  private:
    static bool isDrawn(const DrawnScene& drawn, std::size_t primitive) {
        return !drawn.scene.primitives[primitive].corners.empty();
    }

    [[nodiscard]] std::string keyOf(const std::string& name) const { return pairs_ != nullptr ? name : nameStem(name); }

    /// Numbers the objects of the low poly. Each node is an object; if nodes have no names, all meshes with the same
    /// name form one object.
    void numberLow() {
        for (std::size_t i = 0; i < low_names_.size(); ++i) {
            const std::string key = keyOf(low_names_[i].shown());
            if (!isDrawn(low_, i)) {
                match_.low.push_back(kEveryGroup);
                continue;
            }
            const auto number = static_cast<std::uint32_t>(by_node_.size());
            match_.low.push_back(by_node_.emplace(key, number).first->second);
            const auto [of_mesh, is_new] = by_mesh_.emplace(keyOf(low_names_[i].mesh), match_.low.back());
            // A mesh that several objects use does not identify an object.
            if (!is_new && of_mesh->second != match_.low.back()) of_mesh->second = kEveryGroup;
        }
    }

    /// Returns the group of an object of the high poly.
    [[nodiscard]] std::uint32_t groupOf(const Names& names) const {
        for (const std::string& name : {names.node, names.mesh}) {
            if (name.empty()) continue;
            std::string key = keyOf(name);
            if (pairs_ != nullptr) {
                const auto pair = pairs_->find(name);
                if (pair == pairs_->end()) continue;
                key = pair->second;
            }
            if (const auto found = by_node_.find(key); found != by_node_.end()) return found->second;
            if (const auto found = by_mesh_.find(key); found != by_mesh_.end()) return found->second;
        }
        return kEveryGroup;
    }

    const DrawnScene &low_, &high_;
    const Pairs* pairs_;
    std::vector<Names> low_names_;
    std::map<std::string, std::uint32_t> by_node_ = {}, by_mesh_ = {};
    MeshMatch match_ = {};
};

}  // namespace

std::string matchFileOf(const std::string& how) { return how == "names" || how == "all" ? "" : how; }

MeshMatch matchMeshes(const DrawnScene& low, const DrawnScene& high, const std::string& how, const FileOptions& file) {
    if (how == "all") return {};
    if (matchFileOf(how).empty()) return Matching(low, high, nullptr).run();
    const Pairs pairs = readPairs(how, file);
    return Matching(low, high, &pairs).run();
}

}  // namespace tspace
