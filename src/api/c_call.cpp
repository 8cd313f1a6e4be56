// SPDX-License-Identifier: MIT
// Implements memory, errors, options and models at the border of the C API.
#include "api/c_call.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/c_api/c_convert.h"

namespace tspace::c_files {

GrowingBytes::~GrowingBytes() { std::free(data_); }

void GrowingBytes::append(std::span<const std::uint8_t> bytes) {
    // The capacity includes one byte for the terminating 0.
    if (bytes.size() >= capacity_ - size_ || data_ == nullptr) {
        const std::size_t capacity = std::max(size_ + bytes.size() + 1, size_ + size_ / 2);
        void* grown = std::realloc(data_, capacity);
        if (grown == nullptr) throw std::bad_alloc();
        data_ = static_cast<std::uint8_t*>(grown);
        capacity_ = capacity;
    }
    if (!bytes.empty()) std::memcpy(data_ + size_, bytes.data(), bytes.size());
    size_ += bytes.size();
    data_[size_] = 0;
}

void GrowingBytes::giveTo(tspace_Bytes* to) noexcept {
    if (to == nullptr) return;
    *to = {data_, size_};
    data_ = nullptr;
    size_ = capacity_ = 0;
}

tspace_ErrorCode finishCall(const Error& error, tspace_Error* out) noexcept {
    const tspace_ErrorCode code = c_api::finish(error, out);
    if (out == nullptr) return code;
    if (!error.place.empty()) {
        for (const std::string_view part :
             {std::string_view(" (at "), std::string_view(error.place), std::string_view(")")})
            c_api::appendMessage(part, *out);
    }
    // An option may contain any text, but the message must be one line.
    for (char* c = out->message; *c != '\0'; ++c) {
        if (static_cast<unsigned char>(*c) < 0x20 || *c == 0x7f) *c = ' ';
    }
    return code;
}

std::string requiredText(const char* text, const char* name) {
    if (text == nullptr) failFile(ErrorCode::nullData, std::string(name) + " is null");
    return text;
}

void readOptions(const options::OptionList& list, const char* text, options::Given& given) {
    const std::string wrong = options::readJsonOptions(list, text == nullptr ? "" : text, given);
    if (!wrong.empty()) failFile(ErrorCode::invalidOption, wrong);
}

std::string nameOf(const tspace_Model& model) {
    return model.name == nullptr || *model.name == '\0' ? "model" : model.name;
}

void openModel(const tspace_Model* model, FileOptions& options) {
    if (const Error error = c_api::checkRequired(model, "tspace_Model"); error.code != ErrorCode::ok)
        throw FileError{error};
    if (model->data == nullptr) failFile(ErrorCode::nullData, "the data of the model is null");
    options.content = {model->data, model->size};
    if (model->find_file == nullptr) return;
    options.find_file = [find = model->find_file,
                         user = model->user](const std::string& path) -> Result<std::span<const std::uint8_t>> {
        const std::uint8_t* data = nullptr;
        std::size_t size = 0;
        const tspace_ErrorCode code = find(user, path.c_str(), &data, &size);
        if (code == TSPACE_OK && data == nullptr && size != 0)
            return Error{ErrorCode::nullData, "find_file returned null for the file " + inQuotes(path, 100)};
        if (code == TSPACE_OK) return std::span(data, size);
        return Error{static_cast<ErrorCode>(code), "find_file failed for the file " + inQuotes(path, 100)};
    };
}

}  // namespace tspace::c_files

void tspace_destroyBytes(tspace_Bytes* bytes) noexcept {
    if (bytes == nullptr) return;
    std::free(bytes->data);
    *bytes = tspace_Bytes{};
}
