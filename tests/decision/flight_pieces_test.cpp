// Flights that follow an estimate of what lies ahead: what is drawn has the density that is claimed, that density is
// one, and with a true estimate nothing is left to chance.
#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/decision/flight_pieces.h>
#include <wend/numeric/quadrature.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace wend {
namespace {

/// Of about 60 tests in this file, all true ones are passed in 994 runs of 1000.
constexpr double passing = 1e-4;

struct Stretch {
    float t_out, in_scattered;
};

/// A light beside the ray along +x, close to a piece.
struct Lamp {
    std::size_t piece;
    float x, y;
    float strength;
};

/// A lamp whose beam the ray crosses.
struct Crossed {
    float t_in, t_out, x, y;
    float strength;
};

struct Coefficients {
    Rgb extinction, scattering, channels;
};

struct Case {
    const char* name;
    Coefficients coefficients;
    std::vector<Stretch> stretches;
    float ahead;
    bool level = false;
    std::vector<Lamp> lamps{};
    std::vector<Crossed> beams{};

    float length() const { return stretches.back().t_out; }

    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

const Coefficients grey{Rgb(0.8f), Rgb(0.5f), Rgb(1.0f / 3)};
const Coefficients chromatic{{0.3f, 0.8f, 2.5f}, {0.3f, 0.5f, 1.5f}, {0.2f, 0.5f, 0.3f}};
const Coefficients one_channel{{0.3f, 0.8f, 2.5f}, {0.3f, 0.5f, 1.5f}, {0, 1, 0}};
const Coefficients with_clear_channel{{0, 0.8f, 2.5f}, {0, 0.5f, 1.5f}, {0.2f, 0.5f, 0.3f}};

/// Bright and dark.
const std::vector<Stretch> uneven = {{0.5f, 1}, {0.9f, 0}, {1, 40}, {2, 3}, {2.7f, 0}, {4, 0.1f}};

std::vector<Stretch> many(int count, float length) {
    std::vector<Stretch> result;
    for (int i = 0; i < count; ++i) {
        const float t = length * static_cast<float>(i + 1) / static_cast<float>(count);
        result.push_back({t, static_cast<float>(1 + i % 7)});
    }
    return result;
}

/// The last one reaches on beyond any scene.
std::vector<Stretch> open_ended(std::vector<Stretch> stretches) {
    stretches.back().t_out = 1e30f;
    return stretches;
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"grey", grey, uneven, 2},
        {"grey, level", grey, uneven, 2, true},
        {"chromatic", chromatic, uneven, 2},
        {"chromatic, level", chromatic, uneven, 2, true},
        {"one channel", one_channel, uneven, 2},
        {"clear channel", with_clear_channel, uneven, 0.5f},
        {"clear channel, level", with_clear_channel, uneven, 0.5f, true},
        {"clear channel, open-ended", with_clear_channel, open_ended(uneven), 0.5f},
        {"dark end", chromatic, uneven, 0},
        {"dark pieces", chromatic, {{2, 0}}, 1},
        {"dark pieces, level", chromatic, {{2, 0}}, 1, true},
        {"open-ended", grey, open_ended(uneven), 2},
        {"chromatic, open-ended", chromatic, open_ended(uneven), 2},
        {"chromatic, open-ended, level", chromatic, open_ended(uneven), 2, true},
        {"many", chromatic, many(120, 4), 2},
        {"too many", chromatic, many(500, 4), 2},
        {"too many, open-ended", grey, open_ended(many(300, 4)), 2},
        {"deep", grey, many(100, 400), 5},
        {"deep, chromatic", chromatic, many(100, 400), 5},
        {"deep, open-ended", grey, open_ended(many(100, 400)), 5},
        {"deep from the start", {Rgb(1e4f), Rgb(5e3f), Rgb(1.0f / 3)}, {{1, 2}, {2, 3}}, 5},
        {"behind a dark deep piece", grey, {{12, 0}, {13, 3e4f}}, 5},
        {"thin", grey, many(100, 4e-4f), 0},
        {"very thin", grey, many(100, 4e-6f), 0},
        {"very thin, level", grey, many(100, 4e-6f), 0, true},
        {"very thin, chromatic", chromatic, many(100, 4e-6f), 0},
        {"lamp", grey, uneven, 2, false, {{0, 0.3f, 0.1f, 0.2f}}},
        {"lamp, chromatic", chromatic, uneven, 2, false, {{3, 1.5f, 0.1f, 1}}},
        {"lamp, level", chromatic, uneven, 2, true, {{3, 1.5f, 0.1f, 1}}},
        {"lamps, dark pieces", chromatic, {{1, 0}, {2, 0}}, 0, false, {{0, 1.1f, 0.3f, 2}, {1, 1.1f, 0.3f, 1}}},
        {"beam", grey, uneven, 2, false, {}, {{0.9f, 2.7f, 1.2f, 0.3f, 0.4f}}},
        {"beam, level", chromatic, uneven, 2, true, {}, {{0.9f, 2.7f, 1.2f, 0.3f, 0.4f}}},
        {"beams, lamp", chromatic, uneven, 2, false, {{3, 1.5f, 0.1f, 1}}, {{0.9f, 2, 1, 0.3f, 2}, {1, 4, 5, 1, 30}}},
        {"beam, dark pieces", grey, {{1, 0}, {2, 0.01f}}, 1, false, {}, {{0, 2, 1, 0.3f, 5}}},
        {"lamp in the last piece", with_clear_channel, uneven, 0.5f, false, {{5, 2.9f, 0.1f, 3}}},
    };
    return all;
}

