// Feeds arbitrary bytes to what restores a render: the state in a checkpoint whose checksum fits.
#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/render/render.h>

#include <cstdint>
#include <string_view>

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::Scene scene(lit_floor());
    wend::Film film({4, 4}, {{0, 0}, {4, 4}});
    wend::Render render(scene, film, settings());
    try {
        wend::ArchiveReader bytes({reinterpret_cast<const char*>(data), size});
        render.restore(bytes);
        render.progress();
        film.picture();
    } catch (const wend::InputError&) {
    }
    return 0;
}
