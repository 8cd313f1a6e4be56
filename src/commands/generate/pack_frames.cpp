// SPDX-License-Identifier: MIT
// Groups primitives that share frames, and packs each group once.
#include "commands/generate/pack_frames.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/generate/edit_attributes.h"
#include "model/gltf/packed_frames.h"
#include "tspace/pack.h"

namespace tspace::gltf {
namespace {

bool movesAttribute(const Primitive& primitive, const char* name) {
    return std::any_of(primitive.targets.begin(), primitive.targets.end(),
                       [&](const AttributeList& target) { return findAttribute(target, name).has_value(); });
}

/// Attributes that are removed.
struct Dropped {
    bool normals = false, tangents = false;

    [[nodiscard]] std::vector<const char*> names() const {
        std::vector<const char*> list;
        if (normals) list.push_back("NORMAL");
        if (tangents) list.push_back("TANGENT");
        return list;
    }
};

/// Returns the attributes to remove. Attributes that morph targets modify are kept. Normals are kept if tangents are
/// kept, because TANGENT is ignored without NORMAL.
Dropped droppedFrom(const Primitive& primitive, PackDrop asked) {
    Dropped dropped;
    dropped.tangents = asked != PackDrop::nothing && !movesAttribute(primitive, "TANGENT");
    dropped.normals = asked == PackDrop::all && dropped.tangents && !movesAttribute(primitive, "NORMAL");
    return dropped;
}

class PackedWriter {
  public:
    PackedWriter(Editor& editor, const Document& document, const GenerateOptions& options,
                 std::span<PrimitiveReport> reports)
        : editor_(editor), document_(document), options_(options), layout_(packedLayout(*options.storage.pack)),
          reports_(reports), primitives_(readPrimitives(document)) {}

    void run() {
        for (const std::vector<std::size_t>& group : groups()) write(group);
    }

  private:
    using Key = std::array<std::size_t, 6>;

    /// Returns groups of primitives that share NORMAL, TANGENT and existing packed attributes, in file order.
    std::vector<std::vector<std::size_t>> groups() {
        std::vector<std::vector<std::size_t>> list;
        std::map<Key, std::size_t> known;
        const std::size_t none = rootArray(document_, "accessors").size();
        for (std::size_t i = 0; i < primitives_.size(); ++i) {
            const Primitive& primitive = primitives_[i];
            if (isDone(primitive)) {
                reports_[i].frames_packed = true;
                continue;
            }
            if (const std::string why = whyNot(primitive, reports_[i]); !why.empty()) {
                reports_[i].notes.push_back(std::string("its frames were not packed: ") + why);
                continue;
            }
            const Dropped dropped = droppedFrom(primitive, options_.storage.pack_drop);
            Key key{*primitive.find("NORMAL"), *primitive.find("TANGENT"), dropped.normals, dropped.tangents};
            for (std::size_t p = 0; p < layout_.parts.size(); ++p)
                key[4 + p] = primitive.find(layout_.parts[p].attribute).value_or(none);
            const auto [entry, is_new] = known.try_emplace(key, list.size());
            if (is_new) list.emplace_back();
            list[entry->second].push_back(i);
        }
        return list;
    }

    /// Returns whether an earlier run packed the frames and removed NORMAL and TANGENT.
    [[nodiscard]] bool isDone(const Primitive& primitive) const {
        const std::string alone = packedAlone(document_, primitive);
        return std::any_of(layout_.parts.begin(), layout_.parts.end(),
                           [&](const PackedPart& part) { return alone == part.attribute; });
    }

    /// Returns why the primitive cannot be packed, as a clause; empty if it can.
    [[nodiscard]] std::string whyNot(const Primitive& primitive, const PrimitiveReport& report) const {
        if (const std::string alone = packedAlone(document_, primitive); !alone.empty())
            return "it has only other packed frames in " + alone +
                   ", not the normals and tangents that they were packed from";
        for (const auto& [name, type] : {std::pair{"POSITION", ""}, {"NORMAL", "VEC3"}, {"TANGENT", "VEC4"}}) {
            const auto index = primitive.find(name);
            if (!index) {
                const bool can_have = report.action == PrimitiveAction::notNeeded && name[0] != 'P';
                return std::string("it has no ") + name + (can_have ? "; use --all to add it" : "");
            }
            const Accessor accessor = readAccessor(document_, *index);
            if (*type == '\0') continue;
            if (accessor.type != type)
                return std::string("its ") + name + " is " + formatName(accessor) + ", not " + type;
            if (!hasData(document_, accessor)) return std::string("its ") + name + " cannot be read";
        }
        return {};
    }

