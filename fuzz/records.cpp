// Feeds arbitrary bytes to what reads samples of records.
#include "sealed.h"

#include <wend/guide/record_sample.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        wend::guide::record_sample_from_bytes(wend::fuzz::sealed(data, size));
    } catch (const wend::InputError&) {
    }
    return 0;
}
