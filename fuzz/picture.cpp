// Feeds arbitrary bytes to the readers of pictures, each of which knows its own by their first bytes.
#include "memory_file.h"

#include <wend/core/error.h>
#include <wend/io/image_file.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    try {
        wend::read_image(file.filled_with(data, size));
    } catch (const wend::InputError&) {
    }
    return 0;
}
