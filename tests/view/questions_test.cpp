// What the page asks, and what it is answered.
#include <tests/support/scenes.h>

#include <wend/view/page.h>
#include <wend/view/pixel_flight.h>
#include <wend/view/pixel_report.h>
#include <wend/view/questions.h>
#include <wend/view/render_view.h>

#include <gtest/gtest.h>
#include <half.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <numeric>

namespace wend {
namespace {

using Json = nlohmann::json;

constexpr int resolution = 8;

/// A camera 5 in front of fog of unit thickness that begins at z = 0, with a lit wall behind.
SceneDescription foggy(float extinction) {
    SceneDescription s = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 0.1f, resolution);
    const MediumId medium = test::add_homogeneous(s, Rgb(0.1f * extinction), Rgb(0.9f * extinction));
    test::add_box(s, Box3(Vec3(-100, -100, 0), Vec3(100, 100, 1)), test::add_interface(s), medium);
    test::add_parallelogram(s, {-100, -100, 3}, {0, 200, 0}, {200, 0, 0}, test::add_diffuse(s, Rgb(0.5f)));
    test::add_environment(s, Rgb(1.0f));
    return s;
}

/// A picture of 2 by 2 pixels with a layer of numbers and the variance.
ShownPicture small_picture() {
    Picture picture;
    picture.image = Image(2, 2);
    picture.image.pixels = {Rgb(1.0f, 2.0f, 3.0f), Rgb(0.5f), Rgb(0.25f), Rgb(4.0f)};
    picture.full_size = {2, 2};
    picture.layers = {{"depth", {"Z"}, {1, 2, 3, 4}}, {"variance", {"R", "G", "B"}, std::vector<float>(12, 0.04f)}};
    ShownPicture shown;
    shown.name = "small";
    shown.phase = "file";
    shown.size = {2, 2};
    shown.picture = std::make_shared<const Picture>(std::move(picture));
    shown.layers = layer_names(*shown.picture);
    shown.version = 3;
    return shown;
}

Json ask(Board& board, const ViewOffer& offer, const Json& question) {
    const Reply reply = answer(board, offer, question.dump());
    EXPECT_FALSE(reply.is_binary);
    return Json::parse(reply.bytes);
}

struct Halves {
    Json header;
    std::vector<float> values;
};

Halves halves_of(const Reply& reply) {
    EXPECT_TRUE(reply.is_binary);
    std::uint32_t length = 0;
    std::memcpy(&length, reply.bytes.data(), sizeof(length));
    Halves result{Json::parse(reply.bytes.substr(sizeof(length), length)), {}};
    for (std::size_t at = sizeof(length) + length; at < reply.bytes.size(); at += 2) {
        std::uint16_t bits = 0;
        std::memcpy(&bits, reply.bytes.data() + at, sizeof(bits));
        result.values.push_back(imath_half_to_float(bits));
    }
    return result;
}

TEST(Questions, PicturesComeAsHalvesWhereTheyAreNew) {
    Board board;
    board.show(0, small_picture());
    const ViewOffer offer{"small", nullptr, {}};
    const Json question = {{"ask", "picture"}, {"of", 0}, {"layer", "beauty"}, {"have", 0}};
    const Halves beauty = halves_of(answer(board, offer, question.dump()));
    EXPECT_EQ(beauty.header["version"], 3);
    EXPECT_EQ(beauty.header["channels"], 3);
    EXPECT_EQ(beauty.values, (std::vector<float>{1, 2, 3, .5, .5, .5, .25, .25, .25, 4, 4, 4}));
    Json has = question;
    has["have"] = 3;
    EXPECT_TRUE(ask(board, offer, has).is_null());
    EXPECT_TRUE(board.is_wanted(0, 3));
    Json depth = question;
    depth["layer"] = "depth";
    EXPECT_EQ(halves_of(answer(board, offer, depth.dump())).values, (std::vector<float>{1, 2, 3, 4}));
    EXPECT_TRUE(board.wants_layers(0));
    Json noise = question;
    noise["layer"] = "noise";
    const Halves relative = halves_of(answer(board, offer, noise.dump()));
    EXPECT_NEAR(relative.values[1], 0.2f / 0.5f, 1e-3f);
    EXPECT_NEAR(relative.values[2], 0.2f / 0.25f, 1e-3f);
}

TEST(Questions, StateAndValuesAreJson) {
    Board board;
    board.show(0, small_picture());
    const ViewOffer offer{"small", nullptr, {ViewCommand::Kind::save}};
    const Json state = ask(board, offer, {{"ask", "state"}});
    EXPECT_EQ(state["title"], "small");
    EXPECT_EQ(state["can"], Json::array({"save"}));
    EXPECT_EQ(state["pictures"][0]["layers"], Json::array({"beauty", "noise", "depth", "variance"}));
    const Json values = ask(board, offer, {{"ask", "values"}, {"of", 0}, {"x", 1}, {"y", 1}});
    EXPECT_EQ(values["values"]["beauty"], Json::array({4, 4, 4}));
    EXPECT_EQ(values["values"]["depth"], Json::array({4}));
}

TEST(Questions, CommandsAreThoseThatAreOffered) {
    Board board;
    board.show(0, small_picture());
    const ViewOffer offer{"small", nullptr, {ViewCommand::Kind::more_seconds, ViewCommand::Kind::restart}};
    EXPECT_EQ(ask(board, offer, {{"ask", "more_seconds"}, {"seconds", 60}}), Json::object());
    EXPECT_EQ(ask(board, offer, {{"ask", "restart"}, {"of", 0}, {"sampling", "direction"}}), Json::object());
    const std::vector<ViewCommand> posted = board.take();
    ASSERT_EQ(posted.size(), 2u);
    EXPECT_EQ(posted[0].seconds, 60);
    EXPECT_EQ(posted[1].sampling, "direction");
    EXPECT_TRUE(board.take().empty());
    for (int i = 0; i < 1000; ++i) {
        ask(board, offer, {{"ask", "more_seconds"}, {"seconds", 1}});
    }
    EXPECT_LE(board.take().size(), 100u) << "nobody waits for so many";
}

TEST(Questions, WhatCannotBeAnsweredIsAnError) {
    Board board;
    board.show(0, small_picture());
    const ViewOffer offer{"small", nullptr, {ViewCommand::Kind::more_seconds, ViewCommand::Kind::restart}};
    const std::string deep = std::string(8000, '[') + std::string(8000, ']');
    for (const std::string& message :
         {std::string(), std::string("{"), std::string("[]"), std::string("\xff\xfe"), deep, std::string("{}"),
          std::string(R"({"ask": 1})"), std::string(R"({"ask": "fly"})"), std::string(R"({"ask": "save"})"),
          std::string(R"({"ask": "values", "of": 0, "x": 2, "y": 0})"),
          std::string(R"({"ask": "values", "of": 0, "x": -1, "y": 0})"),
          std::string(R"({"ask": "values", "of": 0, "x": 4294967296, "y": 0})"),
          std::string(R"({"ask": "values", "of": 1, "x": 0, "y": 0})"),
          std::string(R"({"ask": "picture", "of": 7, "layer": "beauty", "have": 0})"),
          std::string(R"({"ask": "more_seconds", "seconds": -1})"),
          std::string(R"({"ask": "more_seconds", "seconds": 1e300})"),
          std::string(R"({"ask": "restart", "of": 0, "sampling": "guess"})")}) {
        const Json reply = Json::parse(answer(board, offer, message).bytes);
        EXPECT_TRUE(reply.contains("error")) << message.substr(0, 60);
    }
    EXPECT_TRUE(board.take().empty());
}

TEST(Questions, ThePageNamesFilesThatThereAre) {
    const std::string_view page = view_page.front().text;
    ASSERT_EQ(view_page.front().name, "");
    for (const ServedFile& file : view_page.subspan(1)) {
        bool is_named = page.find(file.name) != std::string_view::npos;
        for (const ServedFile& other : view_page) {
            is_named = is_named || other.text.find("\"./" + std::string(file.name) + "\"") != std::string_view::npos;
        }
        EXPECT_TRUE(is_named) << file.name;
    }
}

TEST(Board, LayersAreWantedAsLongAsSomebodyLooksAtThem) {
    Board board;
    ShownPicture shown = small_picture();
    board.show(0, shown);
    const auto show_next = [&] {
        ++shown.version;
        board.show(0, shown);
    };
    board.want(0, shown.version, false);
    EXPECT_FALSE(board.wants_layers(0));
    board.want(0, shown.version, true);
    for (int i = 0; i < 100; ++i) {
        board.show(0, shown);
        EXPECT_TRUE(board.wants_layers(0)) << "the same version answers nobody";
    }
    for (int i = 0; i < 10; ++i) {
        show_next();
        EXPECT_TRUE(board.wants_layers(0)) << "a slow viewer asks for every second version";
        show_next();
        EXPECT_TRUE(board.wants_layers(0));
        board.want(0, shown.version, true);
    }
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(board.wants_layers(0));
        show_next();
        board.want(0, shown.version, false);
    }
    EXPECT_FALSE(board.wants_layers(0)) << "who still looks looks at the beauty";
    EXPECT_TRUE(board.is_wanted(0, shown.version));
}

