#include <wend/core/random.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/learner.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

/// What a tile's own walks are weighed against: so many walks of the picture's.
constexpr double walks_of_picture = 4000;
/// Kinds whose squared error times work is more than this times that of the best are not tried again.
constexpr double close = 2;
/// Of walks, the share of each kind that is close; less where its noise would be seen beside that of the best.
constexpr double trial_share = 1.0 / 16, noise_of_trials = 0.02;
/// What an older field has shown counts so much less with each pass.
constexpr double age = 0.25;

/// Squared error times work, of one walk.
double price_of(const WalkTally& tally) {
    return tally.walks > 0 ? tally.variance() * tally.work / tally.walks : std::numeric_limits<double>::infinity();
}

WalkShares all_of(std::size_t kind) {
    WalkShares shares{};
    shares[kind] = 1;
    return shares;
}

}  // namespace

WalkTally PixelWalks::tally() const {
    if (!(expected_ > 0) || count_ < 2) {
        return {};
    }
    const double variance = std::max(0.0, squares_ - sum_ * sum_ / count_) / (count_ - 1);
    const auto expected = static_cast<double>(expected_);
    return {count_, count_ * variance / (expected * expected), work_};
}

WalkTally& WalkTally::operator+=(const WalkTally& o) {
    walks += o.walks;
    square += o.square;
    work += o.work;
    return *this;
}

WalkTally WalkTally::scaled(double factor) const {
    return {factor * walks, factor * square, factor * work};
}

GuidingChoice::GuidingChoice(const Preset& preset, const Guidable& guidable, bool is_taught, std::size_t tiles) {
    const bool dense = guidable.dense_media;
    if (!preset.where_it_pays) {
        kinds_ = {{preset, dense}};
    } else {
        const Preset survival{.roulette = preset.roulette, .splitting = preset.splitting};
        Preset directions = survival, flights = preset;
        directions.direction = preset.direction;
        flights.where_it_pays = false;
        kinds_ = {{}};
        if (dense) {
            kinds_.push_back({Preset(), true});
        }
        kinds_.push_back({survival, dense});
        kinds_.push_back({directions, dense});
        if (guidable.flights) {
            kinds_.push_back({flights, dense});
        }
    }
    shares_.assign(tiles, all_of(is_taught ? kinds_.size() - 1 : 0));
    tallies_.resize(tiles);
}

std::size_t GuidingChoice::kind_of(const WalkShares& shares, std::uint64_t seed, std::uint64_t pixel, int sample,
                                   int samples) {
    constexpr std::uint64_t purpose = 0x6b696e64;
    double u = (sample + Pcg32(hash_of(seed, pixel, purpose)).uniform_double()) / samples;
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

WalkTallies GuidingChoice::totals() const {
    WalkTallies sum;
    for (const WalkTallies& tile : tallies_) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            sum[kind] += tile[kind];
        }
    }
    return sum;
}

WalkShares GuidingChoice::mean_shares() const {
    WalkShares mean{};
    for (const WalkShares& shares : shares_) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            mean[kind] += shares[kind] / static_cast<float>(shares_.size());
        }
    }
    return mean;
}

bool GuidingChoice::learn(std::span<const WalkTallies> pass, bool is_warm, bool learns) {
    if (kinds_.size() == 1) {
        return false;
    }
    for (std::size_t tile = 0; tile < pass.size(); ++tile) {
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            WalkTally& known = tallies_[tile][kind];
            known = known.scaled(learns && kind > 0 ? age : 1.0);
            known += pass[tile][kind];
        }
    }
    if (!is_warm) {
        return false;
    }
    const std::vector<WalkShares> before = shares_;
    if (state_ == State::classical) {
        state_ = State::trial;
        WalkShares even{};
        std::fill_n(even.begin(), kinds_.size(), 1 / static_cast<float>(kinds_.size()));
        std::fill(shares_.begin(), shares_.end(), even);
        return true;
    }
    const WalkTallies picture = totals();
    if (std::any_of(picture.begin(), picture.begin() + static_cast<std::ptrdiff_t>(kinds_.size()),
                    [](const WalkTally& tally) { return tally.walks == 0; })) {
        return false;
    }
    state_ = State::chosen;
    gain_ = 0;
    for (std::size_t kind = 1; kind < kinds_.size(); ++kind) {
        gain_ = std::max(gain_, price_of(picture[0]) / price_of(picture[kind]));
    }
    for (std::size_t tile = 0; tile < shares_.size(); ++tile) {
        shares_[tile] = chosen_for(tallies_[tile], picture);
    }
    return shares_ != before;
}

bool GuidingChoice::guides(int samples) const {
    if (kinds_.size() == 1) {
        return !kinds_[0].is_classical();
    }
    const bool is_too_short = is_trial() && samples < static_cast<int>(kinds_.size());
    return !is_too_short && !(state_ == State::classical && shares_.front()[0] == 1);
}

WalkShares GuidingChoice::shares(std::size_t tile, int samples) const {
    return kinds_.size() > 1 && !guides(samples) ? all_of(0) : shares_[tile];
}

double GuidingChoice::recorded_share(int samples) const {
    if (kinds_.size() == 1) {
        return 1;
    }
    constexpr double first = 1.0 / 16, before_trial = 0.2, at_trial = 0.4, least = 0.15, most = 0.5, enough = 6;
    switch (state_) {
        case State::classical:
            return samples < warm_up_samples / 2 ? first : before_trial;
        case State::trial:
            return at_trial;
        case State::chosen:
            return std::clamp(gain_ / enough, least, most);
    }
    return 1;
}

WalkShares GuidingChoice::chosen_for(const WalkTallies& tile, const WalkTallies& picture) const {
    // Tiles differ in what is hard there for walks of all kinds.
    double squares = 0, expected_squares = 0, work = 0, expected_work = 0;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        const WalkTally &here = tile[kind], &all = picture[kind];
        if (all.walks > 0) {
            squares += here.square;
            expected_squares += here.walks * all.variance();
            work += here.work;
            expected_work += here.walks * all.work / all.walks;
        }
    }
    const double hard = expected_squares > 0 ? squares / expected_squares : 1.0;
    const double long_walks = expected_work > 0 ? work / expected_work : 1.0;
    std::array<double, most_walk_kinds> variance{}, price{};
    std::size_t best = 0;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        const WalkTally &here = tile[kind], &all = picture[kind];
        if (!(all.walks > 0)) {
            price[kind] = std::numeric_limits<double>::infinity();
            continue;
        }
        const double n = here.walks + walks_of_picture;
        variance[kind] = (here.square + walks_of_picture * hard * all.variance()) / n;
        price[kind] = variance[kind] * (here.work + walks_of_picture * long_walks * all.work / all.walks) / n;
        best = price[kind] < price[best] ? kind : best;
    }
    WalkShares shares{};
    float rest = 1;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        if (kind != best && price[kind] < close * price[best]) {
            const double excess = std::max(0.0, variance[kind] / variance[best] - 1);
            shares[kind] = static_cast<float>(std::min(trial_share, noise_of_trials / excess));
            rest -= shares[kind];
        }
    }
    shares[best] = rest;
    return shares;
}

}  // namespace wend
