/* SPDX-License-Identifier: MIT */
/* The C API of model files: what the tool does, for programs and bindings. Files in and out, or bytes in and out.
 * CMake target tspace::files. The rules of tspace.h hold here too: errors, sized structs, threads, nothing printed.
 *
 * Options are a JSON object in UTF-8. Its members are the tool's options, by their long names without dashes:
 *     {"method": "best", "crease": 60, "overwrite": true, "threads": 2, "ignore": ["tangentsUnused"]}
 * A flag is true or false; everything else is a number or a string with what stands on a command line. Null and ""
 * mean no options: those of the tool, but for threads, which are 1 unless said. `tspace help generate` and docs/reference/tool.md
 * list the options; those about command lines (names and numbers of files, text, SARIF) are none here.
 * Errors of all functions: INVALID_OPTION (an option that is not there or has a wrong value: the tool's sentence).
 *
 * Reports are the JSON that the tool prints by --json (docs/reference/json.md), here always of one file. A report has `exitCode`
 * and `ok` as the tool would: a check that finds errors succeeds, and its report has exit code 1. `report` may be null.
 * Free it by tspace_destroyBytes; it is empty after an error. Output files are put in place when the report is complete,
 * so an error always means that none was written.
 *
 * Functions on files take paths, and read all formats that generate.h names; those on bytes do the same in memory.
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

/* Reads `input`, adds or replaces normals and tangents, and writes `output` (.glb or .gltf; may be the same file).
 * All outputs appear at once or not at all: they are written beside the target under a temporary name, then renamed.
 * Errors: CANNOT_READ (the input), INVALID_FILE (also when a buffer file that it names cannot be read),
 * UNSUPPORTED_FILE, FORBIDDEN_PATH, INVALID_OPTION, TOO_LARGE, CANNOT_WRITE, OUT_OF_MEMORY. On error nothing on disk
 * has changed.
 * In C: options of `tspace generate`, report tspace.generate/1. */
tspace_ErrorCode tspace_generateFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
/* The same from bytes to bytes.
 * output    a GLB with everything in it. Free it by tspace_destroyBytes. Empty after an error, and with the option
 *           "dry-run" */
