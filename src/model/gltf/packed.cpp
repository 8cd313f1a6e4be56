// SPDX-License-Identifier: MIT
// Packed tangent frames in glTF.
#include "model/gltf/packed.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "model/gltf/apply_frames.h"
#include "model/io/file_error.h"
#include "tspace/asset.h"

namespace tspace::gltf {

// The table of formats. glTF allows attributes no 32-bit integers, so words are bytes or shorts, at most four to an
// accessor, which every reader takes; vectors are normalised, so that a GPU decodes them.

namespace {

constexpr ComponentType kI8 = ComponentType::i8, kU8 = ComponentType::u8, kI16 = ComponentType::i16,
                        kU16 = ComponentType::u16;

constexpr PackedPart kFrame32Parts[] = {{"_FRAME32", kU8, "VEC4", false, 0, 4}};
constexpr PackedPart kFrame48Parts[] = {{"_FRAME48", kU16, "VEC3", false, 0, 6}};
constexpr PackedPart kFrame64Parts[] = {{"_FRAME64", kU16, "VEC4", false, 0, 8}};
constexpr PackedPart kOct32Parts[] = {{"_OCT32", kU8, "VEC4", false, 0, 4}};
constexpr PackedPart kQtangent64Parts[] = {{"_QTANGENT64", kI16, "VEC4", true, 0, 8}};
constexpr PackedPart kSnorm8PairParts[] = {{"_SNORM8_PAIR_TANGENT", kI8, "VEC4", true, 0, 4},
                                           {"_SNORM8_PAIR_NORMAL", kI8, "VEC4", true, 4, 4}};
constexpr PackedPart kSnorm16PairParts[] = {{"_SNORM16_PAIR_TANGENT", kI16, "VEC4", true, 0, 8},
                                            {"_SNORM16_PAIR_NORMAL", kI16, "VEC4", true, 8, 8}};
constexpr PackedPart kGltfSnorm8Parts[] = {{"_GLTF_SNORM8_TANGENT", kI8, "VEC4", true, 0, 4},
                                           {"_GLTF_SNORM8_NORMAL", kI8, "VEC3", true, 4, 3}};
constexpr PackedPart kGltfSnorm16Parts[] = {{"_GLTF_SNORM16_TANGENT", kI16, "VEC4", true, 0, 8},
                                            {"_GLTF_SNORM16_NORMAL", kI16, "VEC3", true, 8, 6}};

constexpr PackedLayout kLayouts[] = {
    {FrameFormat::frame32, kFrame32Parts},         {FrameFormat::frame48, kFrame48Parts},
    {FrameFormat::frame64, kFrame64Parts},         {FrameFormat::oct32, kOct32Parts},
    {FrameFormat::qtangent64, kQtangent64Parts},   {FrameFormat::snorm8Pair, kSnorm8PairParts},
    {FrameFormat::snorm16Pair, kSnorm16PairParts}, {FrameFormat::gltfSnorm8, kGltfSnorm8Parts},
    {FrameFormat::gltfSnorm16, kGltfSnorm16Parts},
};

}  // namespace

std::span<const PackedLayout> packedLayouts() { return kLayouts; }

const PackedLayout& packedLayout(FrameFormat format) { return kLayouts[static_cast<std::size_t>(format)]; }

bool isPackedAttribute(const std::string& name) {
    return std::any_of(std::begin(kLayouts), std::end(kLayouts), [&](const PackedLayout& layout) {
        return std::any_of(layout.parts.begin(), layout.parts.end(),
                           [&](const PackedPart& part) { return name == part.attribute; });
    });
}

Bytes takePart(const Bytes& words, FrameFormat format, const PackedPart& part) {
    const std::size_t word_bytes = frameBytes(format), count = words.size() / word_bytes;
    Bytes elements(count * part.byte_count);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(elements.data() + i * part.byte_count, words.data() + i * word_bytes + part.begin, part.byte_count);
    return elements;
}

void putPart(const Bytes& elements, FrameFormat format, const PackedPart& part, Bytes& words) {
    const std::size_t word_bytes = frameBytes(format), count = words.size() / word_bytes;
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(words.data() + i * word_bytes + part.begin, elements.data() + i * part.byte_count, part.byte_count);
}

namespace {

/// The least frames per task. Packing a frame takes about as long as ten corners of a method (the unit of Parallel).
constexpr std::size_t kPackGrain = 512, kCornersPerFrame = 10;

void add(const PackReport& part, PackReport& sum) {
    sum.bad_normal_count += part.bad_normal_count;
    sum.not_finite_count += part.not_finite_count;
    sum.zero_count += part.zero_count;
    sum.parallel_count += part.parallel_count;
    sum.not_unit_count += part.not_unit_count;
    sum.not_orthogonal_count += part.not_orthogonal_count;
    sum.bad_sign_count += part.bad_sign_count;
}

}  // namespace

Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report) {
    const std::size_t word_bytes = frameBytes(format);
    Bytes words(normals.size() * word_bytes);
    const auto out = std::as_writable_bytes(std::span(words));
    Error failure{ErrorCode::ok, {}};
    std::mutex mutex;
    Parallel parallel(execution, kCornersPerFrame * normals.size());
    parallel.forRanges(normals.size(), kPackGrain, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        const Result<PackReport> packed =
            tspace::packFrames(normals.subspan(begin, count), tangents.subspan(begin, count), format,
                               out.subspan(begin * word_bytes, count * word_bytes));
        const std::lock_guard lock(mutex);
        if (packed) {
            add(*packed, report);
        } else {
            failure = packed.error();
        }
    });
    if (failure.code != ErrorCode::ok) failFile(failure.code, failure.message);
    return words;
}

}  // namespace tspace::gltf