    void write(const std::vector<std::size_t>& numbers) {
        const Primitive& first = primitives_[numbers[0]];
        constexpr std::uint64_t kWorkBytes = sizeof(Vec3) + sizeof(Vec4) + 16;
        document_.memory->require(kWorkBytes * first.vertex_count, first.place());
        PackReport packing;
        const Bytes words = packWords(layout_.format, readVec3(document_, first, "NORMAL"),
                                      readTangents(document_, first), options_.execution, packing);
        const Dropped dropped = droppedFrom(first, options_.storage.pack_drop);
        std::vector<std::size_t> spare = drop(numbers, dropped);
        for (const PackedPart& part : layout_.parts) {
            SharedAttribute attribute{.primitives = primitives_, .numbers = numbers, .name = part.attribute};
            if (!spare.empty() && !first.find(part.attribute)) {
                attribute.spare = spare.back();
                spare.pop_back();
                editor_.accessor(*attribute.spare).erase("name");
            }
            setAttribute(editor_, document_, attribute,
                         {.component = part.component,
                          .type = part.type,
                          .normalized = part.normalized,
                          .count = first.vertex_count,
                          .element_bytes = part.byte_count,
                          .bytes = takePart(words, layout_.format, part)});
        }
        for (const std::size_t accessor : spare) {
            for (std::size_t i = 0; i < numbers.size(); ++i) editor_.release(accessor);
        }
        for (const std::size_t number : numbers) reportPacking(reports_[number], dropped, packing);
    }

    /// Removes the attributes. Returns accessors without other uses; packed attributes reuse their entries.
    std::vector<std::size_t> drop(const std::vector<std::size_t>& numbers, const Dropped& dropped) {
        std::vector<std::size_t> spare;
        for (const char* name : dropped.names()) {
            const std::size_t accessor = *primitives_[numbers[0]].find(name);
            const bool alone = editor_.accessorUses(accessor) == numbers.size();
            if (alone) spare.push_back(accessor);
            for (const std::size_t number : numbers) {
                eraseAttribute(editor_, primitives_[number], name);
                if (!alone) editor_.release(accessor);
            }
        }
        return spare;
    }

    void reportPacking(PrimitiveReport& report, const Dropped& dropped, const PackReport& packing) const {
        report.frames_packed = true;
        report.packing = packing;
        report.tangents_dropped = dropped.tangents;
        report.normals_dropped = dropped.normals;
        const bool keeps_more =
            options_.storage.pack_drop != PackDrop::nothing &&
            !(dropped.tangents && (dropped.normals || options_.storage.pack_drop == PackDrop::tangents));
        if (!keeps_more) return;
        report.notes.push_back(
            std::string(dropped.tangents ? "its NORMAL was kept" : "its NORMAL and TANGENT were kept") +
            " in addition to the packed frames, because its morph targets have deltas for " +
            (dropped.tangents ? "it" : "them"));
    }

    Editor& editor_;
    const Document& document_;
    const GenerateOptions& options_;
    const PackedLayout& layout_;
    std::span<PrimitiveReport> reports_;
    std::vector<Primitive> primitives_;
};

}  // namespace

void writePackedFrames(Editor& editor, const Document& document, const GenerateOptions& options,
                       std::span<PrimitiveReport> reports) {
    PackedWriter(editor, document, options, reports).run();
}

void noteStalePackedFrames(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options, std::span<PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const bool is_new = reports[i].action == PrimitiveAction::generated ||
                            reports[i].action == PrimitiveAction::replaced || reports[i].normals_replaced;
        if (!is_new) continue;
        for (const StoredPacking& packing : findPacked(document, primitives[i])) {
            if (!packing.fault.empty() || packing.layout->format == options.storage.pack) continue;
            reports[i].notes.push_back("its packed frames in " + packing.attribute + " are outdated (use --pack " +
                                       frameFormatName(packing.layout->format) + " to replace them)");
        }
    }
}

}  // namespace tspace::gltf
