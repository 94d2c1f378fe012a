#include <wend/render/guiding_choice.h>

#include <wend/core/random.h>
#include <wend/render/learner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace wend {
namespace {

/// Of the first guided walks, the share of each kind: they cost little where they do not pay, least while all of the
/// render may be a few samples. By fewer walks of a pass than this nothing is known.
constexpr float early_probe_share = 1.0f / 48, probe_share = 1.0f / 12;
constexpr double fewest_probes = 2000;
constexpr int few_samples = 3;
/// Where they seem so many times better, only those are tried that take directions from the fields, which get better.
constexpr double plain = 2.5;
/// What a tile's own walks are weighed against: so many walks of the picture's.
constexpr double walks_of_picture = 4000;
/// Kinds that are close to the best go on being tried.
constexpr double close = 2;
/// Of walks, the share of each; less where its noise would be seen beside that of the best.
constexpr double trial_share = 1.0 / 16, noise_of_trials = 0.02;
/// While the fields learn, every kind that takes directions from them has that share, whatever it has shown: it gets
/// better, a few bright walks by a field that knows little would speak against it for long, and no others bring light
/// to learn from where it is hard to find.
constexpr double learning_share = 1.0 / 8;
/// And it is taken to be as much better as it may become.
constexpr double promise = 4;
/// Later the best of them keeps this much: one that was misjudged is found out.
constexpr double watched_share = 1.0 / 64;
/// What an older field has shown counts so much less with each pass.
constexpr double age = 1.0 / 16;

WalkShares all_of(std::size_t kind) {
    WalkShares shares{};
    shares[kind] = 1;
    return shares;
}

}  // namespace

GuidingChoice::GuidingChoice(const Preset& preset, const Guidable& guidable, bool is_taught, std::size_t tiles,
                             double pixels)
    : pixels_(pixels) {
    const bool dense = guidable.dense_media;
    Preset everywhere = preset;
    everywhere.where_it_pays = everywhere.adaptive = false;
    if (!preset.where_it_pays || pixels < fewest_pixels) {
        kinds_ = {{everywhere, dense}};
    } else {
        const Preset survival{.roulette = preset.roulette, .splitting = preset.splitting};
        Preset directions = survival;
        directions.direction = preset.direction;
        kinds_ = {{Preset(), dense}, {survival, dense}, {directions, dense}};
        if (guidable.flights) {
            kinds_.push_back({everywhere, dense});
        }
    }
    shares_.assign(tiles, all_of(is_taught ? kinds_.size() - 1 : 0));
    tallies_.resize(tiles);
}

std::size_t GuidingChoice::kind_of(const WalkShares& shares, std::uint64_t seed, std::uint64_t pixel, int sample,
                                   int samples) {
    constexpr std::uint64_t purpose = 0x6b696e64;
    const int pairs = (samples + 1) / 2;
    double u = (sample / 2 + Pcg32(hash_of(seed, pixel, purpose)).uniform_double()) / pairs;
    std::size_t kind = 0;
    while (kind + 1 < most_walk_kinds && u >= static_cast<double>(shares[kind])) {
        u -= static_cast<double>(shares[kind++]);
    }
    // By rounding it may be one that has no share.
    while (kind > 0 && shares[kind] == 0) {
        --kind;
    }
    return kind;
}

double GuidingChoice::cost_of_segment(const WalkKind& kind) {
    const Preset& guided = kind.preset;
    return 1 + (guided.guides_survival() ? 0.15 : 0.0) + (guided.direction ? 0.15 : 0.0) +
           (guided.guides_distance() ? 0.2 : 0.0);
}

TallyProducts GuidingChoice::unguided_squares() const {
    std::vector<WalkTallies> of_all(tallies_.size());
    for (std::size_t tile = 0; tile < tallies_.size(); ++tile) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            of_all[tile][0] += tallies_[tile][kind];
        }
        of_all[tile][0].unguided = std::max(of_all[tile][0].unguided, 0.0);
    }
    return {of_all, 1, &WalkTally::unguided};
}

