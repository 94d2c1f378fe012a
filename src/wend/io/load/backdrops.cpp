#include <wend/io/load/backdrops.h>

#include <fmt/format.h>

#include <string>
#include <utility>

namespace wend {

BackdropView load_backdrop_view(const pbrt::LightEntity& light) {
    if (light.type != "infinite" && light.type != "distant") {
        return BackdropView::shown;
    }
    const std::string view = light.parameters.get_string("cameraview", "shown");
    if (view != "shown" && view != "hidden" && view != "only") {
        throw InputError(light.parameters.place_of("cameraview"),
                         fmt::format("\"{}\" is no view of a light; known are shown, hidden, only", view));
    }
    return view == "hidden" ? BackdropView::hidden : view == "only" ? BackdropView::only : BackdropView::shown;
}

void add_light(Light light, BackdropView view, SceneDescription& scene) {
    if (view == BackdropView::shown) {
        scene.lights.push_back(std::move(light));
        return;
    }
    Light dark = UniformInfiniteLight{Rgb(0.0f)};
    if (view == BackdropView::only) {
        std::swap(light, dark);
    }
    scene.backdrops.push_back({static_cast<int>(scene.lights.size()), std::move(dark)});
    scene.lights.push_back(std::move(light));
}

}  // namespace wend