FlightPieces pieces_of(const Case& c) {
    FlightPieces pieces(c.coefficients.extinction, c.coefficients.scattering, c.coefficients.channels);
    for (const Crossed& beam : c.beams) {
        pieces.add_beam(
            Equiangular(ClosestApproach({{0, 0, 0}, {1, 0, 0}}, {beam.x, beam.y, 0}, 0), beam.t_in, beam.t_out),
            beam.strength);
    }
    float t_in = 0;
    for (std::size_t i = 0; i < c.stretches.size(); ++i) {
        const Stretch& s = c.stretches[i];
        for (const Lamp& lamp : c.lamps) {
            if (lamp.piece == i) {
                pieces.add_near(
                    Equiangular(ClosestApproach({{0, 0, 0}, {1, 0, 0}}, {lamp.x, lamp.y, 0}, 0), t_in, s.t_out),
                    lamp.strength);
            }
        }
        if (!pieces.add(s.t_out, s.in_scattered)) {
            break;
        }
        t_in = s.t_out;
    }
    pieces.finish(c.length(), c.ahead, c.level);
    return pieces;
}

/// Probabilities of collisions between increasing distances, by quadrature of the claimed density. Intervals grow
/// from the beginning of each piece, where a deep one has all its collisions.
struct Claimed {
    std::vector<float> ends;
    std::vector<double> probabilities;
    double end = 0;
    double total = 0;

    Claimed(const Case& c, double share) {
        static const Quadrature rule = gauss_legendre(12);
        const FlightPieces pieces = pieces_of(c);
        const auto density = [&](double t) {
            return static_cast<double>(pieces.collision(static_cast<float>(t), static_cast<float>(share)).density);
        };
        const int parts = c.lamps.empty() && c.beams.empty() ? 1 : 32;
        const auto add = [&](double from, double to) {
            double sum = 0;
            for (int part = 0; part < parts; ++part) {
                for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                    sum += rule.weights[i] / parts * density(from + (to - from) * (part + rule.nodes[i]) / parts);
                }
            }
            ends.push_back(static_cast<float>(to));
            probabilities.push_back(sum * (to - from));
            total += probabilities.back();
        };
        double t = 0;
        for (const Stretch& s : c.stretches) {
            // What is further away than this gets no light.
            const double reach = std::min(s.t_out - t, 1e4), begin = t;
            for (int k = 40; k >= 0; --k) {
                const double next = begin + std::ldexp(reach, -k);
                if (static_cast<float>(next) > static_cast<float>(t)) {
                    add(t, next);
                    t = next;
                }
            }
            t = s.t_out;
        }
        end = pieces.end(static_cast<float>(share)).density;
        total += end;
    }
};

double p_value_of(const Case& drawn, float share, const Claimed& claimed, int samples, std::uint64_t seed) {
    const FlightPieces pieces = pieces_of(drawn);
    std::vector<std::uint64_t> observed(claimed.ends.size() + 1);
    Pcg32 random(seed);
    for (int i = 0; i < samples; ++i) {
        const FlightPieces::Outcome outcome = pieces.sample(share, random.uniform());
        const auto place = std::upper_bound(claimed.ends.begin(), claimed.ends.end(), outcome.distance);
        const auto index = static_cast<std::size_t>(place - claimed.ends.begin());
        ++observed[outcome.scatters ? std::min(index, claimed.ends.size() - 1) : claimed.ends.size()];
    }
    std::vector<double> expected = claimed.probabilities;
    expected.push_back(claimed.end);
    for (double& e : expected) {
        e *= samples / claimed.total;
    }
    return chi_square_test(observed, expected).p_value;
}

