#include <tests/targets/fingerprint.h>
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/serialization.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace wend::test {
namespace {

/// The hash of Fowler, Noll and Vo (FNV-1a, 64 bits).
class Hash {
public:
    void add(std::string_view bytes) {
        for (const char c : bytes) {
            value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
        }
    }
    void add(float number) { add({reinterpret_cast<const char*>(&number), sizeof number}); }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

/// Two coloured lamps and a background, seen from anywhere in a cube, by records of a mixture with a poor guide.
guide::Records records(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    guide::Records result;
    for (int i = 0; i < count; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(u.x, u.y, random.uniform());
        const std::array<guide::WeightedVmf, 3> seen = {{{0.5f, {normalize(Vec3(0.5f, 0.5f, 2) - position), 70}},
                                                         {0.3f, {normalize(Vec3(-2, 0.1f, 0.4f) - position), 400}},
                                                         {0.2f, {Vec3(0, 0, 1), 0}}}};
        const guide::VmfMixture truth(seen);
        const Vec3 w = random.uniform() < 0.5f ? Vmf{}.sample(random.uniform2()) : truth.sample(random.uniform2());
        guide::Record r{};
        r.position = position;
        r.direction = w;
        r.radiance = truth.density(w) * (0.5f + random.uniform());
        r.classical_density = inv_4pi;
        r.guided_density = truth.density(w);
        r.density = 0.5f * (r.classical_density + r.guided_density);
        r.distance = i % 3 == 0 ? std::numeric_limits<float>::infinity() : 1 + random.uniform();
        r.scattered = inv_4pi * r.radiance;
        r.colour = {1, 0.5f + w.x * 0.4f, 0.5f + w.z * 0.4f};
        result.push_back(r);
    }
    return result;
}

std::array<AxialLobes, 3> scatterers() {
    return {AxialLobes(std::array{AxialLobe{1, 2.0f}}), AxialLobes(std::array{AxialLobe{2, 30}, AxialLobe{1, -1.5f}}),
            AxialLobes(std::array{AxialLobe{1, 0.5f}, AxialLobe{1, 4}, AxialLobe{1, 40}, AxialLobe{1, 300}})};
}

}  // namespace

std::uint64_t fingerprint() {
    Hash hash;
    guide::Field field = guide::Field::empty(Box3(Vec3(0), Vec3(1)));
    guide::FitSettings settings;
    settings.leaf_samples = 300;
    for (int pass = 0; pass < 3; ++pass) {
        field = guide::fit(field, records(3000 << pass, static_cast<std::uint64_t>(pass) + 1), settings, 1).field;
        hash.add(guide::to_bytes(field));
    }
    Pcg32 random(9);
    for (int i = 0; i < 2000; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(u.x, u.y, random.uniform());
        const guide::VmfMixture incident = field.find(position)->incident(position);
        const Vec3 w = incident.sample(random.uniform2());
        hash.add(w);
        hash.add(incident.density(w));
        for (const AxialLobes& lobes : scatterers()) {
            const auto product = incident.product(lobes.around(Vmf{}.sample(random.uniform2())));
            const Vec3 drawn = product.sample(random.uniform2());
            hash.add(product.integral());
            hash.add(drawn);
            hash.add(product.density(drawn));
        }
    }
    return hash.value();
}

}  // namespace wend::test
