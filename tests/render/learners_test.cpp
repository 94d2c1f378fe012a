// A learner beside those of render(): all that one has to write.
#include <tests/support/scenes.h>

#include <wend/render/learners.h>
#include <wend/transport/path_tracer.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace wend {
namespace {

/// Counts the vertices of walks, all branches of a walk together.
class VertexCounter {
public:
    VertexCounter() = default;
    explicit VertexCounter(std::uint64_t* count) : count_(count) {}

    struct Branch {};
    Branch branch() const { return {}; }
    void resume(const Branch&) {}
    void start() {}
    void finish() {}

    void on(const walk_events::Arrived&) {
        if (count_) {
            ++*count_;
        }
    }

private:
    std::uint64_t* count_ = nullptr;
};

class VertexLearner {
public:
    VertexLearner(const LearningContext&) {}

    static constexpr bool steers = false;
    using Recorder = VertexCounter;
    struct Records {
        std::uint64_t of_walk = 0, vertices = 0;
    };

    void begin(const PassPlan& plan) { records_ = plan.learns; }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool is_recorded) const {
        return Recorder(records_ && is_recorded ? &records.of_walk : nullptr);
    }
    void keep(Records& records, bool is_recorded) const {
        records.vertices += is_recorded ? records.of_walk : 0;
        records.of_walk = 0;
    }
    void learn(std::vector<Records>& all, const PassPlan&) {
        for (const Records& tile : all) {
            vertices_ += tile.vertices;
        }
    }

    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& learner) {
        bytes(learner.vertices_);
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        bytes(records);
    }

    std::uint64_t vertices() const { return vertices_; }

private:
    bool records_ = false;
    std::uint64_t vertices_ = 0;
};

using More = LearnerList<FieldLearner, InteriorLearner, LightLearner, ReflectionLearner, VertexLearner>;

/// A ball of fog over a floor, under a white sky.
SceneDescription fog() {
    SceneDescription s;
    test::add_sphere(s, {0, 0, 0}, 1, test::add_interface(s), test::add_homogeneous(s, Rgb(0.1f), Rgb(2.0f), 0.3f));
    test::add_parallelogram(s, {-5, -1.2f, -5}, {0, 0, 10}, {10, 0, 0}, test::add_diffuse(s, Rgb(0.5f)));
    test::add_environment(s, Rgb(1.0f));
    return s;
}

TEST(Learners, OneMoreIsToldOfEveryVertexAndChangesNothing) {
    const Scene scene(fog());
    const RenderSettings settings;
    More learners(LearningContext{scene, settings, 1});
    PassPlan plan;
    plan.count = 1;
    plan.learns = true;
    TileShares alone(nullptr);
    const ClassicalDecisions decisions;
    const auto& guides = learners.get<InteriorLearner>().guides();
    const auto& lights = learners.get<LightLearner>().selection();
    const auto& reflections = learners.get<ReflectionLearner>().probability();
    const PathTracer<ClassicalDecisions, More::Recorders> tracer(scene, decisions, guides, lights, reflections, 100);
    const PathTracer<ClassicalDecisions> standard(scene, decisions, guides, lights, reflections, 100);
    const Ray ray{{0.2f, 0.1f, -4}, {0, 0, 1}};

    const auto walk = [&](int walks, bool counts) {
        learners.begin(plan);
        std::vector<More::Records> records(2);
        for (int i = 0; i < walks; ++i) {
            Sampler sampler(SamplerKind::independent, 1, 0, static_cast<std::uint32_t>(i)), same = sampler;
            More::Records& tile = records[static_cast<std::size_t>(i % 2)];
            const Rgb radiance = tracer.trace(ray, 0, sampler, learners.recorders(tile, true)).sample.radiance;
            EXPECT_EQ(radiance, standard.trace(ray, 0, same).sample.radiance);
            learners.keep(tile, counts);
        }
        learners.learn(records, plan, alone);
        return learners.get<VertexLearner>().vertices();
    };
    EXPECT_EQ(walk(100, false), 0u) << "walks that do not count";
    const std::uint64_t vertices = walk(2000, true);
    EXPECT_GT(vertices, 2000u);
    EXPECT_EQ(walk(2000, true), 2 * vertices);
    plan.learns = false;
    EXPECT_EQ(walk(2000, true), 2 * vertices) << "a pass that is not recorded";
}

}  // namespace
}  // namespace wend
