// SPDX-License-Identifier: MIT
// Which files a model may name, and decoding of data URIs.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "model/io/uri.h"
#include "model/read/read_scene.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

using test::errorOf;
using test::TempFolder;

TEST(DataUri, RoundTripsEveryLength) {
    Bytes bytes;
    for (int i = 0; i < 300; ++i) {
        EXPECT_EQ(decodeDataUri(encodeDataUri("a/b", bytes), "").bytes, bytes);
        bytes.push_back(static_cast<std::uint8_t>(i * 7));
    }
}

TEST(DataUri, DecodesPercentsAndMissingPadding) {
    EXPECT_EQ(decodeDataUri("data:text/plain;charset=x,a%20b%2", "").bytes, test::toBytes("a b%2"));
    EXPECT_EQ(decodeDataUri("data:;base64,YQ", "").bytes, test::toBytes("a"));
    EXPECT_EQ(decodeDataUri("DATA:image/png;BASE64,YWI=", "").mime_type, "image/png");
    EXPECT_EQ(errorOf([] { decodeDataUri("data:;base64,Y*==", "p"); }).place, "p");
    EXPECT_EQ(errorOf([] { decodeDataUri("data:;base64", "p"); }).code, ErrorCode::invalidFile);
}

TEST(ResolveUri, StaysInsideTheFolder) {
    const TempFolder folder;
    folder.write("model/sub/a b.bin", std::string("x"));
    const auto resolve = [&](const char* uri, bool allow = false) {
        return errorOf([&] { resolveUri(folder.path("model"), uri, allow, "/buffers/0/uri"); }).code;
    };
    for (const char* uri :
         {"sub/a%20b.bin", "sub/a b.bin", "./sub/x", "missing.bin", "a..b", "100%.bin", "sub\\x", "sub%5Cx"}) {
        EXPECT_EQ(resolve(uri), ErrorCode::ok) << uri;
    }
    for (const char* uri :
         {"../x", "sub/../../x", "%2e%2e/x", "..%2Fx", "/etc/passwd", "//host/x", "..\\x", "sub\\..\\../x", "..%5Cx",
          "\\etc", "\\\\host\\x", "http://host/x", "file:///etc/passwd", "C:/x", "sub/../x"}) {
        EXPECT_EQ(resolve(uri), ErrorCode::forbiddenPath) << uri;
    }
    EXPECT_EQ(resolve("../x", true), ErrorCode::ok);
    EXPECT_EQ(resolve("/etc/passwd", true), ErrorCode::ok);
    EXPECT_EQ(resolve("http://host/x", true), ErrorCode::forbiddenPath);
    EXPECT_EQ(resolve("a%00b"), ErrorCode::invalidFile);
    EXPECT_EQ(resolve(""), ErrorCode::invalidFile);
}

TEST(ResolveUri, TakesWindowsSeparatorsForSlashes) {
    const TempFolder folder;
    EXPECT_EQ(resolveUri(folder.path(""), "sub\\a%20b.bin", false, ""), folder.path("") / "sub/a b.bin");
    EXPECT_EQ(resolveUri(folder.path(""), "..\\b.bin", true, ""), folder.path("") / "../b.bin");
}

TEST(ResolveUri, FollowsNoLinkOut) {
    const TempFolder folder;
    folder.write("secret.bin", std::string("x"));
    folder.write("model/inside.bin", std::string("x"));
    std::filesystem::create_symlink("../secret.bin", folder.path("model/out.bin"));
    std::filesystem::create_directory_symlink("..", folder.path("model/up"));
    std::filesystem::create_symlink("inside.bin", folder.path("model/in.bin"));
    const auto resolve = [&](const char* uri, bool allow = false) {
        return errorOf([&] { resolveUri(folder.path("model"), uri, allow, ""); }).code;
    };
    EXPECT_EQ(resolve("out.bin"), ErrorCode::forbiddenPath);
    EXPECT_EQ(resolve("up/secret.bin"), ErrorCode::forbiddenPath);
    EXPECT_EQ(resolve("in.bin"), ErrorCode::ok);
    EXPECT_EQ(resolve("out.bin", true), ErrorCode::ok);
}

TEST(ResolveUri, IsAskedForBuffersAndImages) {
    const TempFolder folder;
    folder.write("secret.bin", std::string("abcd"));
    const auto load = [&](const std::string& members, bool allow) {
        const std::string file = folder.write("model/m.gltf", "{\"asset\":{\"version\":\"2.0\"}," + members + "}");
        return errorOf([&] { gltf::loadDocument(file, {.allow_external = allow}); });
    };
    const std::string buffer = R"("buffers":[{"byteLength":4,"uri":"../secret.bin"}])";
    EXPECT_EQ(load(buffer, false).code, ErrorCode::forbiddenPath);
    EXPECT_EQ(load(buffer, false).place, "/buffers/0/uri");
    EXPECT_EQ(load(buffer, true).code, ErrorCode::ok);
    EXPECT_EQ(load(R"("images":[{"uri":"../secret.bin"}])", false).place, "/images/0/uri");
    EXPECT_EQ(load(R"("buffers":[{"byteLength":4,"uri":"gone.bin"}])", false).code, ErrorCode::invalidFile);
    EXPECT_EQ(load(R"("buffers":[{"byteLength":4,"uri":"."}])", false).code, ErrorCode::invalidFile);
}

TEST(ResolveUri, OfModelsInMemoryWithoutFilesIsNotFollowedAndYetAUri) {
    const auto load = [](const std::string& uri) {
        const std::string text = R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + "\"}]}";
        FileOptions options;
        options.content = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        return errorOf([&] { gltf::loadDocument("m.gltf", options); });
    };
    EXPECT_EQ(load(":").code, ErrorCode::invalidFile);
    EXPECT_EQ(load(":").place, "/images/0/uri");
    EXPECT_EQ(load("a%00b").code, ErrorCode::invalidFile);
    for (const char* uri : {"a.png", "../a.png", "/a.png", "http://a/b.png", ""})
        EXPECT_EQ(load(uri).code, ErrorCode::ok) << uri;
}

}  // namespace
}  // namespace tspace
