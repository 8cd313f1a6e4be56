// SPDX-License-Identifier: MIT
// GLB chunks and their JSON: which files are accepted, and that every defect has its own message.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "model/gltf/container.h"
#include "model/gltf/document.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/load_document.h"
#include "model/gltf/meshopt_views.h"

namespace tspace::gltf {
namespace {

using test::errorOf;
using test::GltfBuilder;
using test::toBytes;

Bytes smallGlb() {
    GltfBuilder builder;
    builder.addFloats({1, 2, 3}, 3);
    return builder.glb({{0x12345678, {1, 2, 3, 4}}});
}

TEST(Glb, ReadsBackWhatItFrames) {
    const Bytes file = smallGlb();
    ASSERT_TRUE(isGlb(file));
    const GlbChunks chunks = readGlb(file);
    ASSERT_TRUE(chunks.bin.has_value());
    EXPECT_EQ(chunks.bin->size(), 12u);
    ASSERT_EQ(chunks.extra.size(), 1u);
    EXPECT_EQ(chunks.extra[0].type, 0x12345678u);
    EXPECT_EQ(chunks.extra[0].bytes, (Bytes{1, 2, 3, 4}));
    EXPECT_EQ(file.size() % 4, 0u);
}

TEST(Glb, RejectsEveryTruncation) {
    const Bytes file = smallGlb();
    for (std::size_t length = 0; length < file.size(); ++length) {
        const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_EQ(errorOf([&] { readGlb(cut); }).code, ErrorCode::invalidFile) << length;
        const Error error = errorOf([&] { parseDocument(cut, "cut.glb", {}); });
        EXPECT_EQ(error.code, ErrorCode::invalidFile) << length;
        EXPECT_FALSE(error.message.empty());
    }
}

TEST(Glb, RejectsWrongLengthsAndOrder) {
    Bytes shorter = smallGlb();
    shorter.pop_back();
    EXPECT_EQ(errorOf([&] { readGlb(shorter); }).place, "byte 8");
    Bytes huge_chunk = smallGlb();
    huge_chunk[12] = huge_chunk[13] = huge_chunk[14] = huge_chunk[15] = 0xff;
    EXPECT_EQ(errorOf([&] { readGlb(huge_chunk); }).place, "byte 12");
    Bytes not_json = smallGlb();
    not_json[16] = 'X';
    EXPECT_EQ(errorOf([&] { readGlb(not_json); }).message, "the first chunk of the GLB is not JSON");
    Bytes version = smallGlb();
    version[4] = 1;
    EXPECT_EQ(errorOf([&] { readGlb(version); }).code, ErrorCode::unsupportedFile);
}

TEST(Glb, IgnoresBytesBehindItsEnd) {
    Bytes longer = smallGlb();
    longer.insert(longer.end(), {1, 2, 3, 4, 5});
    const GlbChunks chunks = readGlb(longer);
    EXPECT_EQ(chunks.ignored_bytes, 5u);
    EXPECT_EQ(chunks.extra.size(), 1u);
    EXPECT_EQ(parseDocument(longer, "model.glb", {}).warnings.size(), 1u);
    EXPECT_TRUE(parseDocument(smallGlb(), "model.glb", {}).warnings.empty());
    for (std::uint8_t stated = 0; stated < 12; ++stated) {
        longer[8] = stated;
        longer[9] = longer[10] = longer[11] = 0;
        EXPECT_EQ(errorOf([&] { readGlb(longer); }).code, ErrorCode::invalidFile) << int{stated};
    }
}

TEST(Glb, RejectsToGrowBeyond4GiB) {
    EXPECT_EQ(errorOf([] { frameGlb("{}", std::size_t{0xffffffff}, {}); }).code, ErrorCode::cannotWrite);
}

TEST(JsonText, KeepsOrderAndUnknownMembers) {
    const std::string text =
        R"({"z":1,"a":[true,null,-0.0,0.10000000149011612,12345678901234567890],"":{"x":"\u00e9"}})";
    const ParsedJson parsed = parseJson(toBytes(text));
    EXPECT_EQ(writeJson(parsed.root, parsed.style),
              "{\"z\":1,\"a\":[true,null,-0.0,0.10000000149011612,"
              "12345678901234567890],\"\":{\"x\":\"\u00e9\"}}");
}

TEST(JsonText, KeepsItsLayout) {
    for (const std::string text :
         {"{\n  \"a\": [\n    1\n  ]\n}\n", "{\n\t\"a\": {\n\t\t\"b\": 1\n\t}\n}", "{\"a\":1}"}) {
        const ParsedJson parsed = parseJson(toBytes(text));
        EXPECT_EQ(writeJson(parsed.root, parsed.style), text);
    }
}

TEST(JsonText, RejectsDeepNestingWithoutRecursion) {
    const std::string deep(2000000, '[');
    EXPECT_NE(errorOf([&] { parseJson(toBytes(deep)); }).message.find("nested"), std::string::npos);
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    EXPECT_NE(errorOf([&] { parseJson(toBytes(objects)); }).message.find("nested"), std::string::npos);
}

TEST(JsonText, ReadsWideObjectsInLinearTime) {
    std::string wide = "{\"asset\":{\"version\":\"2.0\"},\"extras\":{";
    for (int i = 0; i < 300000; ++i) wide += "\"key" + std::to_string(i) + "\":0,";
    wide += "\"last\":0}}";
    const ParsedJson parsed = parseJson(toBytes(wide));
    EXPECT_EQ(parsed.root["extras"].size(), 300001u);
}

TEST(JsonText, ReportsErrors) {
    const auto message = [](const std::string& text) { return errorOf([&] { parseJson(toBytes(text)); }).message; };
    EXPECT_EQ(message("{\"a\":1e400}"), "the JSON contains a number that is too large");
    EXPECT_EQ(message("{\"a\":NaN}"), "the JSON has a syntax error");
    EXPECT_EQ(message("{\"a\":1,\"a\":2}"), "the JSON contains the member 'a' twice in one object");
    EXPECT_EQ(message("[1]"), "the top level of the JSON is not an object");
    EXPECT_EQ(message(""), "the JSON has a syntax error");
    EXPECT_EQ(message("{\"a\":\"\xff\"}"), "the JSON has a syntax error");
}

TEST(Document, RejectsWrongTypesWithTheirLocation) {
    const struct {
        const char* text;
        const char* place;
    } cases[] = {
        {R"({})", ""},
        {R"({"asset":5})", "/asset"},
        {R"({"asset":{"version":2}})", "/asset/version"},
        {R"({"asset":{"version":"2.0"},"accessors":{}})", "/accessors"},
        {R"({"asset":{"version":"2.0"},"accessors":[1]})", "/accessors/0"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":-1}]})", "/buffers/0/byteLength"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":7}]})", "/buffers/0/uri"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:,abc"}]})", "/buffers/0/byteLength"},
        {R"({"asset":{"version":"2.0"},"bufferViews":[{"buffer":0,"byteLength":4}]})", "/bufferViews/0/buffer"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"data:,abc"}],
             "bufferViews":[{"buffer":0,"byteOffset":18446744073709551615,"byteLength":2}]})",
         "/bufferViews/0"},
        {R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"type":"VEC3","count":1e10}]})",
         "/accessors/0/count"},
        {R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5124,"type":"VEC3","count":1}]})",
         "/accessors/0/componentType"},
        {R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":1}]})", "/accessors/0/type"},
        // These members are not needed for reading geometry.
        {R"({"asset":{"version":"2.0"},"scene":"0"})", "/scene"},
        {R"({"asset":{"version":"2.0"},"scenes":[{"nodes":["0"]}]})", "/scenes/0/nodes/0"},
        {R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0.5}]})", "/nodes/0/mesh"},
        {R"({"asset":{"version":"2.0"},"nodes":[{"name":5}]})", "/nodes/0/name"},
        {R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1,"1",1]}]})", "/nodes/0/scale/1"},
        {R"({"asset":{"version":"2.0"},"textures":[{"source":{}}]})", "/textures/0/source"},
        {R"({"asset":{"version":"2.0"},"textures":[{"extensions":{"EXT_texture_webp":{"source":true}}}]})",
         "/textures/0/extensions/EXT_texture_webp/source"},
        {R"({"asset":{"version":"2.0"},"images":[{"bufferView":"x"}]})", "/images/0/bufferView"},
        {R"({"asset":{"version":"2.0"},"materials":[{"normalTexture":{"index":"0"}}]})",
         "/materials/0/normalTexture/index"},
        {R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":{"baseColorTexture":3}}]})",
         "/materials/0/pbrMetallicRoughness/baseColorTexture"},
        {R"({"asset":{"version":"2.0"},"materials":[{"extensions":{"KHR_materials_clearcoat":
             {"clearcoatNormalTexture":{"texCoord":"1"}}}}]})",
         "/materials/0/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/texCoord"},
        {R"({"asset":{"version":"2.0"},"animations":[{"samplers":[{"input":null}]}]})",
         "/animations/0/samplers/0/input"},
    };
    for (const auto& test : cases) {
        const Error error = errorOf([&] { parseDocument(toBytes(test.text), "model.gltf", {}); });
        EXPECT_NE(error.code, ErrorCode::ok) << test.text;
        EXPECT_NE(error.code, ErrorCode::internal) << test.text;
        EXPECT_EQ(error.place, test.place) << test.text;
        EXPECT_EQ(error.message.find('\n'), std::string::npos);
    }
}

