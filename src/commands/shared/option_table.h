// SPDX-License-Identifier: MIT
// Descriptions of options. The C API uses them to read options from JSON; the tool uses them for its command line,
// help, man pages and completions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tspace::options {

/// Receives a value and stores it. Returns an error message ("must be ...") or an empty string.
using Take = std::function<std::string(const std::string& value)>;

#ifdef TSPACE_SMALL
/// Help text of an option. The bindings print no help, so in their builds this type discards the text.
struct HelpText {
    constexpr HelpText() = default;
    constexpr HelpText(const char*) {}
    HelpText(const std::string&) {}
};
#else
using HelpText = std::string;
#endif

/// Kind of the files that an option or operand names, as far as it is known from their extensions.
enum class InputKind { any, model, image, text };

/// An option, or an operand of a command line (a word without an option name, such as an input file).
struct Option {
    std::vector<std::string> names = {};  ///< {"-o", "--output"}; empty: an operand
    /// Former names of a renamed option: accepted, but absent from help, completions and man pages.
    std::vector<std::string> old_names = {};
    std::string value = {};  ///< name of the value in help, such as "DEG"; empty: a flag
    HelpText help = {};      ///< one or more sentences
    /// Default value, printed after the help text. Empty if the help text states the default, or if there is none.
    std::string default_text = {};
    std::string group = {};                 ///< heading of the help under which the option is listed
    std::vector<std::string> choices = {};  ///< allowed values; empty: all values that `take` accepts
    bool is_file = false;                   ///< the value is a path; used by completions
    /// kind of file that the option reads or writes; files with an extension of another kind are rejected
    InputKind reads = InputKind::any;
    bool is_required = false;
    bool is_repeatable = false;
    bool is_list = false;                    ///< the value is a comma-separated list of choices
    std::vector<std::string> excludes = {};  ///< options that cannot be used together with this option
    std::string needs = {};                  ///< option that this option requires
    Take take = {};

    /// Returns the name used in messages: the last name, which is the long one; for an operand, the name of its value.
    [[nodiscard]] const std::string& name() const { return names.empty() ? value : names.back(); }
    /// Returns whether `given` is one of the names, including old names.
    [[nodiscard]] bool isNamed(const std::string& given) const;
};

/// Options that were given, in this order, with their values (empty for flags).
struct Given {
    struct Item {
        const Option* option = nullptr;
        std::string value = {};
    };
    std::vector<Item> items = {};

    /// Returns whether an option was given. `name`: see Option::name.
    [[nodiscard]] bool has(const std::string& name) const;
};

/// All options of a command, or of the equivalent library call.
using OptionList = std::vector<Option>;

/// Appends an option under the heading `group` in help.
Option& add(OptionList& list, const char* group, Option option);
/// Returns a function that appends an option under this heading.
inline auto adder(OptionList& list, const char* group) {
    return [&list, group](Option option) -> Option& { return add(list, group, std::move(option)); };
}

/// Passes a value ("" for a flag) to an option, and appends it to `given`. Returns an error message or an empty string.
std::string giveValue(const Option& option, const std::string& value, Given& given);

/// Returns an error message if options exclude each other or a required option is missing; otherwise an empty string.
std::string checkTogether(const OptionList& list, const Given& given);

/// Returns the option with this long name, or null.
const Option* findOption(const OptionList& list, const std::string& name);
/// Returns the error message for an unknown option name.
std::string unknownOption(const OptionList& list, const std::string& name);

/// Name and value of a choice.
template <class Value>
struct Named {
    const char* name;
    Value value;
};

/// Makes an option. `names`: as in help, "-q, --quiet"; empty for an operand. An empty `value_name` makes a flag.
Option option(const char* names, const char* value_name, Take take, HelpText help);
/// Makes a flag that sets `target` to `value`.
template <class Value>
Option setting(const char* names, Value& target, Value value, HelpText help) {
    const auto take = [&target, value](const std::string&) {
        target = value;
        return std::string();
    };
    return option(names, "", take, std::move(help));
}
inline Option flag(const char* names, bool& target, HelpText help) {
    return setting(names, target, true, std::move(help));
}

Option numberOption(const char* names, std::uint64_t default_value, unsigned most,
                    std::function<void(std::uint64_t)> store, HelpText help);
Option degreesOption(const char* names, double default_value, int most, std::function<void(double)> store,
                     HelpText help);

Option text(const char* names, const char* value_name, std::string& target, HelpText help);
/// Makes an option for the name of a file, an input or an output. `reads`: its kind.
Option fileOption(const char* names, const char* value_name, std::string& target, HelpText help,
                  InputKind reads = InputKind::any);
/// Makes an option for the name of an HTML output: it ends in .html or .htm, or has no extension (a pipe or a device).
Option htmlOutput(const char* names, const char* value_name, std::string& target, HelpText help);
/// Makes an option for an integer from 0 to `most`. The default is the value of `target`.
template <class Unsigned>
Option number(const char* names, Unsigned& target, unsigned most, HelpText help) {
    const auto store = [&target](std::uint64_t given) { target = static_cast<Unsigned>(given); };
    return numberOption(names, target, most, store, std::move(help));
}
/// Makes an option for an angle in degrees from 0 to `most`. The default is the value of `target`.
template <class Float>
Option degrees(const char* names, Float& target, int most, HelpText help) {
    const auto store = [&target](double given) { target = static_cast<Float>(given); };
    return degreesOption(names, static_cast<double>(target), most, store, std::move(help));
}

/// Makes an option for a number from 0 to `most`, or "auto". `noun`: term for messages, such as "a number".
Option numberOrAuto(const char* names, const char* value_name, const char* noun, float& target, float automatic,
                    int most, HelpText help);

/// Makes an option for one of the names of a table. The default is the name of the value of `target`.
template <class Value, std::size_t count>
Option choice(const char* names, const char* value_name, const Named<Value> (&table)[count], Value& target,
              HelpText help) {
    const auto take = [&target, &table](const std::string& name) {
        for (const Named<Value>& entry : table) {
            if (name == entry.name) target = entry.value;
        }
        return std::string();
    };
    Option chosen = option(names, value_name, take, std::move(help));
    for (const Named<Value>& entry : table) {
        chosen.choices.emplace_back(entry.name);
        if (entry.value == target && chosen.default_text.empty()) chosen.default_text = entry.name;
    }
    return chosen;
}

/// Parses the whole text as an integer. Returns false if it is not an integer or too large.
bool parseNumber(const std::string& text, std::uint64_t& number);
/// Parses the whole text as a finite number. Returns false if it is not one.
bool parseReal(const std::string& text, double& number);

/// Returns the name with the smallest edit distance (insertions, deletions, substitutions and swaps of adjacent
/// letters) to `word`, or a name that starts with `word`. Empty if no name is close enough.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

/// Returns "; did you mean '...'?", or an empty string.
std::string didYouMean(const std::string& word, const std::vector<std::string>& names);

// Options given as JSON, for callers of the C API.

/// Passes the members of a JSON object to the options with these names, without dashes: {"method": "best", "crease":
/// 60, "overwrite": true, "ignore": ["tangentsUnused"]}. Flags are booleans; false and null leave an option unset. An
/// empty text has no members. Returns an error message, worded as for the command line, or an empty string.
std::string readJsonOptions(const OptionList& list, std::string_view text, Given& given);

}  // namespace tspace::options
