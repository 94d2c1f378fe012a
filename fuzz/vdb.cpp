// Feeds arbitrary bytes to the check of OpenVDB files and, behind it, to their library.
#include "memory_file.h"

#include <wend/core/error.h>
#include <wend/io/volume_file.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    try {
        wend::try_read_volume(file.filled_with(data, size), "density");
    } catch (const wend::InputError&) {
    }
    return 0;
}