TEST(Document, AcceptsNullForNumbersAndAnyDataOfUnknownExtensions) {
    for (const char* members :
         {R"("accessors":[{"componentType":5126,"type":"VEC3","count":0,"min":[null,null,null],"max":null}])",
          R"("nodes":[{"matrix":[null]}],"materials":[{"normalTexture":{"index":0,"scale":null}}])",
          R"("nodes":[{"mesh":0.0,"extras":5,"extensions":{"ACME_x":7}}])",
          R"("materials":[{"extensions":{"ACME_x":{"someTexture":1}}}])", R"("textures":[{"source":-1}])"}) {
        const std::string text = R"({"asset":{"version":"2.0"},)" + std::string(members) + "}";
        const Error error = errorOf([&] { parseDocument(toBytes(text), "model.gltf", {}); });
        EXPECT_EQ(error.code, ErrorCode::ok) << text << error.message;
    }
}

TEST(Document, NamesTheEncodingOfWideText) {
    using std::operator""s;
    for (const std::string& text : {"\xff\xfe{\0}\0"s, "\xfe\xff\0{\0}"s, "{\0}\0"s, "\0{\0}"s}) {
        const Error error = errorOf([&] { parseDocument(toBytes(text), "model.gltf", {}); });
        EXPECT_EQ(error.code, ErrorCode::invalidFile);
        EXPECT_NE(error.message.find("encoded as UTF-16"), std::string::npos) << error.message;
    }
}