TEST(FlightPieces, TheDensityIsOneInTotal) {
    for (const Case& c : cases()) {
        for (const float share : {1.0f, 0.3f, 0.001f, 0.0f}) {
            EXPECT_NEAR(Claimed(c, share).total, 1, 1e-4) << c.name << ", share " << share;
        }
    }
}

TEST(FlightPieces, SamplesHaveTheDensity) {
    std::uint64_t seed = 0;
    for (const Case& c : cases()) {
        for (const float share : {1.0f, 0.3f, 0.0f}) {
            const Claimed claimed(c, share);
            if (claimed.end > 0.9999) {
                continue;  // nothing to count
            }
            EXPECT_GT(p_value_of(c, share, claimed, 200000, ++seed), passing) << c.name << ", share " << share;
        }
    }
}

TEST(FlightPieces, AnotherDensityIsRejected) {
    const Case drawn{"", chromatic, uneven, 2};
    Case other = drawn;
    other.stretches[0].in_scattered *= 1.06f;
    EXPECT_LT(p_value_of(drawn, 0, Claimed(other, 0), 200000, 1), test::failing);
    other = drawn;
    other.ahead *= 1.06f;
    EXPECT_LT(p_value_of(drawn, 0, Claimed(other, 0), 200000, 2), test::failing);
    EXPECT_LT(p_value_of(drawn, 0.3f, Claimed(drawn, 0.33f), 200000, 3), test::failing);
    EXPECT_LT(p_value_of({"", grey, uneven, 2}, 1, Claimed({"", chromatic, uneven, 2}, 1), 200000, 4), test::failing);
}

TEST(FlightPieces, SamplesTellTheirDensity) {
    Pcg32 random(1);
    for (const Case& c : cases()) {
        const FlightPieces pieces = pieces_of(c);
        for (const float share : {1.0f, 0.3f, 0.0f}) {
            SCOPED_TRACE(c.name);
            for (int i = 0; i < 2000; ++i) {
                const FlightPieces::Outcome drawn = pieces.sample(share, random.uniform());
                ASSERT_TRUE(std::isfinite(drawn.density) && std::isfinite(drawn.classical));
                if (!drawn.scatters) {
                    const FlightPieces::Outcome end = pieces.end(share);
                    ASSERT_EQ(drawn.distance, c.length());
                    ASSERT_EQ(drawn.density, end.density);
                    ASSERT_EQ(drawn.classical, end.classical);
                    continue;
                }
                // A distance is a float: at the edge of a piece it may round into the next one.
                const bool at_edge = std::any_of(c.stretches.begin(), c.stretches.end(),
                                                 [&](const Stretch& s) { return s.t_out == drawn.distance; });
                const FlightPieces::Outcome there = pieces.collision(drawn.distance, share);
                ASSERT_TRUE(at_edge || drawn.density == there.density) << drawn.distance;
                ASSERT_EQ(drawn.classical, there.classical) << drawn.distance;
            }
        }
    }
}

/// Without a classical share all flights have the same weight times what they are to find.
void expect_no_variance(const Case& c, int channel) {
    const FlightPieces pieces = pieces_of(c);
    const double sigma = c.coefficients.extinction[channel], scattering = c.coefficients.scattering[channel];
    const auto passed = [&](double t) { return std::exp(-sigma * t); };
    double from = 0, total = c.ahead * passed(c.length());
    for (const Stretch& s : c.stretches) {
        total += s.in_scattered * scattering / sigma * (passed(from) - passed(s.t_out));
        from = s.t_out;
    }
    Pcg32 random(2);
    for (int i = 0; i < 20000; ++i) {
        const FlightPieces::Outcome drawn = pieces.sample(0, random.uniform());
        double found = c.ahead * passed(drawn.distance);
        if (drawn.scatters) {
            const auto there = std::find_if(c.stretches.begin(), c.stretches.end(),
                                            [&](const Stretch& s) { return drawn.distance <= s.t_out; });
            ASSERT_NE(there, c.stretches.end());
            if (drawn.distance == there->t_out ||
                (there != c.stretches.begin() && drawn.distance == (there - 1)->t_out)) {
                continue;  // rounded to an edge
            }
            found = scattering * there->in_scattered * passed(drawn.distance);
        }
        ASSERT_NEAR(found / drawn.density, total, 3e-4 * total) << drawn.distance << ' ' << drawn.scatters;
    }
}

