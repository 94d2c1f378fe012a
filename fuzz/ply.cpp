// Feeds arbitrary bytes to the reader of meshes: it may refuse them with an InputError, and do nothing else unusual.
#include "memory_file.h"

#include <wend/core/error.h>
#include <wend/io/ply.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    try {
        wend::read_ply(file.filled_with(data, size));
    } catch (const wend::InputError&) {
    }
    return 0;
}
