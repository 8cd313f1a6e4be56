// SPDX-License-Identifier: MIT
// The C API for files with the cases that all languages share: tests/cases/files.json.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "api/made_bytes.h"

namespace tspace::test {
namespace {

using CaseJson = nlohmann::json;

tspace_ErrorCode runFileCase(const std::string& call, const tspace_Model& model, const char* options, Made& report) {
    Made output;
    if (call == "generate") return tspace_generateBytes(&model, options, &output.bytes, &report.bytes, nullptr);
    if (call == "diff") return tspace_diffBytes(&model, &model, options, &report.bytes, nullptr);
    static const std::map<std::string, decltype(&tspace_checkBytes)> kCalls = {
        {"check", tspace_checkBytes}, {"inspect", tspace_inspectBytes}, {"identify", tspace_identifyBytes}};
    return kCalls.at(call)(&model, options, &report.bytes, nullptr);
}

TEST(CFileCases, GiveTheResultsOfTheTable) {
    const CaseJson table = CaseJson::parse(std::ifstream(TSPACE_CASES_DIR "/files.json"));
    for (const CaseJson& one : table["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        CaseJson document = table["model"];
        if (one.contains("change")) {
            const CaseJson::json_pointer at("/" + one["change"][0].get<std::string>());
            document[at] = one["change"][1];
            if (document[at].is_null()) document[at.parent_pointer()].erase(at.back());
        }
        const std::string bytes = document.dump(), options = one.value("options", CaseJson::object()).dump();
        tspace_Model model;
        TSPACE_INIT(model);
        model.data = reinterpret_cast<const std::uint8_t*>(bytes.data());
        model.size = bytes.size();
        Made report;
        const tspace_ErrorCode code = runFileCase(one["call"], model, options.c_str(), report);
        ASSERT_EQ(tspace_errorName(code), one.value("error", std::string("ok")));
        if (code != TSPACE_OK) continue;
        CaseJson made = CaseJson::parse(report.text());
        if (made.contains("files")) made.update(made["files"][0]);
        for (const auto& [path, wanted] : one["gives"].items()) {
            EXPECT_EQ(made.at(CaseJson::json_pointer("/" + path)), wanted) << path;
        }
    }
}

}  // namespace
}  // namespace tspace::test