tspace_ErrorCode tspace_generateBytes(const tspace_Model* model, const char* options, tspace_Bytes* output,
                                      tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and says what is wrong with its frames; or an image (by its extension, or by the first bytes of
 * file.content), and says what is wrong with it as a normal map: by the same tests as those of a model, without the
 * mesh. Near-linear in the size of the model. Memory: the model as floats, and about 150 bytes per triangle of the
 * primitives at work. Thread-safe; the report does not depend on the number of threads. Errors as
 * tspace_generateFile; also INVALID_OPTION (an angle or share that is negative or not finite).
 * In C: options of `tspace check`, report tspace.check/1. */
tspace_ErrorCode tspace_checkFile(const char* input, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_checkBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and says what is in it. Changes nothing. Errors as tspace_generateFile.
 * In C: options of `tspace inspect`, report tspace.inspect/1. */
tspace_ErrorCode tspace_inspectFile(const char* input, const char* options, tspace_Bytes* report,
                                    tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_inspectBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads a model and compares its tangents with those of mikktspace, angle, area, uniform, lengyel, flat and the
 * other methods of tspace that follow UVs; mikktspace also on quads, where pairs of triangles explain clearly more.
 * "The best" is the one with the most near corners; of those within half a percent the nearest in the mean, where
 * that is more than rounding, else the better known (that order). `fast` and `best`, which only tspace has, must
 * explain 5 % more than any other. Errors: those of tspace_generateFile for reading.
 * Time: about that of generating with each method. Thread-safe; the same result for any number of threads.
 * In C: options of `tspace identify`, report tspace.identify/1. */
tspace_ErrorCode tspace_identifyFile(const char* input, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_identifyBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads two models and compares their frames corner by corner.
 *
 * Primitives are paired by their triangles: as sets of corner positions (and UVs), so that the order of triangles
 * and vertices, split vertices and other indices do not matter. What is left is paired by name, then by place in the
 * file when it has as many triangles; its triangles are paired where they lie at the same place but for rounding
 * (1/1000 of the primitive's size) once both primitives are scaled to one box, as after quantisation. Errors: those
 * of tspace_generateFile for reading; `element` is 0 when A is at fault, 1 when B is. Expected time n log n in the
 * number of corners. Thread-safe.
 * In C: options of `tspace diff`, report tspace.diff/1. */
tspace_ErrorCode tspace_diffFiles(const char* a, const char* b, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) TSPACE_NOEXCEPT;
tspace_ErrorCode tspace_diffBytes(const tspace_Model* a, const tspace_Model* b, const char* options,
                                  tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Inverts the green channel of an image: makes a normal map for OpenGL of one for DirectX, and back.
 *
 * PNG keeps its colour type, bits, alpha, palette, and every chunk; rows come one after the other (interlaced files
 * no longer are). Of a transparent or background colour green is inverted too. JPEG is compressed once more, without
 * subsampling, and keeps its Exif data, profile and comments. WebP is written without loss, without metadata. KTX2
 * and DDS keep their blocks, of which green is inverted exactly in all levels: uncompressed integers and BC5;
 * others, and KTX2 packed by Zstandard or zlib, are refused (UNSUPPORTED_FILE), but can be written as PNG: x, y and
 * z, where z is made if there are two channels. Whatever a file says about its colour space stays as it is, and
 * nothing is added: glTF takes normal maps as numbers.
 *
 * Errors: UNSUPPORTED_FILE (not an image that this build reads; grey, so that there is no green channel; animated; a
 * format that cannot be written), INVALID_FILE (broken), INVALID_OPTION, TOO_LARGE, OUT_OF_MEMORY. Time and memory:
 * linear in the pixels; a PNG that is not interlaced needs a few rows and the size of its file. TOO_LARGE also for a
 * PNG that claims to unpack to more than 16 times the memory limit, 1 GB and more by default.
 * In C: options of `tspace flip-green`, report tspace.flip-green/1. The output has the format of the input, and is
 * empty after an error, and with the option "dry-run". Free it by tspace_destroyBytes. */
tspace_ErrorCode tspace_flipGreenBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                       tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;
/* The same from file to file; `output` may be `input`. Where no format is asked for, the name of the output decides:
 * .png, .jpg, .jpeg, .webp, .ktx2 or .dds. The output appears at once, or not at all. Errors also: CANNOT_READ,
 * CANNOT_WRITE; UNSUPPORTED_FILE for another extension. Returns what was done.
 * In C: options and report as tspace_flipGreenBytes. */
tspace_ErrorCode tspace_flipGreenFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Converts the image `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA) into `output` (.png or .exr), which appears at
 * once, or not at all. Alpha stays. The output has no word on colours. In tangent space the scale that a model's
 * material gives the map counts on its side.
 *
 * Errors: those of readers of models; CANNOT_READ, CANNOT_WRITE, UNSUPPORTED_FILE, INVALID_FILE (an image that is
 * broken; a model without what is needed, or whose primitives need a map each), INVALID_OPTION, TOO_LARGE,
 * OUT_OF_MEMORY. Thread-safe.
 * In C: options of `tspace convert-map`, report tspace.convert-map/1. */
tspace_ErrorCode tspace_convertMapFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                       tspace_Error* error) TSPACE_NOEXCEPT;

/* Makes a normal map, `output` (.png), of the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; of colors
 * the mean counts, unless `encoding` says otherwise).
 * Errors: those of tspace_convertMapFile. Thread-safe.
 * In C: options of `tspace height-to-normal`, report tspace.height-to-normal/1. */
tspace_ErrorCode tspace_heightToNormalFile(const char* input, const char* output, const char* options,
                                           tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Packs a normal map in tangent space: x in red, y in green; z is made by who reads it. `output` ends in .dds or
 * .ktx2; or in / for a folder of PNGs, NAME.0.png and on, with three channels. From PNG of 16 bits or EXR blocks are
 * better than from 8 bits. Errors: those of tspace_convertMapFile, and INVALID_OPTION: grids of normals and
 * roughness that do not fit, a format that the container does not hold. Thread-safe; the same bytes for any number
 * of threads.
 * In C: options of `tspace compress-map`, report tspace.compress-map/1. */
tspace_ErrorCode tspace_compressMapFile(const char* input, const char* output, const char* options,
                                        tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;
/* The same from the bytes of an image to those of a KTX2, without roughness. Free `output` by tspace_destroyBytes; it is
 * empty after an error, and with the option "dry-run". */
tspace_ErrorCode tspace_compressMapBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                         tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Bakes the maps of `low` from `high`; the normal map is `output`, a PNG. A low poly of several materials gives a
 * file each: NAME.MATERIAL.png. All files appear at once or not at all. Errors: MISSING_ATTRIBUTE (a low poly
 * without UVs), INVALID_OPTION, OUT_OF_MEMORY; rays that meet nothing are findings. Also CANNOT_READ, INVALID_FILE,
 * UNSUPPORTED_FILE (also a build that writes no PNG), FORBIDDEN_PATH, TOO_LARGE, CANNOT_WRITE.
 * In C: options of `tspace bake`, report tspace.bake/1. tspace_Error.element says which file it is about: 0 is the
 * low poly, 1 the high poly, 2 the cage, 4 the image of skew. */
tspace_ErrorCode tspace_bakeFile(const char* low, const char* high, const char* output, const char* options,
                                 tspace_Bytes* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Reads `input` (any format), and writes `output`, a GLB. Right normals and tangents stay; where nothing is wrong a
 * GLB is copied byte for byte. Maps stand beside the output, OUT_normal.png, OUT_ao.png and so on, and those that
 * glTF has a place for in it too. All files appear at once or not at all. Errors: those of tspace_generateFile and
 * tspace_bakeFile; tspace_Error.element is 1 where it is about the input, and 0 where about the low poly.
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
