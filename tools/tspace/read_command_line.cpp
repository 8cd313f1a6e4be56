// SPDX-License-Identifier: MIT
// Parses arguments in order.
#include "read_command_line.h"

#include <algorithm>
#include <string_view>

namespace tspace::tool {
namespace {

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
                // An argument such as -o2 is a name only if the command declares it.
                const bool is_name = argument[1] == '-' || (argument.size() > 2 && find(argument) != nullptr);
                wrong = is_name ? readLong(argument) : readShort(argument);
            }
        }
        return wrong.empty() ? checkWhole() : wrong;
    }

  private:
    [[nodiscard]] const Option* find(const std::string& name) const {
        for (const Option& option : command_.options) {
            if (option.isNamed(name)) return &option;
        }
        return nullptr;
    }

    std::string readLong(const std::string& argument) {
        const std::size_t equals = argument.find('=');
        const std::string name = argument.substr(0, equals);
        const Option* option = find(name);
        if (option == nullptr) return unknownOption(command_.options, name);
        if (equals == std::string::npos) return option->value.empty() ? take(*option, "") : takeNext(*option);
        if (option->value.empty()) return name + " takes no value";
        return take(*option, argument.substr(equals + 1));
    }

    std::string readShort(const std::string& argument) {
        for (std::size_t i = 1; i < argument.size(); ++i) {
            const Option* option = find({'-', argument[i]});
            if (option == nullptr) return unknownOption(command_.options, argument);
            if (!option->value.empty())
                return i + 1 < argument.size() ? take(*option, argument.substr(i + 1)) : takeNext(*option);
            const std::string wrong = take(*option, "");
            if (!wrong.empty()) return wrong;
        }
        return {};
    }

    /// Takes the value of an option. If the next argument is the name of another option, the value is missing.
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
        if (place >= operands.size()) return "'" + argument + "' is unexpected";
        ++operand_count_;
        return take(*operands[place], argument);
    }

    std::string take(const Option& option, const std::string& value) { return giveValue(option, value, given_); }

    [[nodiscard]] std::string checkWhole() const {
        const std::string wrong = checkTogether(command_.options, given_);
        return wrong.empty() && command_.finish ? command_.finish(given_) : wrong;
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
