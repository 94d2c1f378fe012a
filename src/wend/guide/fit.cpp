#include <wend/guide/fit.h>

#include <wend/guide/field_memory.h>

#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/guide/evidence.h>
#include <wend/guide/lobe_learning.h>
#include <wend/guide/records_by_cell.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/shared_learning.h>
#include <wend/guide/weight_limit.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace wend::guide {
namespace {

void validate(const FitSettings& s) {
    const auto require = [](bool holds, const char* rule) {
        if (!holds) {
            throw InputError(std::string("guiding field: ") + rule);
        }
    };
    require(s.lobes >= 1 && s.lobes <= max_lobes, "the number of lobes must be 1 to 16");
    require(s.most_lobes >= s.lobes && s.most_lobes <= max_lobes,
            "the largest number of lobes must be between the number at first and 16");
    require(s.leaf_samples >= 1, "the samples of a leaf must be at least 1");
    require(s.uniform_factor >= 1, "the factor of uniform leaves must be at least 1");
    require(s.uniform_evidence >= 0, "the evidence of uniform leaves must not be negative");
    require(s.variation >= 0, "the variation must not be negative");
    require(s.max_depth >= 0 && s.max_depth <= Field::max_depth, "the depth must be 0 to 64");
    require(s.max_bytes >= (std::size_t{64} << 10), "the memory must be at least 64 KiB");
    require(s.decay >= 0 && s.decay <= 1, "the decay must be 0 to 1");
    require(s.max_iterations >= 1, "the iterations must be at least 1");
    require(s.tolerance >= 0, "the tolerance must not be negative");
    require(s.priors.weight > 0 && s.priors.mean_cosine > 0, "the priors must be positive");
    require(s.priors.max_kappa > 0 && s.priors.max_kappa <= Vmf::max_kappa,
            "the largest concentration must be above 0 and at most 1e5");
}

}  // namespace

/// One call of fit(), step by step: the records are sorted into the leaves, leaves are split level by level, and every
/// leaf is fitted. What runs in parallel writes to one leaf only.
class Fitting {
public:
    Fitting(const Field& previous, std::span<const Record> records, std::span<const std::uint32_t> cells,
            const FitSettings& settings, int threads)
        : field_(previous),
          sorted_(previous, records, cells, threads),
          cells_(sorted_.cells()),
          settings_(settings),
          threads_(threads) {
        report_.records = records.size();
        report_.ignored = records.size() - sorted_.size();
        report_.dark = sorted_.dark();
    }

    FitResult run() && {
        for (Field::Memory& memory : field_.memories_) {
            const auto decay = static_cast<float>(settings_.decay);
            memory.statistics = memory.statistics.decayed(settings_.decay);
            memory.located *= decay;
            memory.offset *= decay;
            memory.offset_square *= decay;
        }
        grow();
        parallel_for(cells_.size(), threads_, [&](std::size_t i) { fit_cell(cells_[i]); });
        field_.trained_ = field_.trained_ || sorted_.size() > 0;
        report_.cells = field_.size();
        report_.bytes = field_.bytes();
        // What the cells tell rays follows from what they know.
        return {fit_scattered(std::move(field_), {}, 1, threads_), report_};
    }

private:
    using Cell = RecordsByCell::Cell;

    /// The records of a cell that carry radiance, as seen from its reference point.
    struct View {
        std::vector<Observation> observations;
        /// What a weight of 1 stands for, in radiance times sr.
        double unit = 0;
        /// Sums of the weights before freaks are cut, and of their squares.
        double fluence = 0, fluence_square = 0;
    };

    std::uint32_t region_of(const Cell& cell) const { return field_.nodes_[cell.node].child; }
    Field::Memory& memory_of(const Cell& cell) { return field_.memories_[region_of(cell)]; }
    const Field::Memory& memory_of(const Cell& cell) const { return field_.memories_[region_of(cell)]; }
    double count_of(const Cell& cell) const {
        return memory_of(cell).statistics.count + static_cast<double>(cell.size());
    }