TEST(FlightPieces, ATrueEstimateLeavesNoVariance) {
    expect_no_variance({"", grey, uneven, 2}, 0);
    expect_no_variance({"", one_channel, uneven, 2}, 1);
    expect_no_variance({"", grey, open_ended(uneven), 2}, 2);
    expect_no_variance({"", grey, many(120, 4), 0.1f}, 2);
}

TEST(FlightPieces, TowardsALampWeightsStayWithinWhatPassesOnTheWay) {
    // Where a lamp is all the light there is, transmittance is what the density does not follow.
    const Case c{"", grey, {{0.5f, 0}}, 0, false, {{0, 0.3f, 0.01f, 1}}};
    const FlightPieces pieces = pieces_of(c);
    Pcg32 random(4);
    float least = std::numeric_limits<float>::infinity(), most = 0;
    for (int i = 0; i < 20000; ++i) {
        const FlightPieces::Outcome drawn = pieces.sample(0, random.uniform());
        ASSERT_TRUE(drawn.scatters);
        const float square = sqr(drawn.distance - 0.3f) + sqr(0.01f);
        const float weight = std::exp(-grey.extinction.r * drawn.distance) / (square * drawn.density);
        least = std::min(least, weight);
        most = std::max(most, weight);
    }
    EXPECT_LT(most / least, std::exp(grey.extinction.r * 0.5f) * 1.01f);
}

TEST(FlightPieces, ThereIsRoomForAFewLamps) {
    FlightPieces pieces(grey.extinction, grey.scattering, grey.channels);
    int lamps = 0;
    for (; pieces.has_room_for_near(); ++lamps) {
        const auto t = static_cast<float>(lamps);
        pieces.add_near(Equiangular(ClosestApproach({{0, 0, 0}, {1, 0, 0}}, {t, 0.1f, 0}, 0), t, t + 1), 1);
        pieces.add(t + 1, 0);
    }
    EXPECT_GE(lamps, 4);
    EXPECT_LE(lamps, 64);
}

TEST(FlightPieces, AFalseEstimateLeavesSome) {
    const FlightPieces pieces = pieces_of({"", grey, {{1, 1}, {2, 1.01f}}, 1});
    const auto weight = [&](float t) {
        const FlightPieces::Outcome o = pieces.collision(t, 0);
        return std::exp(-grey.extinction.r * t) / o.density;
    };
    EXPECT_NEAR(weight(0.5f) / weight(1.5f), 1.01f, 1e-4f);
}

TEST(FlightPieces, LevelChoosesOnlyWhetherToScatter) {
    for (const Coefficients& coefficients : {grey, one_channel}) {
        const Case uneven_light{"", coefficients, uneven, 2, false};
        Case levelled = uneven_light;
        levelled.level = true;
        const FlightPieces pieces = pieces_of(levelled);
        const FlightPieces::Outcome first = pieces.collision(0.1f, 0);
        for (const float t : {0.6f, 0.95f, 1.7f, 3.4f}) {
            const FlightPieces::Outcome o = pieces.collision(t, 0);
            EXPECT_NEAR(o.density / o.classical, first.density / first.classical, 1e-5f) << t;
        }
        EXPECT_NEAR(pieces.end(0).density, pieces_of(uneven_light).end(0).density, 1e-6f);
    }
}

TEST(FlightPieces, AFullClassicalShareNeedsNoLight) {
    const FlightPieces dark = pieces_of({"", chromatic, {{2, 0}}, 0});
    EXPECT_FALSE(dark.is_lit());
    EXPECT_TRUE(pieces_of({"", chromatic, {{2, 0}}, 1}).is_lit());
    EXPECT_TRUE(pieces_of({"", chromatic, {{2, 1}}, 0}).is_lit());
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const FlightPieces::Outcome o = dark.sample(1, random.uniform());
        EXPECT_EQ(o.density, o.classical);
        EXPECT_GT(o.density, 0);
    }
}

}  // namespace
}  // namespace wend
