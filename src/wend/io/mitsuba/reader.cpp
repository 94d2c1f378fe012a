#include <wend/io/mitsuba/reader.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/document.h>
#include <wend/io/mitsuba/emitters.h>
#include <wend/io/mitsuba/sensor.h>
#include <wend/io/mitsuba/shapes.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace wend::mitsuba {
namespace {

/// In place of "no sensor".
void refuse_sensors_of_shapes(const Object& scene) {
    for (const Element* shape : scene.nested("shape")) {
        for (const Element* sensor : Object(scene.context(), *shape).nested("sensor")) {
            throw InputError(sensor->place,
                             "a sensor on a shape is not implemented: put a <sensor> into the scene, such "
                             "as a \"radiancemeter\" for one ray");
        }
    }
}

/// Whether rays cannot meet it.
bool is_point(const Element* emitter) {
    constexpr std::string_view types[] = {"directional", "point", "projector", "spot"};
    return std::find(std::begin(types), std::end(types), emitter->attribute("type")) != std::end(types);
}

pbrt::Description translate(const Document& document, const std::string& name) {
    pbrt::DescriptionBuilder builder(document.base_directory);
    Context context{document, builder};
    Media media(context);
    Textures textures(context);
    Materials materials(context, textures);
    Shapes shapes(context, materials, media);
    const Object scene(context, *document.root);
    const std::vector<const Element*> sensors = scene.nested("sensor");
    if (sensors.empty()) {
        refuse_sensors_of_shapes(scene);
        throw InputError(scene.place(), "the scene has no <sensor>");
    }
    if (sensors.size() > 1) {
        context.warn(sensors[1]->place, "the scene has several sensors: the first one is taken");
    }
    const std::vector<const Element*> emitters = scene.nested("emitter");
    materials.set_integrator(add_integrator(context, scene.nested_one("integrator")),
                             std::any_of(emitters.begin(), emitters.end(), is_point));
    add_sensor(context, media, *sensors.front(), std::filesystem::path(name).stem().string() + ".exr");
    builder.world_begin(scene.place());
    for (const Element* emitter : emitters) {
        add_emitter(context, *emitter);
    }
    for (const Element* shape : scene.nested("shape")) {
        shapes.add(*shape);
    }
    // What others refer to.
    for (const char* tag : {"bsdf", "medium", "phase", "spectrum", "texture", "volume"}) {
        static_cast<void>(scene.nested(tag));
    }
    scene.warn_of_unused();
    pbrt::Description description = builder.finish(scene.place());
    description.files = document.files;
    description.files.insert(description.files.end(), context.files.begin(), context.files.end());
    return description;
}

}  // namespace

pbrt::Description read_scene(const std::filesystem::path& file) {
    return translate(read_document(file), file.string());
}

pbrt::Description read_scene(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                             bool allow_includes) {
    return translate(read_document(text, folder, name, allow_includes), name);
}

}  // namespace wend::mitsuba
