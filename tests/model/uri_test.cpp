// SPDX-License-Identifier: MIT
// Files that a model may reference, and decoding of data URIs.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "model/io/named_files.h"
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

/// Exporters break base64 into lines, and browsers ignore these line breaks.
TEST(DataUri, IgnoresWhiteSpaceInBase64) {
    EXPECT_EQ(decodeDataUri("data:;base64,YWJj\nZGVm\r\n", "").bytes, test::toBytes("abcdef"));
    EXPECT_EQ(decodeDataUri("data:;base64,YW Jj\tZG%0AU=\n", "").bytes, test::toBytes("abcde"));
    EXPECT_EQ(errorOf([] { decodeDataUri("data:;base64,YWJj\nY", "p"); }).place, "p");
}

TEST(ResolveUri, StaysInsideTheFolder) {
    const TempFolder folder;
    folder.write("model/sub/a b.bin", std::string("x"));
    const auto resolve = [&](const char* uri, bool allow = false) {
        return errorOf([&] { resolveUri(folder.path("model"), uri, allow, "/buffers/0/uri"); }).code;
    };
    for (const char* uri : {"sub/a%20b.bin", "sub/a b.bin", "./sub/x", "missing.bin", "a..b", "100%.bin", "sub\\x",
                            "sub%5Cx", "sub/../x", "gone/../x", "gone\\..\\sub\\x", "gone/%2e%2e/x"}) {
        EXPECT_EQ(resolve(uri), ErrorCode::ok) << uri;
    }
    for (const char* uri : {"../x", "sub/../../x", "%2e%2e/x", "..%2Fx", "/etc/passwd", "//host/x", "..\\x",
                            "sub\\..\\../x", "..%5Cx", "\\etc", "\\\\host\\x", "http://host/x", "file:///etc/passwd",
                            "C:/x", "C:\\x", "d%3A%5Cx", "/sub/../x", "sub/..//../x"}) {
        EXPECT_EQ(resolve(uri), ErrorCode::forbiddenPath) << uri;
    }
    EXPECT_EQ(resolve("../x", true), ErrorCode::ok);
    EXPECT_EQ(resolve("/etc/passwd", true), ErrorCode::ok);
    EXPECT_EQ(resolve("http://host/x", true), ErrorCode::forbiddenPath);
    EXPECT_EQ(resolve("a%00b"), ErrorCode::invalidFile);
    EXPECT_EQ(resolve(""), ErrorCode::invalidFile);
}

TEST(ResolveUri, TreatsWindowsSeparatorsAsSlashes) {
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
    EXPECT_EQ(load(R"("images":[{"uri":"../secret.bin"}])", false).code, ErrorCode::ok) << "only a warning";
    EXPECT_EQ(load(R"("buffers":[{"byteLength":4,"uri":"gone.bin"}])", false).code, ErrorCode::invalidFile);
    EXPECT_EQ(load(R"("buffers":[{"byteLength":4,"uri":"."}])", false).code, ErrorCode::invalidFile);
}

TEST(ResolveUri, OfModelsInMemoryWithoutFilesIsKeptButNotFollowed) {
    const auto load = [](const std::string& uri) {
        const std::string text = R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + "\"}]}";
        FileOptions options;
        options.content = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        return gltf::loadDocument("m.gltf", options).warnings.size();
    };
    for (const char* uri : {":", "a%00b"}) EXPECT_EQ(load(uri), 1u) << uri;
    for (const char* uri : {"a.png", "../a.png", "/a.png", "http://a/b.png", ""}) EXPECT_EQ(load(uri), 0u) << uri;
}

/// Geometry does not depend on images, so a rejected image is only a warning.
TEST(ResolveUri, OfARejectedImageIsAWarning) {
    const TempFolder folder;
    folder.write("secret.png", std::string("x"));
    folder.write("model/n.png", std::string("x"));
    std::filesystem::create_symlink("../secret.png", folder.path("model/out.png"));
    const auto warnings = [&](const std::string& uri, bool allow = false) {
        const std::string text = R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + "\"}]}";
        const gltf::Document document =
            gltf::loadDocument(folder.write("model/m.gltf", text), {.allow_external = allow});
        return document.warnings.empty() ? std::string() : document.warnings[0];
    };
    for (const char* uri :
         {"../secret.png", "C:\\\\tex\\\\c.png", "D:/c.png", "/c.png", "out.png", "a/../../secret.png"}) {
        EXPECT_NE(warnings(uri).find("image 0 is not read: "), std::string::npos) << uri;
        EXPECT_NE(warnings(uri).find("--allow-external"), std::string::npos) << uri;
        EXPECT_EQ(warnings(uri, true), "") << uri;
    }
    for (const char* uri : {"https://cdn.example.com/c.png", "file:///c.png", "file:c.png"}) {
        EXPECT_NE(warnings(uri).find("scheme"), std::string::npos) << uri;
        EXPECT_EQ(warnings(uri).find("--allow-external"), std::string::npos) << uri;
    }
    for (const char* uri : {"n.png", "textures/../n.png", "textures\\\\..\\\\n.png", "gone.png"})
        EXPECT_EQ(warnings(uri), "") << uri;
}

}  // namespace
}  // namespace tspace
