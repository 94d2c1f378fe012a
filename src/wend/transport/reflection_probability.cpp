#include <wend/transport/reflection_probability.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Until more records tell the two ways apart, both are taken to bring the same.
constexpr double confidence_in_both = 8;
constexpr double most_odds = 64;

}  // namespace

void ReflectionProbability::add(std::span<const ReflectionRecord> records) {
    tallies_.resize(VertexCells::count);
    for (const ReflectionRecord& record : records) {
        if (std::isfinite(record.brought)) {
            Cell& cell = tallies_[record.cell];
            Tally& tally = record.reflected ? cell.reflected : cell.refracted;
            ++tally.count;
            tally.sum += static_cast<double>(record.brought);
        }
    }
}

void ReflectionProbability::learn() {
    odds_.assign(VertexCells::count, 1.0f);
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
        const auto& [reflected, refracted] = tallies_[i];
        const double both = (reflected.sum + refracted.sum) / (reflected.count + refracted.count);
        if (!(both > 0)) {
            continue;
        }
        const auto mean = [&](const Tally& tally) {
            return (tally.sum + confidence_in_both * both) / (tally.count + confidence_in_both);
        };
        odds_[i] = static_cast<float>(std::clamp(mean(reflected) / mean(refracted), 1 / most_odds, most_odds));
    }
}

void ReflectionLog::finish(std::vector<ReflectionRecord>& records) {
    for (std::size_t i = notes_.size(); i-- > 0;) {
        const Note& note = notes_[i];
        bring(note.before, note.record.brought);
        ReflectionRecord record = note.record;
        record.brought /= note.worth;
        records.push_back(record);
    }
    notes_.clear();
}

}  // namespace wend
