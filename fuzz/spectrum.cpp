// Feeds arbitrary text to the reader of measured spectra, by a scene that names the file.
#include "memory_file.h"

#include <wend/core/error.h>
#include <wend/io/load/load_scene.h>
#include <wend/io/pbrt/parser.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    const std::string scene = "Camera \"perspective\"\nWorldBegin\nMaterial \"diffuse\" \"spectrum reflectance\" [ \"" +
                              file.filled_with(data, size).string() + "\" ]\n";
    try {
        wend::load_scene(wend::pbrt::parse_string(scene, {}, "fuzz.pbrt", {.allow_includes = false}));
    } catch (const wend::InputError&) {
    }
    return 0;
}
