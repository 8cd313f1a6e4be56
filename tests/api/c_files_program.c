/* SPDX-License-Identifier: MIT */
/* Uses the file API from C with models in memory and reports. argv[1]: a .gltf file that references other files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_api/c_check.h"
#include "tspace/tspace_files.h"

enum { MOST_FILES = 16 };

/* Files in the folder of the model. They are kept in memory until the program ends. */
typedef struct Folder {
    char path[1024];
    uint8_t* bytes[MOST_FILES];
    size_t count;
} Folder;

static uint8_t* readWhole(const char* path, size_t* size) {
    FILE* file = fopen(path, "rb");
    uint8_t* bytes;
    if (file == NULL) return NULL;
    CHECK(fseek(file, 0, SEEK_END) == 0);
    *size = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(*size + 1);
    CHECK(bytes != NULL && fread(bytes, 1, *size, file) == *size);
    fclose(file);
    return bytes;
}

static tspace_ErrorCode findFile(void* user, const char* path, const uint8_t** data, size_t* size) {
    Folder* folder = user;
    char whole[2048];
    if (folder->count == MOST_FILES) return TSPACE_ERROR_TOO_LARGE;
    snprintf(whole, sizeof(whole), "%s/%s", folder->path, path);
    *data = folder->bytes[folder->count] = readWhole(whole, size);
    if (*data == NULL) return TSPACE_ERROR_CANNOT_READ;
    ++folder->count;
    return TSPACE_OK;
}

int main(int argc, char** argv) {
    Folder folder = {"", {NULL}, 0};
    tspace_Model model, made;
    tspace_Bytes output, report;
    tspace_Error error;
    size_t i;
    CHECK(argc == 2 && strrchr(argv[1], '/') != NULL);
    snprintf(folder.path, sizeof(folder.path), "%s", argv[1]);
    *strrchr(folder.path, '/') = '\0';

    TSPACE_INIT(model);
    model.data = readWhole(argv[1], &model.size);
    if (model.data == NULL) {
        printf("there is no %s\n", argv[1]);
        return 77;
    }
    model.name = "model.gltf";
    model.find_file = findFile;
    model.user = &folder;
    CHECK(tspace_generateBytes(&model, "{\"all\": true, \"overwrite\": true, \"method\": \"lengyel\"}", &output,
                               &report, &error) == TSPACE_OK);
    CHECK(error.code == TSPACE_OK && error.message[0] == '\0');
    CHECK(output.size > 12 && memcmp(output.data, "glTF", 4) == 0);
    CHECK(strstr((const char*)report.data, "\"schema\": \"tspace.generate/1\"") != NULL);
    CHECK(strlen((const char*)report.data) == report.size);
    CHECK(folder.count > 0);
    tspace_destroyBytes(&report);
    CHECK(report.data == NULL && report.size == 0);

    /* The result is self-contained, so the next call needs no other files. */
    TSPACE_INIT(made);
    made.data = output.data;
    made.size = output.size;
    CHECK(tspace_checkBytes(&made, NULL, &report, &error) == TSPACE_OK);
    CHECK(strstr((const char*)report.data, "\"exitCode\": 0") != NULL);
    tspace_destroyBytes(&report);
    CHECK(tspace_identifyBytes(&made, "", &report, NULL) == TSPACE_OK);
    CHECK(strstr((const char*)report.data, "\"explanations\": [\n        {\n          \"method\": \"lengyel\"") !=
          NULL);
    tspace_destroyBytes(&report);

    CHECK(tspace_checkBytes(&made, "{\"angel\": 5}", &report, &error) == TSPACE_ERROR_INVALID_OPTION);
    CHECK(strcmp(error.message, "unknown option '--angel'; did you mean '--angle'?") == 0);
    CHECK(report.data == NULL);

    tspace_destroyBytes(&output);
    tspace_destroyBytes(&output);
    tspace_destroyBytes(NULL);
    for (i = 0; i < folder.count; ++i) free(folder.bytes[i]);
    free((void*)model.data);
    return 0;
}
