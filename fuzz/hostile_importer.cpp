// SPDX-License-Identifier: MIT
// Simulates an importer that a hostile model controls. The "model" is the importer's script: exit status (1 byte),
// length of the messages (2 bytes, little-endian), the messages, and the result.
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <vector>

int main(int argc, char** argv) {
    std::FILE* const file = argc > 1 ? std::fopen(argv[1], "rb") : nullptr;
    if (file == nullptr) return 2;
    std::vector<unsigned char> bytes;
    for (int byte = 0; (byte = std::fgetc(file)) != EOF;) bytes.push_back(static_cast<unsigned char>(byte));
    std::fclose(file);
    if (bytes.size() < 3) return 0;
    std::size_t messages = bytes[1] + std::size_t{256} * bytes[2];
    if (messages > bytes.size() - 3) messages = bytes.size() - 3;
    std::fwrite(bytes.data() + 3, 1, messages, stderr);
    std::fwrite(bytes.data() + 3 + messages, 1, bytes.size() - 3 - messages, stdout);
    std::fflush(stdout);
    if (bytes[0] == 255) std::abort();
    return bytes[0] % 8 == 7 ? 1 : 0;
}
