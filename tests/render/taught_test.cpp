// Renders that begin with what another has learned: its fields and its notes.
#include <tests/support/film_bytes.h>
#include <tests/support/scenes.h>

#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace wend {
namespace {

using test::bytes_of;

/// Fog around a dense block, under two lamps.
Scene foggy_block(float lamp = 2) {
    SceneDescription s = test::scene_with_camera({0, 1.2f, -5}, {0, -0.2f, 0}, 32, 1);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.01f), Rgb(0.1f), 0.4f);
    const MediumId wax = test::add_homogeneous(s, {0.2f, 0.5f, 1.5f}, {15, 14, 12}, 0.3f);
    test::add_box(s, Box3(Vec3(-2, -1, -1.5f), Vec3(2, 1.5f, 1.5f)), test::add_interface(s), fog);
    test::add_box(s, Box3(Vec3(-1.1f, -0.9f, -0.5f), Vec3(-0.1f, 0.6f, 0.5f)), test::add_interface(s), wax, fog);
    const int grey = test::add_diffuse(s, Rgb(0.5f));
    test::add_parallelogram(s, {-4, -1.001f, -4}, {0, 0, 8}, {8, 0, 0}, grey);
    test::add_lamp(s, {-2, lamp, -2}, 1, {9, 4, 2}, grey);
    test::add_lamp(s, {1, 2.5f, 0}, 0.5f, {2, 8, 9}, grey);
    return Scene(std::move(s));
}

// Large enough for all kinds of walks to be tried.
constexpr int taught_side = 40;

Film taught_film(int width = taught_side) {
    return Film({width, taught_side}, {{0, 0}, {width, taught_side}});
}

RenderSettings settings_of(int samples, std::uint64_t seed, std::shared_ptr<const guide::Fields> fields = nullptr) {
    RenderSettings settings;
    settings.preset = parse_preset("full");
    settings.subsurface = parse_subsurface("auto");
    settings.samples = samples;
    settings.seed = seed;
    settings.max_depth = 20;
    settings.fields = std::move(fields);
    return settings;
}

std::string rendered_bytes(const Scene& scene, const RenderSettings& settings, int width = taught_side) {
    Film film = taught_film(width);
    render(scene, film, settings);
    return bytes_of(film);
}

TEST(Taught, NoFieldIsFilledBySoFewSamplesThatNoneFollowsIt) {
    const Scene scene = foggy_block();
    const auto is_filled = [&](int samples, bool keeps_fields) {
        RenderSettings settings = settings_of(samples, 1);
        settings.keeps_fields = keeps_fields;
        Film film = taught_film();
        return render(scene, film, settings).fields->volume.is_trained();
    };
    EXPECT_FALSE(is_filled(4, false));
    EXPECT_TRUE(is_filled(4, true));
    EXPECT_TRUE(is_filled(16, false));
}

class SlowTaught : public testing::Test {
protected:
    static void SetUpTestSuite() {
        RenderSettings settings = settings_of(31, 1);
        settings.keeps_fields = true;
        Film film = taught_film();
        fields_ = render(scene_, film, settings).fields;
    }
    static void TearDownTestSuite() { fields_ = nullptr; }

    std::shared_ptr<const guide::Fields> without_notes() const {
        auto fields = std::make_shared<guide::Fields>(*fields_);
        fields->notes.clear();
        return fields;
    }
    static std::ptrdiff_t kinds_walked(const RenderStatistics& statistics) {
        return std::count_if(statistics.kinds.begin(), statistics.kinds.end(),
                             [](const WalkKindStatistics& kind) { return kind.share > 0; });
    }

    inline static const Scene scene_ = foggy_block();
    inline static std::shared_ptr<const guide::Fields> fields_;
};

TEST_F(SlowTaught, BeginsWhereTheOtherHadFoundGuidingToPay) {
    ASSERT_FALSE(fields_->notes.empty());
    Film film = taught_film(), other = taught_film();
    EXPECT_GT(kinds_walked(render(scene_, film, settings_of(7, 2, fields_))), 1);
    EXPECT_EQ(kinds_walked(render(scene_, other, settings_of(7, 2, without_notes()))), 1);
}

TEST_F(SlowTaught, NotesOfAnotherSceneOrPictureSayNothing) {
    // Another size of the picture: lights and techniques are as they were learned, where guiding pays is not known.
    Film wide = taught_film(taught_side + 1);
    EXPECT_EQ(kinds_walked(render(scene_, wide, settings_of(7, 2, fields_))), 1);
    // Another place of a lamp, which makes the scene larger.
    const Scene other = foggy_block(3);
    EXPECT_TRUE(rendered_bytes(other, settings_of(9, 2, fields_)) ==
                rendered_bytes(other, settings_of(9, 2, without_notes())));
    // Another sampling.
    RenderSettings direction = settings_of(9, 2, fields_), unnoted = settings_of(9, 2, without_notes());
    direction.preset = unnoted.preset = parse_preset("direction");
    direction.subsurface = unnoted.subsurface = parse_subsurface("classical");
    EXPECT_TRUE(rendered_bytes(scene_, direction) == rendered_bytes(scene_, unnoted));
}

TEST_F(SlowTaught, ForeignNotesAreRefused) {
    auto fields = std::make_shared<guide::Fields>(*fields_);
    for (std::size_t size = 1; size < fields_->notes.size(); size += 1 + fields_->notes.size() / 6) {
        fields->notes = fields_->notes.substr(0, size);
        EXPECT_THROW(rendered_bytes(scene_, settings_of(1, 2, fields)), InputError) << size;
    }
    fields->notes = fields_->notes + "x";
    EXPECT_THROW(rendered_bytes(scene_, settings_of(1, 2, fields)), InputError);
}

TEST_F(SlowTaught, IsResumedWithoutTheFields) {
    const std::string expected = rendered_bytes(scene_, settings_of(16, 2, fields_));
    std::string state;
    {
        Film film = taught_film();
        Render render(scene_, film, settings_of(16, 2, fields_));
        for (int pass = 0; pass < 2; ++pass) {
            render.step();
        }
        ArchiveWriter bytes;
        render.save(bytes);
        state = bytes.take();
    }
    Film film = taught_film();
    Render render(scene_, film, settings_of(16, 2));
    ArchiveReader bytes(state);
    render.restore(bytes);
    while (render.step()) {
    }
    EXPECT_TRUE(bytes_of(film) == expected);
}

}  // namespace
}  // namespace wend
