// SPDX-License-Identifier: MIT
// Rules of the schema of SARIF 2.1.0 for the output of tspace: required and optional members of each object, and their
// types. Other members are not allowed.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace tspace::test {

class SarifSchema {
  public:
    /// Fails the test at each place of the log that violates a rule.
    void expectValid(const nlohmann::json& log) const { expect(log, "sarifLog", ""); }

  private:
    using Json = nlohmann::json;
    struct Object {
        std::set<std::string> required;
        std::map<std::string, std::string>
            members;  ///< name -> type; "[type]" is an array, "{type}" an array without duplicates
    };

    void expect(const Json& value, const std::string& kind, const std::string& place) const {
        if (kind.front() == '[' || kind.front() == '{') {
            ASSERT_TRUE(value.is_array()) << place;
            std::set<Json> different;
            for (std::size_t i = 0; i < value.size(); ++i) {
                expect(value[i], kind.substr(1, kind.size() - 2), place + "/" + std::to_string(i));
                different.insert(value[i]);
            }
            EXPECT_TRUE(kind.front() == '[' || different.size() == value.size()) << place << " repeats an entry";
        } else if (const auto object = kObjects.find(kind); object != kObjects.end()) {
            expectObject(value, object->second, place);
        } else {
            expectPlain(value, kind, place);
        }
    }

    void expectObject(const Json& value, const Object& object, const std::string& place) const {
        ASSERT_TRUE(value.is_object()) << place;
        for (const std::string& name : object.required) EXPECT_TRUE(value.contains(name)) << place << " lacks " << name;
        for (const auto& [name, member] : value.items()) {
            const auto known = object.members.find(name);
            EXPECT_NE(known, object.members.end()) << place << "/" << name << " is not allowed";
            if (known != object.members.end()) expect(member, known->second, place + "/" + name);
        }
    }

    static void expectPlain(const Json& value, const std::string& kind, const std::string& place) {
        if (kind == "any object") {
            EXPECT_TRUE(value.is_object()) << place;
        } else if (kind == "boolean") {
            EXPECT_TRUE(value.is_boolean()) << place;
        } else if (kind == "integer" || kind == "from 1") {
            ASSERT_TRUE(value.is_number_integer()) << place;
            EXPECT_GE(value.get<int>(), kind == "from 1" ? 1 : -1) << place;
        } else {
            ASSERT_TRUE(value.is_string()) << place;
            expectText(value.get<std::string>(), kind, place);
        }
    }

    static void expectText(const std::string& text, const std::string& kind, const std::string& place) {
        static const std::set<std::string> kLevels{"none", "note", "warning", "error"};
        EXPECT_TRUE(kind != "version" || text == "2.1.0") << place << ": " << text;
        EXPECT_TRUE(kind != "level" || kLevels.contains(text)) << place << ": " << text;
        EXPECT_TRUE(kind != "uri" || text.find("://") != std::string::npos) << place << ": " << text;
        if (kind == "uri" || kind == "uri-reference") {
            const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/%:#?@!$&'()*+,;=";
            EXPECT_EQ(text.find_first_not_of(allowed), std::string::npos) << place << ": " << text;
        }
    }

    const std::map<std::string, Object> kObjects = {
        {"sarifLog", {{"version", "runs"}, {{"$schema", "uri"}, {"version", "version"}, {"runs", "[run]"}}}},
        {"run", {{"tool"}, {{"tool", "tool"}, {"invocations", "[invocation]"}, {"results", "[result]"}}}},
        {"tool", {{"driver"}, {{"driver", "toolComponent"}}}},
        {"toolComponent",
         {{"name"},
          {{"name", "text"}, {"version", "text"}, {"informationUri", "uri"}, {"rules", "{reportingDescriptor}"}}}},
        {"reportingDescriptor",
         {{"id"},
          {{"id", "text"},
           {"shortDescription", "multiformatMessageString"},
           {"help", "multiformatMessageString"},
           {"helpUri", "uri"}}}},
        {"multiformatMessageString", {{"text"}, {{"text", "text"}}}},
        {"result",
         {{"message"},
          {{"ruleId", "text"},
           {"ruleIndex", "integer"},
           {"level", "level"},
           {"message", "message"},
           {"locations", "[location]"},
           {"properties", "any object"}}}},
        {"message", {{"text"}, {{"text", "text"}}}},  // instead of a text, an id is allowed, which tspace does not use
        {"location", {{}, {{"physicalLocation", "physicalLocation"}, {"logicalLocations", "{logicalLocation}"}}}},
        {"physicalLocation", {{"artifactLocation"}, {{"artifactLocation", "artifactLocation"}, {"region", "region"}}}},
        {"artifactLocation", {{}, {{"uri", "uri-reference"}, {"uriBaseId", "text"}}}},
        {"region", {{"startLine"}, {{"startLine", "from 1"}}}},
        {"logicalLocation", {{}, {{"name", "text"}, {"fullyQualifiedName", "text"}}}},
        {"invocation",
         {{"executionSuccessful"},
          {{"executionSuccessful", "boolean"},
           {"exitCode", "integer"},
           {"toolExecutionNotifications", "[notification]"}}}},
        {"notification", {{"message"}, {{"level", "level"}, {"message", "message"}, {"locations", "{location}"}}}},
    };
};

}  // namespace tspace::test
