// SPDX-License-Identifier: MIT
#include "depfile.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "commands/shared/file_options.h"
#include "model/io/file_io.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

/// Appends a name to a rule. Backslashes are doubled before a space or #, as in the depfiles of GCC. A colon would end
/// the list of targets, except for the colon of a drive (C:/).
void appendName(std::string& rule, const std::string& name) {
    const bool has_drive = name.size() > 2 && name[1] == ':' && (name[2] == '/' || name[2] == '\\');
    std::size_t backslashes = 0;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (c == ' ' || c == '#') rule.append(backslashes + 1, '\\');
        if (c == ':' && !(has_drive && i == 1)) rule += '\\';
        if (c == '$') rule += '$';
        backslashes = c == '\\' ? backslashes + 1 : 0;
        rule += c;
    }
}

/// Returns whether an option names a file that a command writes.
bool isOutputOption(const Option& option) {
    constexpr std::string_view kOutputOptions[] = {"--output", "--html", "--sarif", "--report"};
    return std::find(std::begin(kOutputOptions), std::end(kOutputOptions), option.name()) != std::end(kOutputOptions);
}

Depfile* depfile_of_run = nullptr;

}  // namespace

Depfile::Depfile(const std::string& path) : path_(path), kept_(std::in_place, std::vector<std::string>{path}) {
    depfile_of_run = this;
}

Depfile::~Depfile() { depfile_of_run = nullptr; }

Depfile* Depfile::ofRun() { return depfile_of_run; }

Result<Done> Depfile::write(const std::vector<std::string>& held) {
    std::vector<std::string> outputs = recorded_.outputs(), inputs = recorded_.inputs();
    outputs.insert(outputs.end(), held.begin(), held.end());
    if (outputs.empty()) return Done{};
    std::set<std::string> written;
    for (const std::string& output : held) written.insert(identityOf(output));
    std::erase_if(inputs, [&](const std::string& input) { return written.contains(identityOf(input)); });
    const std::string identity = identityOf(path_);
    if (std::any_of(inputs.begin(), inputs.end(),
                    [&](const std::string& input) { return identityOf(input) == identity; }))
        return Error{ErrorCode::invalidOption, "the output " + path_ + " is an input"};
    const Result<std::string> text = depfileText(outputs, inputs);
    if (!text) return text.error();
    kept_.reset();
    depfile_of_run = nullptr;
    return writeTextFile(path_, *text);
}

Result<std::string> depfileText(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    for (const std::vector<std::string>* names : {&outputs, &inputs}) {
        for (const std::string& name : *names) {
            if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
                return Error{ErrorCode::invalidOption,
                             "a dependency file cannot contain a name with a control character: " + printable(name)};
        }
    }
    std::string rule;
    for (const std::string& output : outputs) {
        if (!rule.empty()) rule += ' ';
        appendName(rule, output);
    }
    rule += ':';
    for (const std::string& input : inputs) {
        rule += " \\\n  ";
        appendName(rule, input);
    }
    rule += '\n';
    for (const std::string& input : inputs) {
        rule += '\n';
        appendName(rule, input);
        rule += ":\n";
    }
    return rule;
}

void addDepfile(Command& command) {
    const bool writes = std::any_of(command.options.begin(), command.options.end(), isOutputOption);
    if (!writes) return;
    const auto path = std::make_shared<std::string>();
    Option& depfile = command.add(
        kReporting, fileOption("--depfile", "FILE", *path,
                               "Write a dependency file for make and ninja. It lists the outputs, and every file "
                               "that was read, such as buffers, images and material libraries.",
                               InputKind::text));
    depfile.excludes = {"--in-place", "--dry-run"};
    command.finish = [path, finish = std::move(command.finish)](const Given& given) {
        std::string wrong = finish ? finish(given) : std::string();
        if (!wrong.empty() || path->empty()) return wrong;
        const bool has_output = std::any_of(given.items.begin(), given.items.end(), [&](const Given::Item& item) {
            return item.value != "-" && isOutputOption(*item.option);
        });
        return std::string(has_output ? "" : "--depfile can only be used with an output file");
    };
    const auto run = [prepare = std::move(command.prepare), run = std::move(command.run)] {
        const ExitCode code = prepare ? prepare() : ExitCode::done;
        return code == ExitCode::done ? run() : code;
    };
    command.prepare = {};
    command.run = [path, run] {
        std::optional<Depfile> depfile;
        if (!path->empty()) depfile.emplace(*path);
        return run();
    };
}

}  // namespace tspace::tool
