// How a scene that was read is rendered in tests.
#pragma once

#include <wend/io/load/load_scene.h>
#include <wend/render/render.h>

namespace wend::test {

/// How the scene has its paths drawn, by a preset, with so many samples. Colours are radiances: the film's exposure and
/// balance are left out.
inline RenderSettings settings_of(const LoadedScene& loaded, const char* preset, int samples) {
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.sampler = loaded.sampler;
    settings.max_depth = loaded.max_depth;
    settings.filter = loaded.filter;
    return settings;
}

}  // namespace wend::test
