// SPDX-License-Identifier: MIT
// Geometry first, since names repeat and tools drop them; then names; then the place in the file.
#include "commands/diff/pair_primitives.h"

#include <functional>
#include <map>
#include <string>

namespace tspace {

namespace {

/// The key that both partners have in common; empty: this primitive takes no part.
using KeyOf = std::function<std::string(const ScenePrimitive&)>;

class Pairer {
  public:
    Pairer(const Scene& a, const Scene& b)
        : a_(a), b_(b), partner_(a.primitives.size(), kNoPrimitive), how_(a.primitives.size(), "none") {
        for (const ScenePrimitive& primitive : b.primitives) taken_.push_back(primitive.corners.empty());
    }

    /// Of several with one key the first of A gets the first of B.
    void pairBy(const char* how, const KeyOf& key_of) {
        std::map<std::string, std::vector<std::size_t>> free_by_key;
        for (std::size_t k = b_.primitives.size(); k-- > 0;) {
            if (!taken_[k]) free_by_key[key_of(b_.primitives[k])].push_back(k);
        }
        for (std::size_t i = 0; i < a_.primitives.size(); ++i) {
            const ScenePrimitive& mine = a_.primitives[i];
            if (partner_[i] != kNoPrimitive || mine.corners.empty()) continue;
            const std::string key = key_of(mine);
            const auto found = free_by_key.find(key);
            if (key.empty() || found == free_by_key.end() || found->second.empty()) continue;
            partner_[i] = found->second.back();
            found->second.pop_back();
            taken_[partner_[i]] = true;
            how_[i] = how;
        }
    }

    std::vector<PrimitivePair> result() const {
        std::vector<PrimitivePair> pairs;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (a_.primitives[i].corners.empty()) continue;
            PrimitivePair& pair = pairs.emplace_back();
            pair.a = i;
            pair.b = partner_[i];
            pair.paired_by = how_[i];
            if (pair.b != kNoPrimitive) pairTriangles(pair);
        }
        for (std::size_t k = 0; k < taken_.size(); ++k) {
            if (!taken_[k]) pairs.emplace_back().b = k;
        }
        return pairs;
    }

  private:
    void pairTriangles(PrimitivePair& pair) const {
        const ScenePrimitive& mine = a_.primitives[pair.a];
        const ScenePrimitive& other = b_.primitives[pair.b];
        pair.triangles = pairByCorners(mine, other);
        // Moved a little everywhere: quantised, or written with fewer digits.
        if (pair.triangles.size() < mine.corners.size() / 3) {
            std::vector<TrianglePair> by_place = pairByPlace(mine, other);
            if (by_place.size() > pair.triangles.size()) pair.triangles = std::move(by_place);
        }
    }

    const Scene& a_;
    const Scene& b_;
    std::vector<std::size_t> partner_;  ///< one per primitive of A
    std::vector<std::string> how_;
    std::vector<bool> taken_ = {};  ///< one per primitive of B; also those without triangles
};

/// Looked up several times.
std::map<const ScenePrimitive*, std::string> geometryKeys(const Scene& a, const Scene& b) {
    std::map<const ScenePrimitive*, std::string> keys;
    for (const Scene* scene : {&a, &b}) {
        for (const ScenePrimitive& primitive : scene->primitives) {
            if (!primitive.corners.empty()) keys[&primitive] = std::to_string(geometryHash(primitive)) + ' ';
        }
    }
    return keys;
}

std::string nameKey(const ScenePrimitive& p) {
    return p.mesh_name.empty() ? "" : std::to_string(p.primitive) + ' ' + p.mesh_name;
}

std::string placeKey(const ScenePrimitive& p) { return std::to_string(p.mesh) + ' ' + std::to_string(p.primitive); }

}  // namespace

std::vector<PrimitivePair> pairPrimitives(const Scene& a, const Scene& b) {
    const auto geometry = geometryKeys(a, b);
    const auto keyed = [&](const auto& more) {
        return [&](const ScenePrimitive& p) { return geometry.at(&p) + more(p); };
    };
    Pairer pairer(a, b);
    pairer.pairBy("geometry", keyed([](const ScenePrimitive& p) { return nameKey(p) + '/' + placeKey(p); }));
    pairer.pairBy("geometry", keyed(nameKey));
    pairer.pairBy("geometry", keyed(placeKey));
    pairer.pairBy("geometry", keyed([](const ScenePrimitive&) { return std::string(); }));
    pairer.pairBy("name", nameKey);
    pairer.pairBy("order",
                  [](const ScenePrimitive& p) { return placeKey(p) + ' ' + std::to_string(p.corners.size()); });
    return pairer.result();
}

}  // namespace tspace