TEST(PixelReport, ClassicalFlightsEndAsTheMediumSays) {
    constexpr float extinction = 2;
    const Scene scene(foggy(extinction));
    const Json report = pixel_report(scene, {{resolution / 2, resolution / 2}, {}, nullptr, nullptr});
    EXPECT_TRUE(report["segment"]["in_medium"]);
    EXPECT_EQ(report["segment"]["end"], "interface");
    const float length = report["segment"]["length"];
    EXPECT_NEAR(length, 1, 1e-2f);
    EXPECT_NEAR(report["flight"]["classical"]["scatters"], -std::expm1(-extinction * length), 1e-3);
    const std::vector<int> bins = report["flight"]["classical"]["bins"];
    const int flights = report["flight"]["flights"];
    double before = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const double passed = -std::expm1(-extinction * length * static_cast<double>(i + 1) / bins.size());
        EXPECT_NEAR(bins[i], flights * (passed - before), 2) << i;
        before = passed;
    }
    EXPECT_EQ(report["at"]["part"], "volume");
    EXPECT_TRUE(report["guide"].is_null());
}

TEST(PixelReport, TellsWhatARenderHasLearned) {
    const Scene scene(foggy(2));
    Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
    Board board;
    RenderView view(board, 0, "full");
    RenderSettings settings;
    settings.preset = parse_preset("direction+distance");
    settings.samples = 64;
    settings.keeps_fields = true;
    settings.on_records = [&](std::span<const guide::PathRecords> records) { view.add(records); };
    Render render(scene, film, settings);
    while (render.step()) {
        view.update(render, film, render.progress(), phase_of(render.progress()));
    }
    view.update(render, film, render.progress(), "done");
    const ShownPicture shown = board.picture(0);
    ASSERT_TRUE(shown.fields);
    EXPECT_EQ(shown.curve.size(), render.statistics().passes.size());
    EXPECT_EQ(shown.picture->image.pixels, film.beauty().pixels);
    PixelQuestion question{{resolution / 2, resolution / 2}, 0.25f, shown.fields.get(), shown.records.get()};
    const Json inside = pixel_report(scene, question);
    EXPECT_FLOAT_EQ(inside["at"]["distance"], 0.25f);
    EXPECT_EQ(inside["at"]["part"], "volume");
    EXPECT_TRUE(inside["guide"]["is_inside"]);
    EXPECT_GT(inside["guide"]["records"]["count"], 0);
    EXPECT_FALSE(inside["flight"]["guided"].is_null());
    double weights = 0;
    for (const Json& lobe : inside["guide"]["lobes"]) {
        weights += lobe["weight"].get<double>();
    }
    EXPECT_NEAR(weights, 1, 1e-3);
    // The sky alone shines from in front: there its fluence is known.
    EXPECT_GT(inside["guide"]["fluence"], 1.0);
    EXPECT_LT(inside["guide"]["fluence"], 4 * 3.1416);
    int here = 0;
    for (const Json& cell : inside["cells"]["nearest"]) {
        here += cell["is_here"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(here, 1);

    // It is the flight of `wend field --pixel`.
    Pcg32 random(0);
    const std::optional<PixelFlight> flight = pixel_flight(scene, question.pixel, question.fields, random);
    ASSERT_TRUE(flight);
    ASSERT_TRUE(flight->is_guided);
    double guided = 0, collides = 0;
    for (const FlightPiece& piece : flight->pieces) {
        guided += piece.guided;
        collides += piece.collides;
    }
    EXPECT_NEAR(inside["flight"]["guided"]["scatters"], guided, 1e-12);
    EXPECT_NEAR(inside["flight"]["classical"]["scatters"], collides, 1e-12);
    EXPECT_NEAR(collides, 1 - flight->reaches_end, 1e-6);
    EXPECT_NEAR(flight->length, 8, 1e-2) << "camera to wall";
    EXPECT_GT(std::abs(guided - collides), 0.01) << "the guide knows where the light is";
}

TEST(PixelFlight, GoesOnBehindAnInterface) {
    SceneDescription description = foggy(1);
    const MediumId thick = test::add_homogeneous(description, Rgb(0.0f), Rgb(2.0f));
    test::add_box(description, Box3(Vec3(-100, -100, 1.5f), Vec3(100, 100, 2)), test::add_interface(description),
                  thick);
    const Scene scene(description);
    Pcg32 random(0);
    const std::optional<PixelFlight> flight = pixel_flight(scene, {resolution / 2, resolution / 2}, nullptr, random);
    ASSERT_TRUE(flight);
    EXPECT_FALSE(flight->is_guided);
    EXPECT_NEAR(flight->reaches_end, std::exp(-1 - 0.5 * 2), 1e-2);
    std::vector<double> reached;
    for (const FlightPart& part : flight->parts) {
        double collides = 0;
        for (const FlightPiece& piece : flight->pieces_of(part)) {
            EXPECT_EQ(piece.medium, part.medium);
            collides += piece.collides;
        }
        if (part.pieces > 0) {
            reached.push_back(part.reached);
            EXPECT_NEAR(collides / part.reached, -std::expm1(-1.0), 1e-2) << "both are as thick";
        }
    }
    ASSERT_EQ(reached.size(), 2u);
    EXPECT_EQ(reached[0], 1);
    EXPECT_NEAR(reached[1], std::exp(-1.0), 1e-2);
}

TEST(RenderView, MakesPicturesForThoseWhoLook) {
    const Scene scene(foggy(1));
    Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
    Board board;
    RenderView view(board, 0, "classical");
    RenderSettings settings;
    settings.samples = 4;
    Render render(scene, film, settings);
    bool goes_on = render.step();
    view.update(render, film, render.progress(), "rendering");
    EXPECT_EQ(board.picture(0).version, 0u) << "nobody looks";
    board.want(0, 0, false);
    view.update(render, film, render.progress(), "rendering");
    EXPECT_EQ(board.picture(0).version, 1u);
    EXPECT_TRUE(board.picture(0).picture->layers.empty());
    while (goes_on) {
        goes_on = render.step();
    }
    view.update(render, film, render.progress(), "done");
    EXPECT_EQ(board.picture(0).version, 2u);
    EXPECT_FALSE(board.picture(0).picture->layers.empty());
    view.update(render, film, render.progress(), "done");
    EXPECT_EQ(board.picture(0).version, 2u) << "nothing is new";
}

}  // namespace
}  // namespace wend
