// SPDX-License-Identifier: MIT
// The OBJ parser with minimal streams. The C++ library's streams with their locales would be a sixth of the module.
#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <istream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

// In namespace std, because the parser uses std:: names.
namespace std::tspace_js {

/// Reads text in memory.
class Buffer {
  public:
    int sgetc() const { return at_ == end_ ? -1 : static_cast<unsigned char>(*at_); }
    int sbumpc() { return at_ == end_ ? -1 : static_cast<unsigned char>(*at_++); }

  protected:
    void setg(const char* begin, const char*, const char* end) {
        at_ = begin;
        end_ = end;
    }

  private:
    const char *at_ = nullptr, *end_ = nullptr;
};

class StringBuffer : public Buffer {
  public:
    explicit StringBuffer(const std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

class Input {
  public:
    struct sentry {
        sentry(Input&, bool) {}
        explicit operator bool() const { return true; }
    };
    Input() = default;
    explicit Input(Buffer* buffer) : buffer_(buffer) {}
    [[nodiscard]] int peek() const { return buffer_ == nullptr ? -1 : buffer_->sgetc(); }
    [[nodiscard]] Buffer* rdbuf() const { return buffer_; }
    void setstate(std::ios_base::iostate) {}
    bool operator!() const { return buffer_ == nullptr; }
    explicit operator bool() const { return buffer_ != nullptr; }

  private:
    Buffer* buffer_ = nullptr;
};

/// File input, which is always empty: there is no disk.
class File : public Input {
  public:
    template <class Name>
    explicit File(const Name&) {}
};

/// Appends text, and drops numbers: the parser writes them only to warnings, which tspace does not show.
class Text : public Input {
  public:
    Text() = default;
    explicit Text(const std::string&) {}
    Text& operator<<(const char* text) {
        text_ += text;
        return *this;
    }
    Text& operator<<(const std::string& text) { return *this << text.c_str(); }
    Text& operator<<(std::size_t) { return *this; }
    [[nodiscard]] const std::string& str() const { return text_; }

  private:
    std::string text_ = {};
};

/// Used by the parser's search in several folders, which tspace does not call.
inline bool getline(const Input&, std::string&, char) { return false; }

}  // namespace std::tspace_js

#define stringbuf tspace_js::StringBuffer
#define streambuf tspace_js::Buffer
#define istream tspace_js::Input
#define ifstream tspace_js::File
#define stringstream tspace_js::Text
#define istringstream tspace_js::Text
#pragma clang diagnostic ignored "-Wall"
#pragma clang diagnostic ignored "-Wextra"
// The following file must not include a C++ header that is not included above.
#include "model/obj/tiny_obj_loader.cpp"
