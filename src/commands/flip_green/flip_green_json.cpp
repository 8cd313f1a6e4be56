// SPDX-License-Identifier: MIT
// An image whose green was inverted, as JSON.
#include "commands/flip_green/flip_green_report.h"

namespace tspace::report {

const char* imageFormatName(ImageFileFormat format) {
    switch (format) {
        case ImageFileFormat::png:
            return "PNG";
        case ImageFileFormat::jpeg:
            return "JPEG";
        case ImageFileFormat::webp:
            return "WebP";
        case ImageFileFormat::ktx2:
            return "KTX2";
        case ImageFileFormat::dds:
            return "DDS";
        case ImageFileFormat::sameAsInput:
            break;
    }
    return "";
}

std::string flipGreenJson(const Outcome<FlipGreenReport>& outcome, ExitCode exit_code) {
    const Result<FlipGreenReport>& result = outcome.result;
    Json json = madeFileJson("tspace.flip-green/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["format"] = imageFormatName(result->format);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bits"] = result->bits;
    json["exact"] = result->is_exact;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
