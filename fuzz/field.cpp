// Feeds arbitrary bytes to what reads guiding fields.
#include "sealed.h"

#include <wend/guide/field.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        wend::guide::field_from_bytes(wend::fuzz::sealed(data, size));
    } catch (const wend::InputError&) {
    }
    return 0;
}