TallyProducts GuidingChoice::squared_errors(const TallyProducts& unguided) const {
    TallyProducts squares = unguided;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        // By its own walks, which share most of their noise.
        squares.kind[kind] = unguided.kind[0] * tally_ratio(tallies_, kind, &WalkTally::square, &WalkTally::unguided);
    }
    const TallyProducts values = products(&WalkTally::value), spreads = products(&WalkTally::spread);
    const double hard = squares.mean_of_tiles(), bright = values.mean_of_tiles(), spread = spreads.mean_of_tiles();
    std::array<double, most_walk_kinds> walks{};
    for (const WalkTallies& tile : tallies_) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            walks[kind] += tile[kind].walks;
        }
    }
    if (!(hard > 0)) {
        return squares;
    }
    // All kinds bring the same in the mean. What one lacks of another, beyond chance, it finds in less than one of its
    // walks, and then all of it at once.
    const TallyProducts shown = squares;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        for (std::size_t other = 0; other < kinds_.size(); ++other) {
            if (walks[kind] == 0 || walks[other] == 0) {
                continue;
            }
            // Less than this part of the light may be chance, too, where a few bright walks bring most of it.
            constexpr double beyond_chance = 4, least_part = 0.2;
            const double lack = bright * (values.kind[other] - values.kind[kind]);
            const double chance =
                std::sqrt(spread * (spreads.kind[other] / walks[other] + spreads.kind[kind] / walks[kind]));
            if (lack > std::max(beyond_chance * chance, least_part * bright * values.kind[other])) {
                squares.kind[kind] = std::max(squares.kind[kind], shown.kind[kind] + walks[kind] * lack * lack / hard);
            }
        }
    }
    return squares;
}

std::array<GuidingChoice::Means, most_walk_kinds> GuidingChoice::means() const {
    const TallyProducts squares = squared_errors(unguided_squares()), work = products(&WalkTally::work);
    double value = 0, walks = 0;
    for (const WalkTallies& tile : tallies_) {
        for (const WalkTally& tally : tile) {
            value += tally.value;
            walks += tally.walks;
        }
    }
    const double scale = value > 0 ? squares.mean_of_tiles() * std::pow(walks / value, 2) : 0.0;
    std::array<Means, most_walk_kinds> means;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        means[kind] = {scale * squares.kind[kind], work.mean_of_tiles() * work.kind[kind]};
    }
    return means;
}

void GuidingChoice::remember(std::span<const WalkTallies> pass, bool learns) {
    for (std::size_t tile = 0; tile < pass.size(); ++tile) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            WalkTally& known = tallies_[tile][kind];
            known = known.scaled(learns && !kinds_[kind].is_classical() ? age : 1.0);
            known += pass[tile][kind];
        }
    }
}

bool GuidingChoice::shows_directed(std::span<const WalkTallies> pass) const {
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        if (kinds_[kind].preset.direction &&
            std::all_of(pass.begin(), pass.end(), [kind](const WalkTallies& tile) { return tile[kind].walks == 0; })) {
            return false;
        }
    }
    return true;
}

float GuidingChoice::probed_share(int samples) const {
    const float share = samples <= few_samples ? early_probe_share : probe_share;
    return static_cast<double>(share) * samples * pixels_ >= fewest_probes ? share : 0.0f;
}

void GuidingChoice::begin_trial(bool of_all) {
    state_ = State::trial;
    if (of_all) {
        // Pixels are known better now: what walks have shown by then would not compare.
        std::fill(tallies_.begin(), tallies_.end(), WalkTallies{});
    }
    WalkShares tried{};
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        tried[kind] = of_all || kinds_[kind].preset.direction ? 1.0f : 0.0f;
    }
    const float all = std::accumulate(tried.begin(), tried.end(), 0.0f);
    for (float& share : tried) {
        share /= all;
    }
    std::fill(shares_.begin(), shares_.end(), tried);
}

bool GuidingChoice::learn(std::span<const WalkTallies> pass, int samples, bool learns) {
    if (kinds_.size() == 1) {
        return false;
    }
    remember(pass, learns);
    if (state_ == State::plain) {
        state_ = State::probe;
        return true;
    }
    const bool shows_directed = this->shows_directed(pass);
    const bool is_open = state_ == State::probe && samples < warm_up_samples;
    if ((state_ == State::trial || is_open) && !shows_directed) {
        return false;
    }
    const TallyProducts unguided = unguided_squares(), squares = squared_errors(unguided),
                        work = products(&WalkTally::work);
    const auto price = [&](std::size_t kind) { return squares.kind[kind] * work.kind[kind]; };
    gain_ = 0;
    for (std::size_t kind = 1; kind < kinds_.size(); ++kind) {
        gain_ = std::max(gain_, price(kind) > 0 ? price(0) / price(kind) : 0.0);
    }
    if (state_ == State::probe) {
        const bool is_plain = shows_directed && gain_ > plain;
        if (is_open && !is_plain) {
            return false;
        }
        begin_trial(!is_plain);
        return true;
    }
    const std::vector<WalkShares> before = shares_;
    state_ = State::chosen;
    for (std::size_t tile = 0; tile < shares_.size(); ++tile) {
        shares_[tile] = chosen_for(tile, unguided, squares, work, learns);
    }
    return shares_ != before;
}

