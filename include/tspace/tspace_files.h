/* SPDX-License-Identifier: MIT */
/* The C API for model files: the commands of the tool for programs and bindings, on files or in memory.
 * CMake target tspace::files. The rules of tspace.h apply: errors, sized structs, threads, no printing.
 *
 * Options are a JSON object in UTF-8. Its members are the tool's options, by their long names without dashes:
 *     {"method": "best", "crease": 60, "overwrite": true, "threads": 2, "ignore": ["tangentsUnused"]}
 * A flag is true or false; every other option is a number or a string with the value of the command line. Null and ""
 * mean no options: the tool's defaults, except that threads is 1. `tspace help generate` and docs/reference/tool.md
 * list the options. Options that concern only the command line (input and output names, batches, text and SARIF
 * reports) are not accepted.
 * Errors of all functions: INVALID_OPTION (an unknown option or an invalid value, with the tool's message).
 *
 * Reports are the JSON that the tool prints with --json (docs/reference/json.md), here always for one file. A report
 * has `exitCode` and `ok` as in the tool: a check that finds errors succeeds, and its report has exit code 1. `report`
 * may be null. Free it with tspace_destroyBytes; it is empty after an error. Output files are moved to their final
 * paths after the report is complete, so after an error no output file exists.
 *
 * Functions on files take paths, and read all formats that generate.h lists; functions on bytes do the same in memory.
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

/* In C: bytes allocated by the library. A terminating 0, not counted in `size`, follows: a report is also a C
 * string. */
typedef struct tspace_Bytes {
    uint8_t* data;
    size_t size;
} tspace_Bytes;

/* In C: frees bytes that a function of this header returned, and sets them to empty. Null and empty bytes are
 * allowed. */
void tspace_destroyBytes(tspace_Bytes* bytes) TSPACE_NOEXCEPT;

/* In C: provides a file that a model refers to.
 * user        tspace_Model.user
 * path        path relative to the model: URI escapes decoded, with slashes, zero-terminated. Never a URL, and never a
 *             path outside the model's folder unless the option "allow-external" is set
 * data, size  to be set; the bytes must stay valid until the calling function returns
 * Returns TSPACE_OK, or TSPACE_ERROR_CANNOT_READ if the file does not exist (a missing buffer makes the call fail with
 * INVALID_FILE; a missing image does not); any other code makes the call fail with it. Called from the thread of the
 * call, possibly repeatedly for one file. */
typedef tspace_ErrorCode (*tspace_FindFile)(void* user, const char* path, const uint8_t** data, size_t* size);

/* In C: a model in memory. */
typedef struct tspace_Model {
    uint32_t struct_size;
    uint32_t reserved;   /* 0 */
    const uint8_t* data; /* GLB, glTF, or OBJ; read during the call only */
    size_t size;
    const char* name;          /* name in reports: "helmet.glb"; .obj selects OBJ. Null or "": "model" */
    tspace_FindFile find_file; /* null: a model that needs other files fails with INVALID_FILE */
    void* user;                /* for find_file */
} tspace_Model;

/* Reads `input`, adds or replaces normals and tangents, and writes `output` (.glb or .gltf; may be the same file).
 * All outputs appear at once or not at all: they are written next to the target with a temporary name, then renamed.
 * Errors: CANNOT_READ (the input), INVALID_FILE (also if a buffer file that it refers to cannot be read),
 * UNSUPPORTED_FILE, FORBIDDEN_PATH, INVALID_OPTION, TOO_LARGE, CANNOT_WRITE, OUT_OF_MEMORY. On error no file is
 * changed.
 * In C: options of `tspace generate`, report tspace.generate/1. */
tspace_ErrorCode tspace_generateFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_generateFile, in memory.
 * output    a self-contained GLB. Free it with tspace_destroyBytes. Empty after an error, and with the option
 *           "dry-run" */
