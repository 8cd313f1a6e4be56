// SPDX-License-Identifier: MIT
// Common steps of all functions of the C file API: parsing JSON options, converting errors to codes, returning bytes.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "commands/shared/option_table.h"
#include "model/io/file_error.h"
#include "tspace/callbacks.h"
#include "tspace/file_options.h"
#include "tspace/result.h"
#include "tspace/tspace_files.h"

namespace tspace::c_files {

/// Bytes returned to the caller, who frees them with tspace_destroyBytes.
class GrowingBytes {
  public:
    GrowingBytes() = default;
    explicit GrowingBytes(std::span<const std::uint8_t> bytes) { append(bytes); }
    explicit GrowingBytes(std::string_view text)
        : GrowingBytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}) {}
    ~GrowingBytes();
    GrowingBytes(const GrowingBytes&) = delete;
    GrowingBytes& operator=(const GrowingBytes&) = delete;

    /// Appends bytes. Throws std::bad_alloc.
    void append(std::span<const std::uint8_t> bytes);
    /// Transfers the bytes to `to` unless it is null. Never fails.
    void giveTo(tspace_Bytes* to) noexcept;

  private:
    std::uint8_t* data_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0;
};

/// Writes `error` with its location to the caller's struct, which may be null, and returns its code. Does not allocate.
tspace_ErrorCode finishCall(const Error& error, tspace_Error* out) noexcept;

/// Runs `body`, which may throw like the file layer, and converts its outcome to an error code. Empties `results`, each
/// of which may be null, before the call and after an error.
template <class Body>
tspace_ErrorCode atCallBorder(tspace_Error* out, std::initializer_list<tspace_Bytes*> results, Body&& body) noexcept {
    for (tspace_Bytes* result : results) {
        if (result != nullptr) *result = tspace_Bytes{};
    }
    const Result<Done> result = atFileBorder([&]() -> Result<Done> {
        body();
        return Done{};
    });
    if (!result) {
        for (tspace_Bytes* half_done : results) tspace_destroyBytes(half_done);
    }
    return result ? finishCall(Error{ErrorCode::ok}, out) : finishCall(result.error(), out);
}

/// Returns a text argument. Fails with nullData if it is null.
std::string requiredText(const char* text, const char* name);

/// Parses options; null means none. Fails with invalidOption.
void readOptions(const options::OptionList& list, const char* text, options::Given& given);

/// These do the same as tspace_generateBytes and tspace_checkBytes, but with a progress callback that may end the call
/// by throwing.
tspace_ErrorCode generateBytes(const tspace_Model* model, const char* options, const Progress& progress,
                               tspace_Bytes* output, tspace_Bytes* report, tspace_Error* error) noexcept;
tspace_ErrorCode checkBytes(const tspace_Model* model, const char* options, const Progress& progress,
                            tspace_Bytes* report, tspace_Error* error) noexcept;

/// Returns the name of a model.
std::string nameOf(const tspace_Model& model);
/// Sets up `options` to open the model. Fails with nullData and invalidOption.
void openModel(const tspace_Model* model, FileOptions& options);

}  // namespace tspace::c_files
