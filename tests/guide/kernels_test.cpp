#include <tests/support/vector_targets.h>
#include <wend/core/random.h>
#include <wend/guide/kernels.h>
#include <wend/sampling/vmf.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

namespace wend::guide {
namespace {

MixtureLanes random_mixture(int lobes, Pcg32& random) {
    MixtureLanes mixture(lobes);
    for (int i = 0; i < lobes; ++i) {
        const Vec3 mean = Vmf{}.sample(random.uniform2());
        mixture.mean_x[i] = mean.x;
        mixture.mean_y[i] = mean.y;
        mixture.mean_z[i] = mean.z;
        mixture.kappa[i] = i % 5 == 4 ? 0.0f : std::exp(10 * random.uniform() - 1);
        mixture.weight[i] = random.uniform();
        mixture.amplitude[i] = mixture.weight[i] * vmf_peak(mixture.kappa[i]);
    }
    return mixture;
}

std::array<AxialLobes, 4> scatterers() {
    return {AxialLobes::cosine(), AxialLobes(std::array{AxialLobe{1, -2.0f}}),
            AxialLobes(std::array{AxialLobe{2, 30}, AxialLobe{1, -1.5f}}),
            AxialLobes(std::array{AxialLobe{1, 0.5f}, AxialLobe{1, 4}, AxialLobe{1, 40}, AxialLobe{1, 300}})};
}

/// The bits of what the kernels answer.
class Answers {
public:
    void add(float x) { bits_.push_back(std::bit_cast<std::uint32_t>(x)); }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(const Lanes& lanes, int size) {
        for (int i = 0; i < size; ++i) {
            add(lanes[i]);
        }
    }
    void add(const MixtureLanes& mixture) {
        for (const Lanes* lanes :
             {&mixture.mean_x, &mixture.mean_y, &mixture.mean_z, &mixture.kappa, &mixture.amplitude}) {
            add(*lanes, mixture.size);
        }
    }
    void add(const SumLanes& s, int size) {
        for (const Lanes* lanes : {&s.weight, &s.weight_square, &s.x, &s.y, &s.z, &s.offset_x, &s.offset_y, &s.offset_z,
                                   &s.inverse_distance, &s.inverse_distance_square, &s.turn, &s.spread, &s.straight,
                                   &s.oblique, &s.beyond_square, &s.red, &s.blue}) {
            add(*lanes, size);
        }
    }

    const std::vector<std::uint32_t>& bits() const { return bits_; }

private:
    std::vector<std::uint32_t> bits_;
};

void ask_product(const Kernels& kernels, const ProductLanes& product, Pcg32& random, Answers& answers) {
    answers.add(product.mixture);
    answers.add(product.integral);
    for (int i = 0; i < 5; ++i) {
        const Vec3 drawn = kernels.product_sample(product, random.uniform2());
        answers.add(drawn);
        answers.add(kernels.product_density(product, drawn));
    }
}

LobeLanes as_lobes(const MixtureLanes& mixture, const Lanes& inverse_distance) {
    LobeLanes lobes{};
    lobes.blocks = mixture.blocks();
    lobes.inverse_distance = inverse_distance;
    for (int i = 0; i < max_lobes; ++i) {
        lobes.log_amplitude[i] = i < mixture.size ? std::log(mixture.amplitude[i] + 1e-20f) : -1e30f;
        lobes.half_kappa[i] = 0.5f * mixture.kappa[i];
    }
    lobes.x = lobes.u_y = lobes.v_z = mixture.mean_x;
    lobes.y = lobes.u_z = lobes.v_x = mixture.mean_y;
    lobes.z = lobes.u_x = lobes.v_y = mixture.mean_z;
    return lobes;
}

std::vector<Observation> random_observations(int count, Pcg32& random) {
    std::vector<Observation> result;
    for (int i = 0; i < count; ++i) {
        const float length = random.uniform();
        result.push_back({.direction = Vmf{}.sample(random.uniform2()),
                          .offset = Vmf{}.sample(random.uniform2()) * length,
                          .inverse_distance = i % 3 == 0 ? 0.0f : random.uniform(),
                          .weight = random.uniform() * 2,
                          .red = random.uniform() * 2,
                          .blue = random.uniform() * 2});
    }
    return result;
}

std::vector<std::uint32_t> answers_of(const Kernels& kernels) {
    Pcg32 random(7);
    Answers answers;
    for (int lobes = 1; lobes <= max_lobes; ++lobes) {
        const MixtureLanes mixture = random_mixture(lobes, random);
        Lanes inverse_distance;
        for (int i = 0; i < lobes; i += 2) {
            inverse_distance[i] = random.uniform();
        }
        // The position of the first lobe's source among others.
        const Vec3 first(mixture.mean_x[0], mixture.mean_y[0], mixture.mean_z[0]);
        for (const Vec3& offset : {Vec3(0.1f, -0.3f, 0.2f), -first * (1 / inverse_distance[0])}) {
            MixtureLanes turned(lobes);
            kernels.turn(mixture, offset, inverse_distance, turned);
            answers.add(turned);
            answers.add(kernels.density(turned, Vmf{}.sample(random.uniform2())));
            for (const AxialLobes& scatterer : scatterers()) {
                const AxialLobes around = scatterer.around(Vmf{}.sample(random.uniform2()));
                ProductLanes product(lobes, around), of_turned(lobes, around);
                kernels.multiply(turned, product);
                kernels.turn_and_multiply(mixture, offset, inverse_distance, of_turned);
                ask_product(kernels, product, random, answers);
                ask_product(kernels, of_turned, random, answers);
            }
        }
        SumLanes sums;
        kernels.add_observations(as_lobes(mixture, inverse_distance), random_observations(101, random), sums);
        answers.add(sums, lobes);
    }
    return answers.bits();
}

TEST(Kernels, ComputeTheSameBitsForEveryTarget) {
    const std::vector<std::uint32_t> best = answers_of(best_kernels());
    std::vector<std::string> targets;
    test::for_each_target([&] {
        const Kernels kernels = best_kernels();
        targets.emplace_back(kernels.target);
        EXPECT_EQ(answers_of(kernels), best);
    });
    EXPECT_EQ(targets.size(), hwy::SupportedAndGeneratedTargets().size());
    EXPECT_EQ(std::unordered_set<std::string>(targets.begin(), targets.end()).size(), targets.size());
    EXPECT_EQ(targets.front(), kernels().target);
}

}  // namespace
}  // namespace wend::guide
