// SPDX-License-Identifier: MIT
#include "input_kinds.h"

#include <algorithm>
#include <string_view>

#include "model/imported/import_document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::tool {
namespace {

enum class InputKind { any, model, image, text };

struct Required {
    std::string_view name;
    InputKind kind;
};
/// Operands and options that name a file to read. IN depends on the command.
constexpr Required kRequired[] = {
    {"A", InputKind::model},           {"B", InputKind::model},           {"LOW", InputKind::model},
    {"--high", InputKind::model},      {"--low", InputKind::model},       {"--cage", InputKind::model},
    {"--mesh", InputKind::model},      {"--to-mesh", InputKind::model},   {"MAP", InputKind::image},
    {"--source", InputKind::image},    {"--roughness", InputKind::image}, {"--skew", InputKind::image},
    {"--files-from", InputKind::text}, {"--pairs", InputKind::text},
};

InputKind requiredKind(const Command& command, const Option& option) {
    const std::string& name = option.name();
    if (name == "IN" || name == "IN...") {
        if (command.reads == Reads::anything) return InputKind::any;
        return command.reads == Reads::models ? InputKind::model : InputKind::image;
    }
    const auto* const found = std::find_if(std::begin(kRequired), std::end(kRequired),
                                           [&](const Required& required) { return required.name == name; });
    return found != std::end(kRequired) ? found->kind : InputKind::any;
}

InputKind kindByName(const std::string& name) {
    if (isImageName(name)) return isFolder(name) ? InputKind::any : InputKind::image;
    if (isModelName(name)) return isFolder(name) ? InputKind::any : InputKind::model;
    return InputKind::any;
}

std::string messageFor(const Command& command, const Option& option, InputKind required, const std::string& file) {
    const std::string is_image = ", but '" + file + "' is an image";
    const std::string is_model = ", but '" + file + "' is a model";
    if (required == InputKind::text)
        return option.name() + " must be a text file" + (isImageName(file) ? is_image : is_model);
    const bool is_operand = option.names.empty();
    if (required == InputKind::model)
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
        const InputKind required = requiredKind(command, *item.option);
        if (required == InputKind::any) continue;
        const InputKind kind = kindByName(item.value);
        const bool is_wrong = kind != InputKind::any && kind != required;
        if (is_wrong && !item.option->is_repeatable) return messageFor(command, *item.option, required, item.value);
        if (!item.option->is_repeatable) continue;
        if (!is_wrong) has_right = true;
        if (is_wrong && of_several.empty()) of_several = messageFor(command, *item.option, required, item.value);
    }
    return has_right ? std::string() : of_several;
}

}  // namespace tspace::tool
