// SPDX-License-Identifier: MIT
// Arguments one after the other.
#include "read_command_line.h"

#include <algorithm>
#include <string_view>

#include "nearest_name.h"

namespace tspace::tool {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

class Reader {
  public:
    Reader(const Command& command, std::span<const char* const> arguments, Given& given)
        : command_(command), arguments_(arguments), given_(given) {}

    std::string read() {
        bool only_operands = false;
        std::string wrong;
        while (wrong.empty() && next_ < arguments_.size()) {
            const std::string argument = arguments_[next_++];
            if (only_operands || argument.size() < 2 || argument.front() != '-') {
                wrong = readOperand(argument);
            } else if (argument == "--") {
                only_operands = true;
            } else {
                wrong = argument[1] == '-' ? readLong(argument) : readShort(argument);
            }
        }
        return wrong.empty() ? checkWhole() : wrong;
    }

  private:
    [[nodiscard]] const Option* find(const std::string& name) const {
        for (const Option& option : command_.options) {
            if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return &option;
        }
        return nullptr;
    }

    [[nodiscard]] std::string unknown(const std::string& name) const {
        std::vector<std::string> names;
        for (const Option& option : command_.options) {
            names.insert(names.end(), option.names.rbegin(), option.names.rend());
        }
        return "there is no option '" + name + "'" + didYouMean(name, names);
    }

    std::string readLong(const std::string& argument) {
        const std::size_t equals = argument.find('=');
        const std::string name = argument.substr(0, equals);
        const Option* option = find(name);
        if (option == nullptr) return unknown(name);
        if (equals == std::string::npos) return option->value.empty() ? take(*option, "") : takeNext(*option);
        if (option->value.empty()) return name + " takes no value";
        return take(*option, argument.substr(equals + 1));
    }

    std::string readShort(const std::string& argument) {
        for (std::size_t i = 1; i < argument.size(); ++i) {
            const Option* option = find({'-', argument[i]});
            if (option == nullptr) return unknown(argument);
            if (!option->value.empty()) {
                return i + 1 < argument.size() ? take(*option, argument.substr(i + 1)) : takeNext(*option);
            }
            const std::string wrong = take(*option, "");
            if (!wrong.empty()) return wrong;
        }
        return {};
    }

    /// The name of another option is a value that was forgotten.
    std::string takeNext(const Option& option) {
        const std::string_view next = next_ < arguments_.size() ? arguments_[next_] : "--";
        if (next == "--" || find(std::string(next.substr(0, next.find('=')))) != nullptr)
            return option.name() + " needs a value: " + option.value;
        ++next_;
        return take(option, std::string(next));
    }

    std::string readOperand(const std::string& argument) {
        std::vector<const Option*> operands;
        for (const Option& option : command_.options) {
            if (option.names.empty()) operands.push_back(&option);
        }
        const bool repeats_last = !operands.empty() && operands.back()->is_repeatable;
        const std::size_t place = repeats_last ? std::min(operand_count_, operands.size() - 1) : operand_count_;
        if (place >= operands.size()) return "'" + argument + "' is one too many";
        ++operand_count_;
        return take(*operands[place], argument);
    }

    std::string take(const Option& option, const std::string& value) {
        if (!option.is_repeatable && given_.has(option.name()))
            return option.value.empty() ? "" : option.name() + " is given twice";
        given_.items.push_back({&option, value});
        std::size_t begin = 0;
        std::string wrong;
        while (wrong.empty() && begin <= value.size()) {
            const std::size_t end = option.is_list ? std::min(value.find(',', begin), value.size()) : value.size();
            wrong = takePart(option, value.substr(begin, end - begin));
            begin = end + 1;
        }
        return wrong;
    }

    static std::string takePart(const Option& option, const std::string& value) {
        const auto& choices = option.choices;
        std::string wrong;
        if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end()) {
            constexpr std::size_t kMostListed = 12;
            wrong = choices.size() <= kMostListed ? "must be one of " + joined(choices)
                                                  : "there is no such " + option.value;
            wrong += didYouMean(value, choices);
        } else {
            wrong = option.take(value);
        }
        return wrong.empty() ? "" : option.name() + " " + (value.empty() ? "''" : value) + ": " + wrong;
    }

    [[nodiscard]] std::string checkWhole() const {
        for (const Option& option : command_.options) {
            if (!given_.has(option.name())) {
                if (option.is_required) return option.name() + " is missing";
                continue;
            }
            for (const std::string& other : option.excludes) {
                if (given_.has(other)) return option.name() + " and " + other + " exclude each other";
            }
            if (!option.needs.empty() && !given_.has(option.needs)) return option.name() + " needs " + option.needs;
        }
        return command_.finish ? command_.finish(given_) : "";
    }

    const Command& command_;
    std::span<const char* const> arguments_;
    Given& given_;
    std::size_t next_ = 0;
    std::size_t operand_count_ = 0;
};

}  // namespace

std::string readCommandLine(const Command& command, std::span<const char* const> arguments, Given& given) {
    for (const std::string_view argument : arguments) {
        if (argument == "--") break;
        if (argument == "-h" || argument == "--help") {
            const auto help = std::find_if(command.options.begin(), command.options.end(),
                                           [](const Option& option) { return option.name() == "--help"; });
            given.items.push_back({&*help});
            return {};
        }
    }
    return Reader(command, arguments, given).read();
}

}  // namespace tspace::tool
