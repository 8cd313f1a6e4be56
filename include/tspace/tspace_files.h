/* SPDX-License-Identifier: MIT */
/* The C API of model files: what the tool does, for programs and bindings. Files in and out, or bytes in and out.
 * CMake target tspace::files. The rules of tspace.h hold here too: errors, sized structs, threads, nothing printed.
 *
 * Options are a JSON object in UTF-8. Its members are the tool's options, by their long names without dashes:
 *     {"method": "best", "crease": 60, "overwrite": true, "threads": 2, "ignore": ["tangentsUnused"]}
 * A flag is true or false; everything else is a number or a string with what stands on a command line. Null and ""
 * mean no options: those of the tool, but for threads, which are 1 unless said. `tspace help generate` and docs/tool.md
 * list the options; those about command lines (names and numbers of files, text, SARIF) are none here.
 * Errors of all functions: INVALID_OPTION (an option that is not there or has a wrong value: the tool's sentence).
 *
 * Reports are the JSON that the tool prints by --json (docs/json.md), here always of one file. A report has `exitCode`
 * and `ok` as the tool would: a check that finds errors succeeds, and its report has exit code 1.
 */
#ifndef TSPACE_TSPACE_FILES_H
#define TSPACE_TSPACE_FILES_H

#include "tspace/tspace.h"

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* Bytes that the library made. A 0 stands behind the last, not counted, so a report is a C string too. */
typedef struct tspace_Bytes {
    uint8_t* data;
    size_t size;
} tspace_Bytes;

/* Frees bytes that a function of this header gave, and makes them empty. Null and empty bytes are allowed. */
void tspace_destroyBytes(tspace_Bytes* bytes) TSPACE_NOEXCEPT;

/* Gives a file that a model names.
 * user      tspace_Model.user
 * path      where it lies, relative to the model: escapes of the URI decoded, with slashes, ended by 0. Paths that lead
 *           out of the model's folder are never asked for, unless the option "allow-external" is given; URLs never.
 * data, size  set them; the bytes must stay as they are until the call that asks is over
 * Returns TSPACE_OK; TSPACE_ERROR_CANNOT_READ: there is no such file (without a buffer, the call fails with INVALID_FILE;
 * without an image, it goes on); any other code: the call fails with it. Called from the thread of the call, and perhaps
 * more than once for a file. */
typedef tspace_ErrorCode (*tspace_FindFile)(void* user, const char* path, const uint8_t** data, size_t* size);

/* A model in memory. */
typedef struct tspace_Model {
    uint32_t struct_size;
    uint32_t reserved;   /* 0 */
    const uint8_t* data; /* GLB, glTF, or OBJ; read during the call only */
    size_t size;
    const char* name;          /* what reports call it, "helmet.glb"; OBJ is told by its ending. Null or "": "model" */
    tspace_FindFile find_file; /* null: a model that needs other files is INVALID_FILE */
    void* user;                /* for find_file */
} tspace_Model;

/* Adds normals and tangents where they are needed, and writes a .glb or .gltf; tspace/asset.h says it all.
 * input     path of a model (GLB, glTF, OBJ), not null
 * output    path of the result, not null; may be the input. It appears at once or not at all, with the files it names
 * options   those of `tspace generate`, or null
 * report    may be null; tspace.generate/1. Free it by tspace_destroyBytes. Empty after an error
 * Errors: NULL_DATA, CANNOT_READ, INVALID_FILE, UNSUPPORTED_FILE, FORBIDDEN_PATH, TOO_LARGE, CANNOT_WRITE,
 *         OUT_OF_MEMORY. Nothing on disk has changed then. */
tspace_ErrorCode tspace_generateFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
/* The same from bytes to bytes.
 * model     not null
 * output    not null; a GLB with everything in it. Free it by tspace_destroyBytes. Empty after an error, and with the
 *           option "dry-run" */
tspace_ErrorCode tspace_generateBytes(const tspace_Model* model, const char* options, tspace_Bytes* output,
                                      tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Says what is wrong with the frames of a model (tspace/check.h): options of `tspace check`, report tspace.check/1.
 * Errors: as tspace_generateFile, but nothing is written. */
tspace_ErrorCode tspace_checkFile(const char* input, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_checkBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Says what is in a model: options of `tspace inspect`, report tspace.inspect/1. Errors: as tspace_checkFile. */
tspace_ErrorCode tspace_inspectFile(const char* input, const char* options, tspace_Bytes* report,
                                    tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_inspectBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;

/* Says which method made the tangents of a model (tspace/identify.h): options of `tspace identify`, report
 * tspace.identify/1. Errors: as tspace_checkFile. */
tspace_ErrorCode tspace_identifyFile(const char* input, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_identifyBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Compares the frames of two models that show the same surface (tspace/diff.h): options of `tspace diff`, report
 * tspace.diff/1. Errors: as tspace_checkFile; `element` of the error is 0 when `a` is at fault, 1 when `b` is. */
tspace_ErrorCode tspace_diffFiles(const char* a, const char* b, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_diffBytes(const tspace_Model* a, const tspace_Model* b, const char* options,
                                  tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Inverts the green channel of a normal map, PNG, JPEG or WebP (tspace/flip_green.h): options of `tspace flip-green`, report
 * tspace.flip-green/1. The name of `output`, which may be the input, says its format: that of the input, or PNG.
 * Errors: as tspace_generateFile. */
tspace_ErrorCode tspace_flipGreenFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;
/* The same from bytes to bytes of the same format.
 * data      `size` bytes, not null
 * output    not null; free it by tspace_destroyBytes. Empty after an error, and with the option "dry-run" */
tspace_ErrorCode tspace_flipGreenBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                       tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
