// Feeds arbitrary bytes to what unpacks files.
#include "memory_file.h"

#include <wend/core/error.h>
#include <wend/io/gzip.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    try {
        wend::read_file(file.filled_with(data, size));
    } catch (const wend::InputError&) {
    }
    return 0;
}