tspace_ErrorCode tspace_generateBytes(const tspace_Model* model, const char* options, tspace_Bytes* output,
                                      tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and reports faults of its frames; or reads an image (recognized by its extension, or by the first
 * bytes of file.content) and reports its faults as a normal map, with the same tests but without a mesh. Near-linear
 * in the size of the model. Memory: the model as floats, and about 150 bytes per triangle of the primitives in
 * progress. Thread-safe; the report does not depend on the number of threads. Errors: those of tspace_generateFile,
 * and INVALID_OPTION (an angle or share that is negative or not finite).
 * In C: options of `tspace check`, report tspace.check/1. */
tspace_ErrorCode tspace_checkFile(const char* input, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_checkFile, in memory. */
tspace_ErrorCode tspace_checkBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and returns its properties. Errors: those of tspace_generateFile.
 * In C: options of `tspace inspect`, report tspace.inspect/1. */
tspace_ErrorCode tspace_inspectFile(const char* input, const char* options, tspace_Bytes* report,
                                    tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_inspectFile, in memory. */
tspace_ErrorCode tspace_inspectBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and compares its tangents with those of mikktspace, angle, area, uniform, lengyel, flat and the
 * other methods of tspace that use UVs; mikktspace also on quads, if pairs of triangles explain clearly more. The
 * best method is the one with the most corners whose tangents agree within the tolerance. Among methods within 0.5 %
 * of it, the smallest mean angle decides if the difference exceeds rounding, otherwise the better known method (in
 * this order). `fast` and `best`, which only tspace has, must explain 5 % more than any other. Errors: those of
 * tspace_generateFile for reading.
 * Time: about that of generating with each method. Thread-safe; the same result for any number of threads.
 * In C: options of `tspace identify`, report tspace.identify/1. */
tspace_ErrorCode tspace_identifyFile(const char* input, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_identifyFile, in memory. */
tspace_ErrorCode tspace_identifyBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads two models and compares their frames corner by corner.
 *
 * Primitives are paired by their triangles, as sets of corner positions (and UVs): the order of triangles and
 * vertices, splits and indices do not matter. Other primitives are paired by name, then by position in the file if
 * triangle counts are equal; their triangles are paired if their positions agree within 1/1000 of the primitive's
 * size after both primitives are scaled to the same box, as after quantization. Errors: those of tspace_generateFile
 * for reading; `element` is 0 if A is at fault, 1 if B is. Expected time n log n in the number of corners.
 * Thread-safe.
 * In C: options of `tspace diff`, report tspace.diff/1. */
tspace_ErrorCode tspace_diffFiles(const char* a, const char* b, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_diffFiles, in memory. */
tspace_ErrorCode tspace_diffBytes(const tspace_Model* a, const tspace_Model* b, const char* options,
                                  tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Inverts the green channel of an image: converts between normal maps for OpenGL and DirectX.
 *
 * PNG keeps its color type, bit depth, alpha, palette, and all chunks; interlaced files become non-interlaced. Green
 * of a transparent or background color is inverted too. JPEG is recompressed, without subsampling, and keeps its
 * Exif data, profile and comments. WebP is written losslessly, without metadata. KTX2 and DDS keep their blocks,
 * whose green is inverted exactly in all levels, if they contain uncompressed integers or BC5; others, and
 * supercompressed KTX2 (Zstandard or zlib), are rejected (UNSUPPORTED_FILE), but can be written as PNG with x, y and
 * z, where z of two-channel maps is computed. Color space information of the file is kept, and none is added: glTF
 * normal maps are linear.
 *
 * Errors: UNSUPPORTED_FILE (not an image that this build reads; gray, without a green channel; animated; a format
 * that cannot be written), INVALID_FILE (corrupt), INVALID_OPTION, TOO_LARGE, OUT_OF_MEMORY. Time and memory: linear
 * in the pixels; a PNG that is not interlaced needs a few rows and the size of its file. TOO_LARGE also for a PNG
 * that claims to unpack to more than 16 times the memory limit, 1 GB and more by default.
 * In C: options of `tspace flip-green`, report tspace.flip-green/1. The output has the format of the input, and is
 * empty after an error, and with the option "dry-run". Free it with tspace_destroyBytes. */
tspace_ErrorCode tspace_flipGreenBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                       tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;
/* Reads an image, inverts its green channel like tspace_flipGreenBytes, and writes it; `output` may be `input`. If
 * no format is requested, the extension of the output decides: .png, .jpg, .jpeg, .webp, .ktx2 or .dds. The output
 * is written atomically. Further errors: CANNOT_READ, CANNOT_WRITE; INVALID_OPTION for an extension that is neither
 * .png nor one of the format of the input.
 * In C: options and report as tspace_flipGreenBytes. */
tspace_ErrorCode tspace_flipGreenFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Converts the image `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA) into `output` (.png or .exr), which is written
 * atomically. Alpha is kept; the output contains no color space information. In tangent space, the map scale of a
 * model's material is taken into account.
 *
 * Errors: those of readers of models; CANNOT_READ, CANNOT_WRITE, UNSUPPORTED_FILE, INVALID_FILE (a corrupt image; a
 * model without required data, or whose primitives need different maps), INVALID_OPTION, TOO_LARGE, OUT_OF_MEMORY.
 * Thread-safe.
 * In C: options of `tspace convert-map`, report tspace.convert-map/1. */
tspace_ErrorCode tspace_convertMapFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                       tspace_Error* error) TSPACE_NOEXCEPT;

/* Converts the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; the mean of color channels, unless
 * `encoding` states otherwise) to a normal map, `output` (.png). Errors: those of tspace_convertMapFile.
 * Thread-safe.
 * In C: options of `tspace height-to-normal`, report tspace.height-to-normal/1. */
tspace_ErrorCode tspace_heightToNormalFile(const char* input, const char* output, const char* options,
                                           tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Compresses a tangent-space normal map: x in red, y in green; readers reconstruct z. `output` ends in .dds or
 * .ktx2, or in / for a folder of PNGs, NAME.0.png etc., with three channels. Input from a 16-bit PNG or an EXR gives
 * better blocks than 8-bit input. Errors: those of tspace_convertMapFile, and INVALID_OPTION: sizes of normals and
 * roughness that do not match, or a format that the container does not support. Thread-safe; the same bytes for any
 * number of threads.
 * In C: options of `tspace compress-map`, report tspace.compress-map/1. */
tspace_ErrorCode tspace_compressMapFile(const char* input, const char* output, const char* options,
                                        tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;
/* In C: like tspace_compressMapFile, from the bytes of an image to the bytes of a KTX2, without roughness. Free
 * `output` with tspace_destroyBytes; it is empty after an error, and with the option "dry-run". */
tspace_ErrorCode tspace_compressMapBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                         tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Bakes the maps of `low` from `high`; the normal map is `output`, a PNG. A low poly with several materials gets one
 * file per material: NAME.MATERIAL.png. All files appear at once or not at all. Errors: MISSING_ATTRIBUTE (a low
 * poly without UVs), INVALID_OPTION, OUT_OF_MEMORY; rays that hit nothing are reported as a finding. Also
 * CANNOT_READ, INVALID_FILE, UNSUPPORTED_FILE (also a build that writes no PNG), FORBIDDEN_PATH, TOO_LARGE,
 * CANNOT_WRITE.
 * In C: options of `tspace bake`, report tspace.bake/1. tspace_Error.element identifies the file: 0 is the low poly, 1
 * the high poly, 2 the cage, 4 the skew image. */
tspace_ErrorCode tspace_bakeFile(const char* low, const char* high, const char* output, const char* options,
                                 tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads `input` (any format), and writes `output`, a GLB. Correct normals and tangents are kept; a GLB without
 * faults is copied byte for byte. Maps are written next to the output, as OUT_normal.png, OUT_ao.png and so on, and
 * those that glTF supports are also embedded. All files appear at once or not at all. Errors: those of
 * tspace_generateFile and tspace_bakeFile; tspace_Error.element is 1 for errors about the input, and 0 for errors
 * about the low poly.
 * In C: options of `tspace finish`, report tspace.finish/1. */
tspace_ErrorCode tspace_finishFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