bool GuidingChoice::guides(int samples) const {
    return !kinds_[0].is_classical() || state_ == State::chosen || shares(0, samples)[0] < 1;
}

WalkShares GuidingChoice::shares(std::size_t tile, int samples) const {
    if (state_ == State::trial && samples < static_cast<int>(kinds_.size())) {
        return all_of(0);
    }
    WalkShares shares = shares_[tile];
    if (state_ == State::probe) {
        const float probed = probed_share(samples), others = probed * static_cast<float>(kinds_.size() - 1);
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            shares[kind] = shares[kind] > 0 ? 1 - others : probed;
        }
    }
    return shares;
}

double GuidingChoice::recorded_share(int samples) const {
    if (kinds_.size() == 1) {
        return 1;
    }
    constexpr double at_first = 1.0 / 16, before_trial = 0.3, at_trial = 0.5, least = 0.15, most = 0.5, enough = 6;
    switch (state_) {
        case State::plain:
        case State::probe:
            return samples <= few_samples ? at_first : before_trial;
        case State::trial:
            return at_trial;
        case State::chosen:
            return std::clamp(gain_ / enough, least, most);
    }
    return 1;
}

double GuidingChoice::directed_share(int samples) const {
    double directed = 0;
    for (std::size_t tile = 0; tile < shares_.size(); ++tile) {
        const WalkShares of_tile = shares(tile, samples);
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            directed += kinds_[kind].preset.direction ? static_cast<double>(of_tile[kind]) : 0.0;
        }
    }
    return directed / static_cast<double>(shares_.size());
}

double GuidingChoice::unguided_square(std::size_t tile, const TallyProducts& unguided) const {
    WalkTally shown;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        shown += tallies_[tile][kind];
    }
    return (std::max(shown.unguided, 0.0) + walks_of_picture * unguided.at(tile, 0)) / (shown.walks + walks_of_picture);
}

WalkShares GuidingChoice::chosen_for(std::size_t tile, const TallyProducts& unguided, const TallyProducts& squares,
                                     const TallyProducts& work, bool learns) const {
    std::array<double, most_walk_kinds> variance{}, price{};
    std::size_t best = 0;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        const WalkTally& here = tallies_[tile][kind];
        const double n = here.walks + walks_of_picture;
        const double unguided_here = std::max(here.unguided, 0.0) + walks_of_picture * unguided.at(tile, 0);
        variance[kind] = unguided_here > 0
                             ? unguided_square(tile, unguided) *
                                   (here.square + walks_of_picture * squares.at(tile, kind)) / unguided_here
                             : 0.0;
        // What was not tried is in no measure.
        price[kind] = work.kind[kind] > 0 ? variance[kind] * (here.work + walks_of_picture * work.at(tile, kind)) / n
                                          : std::numeric_limits<double>::infinity();
        if (learns && kinds_[kind].preset.direction) {
            price[kind] /= promise;
        }
        best = price[kind] < price[best] ? kind : best;
    }
    const auto watched =
        static_cast<std::size_t>(std::min_element(price.begin() + 1, price.begin() + kinds_.size()) - price.begin());
    WalkShares shares{};
    float rest = 1;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        if (kind == best) {
            continue;
        }
        const double excess = std::max(0.0, variance[kind] / variance[best] - 1);
        const double unseen = noise_of_trials / excess;
        const double tried = price[kind] < close * price[best] ? std::min(trial_share, unseen)
                             : kind == watched                 ? std::min(watched_share, unseen)
                                                               : 0.0;
        const double taught = learns && kinds_[kind].preset.direction ? learning_share : 0.0;
        shares[kind] = static_cast<float>(std::max(tried, taught));
        rest -= shares[kind];
    }
    shares[best] = rest;
    return shares;
}

}  // namespace wend
