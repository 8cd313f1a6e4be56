// SPDX-License-Identifier: MIT
// Switches the program to a locale with a decimal comma (German). If the machine has none, it is generated for the
// test.
#pragma once

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/temp_folder.h"

namespace tspace::test {

class CommaLocale {
  public:
    CommaLocale() {
        const std::string make =
            "localedef -i de_DE -f UTF-8 " + folder_.path("de_DE.utf8").string() + " >/dev/null 2>&1";
        if (std::system(make.c_str()) != 0) return;
        setenv("LOCPATH", folder_.path().c_str(), 1);
        if (std::setlocale(LC_ALL, "de_DE.utf8") == nullptr) return;
        char text[8];
        std::snprintf(text, sizeof text, "%.1f", 0.5);
        is_there_ = text == std::string("0,5");
    }
    ~CommaLocale() {
        std::setlocale(LC_ALL, "C");
        unsetenv("LOCPATH");
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

    [[nodiscard]] bool isThere() const { return is_there_; }

  private:
    TempFolder folder_;
    bool is_there_ = false;
};

}  // namespace tspace::test
