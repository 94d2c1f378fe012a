// Wend's renderer inside a program of yours: a scene is loaded, rendered pass by pass, looked at, and written.
#include <wend/render.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: render SCENE.pbrt PICTURE.exr\n");
        return 2;
    }
    try {
        const auto scene = wend::renderer::Scene::load(argv[1], {.resolution = "160x90", .crop = {}, .sampler = {}});
        for (const std::string& warning : scene.warnings()) {
            std::fprintf(stderr, "%s\n", warning.c_str());
        }
        wend::renderer::Render render(scene, {.samples = 16, .passes = {}, .subsurface = "auto"});
        // A step ends at the end of a pass, at the latest. In between the film may be looked at, and the render saved.
        bool goes_on = true;
        while (goes_on) {
            goes_on = render.step();
            const wend::renderer::Progress progress = render.progress();
            std::printf("%3.0f %%, %d samples per pixel, noise %.1f %%\n", 100 * progress.fraction, progress.samples,
                        100 * progress.relative_noise);
        }
        const wend::renderer::Film film = render.film();
        double sum = 0;
        for (const float value : film.layers.at("").values) {
            sum += static_cast<double>(value);
        }
        std::printf("%d x %d pixels, mean %.4f\n", film.width, film.height, sum / (3.0 * film.width * film.height));
        film.save(argv[2]);
        return 0;
    } catch (const wend::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
