// Feeds changed bytes to what restores a render: the state in a checkpoint whose checksum fits.
//
// An input says how far a render of this very build is whose state is changed, and how: so no seed has an old layout.
// Its first byte is how many passes have been rendered; 255 is none of these, what follows are the bytes themselves.
// Then come changes: where (four bytes), the new byte, and whether all behind it is cut off.
#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/render/render.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

/// A floor under two lamps, in fog.
wend::SceneDescription lit_floor() {
    wend::SceneDescription scene;
    wend::HomogeneousMedium fog;
    fog.absorption = wend::Rgb(0.1f);
    fog.scattering = wend::Rgb(0.3f);
    scene.media.emplace_back(fog);
    scene.camera_medium = 0;
    scene.materials.emplace_back(wend::DiffuseMaterial{scene.textures.add(wend::ConstantTexture{wend::Rgb(0.5f)})});
    for (const float x : {-1.0f, 1.0f}) {
        const wend::Vec3 corner(x, 2, 4);
        scene.lights.push_back(wend::make_triangle_light(corner, corner + wend::Vec3(1, 0, 0),
                                                         corner + wend::Vec3(0, 0, 1), true, wend::Rgb(1.0f), true));
    }
    wend::Surface floor{wend::TriangleMesh{{{-9, -1, 0}, {0, -1, 9}, {9, -1, 0}}, {}, {}, {0, 1, 2}}, 0};
    floor.interior = floor.exterior = 0;
    scene.world_surfaces.push_back(0);
    scene.surfaces.push_back(std::move(floor));
    return scene;
}

wend::RenderSettings settings() {
    wend::RenderSettings settings;
    settings.preset = wend::parse_preset("full");
    settings.samples = 15;
    settings.threads = 1;
    return settings;
}

constexpr std::size_t most_passes = 3;

std::string state_after(const wend::Scene& scene, std::size_t passes) {
    wend::Film film({4, 4}, {{0, 0}, {4, 4}});
    wend::Render render(scene, film, settings());
    for (std::size_t pass = 0; pass < passes; ++pass) {
        render.step();
    }
    wend::ArchiveWriter bytes;
    render.save(bytes);
    return bytes.take();
}

/// What the fuzzer asks for.
std::string state_of(std::span<const std::uint8_t> input, const std::vector<std::string>& states) {
    constexpr std::uint8_t raw = 255;
    if (input.empty() || input[0] == raw) {
        return std::string(input.begin() + (input.empty() ? 0 : 1), input.end());
    }
    std::string state = states[input[0] % states.size()];
    constexpr std::size_t size_of_change = 6;
    for (std::size_t i = 1; i + size_of_change <= input.size() && !state.empty(); i += size_of_change) {
        std::uint32_t place = 0;
        std::memcpy(&place, input.data() + i, sizeof place);
        const std::size_t at = place % state.size();
        state[at] = static_cast<char>(input[i + 4]);
        if (input[i + 5] == 1) {
            state.resize(at + 1);
        }
    }
    return state;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::Scene scene(lit_floor());
    static const std::vector<std::string> states = [] {
        std::vector<std::string> all;
        for (std::size_t passes = 0; passes <= most_passes; ++passes) {
            all.push_back(state_after(scene, passes));
        }
        return all;
    }();
    const std::string state = state_of({data, size}, states);
    wend::Film film({4, 4}, {{0, 0}, {4, 4}});
    wend::Render render(scene, film, settings());
    try {
        wend::ArchiveReader bytes(state);
        render.restore(bytes);
        render.progress();
        film.picture();
    } catch (const wend::InputError&) {
    }
    return 0;
}
