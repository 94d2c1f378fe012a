// The library wend::render over the rest of the program.
#include <wend/library/renderer.h>

#include <wend/app/owned_render.h>
#include <wend/io/image_file.h>

#include <algorithm>
#include <span>
#include <utility>

namespace wend::renderer {
namespace {

SceneOptions options_of(const std::string& name, const SceneOverrides& overrides) {
    return {name, overrides.resolution, overrides.crop, overrides.max_depth, overrides.sampler};
}

/// The picture itself, among the layers.
const std::string beauty;

Film film_of(Picture picture) {
    Film film{picture.image.width,         picture.image.height, {},
              std::move(picture.metadata), picture.offset.x,     picture.offset.y,
              picture.full_size.x,         picture.full_size.y};
    const std::vector<Rgb>& pixels = picture.image.pixels;
    Film::Layer& colours = film.layers[beauty];
    colours.channels = {"R", "G", "B"};
    colours.values.reserve(3 * pixels.size());
    for (const Rgb& pixel : pixels) {
        colours.values.insert(colours.values.end(), {pixel.r, pixel.g, pixel.b});
    }
    for (Layer& layer : picture.layers) {
        film.layers[layer.name] = {std::move(layer.channels), std::move(layer.values)};
    }
    return film;
}

/// Throws InputError for a film without pixels, or a layer that has not as many values as it should.
Picture picture_of(const Film& film) {
    if (film.width < 1 || film.height < 1) {
        throw InputError("a film without pixels cannot be written");
    }
    Picture picture{Image(film.width, film.height),
                    {},
                    film.metadata,
                    {film.offset_x, film.offset_y},
                    {film.full_width, film.full_height}};
    for (const auto& [name, layer] : film.layers) {
        if (layer.values.size() != picture.image.pixels.size() * layer.channels.size()) {
            throw InputError("layer \"" + name + "\": its values are not those of as many pixels as the film has");
        }
        if (name == beauty && layer.channels.size() == 3) {
            for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
                picture.image.pixels[i] = {layer.values[3 * i], layer.values[3 * i + 1], layer.values[3 * i + 2]};
            }
        } else {
            picture.layers.push_back({name, layer.channels, layer.values});
        }
    }
    return picture;
}

}  // namespace

Scene Scene::load(const std::filesystem::path& file, const SceneOverrides& overrides) {
    return Scene(ParsedScene::load(options_of(file.string(), overrides)));
}

Scene Scene::of_text(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                     const SceneOverrides& overrides) {
    return Scene(ParsedScene::of_text(text, folder, options_of(name, overrides)));
}

int Scene::width() const {
    return scene_->session().resolution().x;
}

int Scene::height() const {
    return scene_->session().resolution().y;
}

int Scene::samples() const {
    return scene_->session().settings().samples;
}

const std::vector<std::string>& Scene::warnings() const {
    return scene_->session().warnings();
}

void Film::save(const std::filesystem::path& file) const {
    require_writable_picture(file);
    write_picture(file, picture_of(*this));
}

Render::Render(const Scene& scene, const Settings& settings)
    : render_(std::make_unique<OwnedRender>(
          scene.scene_,
          RenderChoices{settings.samples, settings.seconds, settings.noise, settings.passes, settings.sampling,
                        settings.subsurface, nullptr, false, settings.seed, settings.threads, settings.layers})) {
}

Render::Render(Render&& other) noexcept = default;
Render& Render::operator=(Render&& other) noexcept = default;
Render::~Render() = default;

bool Render::step(double seconds) {
    return render_->step(seconds) && !render_->is_stopped();
}

void Render::set_stop(bool stop) {
    render_->set_stop(stop);
}

Progress Render::progress() const {
    const RenderProgress p = render_->progress();
    return {p.fraction, p.seconds, p.seconds_left, p.samples, p.relative_noise};
}

std::vector<int> Render::passes() const {
    return render_->statistics().passes;
}

Film Render::film() const {
    return film_of(render_->picture());
}

void Render::save(const std::filesystem::path& file) const {
    render_->save(file);
}

void Render::resume(const std::filesystem::path& file) {
    render_->resume(file);
}

}  // namespace wend::renderer