namespace tspace {

const char* frameFormatName(FrameFormat format) {
    static constexpr std::array kNames{"frame32",     "frame48",      "frame64",     "oct32",       "qtangent64",
                                       "snorm8_pair", "snorm16_pair", "gltf_snorm8", "gltf_snorm16"};
    const auto number = static_cast<std::size_t>(format);
    return number < kNames.size() ? kNames[number] : "";
}

}  // namespace tspace

namespace tspace::gltf {

namespace {

/// The format that the accessor of a part must have, spelled as formatName does.
std::string wantedFormat(const PackedPart& part) {
    Accessor wanted;
    wanted.component = part.component;
    wanted.normalized = part.normalized;
    wanted.component_count = part.byte_count / bytesOf(part.component);
    return formatName(wanted);
}

std::string faultOf(const Document& document, const Accessor& accessor, const PackedPart& part) {
    const bool fits =
        accessor.component == part.component && accessor.type == part.type && accessor.normalized == part.normalized;
    if (!fits) return "is " + formatName(accessor) + ", and must be " + wantedFormat(part);
    return hasData(document, accessor) ? "" : "has no data that can be read here";
}

std::string countFault(const Accessor& accessor, const Primitive& primitive) {
    return "has " + std::to_string(accessor.count) + " elements, and the primitive " +
           std::to_string(primitive.vertex_count) + " vertices";
}

}  // namespace

std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive) {
    std::vector<StoredPacking> found;
    for (const PackedLayout& layout : packedLayouts()) {
        StoredPacking packing{.layout = &layout};
        std::string missing;
        for (const PackedPart& part : layout.parts) {
            const auto index = primitive.find(part.attribute);
            const auto miscounted = findAttribute(primitive.miscounted, part.attribute);
            if (!index && !miscounted) {
                missing = part.attribute;
                continue;
            }
            const std::string fault = index ? faultOf(document, readAccessor(document, *index), part)
                                            : countFault(readAccessor(document, *miscounted), primitive);
            if (packing.attribute.empty() || (packing.fault.empty() && !fault.empty())) {
                packing.attribute = part.attribute;
                packing.fault = fault;
            }
        }
        if (packing.attribute.empty()) continue;
        if (!missing.empty() && packing.fault.empty()) packing.fault = "has no " + missing + " beside it";
        found.push_back(std::move(packing));
    }
    return found;
}

std::string packedAlone(const Document& document, const Primitive& primitive) {
    if (primitive.find("NORMAL") && primitive.find("TANGENT")) return {};
    for (const StoredPacking& packing : findPacked(document, primitive)) {
        if (packing.fault.empty()) return packing.attribute;
    }
    return {};
}

Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout) {
    Bytes words(primitive.vertex_count * frameBytes(layout.format));
    for (const PackedPart& part : layout.parts) {
        const Accessor accessor = readAccessor(document, *primitive.find(part.attribute));
        putPart(copyElements(document, accessor), layout.format, part, words);
    }
    return words;
}

bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack) {
    bool is_changed = false;
    for (Primitive& primitive : primitives) {
        for (const auto& [name, index] : primitive.miscounted) {
            const bool is_made_anew =
                pack &&
                std::any_of(packedLayout(*pack).parts.begin(), packedLayout(*pack).parts.end(),
                            [&attribute = name](const PackedPart& part) { return part.attribute == attribute; });
            if (!is_made_anew) {
                failFile(ErrorCode::invalidFile,
                         "the attribute " + countFault(readAccessor(document, index), primitive),
                         join(join(primitive.place(), "attributes"), name));
            }
            document.json["meshes"][primitive.mesh]["primitives"][primitive.index]["attributes"].erase(name);
            is_changed = true;
        }
        primitive.miscounted.clear();
    }
    return is_changed;
}

