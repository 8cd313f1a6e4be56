// SPDX-License-Identifier: MIT
#include "support/report_schema.h"

#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace tspace::test {
namespace {

using Json = nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

Json readSchema(const std::string& name) {
    std::ifstream file(TSPACE_SCHEMA_DIR "/" + name);
    if (!file) throw std::runtime_error("there is no docs/schema/" + name);
    return Json::parse(file);
}

/// Returns the schema in the file docs/schema/NAME. Its references are files in the same folder.
const valijson::Schema& schemaOf(const std::string& name) {
    static std::map<std::string, std::unique_ptr<valijson::Schema>> schemas;
    std::unique_ptr<valijson::Schema>& schema = schemas[name];
    if (schema == nullptr) {
        schema = std::make_unique<valijson::Schema>();
        // The schemas use no feature that differs between draft 7 and draft 2020-12.
        valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
        const Json json = readSchema(name);
        parser.populateSchema(
            Adapter(json), *schema, [](const std::string& other) { return new Json(readSchema(other)); },
            [](const Json* other) { delete other; });
    }
    return *schema;
}

}  // namespace

std::string reportFaults(const std::string& document) {
    const Json json = Json::parse(document, nullptr, false);
    if (!json.is_object() || !json.contains("schema")) return {};
    std::string name = json["schema"].get<std::string>();
    name.replace(name.rfind('/'), 1, ".");
    valijson::ValidationResults results;
    valijson::Validator validator;
    if (validator.validate(schemaOf(name + ".json"), Adapter(json), &results)) return {};
    std::string faults;
    for (const valijson::ValidationResults::Error& error : results) {
        for (const std::string& step : error.context) faults += step;
        faults += ": " + error.description + '\n';
    }
    return faults;
}

}  // namespace tspace::test
