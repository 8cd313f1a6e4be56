// SPDX-License-Identifier: MIT
// What an option of a call on files is: one description of each, from which the C API reads its JSON, and the tool its command
// line, help, man pages and completions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tspace::options {

/// Receives a value: stores it, and returns an error message ("must be ..."), or nothing.
using Take = std::function<std::string(const std::string& value)>;

#ifdef TSPACE_SMALL
/// The bindings show no help, so its texts are left out there.
struct HelpText {
    constexpr HelpText() = default;
    constexpr HelpText(const char*) {}
    HelpText(const std::string&) {}
};
#else
using HelpText = std::string;
#endif

/// An option, or an operand of a command line (what stands there without a name, such as input files).
struct Option {
    std::vector<std::string> names = {};  ///< {"-o", "--output"}; none: an operand
    /// Names before a rename: accepted, but in no help, completion or man page.
    std::vector<std::string> old_names = {};
    std::string value = {};                 ///< what stands for the value in help, "DEG"; empty: a flag
    HelpText help = {};                     ///< a sentence or more
    std::string default_text = {};          ///< printed behind the help; empty: the help says it, or there is none
    std::string group = {};                 ///< its heading in help
    std::vector<std::string> choices = {};  ///< the values that it may have; empty: any that `take` takes
    bool is_file = false;                   ///< the value is a path, for completions
    bool is_required = false;
    bool is_repeatable = false;
    bool is_list = false;                    ///< the value is a list of choices with commas between them
    std::vector<std::string> excludes = {};  ///< options that it cannot be given with
    std::string needs = {};                  ///< an option that it cannot be given without
    Take take = {};

    /// The name that stands in messages: the last, which is the long one; that of an operand is its value's.
    [[nodiscard]] const std::string& name() const { return names.empty() ? value : names.back(); }
    /// Whether `given` is one of its names, old ones included.
    [[nodiscard]] bool isNamed(const std::string& given) const;
};

/// The options that were given, in their order, with their values (empty for flags).
struct Given {
    struct Item {
        const Option* option = nullptr;
        std::string value = {};
    };
    std::vector<Item> items = {};

    /// `name` as in Option::name.
    [[nodiscard]] bool has(const std::string& name) const;
};

/// The options of one call.
using OptionList = std::vector<Option>;

/// Appends an option under the heading `group` of help.
Option& add(OptionList& list, const char* group, Option option);

/// Gives a value ("" for a flag) to an option, and notes it in `given`. Returns what is wrong with it, or nothing.
std::string giveValue(const Option& option, const std::string& value, Given& given);

/// Returns which options exclude each other or are missing, or nothing.
std::string checkTogether(const OptionList& list, const Given& given);

/// The option of this long name; null: there is none.
const Option* findOption(const OptionList& list, const std::string& name);
/// The message about a name that no option has.
std::string unknownOption(const OptionList& list, const std::string& name);

/// A name of a choice and what it stands for.
template <class Value>
struct Named {
    const char* name;
    Value value;
};

/// `names` as they stand in help: "-q, --quiet"; empty for an operand. Without a `value_name` it is a flag.
Option option(const char* names, const char* value_name, Take take, HelpText help);
/// Sets `target` to `value`.
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
/// The name of an HTML file that is written: any name without an extension (a pipe, a device), else one that ends in .html or .htm.
Option htmlOutput(const char* names, const char* value_name, std::string& target, HelpText help);
/// A whole number from 0 to `most`. The default is what `target` holds.
template <class Unsigned>
Option number(const char* names, Unsigned& target, unsigned most, HelpText help) {
    const auto store = [&target](std::uint64_t given) { target = static_cast<Unsigned>(given); };
    return numberOption(names, target, most, store, std::move(help));
}
/// A number of degrees from 0 to `most`. The default is what `target` holds.
template <class Float>
Option degrees(const char* names, Float& target, int most, HelpText help) {
    const auto store = [&target](double given) { target = static_cast<Float>(given); };
    return degreesOption(names, static_cast<double>(target), most, store, std::move(help));
}

/// A number from 0 to `most`, or "auto". `noun`: "a number", for messages
Option numberOrAuto(const char* names, const char* value_name, const char* noun, float& target, float automatic,
                    int most, HelpText help);

/// One of the names of a table. The default is the name of what `target` holds.
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

/// The whole text as a whole number. false: it is none, or too large.
bool parseNumber(const std::string& text, std::uint64_t& number);
/// Like parseNumber, for any finite number.
bool parseReal(const std::string& text, double& number);

/// The name that `word` becomes by the fewest letters added, left out, changed or swapped with their neighbour, or that
/// it is the beginning of. Empty where none is near enough to be what was meant.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

/// "; did you mean '...'?", or nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& names);

// Options as JSON, for callers of the C API.

/// Gives the members of a JSON object to the options of these names, without their dashes: {"method": "best",
/// "crease": 60, "overwrite": true, "ignore": ["tangentsUnused"]}. A flag is a boolean; false and null are as if nothing
/// was given. An empty text has no members. Returns what is wrong, in the words of the command line, or nothing.
std::string readJsonOptions(const OptionList& list, std::string_view text, Given& given);

}  // namespace tspace::options
