// SPDX-License-Identifier: MIT
// Writes the options of the C API calls as JSON, from which scripts/api generates the options of the bindings.
#include <array>

#include "commands/shared/request.h"
#include "model/json/json.h"
#include "pages/pages.h"

namespace tspace::tool {
namespace {

std::string quoted(const std::string& text) { return Json(text).dump(); }

template <class Texts>
std::string list(const Texts& texts) {
    std::string made;
    for (const auto& text : texts) made += (made.empty() ? "" : ", ") + quoted(text);
    return "[" + made + "]";
}

/// Returns which sample values an option accepts. scripts/api distinguishes numbers from text by them.
std::string taken(const Option& option) {
    std::vector<std::string> values;
    for (const char* value : {"1", "0.5", "auto", "16x16", "64M", "text"}) {
        if (!option.value.empty() && option.take(value).empty()) values.emplace_back(value);
    }
    return list(values);
}

std::string optionJson(const Option& option, const std::string& name, const std::string& help) {
    return "{\"name\": " + quoted(name.substr(2)) + ", \"value\": " + quoted(option.value) +
           ", \"choices\": " + list(option.choices) + ", \"takes\": " + taken(option) +
           ", \"file\": " + (option.is_file ? "true" : "false") + ", \"list\": " + (option.is_list ? "true" : "false") +
           ", \"default\": " + quoted(option.default_text) + ",\n   \"help\": " + quoted(help) + "}";
}

template <class Request>
std::string callJson(const char* name, OptionList (*make)(Request&)) {
    Request request;
    std::string made;
    for (const Option& option : make(request)) {
        made += (made.empty() ? "\n  " : ",\n  ") + optionJson(option, option.name(), option.help);
        for (const std::string& old : option.old_names)
            made += ",\n  " + optionJson(option, old, "The name of " + option.name().substr(2) + " before 0.1.");
    }
    return quoted(name) + ": [" + made + "]";
}

}  // namespace

std::string optionsJson() {
    const std::array calls = {callJson("generate", generateOptions),
                              callJson("check", checkOptions),
                              callJson("inspect", inspectOptions),
                              callJson("identify", identifyOptions),
                              callJson("diff", diffOptions),
                              callJson("flipGreen", flipGreenOptions),
                              callJson("convertMap", convertMapOptions),
                              callJson("heightToNormal", heightToNormalOptions),
                              callJson("compressMap", compressMapOptions),
                              callJson("bake", bakeOptions),
                              callJson("finish", finishOptions)};
    std::string made;
    for (const std::string& call : calls) made += (made.empty() ? "{" : ",\n ") + call;
    return made + "}\n";
}

}  // namespace tspace::tool
