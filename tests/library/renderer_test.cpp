// The renderer as other programs have it: <wend/render.hpp> alone.
#include <tests/support/paths.h>
#include <tests/support/scratch_folder.h>

#include <wend/render.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <string>

namespace {

using wend::InputError;
using wend::renderer::Film;
using wend::renderer::Render;
using wend::renderer::Scene;
using wend::renderer::SceneOverrides;
using wend::renderer::Settings;

// The side of the sky can be seen, and a ball of fog before it.
const std::string ball_of_fog = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" [ 40 ]
Film "rgb" "integer xresolution" [ 24 ] "integer yresolution" [ 16 ] "string filename" "ball.exr"
Sampler "sobol" "integer pixelsamples" [ 8 ]
Integrator "volpath" "integer maxdepth" [ 20 ]
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.6 0.7 ]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ 0.2 0.1 0.1 ] "rgb sigma_s" [ 2 2 2 ]
AttributeBegin
  MediumInterface "fog" ""
  Material "interface"
  Shape "sphere" "float radius" [ 1 ]
AttributeEnd
)";

Scene fog(const SceneOverrides& overrides = {}) {
    return Scene::of_text(ball_of_fog, ".", "ball", overrides);
}

Film rendered(Render render) {
    while (render.step()) {
    }
    return render.film();
}

std::string message_of(const auto& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(RendererLibrary, RendersWhatTheSceneSays) {
    const Scene scene = fog();
    EXPECT_EQ(scene.width(), 24);
    EXPECT_EQ(scene.height(), 16);
    EXPECT_EQ(scene.samples(), 8);
    EXPECT_TRUE(scene.warnings().empty());
    Render render(scene);
    while (render.step()) {
    }
    EXPECT_EQ(render.progress().samples, 8);
    EXPECT_EQ(render.progress().fraction, 1);
    const Film film = render.film();
    ASSERT_EQ(film.width, 24);
    ASSERT_EQ(film.height, 16);
    const Film::Layer& colours = film.layers.at("");
    ASSERT_EQ(colours.values.size(), 24u * 16u * 3u);
    // In the corner nothing is before the sky.
    EXPECT_NEAR(colours.values[0], 0.5f, 1e-5f);
    EXPECT_NEAR(colours.values[2], 0.7f, 1e-5f);
    EXPECT_EQ(film.layers.at("variance").values.size(), colours.values.size());
}

TEST(RendererLibrary, StepsThreadsAndPassesMakeNoDifference) {
    Settings settings;
    settings.samples = 20;
    settings.threads = 1;
    Render whole(fog(), settings);
    while (whole.step()) {
    }
    settings.threads = 2;
    Render in_steps(fog(), settings);
    while (in_steps.step(0.001)) {
    }
    EXPECT_EQ(whole.film().layers.at("").values, in_steps.film().layers.at("").values);
    Settings repeated;
    repeated.passes = whole.passes();
    EXPECT_EQ(rendered(Render(fog(), repeated)).layers.at("").values, whole.film().layers.at("").values);
    settings.seed = 5;
    EXPECT_NE(rendered(Render(fog(), settings)).layers.at("").values, whole.film().layers.at("").values);
}

TEST(RendererLibrary, IsSavedAndResumed) {
    const wend::test::ScratchFolder folder;
    Settings settings;
    settings.samples = 40;
    Render first(fog(), settings);
    first.step();
    first.save(folder.file("a.checkpoint"));
    Render second(fog(), settings);
    second.resume(folder.file("a.checkpoint"));
    while (first.step()) {
    }
    EXPECT_EQ(rendered(std::move(second)).layers.at("").values, first.film().layers.at("").values);
    Render other(fog({.resolution = "12x8", .crop = {}, .max_depth = {}, .sampler = {}}), settings);
    EXPECT_NE(message_of([&] { other.resume(folder.file("a.checkpoint")); }), "no error");
}

TEST(RendererLibrary, AStepThatIsToldToStopEndsWithAPicture) {
    Settings settings;
    settings.samples = 1 << 30;
    Render render(fog(), settings);
    auto steps = std::async(std::launch::async, [&] {
        while (render.step()) {
        }
    });
    while (steps.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout) {
        render.set_stop(true);
    }
    steps.get();
    EXPECT_LT(render.progress().fraction, 1);
    for (const float value : render.film().layers.at("").values) {
        ASSERT_TRUE(std::isfinite(value));
    }
}

TEST(RendererLibrary, FilmsAreWrittenAsTheyAre) {
    const wend::test::ScratchFolder folder;
    Film film = rendered(Render(fog()));
    film.save(folder.file("film.exr"));
    film.save(folder.file("film.png"));
    EXPECT_TRUE(std::filesystem::file_size(folder.file("film.exr")) > 1000);
    EXPECT_NE(message_of([&] { film.save(folder.file("film.bmp")); }), "no error");
    film.layers.at("").values.pop_back();
    EXPECT_NE(message_of([&] { film.save(folder.file("film.exr")); }), "no error");
    EXPECT_NE(message_of([&] { Film().save(folder.file("film.exr")); }), "no error");
}

TEST(RendererLibrary, WhatIsWrongIsNamed) {
    EXPECT_NE(message_of([] { Scene::load("nowhere.pbrt"); }).find("nowhere.pbrt"), std::string::npos);
    EXPECT_NE(message_of([] { Scene::of_text("Shape \"sphere\"\nnonsense", ".", "mine"); }).find("mine:"),
              std::string::npos);
    const Scene scene = fog();
    const auto refused = [&](auto change) {
        Settings settings;
        change(settings);
        return message_of([&] { Render(scene, settings); }) != "no error";
    };
    EXPECT_TRUE(refused([](Settings& s) { s.sampling = "guess"; }));
    EXPECT_TRUE(refused([](Settings& s) { s.subsurface = "guess"; }));
    EXPECT_TRUE(refused([](Settings& s) { s.samples = -1; }));
    EXPECT_TRUE(refused([](Settings& s) { s.seconds = std::nan(""); }));
    EXPECT_TRUE(refused([](Settings& s) { s.noise = -1; }));
    EXPECT_TRUE(refused([](Settings& s) { s.passes = {1, 0}; }));
    EXPECT_TRUE(refused([](Settings& s) { s.threads = -1; }));
    EXPECT_NE(message_of([] { fog({.resolution = "12", .crop = {}, .max_depth = {}, .sampler = {}}); }), "no error");
}

}  // namespace
