// SPDX-License-Identifier: MIT
#include "input_kinds.h"

#include <algorithm>

#include "model/imported/import_document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::tool {
namespace {

InputKind kindByName(const std::string& name) {
    if (isImageName(name)) return isFolder(name) ? InputKind::any : InputKind::image;
    if (isModelName(name)) return isFolder(name) ? InputKind::any : InputKind::model;
    return InputKind::any;
}

std::string messageFor(const Command& command, const Option& option, const std::string& file) {
    const std::string is_image = ", but '" + file + "' is an image";
    const std::string is_model = ", but '" + file + "' is a model";
    if (option.reads == InputKind::text)
        return option.name() + " must be a text file" + (isImageName(file) ? is_image : is_model);
    const bool is_operand = option.names.empty();
    const auto hasOtherKind = [&](const Option& other) { return other.names.empty() && other.reads != option.reads; };
    if (!is_operand || std::any_of(command.options.begin(), command.options.end(), hasOtherKind)) {
        return (is_operand ? option.value : option.name()) +
               (option.reads == InputKind::model ? " must be a model" + is_image : " must be an image" + is_model);
    }
    if (option.reads == InputKind::model)
        return command.name + " reads models" + is_image + "; tspace check examines a normal map";
    return command.name + " reads images" + is_model +
           "; tspace generate --flip-green and --convert-maps change the maps of a model";
}

}  // namespace

bool isModelName(const std::string& name) {
    return isGltfName(name) || lowerExtension(name) == ".obj" || isImportedFormat(name);
}

std::string wrongKindOfInput(const Command& command, const Given& given) {
    std::string of_several;
    bool has_right = false;
    for (const Given::Item& item : given.items) {
        const Option& option = *item.option;
        if (option.reads == InputKind::any) continue;
        const InputKind kind = kindByName(item.value);
        const bool is_wrong = kind != InputKind::any && kind != option.reads;
        if (is_wrong && !option.is_repeatable) return messageFor(command, option, item.value);
        if (!option.is_repeatable) continue;
        if (!is_wrong) has_right = true;
        if (is_wrong && of_several.empty()) of_several = messageFor(command, option, item.value);
    }
    return has_right ? std::string() : of_several;
}

}  // namespace tspace::tool