// Groups primitives that share frames, and packs each group once.

namespace {

bool movesAttribute(const Primitive& primitive, const char* name) {
    return std::any_of(primitive.targets.begin(), primitive.targets.end(),
                       [&](const AttributeList& target) { return findAttribute(target, name).has_value(); });
}

/// Which of NORMAL and TANGENT are removed.
struct Dropped {
    bool normals = false, tangents = false;

    [[nodiscard]] std::vector<const char*> names() const {
        std::vector<const char*> list;
        if (normals) list.push_back("NORMAL");
        if (tangents) list.push_back("TANGENT");
        return list;
    }
};

/// Attributes that morph targets add to must stay, and normals stay where tangents do: TANGENT is ignored without NORMAL.
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
        : editor_(editor),
          document_(document),
          options_(options),
          layout_(packedLayout(*options.pack)),
          reports_(reports),
          primitives_(readPrimitives(document)) {}

    void run() {
        for (const std::vector<std::size_t>& group : groups()) write(group);
    }

  private:
    using Key = std::array<std::size_t, 6>;

    /// Groups of primitives that share NORMAL, TANGENT and existing packed attributes, in file order.
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
                reports_[i].notes.push_back(std::string("its frames are not packed: ") + why);
                continue;
            }
            const Dropped dropped = droppedFrom(primitive, options_.pack_drop);
            Key key{*primitive.find("NORMAL"), *primitive.find("TANGENT"), dropped.normals, dropped.tangents};
            for (std::size_t p = 0; p < layout_.parts.size(); ++p)
                key[4 + p] = primitive.find(layout_.parts[p].attribute).value_or(none);
            const auto [entry, is_new] = known.try_emplace(key, list.size());
            if (is_new) list.emplace_back();
            list[entry->second].push_back(i);
        }
        return list;
    }

    /// Whether an earlier run packed the frames and removed NORMAL and TANGENT.
    [[nodiscard]] bool isDone(const Primitive& primitive) const {
        const std::string alone = packedAlone(document_, primitive);
        return std::any_of(layout_.parts.begin(), layout_.parts.end(),
                           [&](const PackedPart& part) { return alone == part.attribute; });
    }

    /// Why the primitive cannot be packed, half a sentence; empty when it can.
    [[nodiscard]] std::string whyNot(const Primitive& primitive, const PrimitiveReport& report) const {
        if (const std::string alone = packedAlone(document_, primitive); !alone.empty())
            return "it has others in " + alone + ", and not what they were packed from";
        for (const auto& [name, type] : {std::pair{"POSITION", ""}, {"NORMAL", "VEC3"}, {"TANGENT", "VEC4"}}) {
            const auto index = primitive.find(name);
            if (!index) {
                const bool can_have = report.action == PrimitiveAction::notNeeded && name[0] != 'P';
                return std::string("it has no ") + name + (can_have ? " (--all makes what is missing)" : "");
            }
            const Accessor accessor = readAccessor(document_, *index);
            if (*type == '\0') continue;
            if (accessor.type != type) return std::string("its ") + name + " is " + formatName(accessor);
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
        const Dropped dropped = droppedFrom(first, options_.pack_drop);
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
        for (const std::size_t number : numbers) tell(reports_[number], dropped, packing);
    }

    /// Removes the attributes. Returns accessors without other uses, whose entries the packed attributes re-use.
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

    void tell(PrimitiveReport& report, const Dropped& dropped, const PackReport& packing) const {
        report.frames_packed = true;
        report.packing = packing;
        report.tangents_dropped = dropped.tangents;
        report.normals_dropped = dropped.normals;
        const bool keeps_more = options_.pack_drop != PackDrop::nothing &&
                                !(dropped.tangents && (dropped.normals || options_.pack_drop == PackDrop::tangents));
        if (!keeps_more) return;
        report.notes.push_back(std::string(dropped.tangents ? "its NORMAL stays" : "its NORMAL and TANGENT stay") +
                               " beside the packed frames, because its morph targets add to them");
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
            if (!packing.fault.empty() || packing.layout->format == options.pack) continue;
            reports[i].notes.push_back("its packed frames in " + packing.attribute + " are those of before (--pack " +
                                       frameFormatName(packing.layout->format) + " renews them)");
        }
    }
}

}  // namespace tspace::gltf
