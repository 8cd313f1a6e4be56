// SPDX-License-Identifier: MIT
#include "page_origin.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string>

#include "commands/shared/option_table.h"
#include "system.h"

namespace tspace::tool {
namespace {

std::string& rememberedCommand() {
    static std::string command;
    return command;
}

std::string dateText(std::time_t time) {
    const std::tm utc = utcTime(time);
    std::array<char, 64> text{};
    return std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &utc) > 0 ? text.data() : "";
}

}  // namespace

void rememberCommandLine(std::span<char* const> words) {
    std::string& command = rememberedCommand();
    command = "tspace";
    for (std::size_t i = 1; i < words.size(); ++i) command += " " + shellWord(words[i]);
}

Result<PageOrigin> pageOrigin() {
    const char* const given = std::getenv("SOURCE_DATE_EPOCH");
    if (given == nullptr || *given == '\0') {
        using Clock = std::chrono::system_clock;
        return PageOrigin{dateText(Clock::to_time_t(Clock::now())), rememberedCommand()};
    }
    constexpr std::uint64_t kMax = 253402300799;  // the last second of the year 9999
    std::uint64_t seconds = 0;
    if (!options::parseNumber(given, seconds) || seconds > kMax) {
        return Error{
            ErrorCode::invalidOption,
            "the environment variable SOURCE_DATE_EPOCH must be a number of seconds since 1970, at most 253402300799"};
    }
    return PageOrigin{dateText(static_cast<std::time_t>(seconds)), rememberedCommand()};
}

}  // namespace tspace::tool
