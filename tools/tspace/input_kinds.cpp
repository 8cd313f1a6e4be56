// SPDX-License-Identifier: MIT
#include "input_kinds.h"

#include <algorithm>
#include <string_view>

#include "model/imported/import_document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::tool {
namespace {

enum class Kind { any, model, image, text };

struct Required {
    std::string_view name;
    Kind kind;
};
/// Operands and options that name a file to read. IN depends on the command.
constexpr Required kRequired[] = {
    {"A", Kind::model},           {"B", Kind::model},        {"LOW", Kind::model},         {"--high", Kind::model},
    {"--low", Kind::model},       {"--cage", Kind::model},   {"--mesh", Kind::model},      {"--to-mesh", Kind::model},
    {"MAP", Kind::image},         {"--source", Kind::image}, {"--roughness", Kind::image}, {"--skew", Kind::image},
    {"--files-from", Kind::text}, {"--pairs", Kind::text},
};

Kind requiredKind(const Command& command, const Option& option) {
    const std::string& name = option.name();
    if (name == "IN" || name == "IN...") {
        if (command.reads == Reads::anything) return Kind::any;
        return command.reads == Reads::models ? Kind::model : Kind::image;
    }
    const auto* const found = std::find_if(std::begin(kRequired), std::end(kRequired),
                                           [&](const Required& required) { return required.name == name; });
    return found != std::end(kRequired) ? found->kind : Kind::any;
}

Kind kindByName(const std::string& name) {
    if (isImageName(name)) return isFolder(name) ? Kind::any : Kind::image;
    if (isModelName(name)) return isFolder(name) ? Kind::any : Kind::model;
    return Kind::any;
}

std::string messageFor(const Command& command, const Option& option, Kind required, const std::string& file) {
    const std::string is_image = ", but '" + file + "' is an image";
    const std::string is_model = ", but '" + file + "' is a model";
    if (required == Kind::text)
        return option.name() + " must be a text file" + (isImageName(file) ? is_image : is_model);
    const bool is_operand = option.names.empty();
    if (required == Kind::model)
        return is_operand ? command.name + " reads models" + is_image + "; tspace check examines a normal map"
                          : option.name() + " must be a model" + is_image;
    return is_operand ? command.name + " reads images" + is_model +
                            "; tspace generate --flip-green and --convert-maps change the maps of a model"
                      : option.name() + " must be an image" + is_model;
}

}  // namespace

bool isModelName(const std::string& name) {
    return isGltfName(name) || lowerExtension(name) == ".obj" || isImportedFormat(name);
}

std::string wrongKindOfInput(const Command& command, const Given& given) {
    std::string of_several;
    bool has_right = false;
    for (const Given::Item& item : given.items) {
        const Kind required = requiredKind(command, *item.option);
        if (required == Kind::any) continue;
        const Kind kind = kindByName(item.value);
        const bool is_wrong = kind != Kind::any && kind != required;
        if (is_wrong && !item.option->is_repeatable) return messageFor(command, *item.option, required, item.value);
        if (!item.option->is_repeatable) continue;
        if (!is_wrong) has_right = true;
        if (is_wrong && of_several.empty()) of_several = messageFor(command, *item.option, required, item.value);
    }
    return has_right ? std::string() : of_several;
}

}  // namespace tspace::tool
