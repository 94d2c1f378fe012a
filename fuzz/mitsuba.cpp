// Feeds arbitrary text to the reader of Mitsuba scenes: it may refuse it with an InputError, and do nothing else
// unusual.
#include <wend/core/error.h>
#include <wend/io/mitsuba/reader.h>

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        wend::mitsuba::read_scene(std::string(reinterpret_cast<const char*>(data), size), {}, "fuzz.xml", false);
    } catch (const wend::InputError&) {
    }
    return 0;
}