    /// Splits the cells, level by level, until none is too full or a limit is reached.
    void grow() {
        std::vector<Cell> open = std::move(cells_), closed;
        while (!open.empty()) {
            std::vector<SplitPlane> planes(open.size());
            parallel_for(open.size(), threads_, [&](std::size_t i) { planes[i] = choose_plane(open[i]); });
            limit_memory(open, planes);

            std::vector<std::size_t> middles(open.size());
            parallel_for(open.size(), threads_,
                         [&](std::size_t i) { middles[i] = sorted_.partition(open[i], planes[i]); });

            std::vector<Cell> children;
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (planes[i].axis == SplitPlane::no_axis) {
                    closed.push_back(open[i]);
                } else {
                    const std::uint32_t first = split(open[i], planes[i], middles[i]);
                    children.push_back({{open[i].begin, middles[i]}, first});
                    children.push_back({{middles[i], open[i].end}, first + 1});
                }
            }
            open = std::move(children);
        }
        cells_ = std::move(closed);
    }

    /// Where to split a cell; no axis where it is to stay whole.
    SplitPlane choose_plane(const Cell& cell) {
        if (count_of(cell) <= settings_.leaf_samples || cell.size() < 2 ||
            memory_of(cell).depth >= static_cast<std::uint32_t>(settings_.max_depth)) {
            return {};
        }
        if (is_overfull(cell)) {
            return sorted_.plane_across(cell, SplitPlane::no_axis);
        }
        const SplitEvidence evidence = evidence_for(cell);
        constexpr double beyond_chance = 5;
        return evidence.significance > beyond_chance && evidence.gain > settings_.variation
                   ? sorted_.plane_across(cell, evidence.axis)
                   : SplitPlane{};
    }

    /// Whether a cell is to be split in any case.
    bool is_overfull(const Cell& cell) const {
        constexpr double rare_factor = 3;
        const double most = settings_.uniform_factor * settings_.leaf_samples;
        return count_of(cell) > rare_factor * most ||
               (count_of(cell) > most && effective_records_of(cell) >= settings_.uniform_evidence);
    }

    /// How many records of equal weight would know as much as those of a cell (kish1965).
    double effective_records_of(const Cell& cell) const {
        const Statistics& earlier = memory_of(cell).statistics;
        double sum = earlier.fluence, squares = earlier.fluence_square;
        for (std::size_t i = cell.begin; i < cell.end; ++i) {
            const double weight = weight_of(sorted_[i]);
            sum += weight;
            squares += weight * weight;
        }
        return squares > 0 ? sum * sum / squares : 0.0;
    }

    /// Whether a cell's halves differ, by a fit to a sample of its records on top of what earlier ones told. The fit is
    /// where those of the cell or its children start.
    SplitEvidence evidence_for(const Cell& cell) {
        constexpr std::size_t enough = 256, share = 8;
        const std::size_t stride = std::max<std::size_t>(cell.size() / std::max(enough, cell.size() / share), 1);
        settle(cell);
        Region& region = field_.regions_[region_of(cell)];
        Field::Memory seen = memory_of(cell);
        const View view = look(cell, stride, seen);
        if (view.observations.empty()) {
            return {};
        }
        Statistics& statistics = memory_of(cell).statistics;
        statistics = statistics.in_unit(statistics.unit_with(view.unit));
        std::array<LobeSums, max_lobes> earlier = statistics.lobe_sums();
        const LobeLearning learning(settings_, view.unit / statistics.unit * static_cast<double>(stride), seen.radius);
        const LearnedLobes learned = learning.learn(start(region), earlier, view.observations);
        statistics.keep(earlier);
        region = Region(region.reference(), learned.model.mixture, learned.model.inverse_distance, region.fluence(),
                        colours_of(learned), region.defensive_fraction());
        const Vec3 mean = seen.offset / seen.located;
        return split_evidence(learned.model, learned.sums, {mean, seen.offset_square / seen.located - mean * mean});
    }

    /// Withdraws the planes of the least used cells where memory does not suffice for all.
    void limit_memory(const std::vector<Cell>& open, std::vector<SplitPlane>& planes) {
        const std::size_t most_cells = settings_.max_bytes / Field::bytes_per_cell();
        const std::size_t room = most_cells - std::min(most_cells, field_.size());
        std::vector<std::size_t> wanted;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (planes[i].axis != SplitPlane::no_axis) {
                wanted.push_back(i);
            }
        }
        if (wanted.size() <= room) {
            return;
        }
        report_.memory_limited = true;
        std::stable_sort(wanted.begin(), wanted.end(),
                         [&](std::size_t a, std::size_t b) { return count_of(open[a]) > count_of(open[b]); });
        for (const std::size_t i : std::span(wanted).subspan(room)) {
            planes[i] = {};
        }
    }

    /// Turns a leaf into an inner node; both children inherit what it knows, each by its share of the new records.
    /// Returns the node of the first child.
    std::uint32_t split(const Cell& cell, const SplitPlane& plane, std::size_t middle) {
        const std::uint32_t region = region_of(cell);
        const auto other_region = static_cast<std::uint32_t>(field_.regions_.size());
        const auto first = static_cast<std::uint32_t>(field_.nodes_.size());

        Field::Memory memory = field_.memories_[region];
        ++memory.depth;
        memory.anchored = false;
        const double share = static_cast<double>(middle - cell.begin) / static_cast<double>(cell.size());
        Field::Memory other = memory;
        memory.statistics = memory.statistics.share(share);
        other.statistics = other.statistics.share(1 - share);
        memory.scattered = memory.scattered.scaled(static_cast<float>(share));
        other.scattered = other.scattered.scaled(static_cast<float>(1 - share));

        field_.memories_[region] = memory;
        field_.memories_.push_back(other);
        field_.regions_.push_back(Region(field_.regions_[region]));
        field_.scattered_.push_back(ScatteredLight(field_.scattered_[region]));
        Field::Node& node = field_.nodes_[cell.node];
        node.plane = plane.position;
        node.axis = static_cast<std::uint32_t>(plane.axis) & 3u;
        node.child = first & Field::largest_child;
        Field::Node leaf;
        leaf.child = region & Field::largest_child;
        field_.nodes_.push_back(leaf);
        leaf.child = other_region & Field::largest_child;
        field_.nodes_.push_back(leaf);
        return first;
    }

    /// Fits a cell, which has at least one record.
    void fit_cell(const Cell& cell) {
        settle(cell);
        Region& region = field_.regions_[region_of(cell)];
        Field::Memory& memory = memory_of(cell);
        Statistics& statistics = memory.statistics;
        const View view = look(cell, 1, memory);
        statistics.fluence += view.fluence;
        statistics.fluence_square += view.fluence_square;
        statistics.count += static_cast<double>(cell.size());

        LobeModel model{region.mixture(), region.inverse_distance()};
        LobeColours colours = region.colours();
        if (!view.observations.empty()) {
            statistics = statistics.in_unit(statistics.unit_with(view.unit));
            const LobeLearning learning(settings_, view.unit / statistics.unit, memory.radius);
            const LearnedLobes learned =
                learning.learn_by_sample(start(region), statistics.lobe_sums(), view.observations);
            model = learned.model;
            colours = colours_of(learned);
            statistics.keep(learned.sums);
        }
        region =
            Region(region.reference(), model.mixture, model.inverse_distance,
                   static_cast<float>(statistics.fluence / statistics.count), colours, statistics.share_sums.best());
    }

    /// Where a cell's fit starts.
    LobeModel start(const Region& region) const {
        return region.mixture().size() > 1 ? LobeModel{region.mixture(), region.inverse_distance()}
                                           : initial_lobes(settings_.lobes);
    }

    /// Sees every stride-th record of a cell from its reference point, and adds to the memory where they are and how
    /// they were drawn.
    View look(const Cell& cell, std::size_t stride, Field::Memory& memory) const {
        constexpr float largest_inverse_distance = 1e12f;  // the sum of many squares is a float
        const Vec3 reference = field_.regions_[region_of(cell)].reference();
        View view;
        std::vector<double> weights;
        weights.reserve(cell.size() / stride + 1);
        view.observations.reserve(cell.size() / stride + 1);
        float radius_squared = sqr(memory.radius);
        Imath::V3d offsets(0, 0, 0), squares(0, 0, 0);
        double seen = 0;
        for (std::size_t i = cell.begin; i < cell.end; i += stride) {
            // The records of a cell lie far apart.
            constexpr std::size_t ahead = 16;
            if (const std::size_t next = i + ahead * stride; next < cell.end) {
                __builtin_prefetch(&sorted_[next].position);
                __builtin_prefetch(&sorted_[next].distance);
            }
            const Record& r = sorted_[i];
            const Vec3 offset = reference - r.position;
            radius_squared = std::max(radius_squared, length_squared(offset));
            offsets += Imath::V3d(offset);
            squares += Imath::V3d(offset) * Imath::V3d(offset);
            ++seen;
            const double weight = weight_of(r);
            if (weight > 0) {
                memory.statistics.share_sums.add(r);
                view.fluence += weight;
                view.fluence_square += weight * weight;
                weights.push_back(weight);
                const double grey = (static_cast<double>(r.colour.r) + r.colour.g + r.colour.b) / 3;
                const auto over_grey = [&](float channel) { return grey > 0 ? static_cast<float>(channel / grey) : 1; };
                view.observations.push_back({r.direction, offset, std::min(1 / r.distance, largest_inverse_distance), 0,
                                             over_grey(r.colour.r), over_grey(r.colour.b)});
            }
        }
        memory.located += static_cast<float>(seen);
        memory.offset += Vec3(offsets);
        memory.offset_square += Vec3(squares);
        memory.radius = std::sqrt(radius_squared);
        if (!weights.empty()) {
            const double limit = weight_limit(weights);
            double sum = 0;
            for (double& w : weights) {
                w = std::min(w, limit);
                sum += w;
            }
            view.unit = sum / static_cast<double>(weights.size());
            for (std::size_t i = 0; i < weights.size(); ++i) {
                view.observations[i].weight = static_cast<float>(weights[i] / view.unit);
            }
        }
        return view;
    }

    /// Chooses a new cell's reference point.
    void settle(const Cell& cell) {
        if (Field::Memory& memory = memory_of(cell); !memory.anchored) {
            anchor(field_.regions_[region_of(cell)], memory, Vec3(sorted_.mean_position(cell, 1)));
        }
    }

    /// Moves a region to a reference point; what was inherited is re-aimed at it.
    static void anchor(Region& region, Field::Memory& memory, const Vec3& reference) {
        memory.anchored = true;
        memory.radius = 0;
        memory.located = 0;
        memory.offset = memory.offset_square = Vec3(0, 0, 0);
        const Vec3 offset = region.reference() - reference;
        const VmfMixture mixture = region.incident(reference);
        Lanes inverse_distance;
        for (int i = 0; i < mixture.size(); ++i) {
            const float inverse = region.inverse_distance()[i];
            const Vec3 to_source = region.mixture().lobe(i).vmf.mean + offset * inverse;
            inverse_distance[i] = inverse / std::max(length(to_source), 1e-3f);
            LobeSums sums = memory.statistics.lobes[static_cast<std::size_t>(i)].sums();
            sums.direction = Vec3(Imath::V3d(mixture.lobe(i).vmf.mean) * Imath::V3d(sums.direction).length());
            sums.turn = inverse_distance[i] * sums.spread;
            // Where in the new cell the earlier records were is not known.
            sums.offset = Vec3(0, 0, 0);
            memory.statistics.lobes[static_cast<std::size_t>(i)] = sums;
        }
        region = Region(reference, mixture, inverse_distance, region.fluence(), region.colours(),
                        region.defensive_fraction());
    }

    Field field_;
    RecordsByCell sorted_;
    std::vector<Cell> cells_;
    const FitSettings& settings_;
    int threads_;
    FitReport report_;
};

FitResult fit(const Field& previous, std::span<const Record> records, std::span<const std::uint32_t> cells,
              const FitSettings& settings, int threads) {
    validate(settings);
    return Fitting(previous, records, cells, settings, threads).run();
}

FitResult fit(const Field& previous, std::span<const Record> records, const FitSettings& settings, int threads) {
    return fit(previous, records, {}, settings, threads);
}

}  // namespace wend::guide
