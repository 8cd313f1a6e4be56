// SPDX-License-Identifier: MIT
// Replaces the functions of the file layer that use a disk or other programs. Models are always in memory: all other
// calls fail, and the linker removes the code that only those functions use.
#include <cerrno>
#include <new>

#include "commands/generate/flip_maps.h"
#include "commands/generate/generate_steps.h"
#include "model/imported/import_document.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/named_files.h"
#include "model/io/recorded_files.h"
#include "model/io/system_files.h"
#include "model/io/uri.h"
#include "tspace/execution.h"

namespace tspace {

Bytes readFile(const Path& path, const std::string& place, const Execution&) {
    failFile(ErrorCode::cannotRead, "without a disk, tspace cannot read " + pathInQuotes(path), place);
}
bool isThere(const Path&) { return false; }
bool isFolder(const Path&) { return false; }
PathKind kindOf(const Path&) { return PathKind::nothing; }
bool isSameFile(const Path&, const Path&) { return false; }
Path resolveUri(const Path&, std::string_view uri, bool, const std::string& place) {
    refuseUri(uri, "cannot be resolved without a disk", place);
}

void recordInput(const std::string&) {}

bool isGlbOutput(const Path& path) { return isGlbName(path); }
std::uint64_t fileSize(const Path&) { return 0; }
std::string pathBelow(const Path&, const Path&) { return {}; }

InputFiles::InputFiles() : call_(0) {}
void InputFiles::addTo(std::set<std::string>&, const Path&) {}
void InputFiles::watch(FileOptions&) {}
bool InputFiles::has(const Path&) const { return false; }
AtomicOutput::File AtomicOutput::planFile(const Path& requested) { return {.target = requested}; }
void AtomicOutput::addFile(File planned, const std::function<int(const Sink&)>&) {
    failToWrite(planned.target, "there is no disk");
}
void AtomicOutput::renameFiles() {}
bool AtomicOutput::leave(const Path&, std::span<const std::uint8_t>) { return false; }
void AtomicOutput::removeTemporaryFiles() noexcept {}

bool isImportedFormat(const Path&) { return false; }
gltf::Document importDocument(const Path&, const FileOptions&, const Progress&) {
    failFile(ErrorCode::unsupportedFile, "only glTF and OBJ can be read in JavaScript");
}

// An arena takes its memory from the module's heap: freed memory is never returned to the system anyway.
Arena::Arena() : impl_(nullptr) {
    allocator_ = {.allocate = [](void*, std::size_t bytes, std::size_t alignment) -> void* {
                      return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
                  },
                  .release = [](void*, void* memory, std::size_t,
                                std::size_t alignment) { ::operator delete(memory, std::align_val_t(alignment)); }};
}
Arena::~Arena() = default;

Bytes rewriteMap(const Scene&, ByteSpan, const GenerateOptions&, JudgedMap& map) {
    map.report.reason = "images cannot be rewritten in JavaScript";
    return {};
}
ConvertedHeights normalMapFromHeights(const Scene&, std::size_t, std::size_t, double, const GenerateOptions&) {
    return {};
}

gltf::MapConversion::MapConversion(gltf::Model& model, const GenerateOptions& options)
    : model_(model), options_(options) {
    failFile(ErrorCode::unsupportedFile, "images are not decoded in JavaScript, so no map was converted");
}
std::vector<ConvertedMapReport> gltf::MapConversion::run(gltf::Editor&, const gltf::OutputTarget&,
                                                         std::span<const PrimitiveReport>) {
    static_cast<void>(model_);  // avoids Clang's warning about a member that only the real version uses
    static_cast<void>(options_);
    return {};
}

}  // namespace tspace
