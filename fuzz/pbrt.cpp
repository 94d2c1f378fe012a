// Feeds arbitrary text to the pbrt parser: it may refuse it with an InputError, and do nothing else unusual.
#include <wend/io/pbrt/parser.h>

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        wend::pbrt::parse_string(std::string(reinterpret_cast<const char*>(data), size), {}, "fuzz.pbrt",
                                 {.allow_includes = false});
    } catch (const wend::InputError&) {
    }
    return 0;
}