TEST(Document, RejectsGltf1WithAMessage) {
    // In glTF 1.0 the root contains objects where glTF 2.0 has arrays.
    const Error error = errorOf([] {
        gltf::parseDocument(toBytes(R"({"accessors":{},"meshes":{},"asset":{"version":"1.0"}})"), "model.gltf", {});
    });
    EXPECT_EQ(error.message, "the file requires glTF version '1.0', not 2.0");
}

TEST(Document, ReadsManyAccessorsInLinearTime) {
    std::string text = R"({"asset":{"version":"2.0"},"accessors":[)";
    for (int i = 0; i < 300000; ++i) text += R"({"componentType":5126,"type":"VEC3","count":1},)";
    text.back() = ']';
    EXPECT_EQ(rootArray(parseDocument(toBytes(text + "}"), "model.gltf", {}), "accessors").size(), 300000u);
}

TEST(Document, MessagesAreOneLineOfValidUtf8) {
    const auto message = [](const std::string& uri) {
        const Json json = {{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", 1}, {"uri", uri}}}}};
        return errorOf([&] { parseDocument(toBytes(json.dump()), "model.gltf", {}); }).message;
    };
    std::string long_name;
    for (int i = 0; i < 300; ++i) long_name += "\u00e9";
    for (const std::string& uri :
         {std::string("../a\nb"), std::string("a%0Ab"), std::string("%FF%C3"), std::string("http:\n\x1b[1m"),
          "../" + long_name, "../x" + long_name, std::string("\0a", 2), std::string("a%00"), long_name}) {
        const std::string text = message(uri);
        EXPECT_FALSE(text.empty()) << uri;
        EXPECT_EQ(text.find_first_of("\n\x1b"), std::string::npos) << text;
        EXPECT_NO_THROW(static_cast<void>(Json(text).dump())) << uri;
    }
}

TEST(InQuotes, KeepsCharactersAndReplacesInvalidBytes) {
    EXPECT_EQ(inQuotes("a\u00e9\u20ac\U0001f600"), "'a\u00e9\u20ac\U0001f600'");
    // Each byte of a malformed sequence counts as one character, and so does a control character.
    const auto unknown = [](std::size_t count) {
        std::string text(count + 2, '?');
        text.front() = text.back() = '\'';
        return text;
    };
    for (const std::string bytes :
         {"\xff", "\xc3", "\xc0\x80", "\xe2\x82", "\xed\xa0\x80", "\xe0\x80\x80", "\xf4\x90\x80\x80"})
        EXPECT_EQ(inQuotes(bytes), unknown(bytes.size()));
    EXPECT_EQ(inQuotes("\t\x7f\u009b\u2028"), unknown(4));
    EXPECT_EQ(inQuotes("\xe2"
                       "a"),
              "'?a'");
    EXPECT_EQ(inQuotes("ab\u00e9", 4), "'ab\u00e9'");
    EXPECT_EQ(inQuotes("ab\u00e9", 3), "'ab...'");
}

TEST(Glb, SaysWhatToDoAt4GiB) {
    const std::size_t around = frameGlb("{}", 0, {}).head.size();
    EXPECT_EQ(errorOf([&] { static_cast<void>(frameGlb("{}", 0xffffffff - around - 3, {})); }).code, ErrorCode::ok);
    for (const std::size_t bin : {0xffffffff - around + 1, std::size_t{0xffffffff}, std::size_t{5} << 30}) {
        const Error error = errorOf([&] { static_cast<void>(frameGlb("{}", bin, {})); });
        EXPECT_EQ(error.code, ErrorCode::cannotWrite);
        EXPECT_NE(error.message.find(".gltf"), std::string::npos) << error.message;
    }
}

TEST(Glb, MayHaveMoreBytesInBinThanItsBuffer) {
    GltfBuilder builder;
    builder.addFloats({1, 2, 3}, 3);
    Json json = builder.json();
    json["buffers"] = Json::array({Json{{"byteLength", 12}}});
    const GlbFrame frame = frameGlb(json.dump(), 40, {});
    Bytes file = frame.head;
    file.insert(file.end(), builder.bytes().begin(), builder.bytes().end());
    file.resize(file.size() + 28, 7);
    file.insert(file.end(), frame.tail.begin(), frame.tail.end());
    const Document document = parseDocument(file, "model.glb", {});
    EXPECT_EQ(document.buffers[0].bytes.size(), 12u);
}

TEST(Document, NamesRequiredExtensions) {
    const auto check = [](const char* name) {
        const std::string text = std::string(R"({"asset":{"version":"2.0"},"extensionsRequired":[")") + name + "\"]}";
        Document document = parseDocument(toBytes(text), "model.gltf", {});
        checkRequiredExtensions(document);
        return document.warnings;
    };
    for (const auto& [name, missing] :
         {std::pair{kDraco, dracoMissing()}, std::pair{kExtMeshopt, meshoptMissing(false)},
          std::pair{kKhrMeshopt, meshoptMissing(true)}}) {
        const Error error = errorOf([&, name = name] { EXPECT_TRUE(check(name).empty()); });
        EXPECT_EQ(error.code, missing.empty() ? ErrorCode::ok : ErrorCode::unsupportedFile) << name;
        // The message names the library and the missing feature.
        EXPECT_TRUE(missing.empty() || error.message == std::string("the file requires ") + name + ": " + missing);
    }
    EXPECT_TRUE(check("KHR_mesh_quantization").empty());
    EXPECT_EQ(check("VENDOR_unknown").size(), 1u);
}

}  // namespace
}  // namespace tspace::gltf
