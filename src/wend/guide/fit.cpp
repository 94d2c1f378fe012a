#include <wend/guide/fit.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/guide/evidence.h>
#include <wend/guide/lobe_revision.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/weight_limit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace wend::guide {
namespace {

constexpr int no_axis = -1;

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

double total_weight(const std::array<LobeSums, max_lobes>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0.0,
                           [](double t, const LobeSums& s) { return t + static_cast<double>(s.weight); });
}

/// All sums, of earlier records and new ones. Where only the weight of earlier ones is known, as of a lobe that was
/// split, they are taken to be like the new ones.
std::array<LobeSums, max_lobes> continued(const std::array<LobeSums, max_lobes>& earlier,
                                          std::array<LobeSums, max_lobes> sums) {
    for (int i = 0; i < max_lobes; ++i) {
        if (earlier[i].weight > 0 && earlier[i].weight_square == 0 && sums[i].weight > 0) {
            const double factor = 1 + static_cast<double>(earlier[i].weight) / sums[i].weight;
            sums[i] = sums[i].scaled(factor, factor * factor);
        } else {
            sums[i] += earlier[i];
        }
    }
    return sums;
}

LobeColours colours_of(const LearnedLobes& learned) {
    LobeColours colours;
    for (int i = 0; i < learned.model.mixture.size(); ++i) {
        const LobeSums& s = learned.sums[static_cast<std::size_t>(i)];
        if (s.weight > 0) {
            colours.set(i, s.red / s.weight, s.blue / s.weight);
        }
    }
    return colours;
}

/// Sum over the lobes of how far their resultant vectors are apart.
double movement(const std::array<LobeSums, max_lobes>& a, const std::array<LobeSums, max_lobes>& b) {
    double sum = 0;
    for (int i = 0; i < max_lobes; ++i) {
        sum += (Imath::V3d(a[i].direction) - Imath::V3d(b[i].direction)).length();
    }
    return sum;
}

}  // namespace

/// One call of fit(), step by step: the records are sorted into the leaves, leaves are split level by level, and every
/// leaf is fitted. What runs in parallel writes to one leaf only.
class Fitting {
public:
    Fitting(const Field& previous, std::span<const Record> records, const FitSettings& settings, int threads)
        : field_(previous), records_(records), settings_(settings), threads_(threads) {
        WEND_EXPECT(records.size() < std::numeric_limits<std::uint32_t>::max());
    }

    FitResult run() && {
        for (Field::Memory& memory : field_.memories_) {
            const auto decay = static_cast<float>(settings_.decay);
            memory.statistics = memory.statistics.decayed(settings_.decay);
            memory.located *= decay;
            memory.offset *= decay;
            memory.offset_square *= decay;
        }
        sort_into_leaves();
        grow();
        parallel_for(cells_.size(), threads_, [&](std::size_t i) { fit_cell(cells_[i]); });
        field_.trained_ = field_.trained_ || !order_.empty();
        report_.records = records_.size();
        report_.ignored = records_.size() - order_.size();
        report_.cells = field_.size();
        report_.bytes = field_.bytes();
        // What the cells tell rays follows from what they know.
        return {fit_scattered(std::move(field_), {}, 1, threads_), report_};
    }

private:
    /// A leaf and its records, order_[begin, end).
    struct Cell {
        std::uint32_t node;
        std::size_t begin, end;

        std::size_t size() const { return end - begin; }
    };

    /// A usable record, with its position at hand: leaves are split again and again, and records lie far apart.
    struct Entry {
        Vec3 position;
        std::uint32_t record;
    };

    struct Plane {
        int axis = no_axis;
        float position = 0;
    };

    /// The records of a cell that carry radiance, as seen from its reference point.
    struct View {
        std::vector<Observation> observations;
        /// What a weight of 1 stands for, in radiance times sr.
        double unit = 0;
        /// Sums of the weights before freaks are cut, and of their squares.
        double fluence = 0, fluence_square = 0;
    };

    const Record& record(std::size_t i) const { return records_[order_[i].record]; }
    std::uint32_t region_of(const Cell& cell) const { return field_.nodes_[cell.node].child; }
    Field::Memory& memory_of(const Cell& cell) { return field_.memories_[region_of(cell)]; }
    const Field::Memory& memory_of(const Cell& cell) const { return field_.memories_[region_of(cell)]; }
    double count_of(const Cell& cell) const {
        return memory_of(cell).statistics.count + static_cast<double>(cell.size());
    }

    /// A stable counting sort of the usable records by leaf, in chunks that do not depend on the threads.
    void sort_into_leaves() {
        constexpr std::uint32_t unusable = std::numeric_limits<std::uint32_t>::max();
        constexpr std::size_t chunk = 1 << 15;
        const std::size_t chunks = (records_.size() + chunk - 1) / chunk;
        const auto for_chunks = [&](const auto& body) {
            parallel_for(chunks, threads_,
                         [&](std::size_t c) { body(c, c * chunk, std::min((c + 1) * chunk, records_.size())); });
        };
        std::vector<std::uint32_t> node_of(records_.size(), unusable);
        // Of each chunk, the records by leaf; then, where the next one belongs.
        std::vector<std::vector<std::size_t>> next(chunks, std::vector<std::size_t>(field_.nodes_.size(), 0));
        std::vector<std::size_t> dark(chunks, 0);
        for_chunks([&](std::size_t c, std::size_t begin, std::size_t to) {
            std::size_t without_radiance = 0;
            for (std::size_t i = begin; i < to; ++i) {
                if (is_usable(records_[i])) {
                    node_of[i] = field_.leaf_of(records_[i].position);
                    ++next[c][node_of[i]];
                    without_radiance += records_[i].radiance == 0 ? 1 : 0;
                }
            }
            dark[c] = without_radiance;
        });
        report_.dark = std::accumulate(dark.begin(), dark.end(), std::size_t{0});

        std::size_t end = 0;
        for (std::uint32_t node = 0; node < field_.nodes_.size(); ++node) {
            const std::size_t begin = end;
            for (std::vector<std::size_t>& of_chunk : next) {
                const std::size_t count = of_chunk[node];
                of_chunk[node] = end;
                end += count;
            }
            if (end > begin) {
                cells_.push_back({node, begin, end});
            }
        }
        order_.resize(end);
        for_chunks([&](std::size_t c, std::size_t begin, std::size_t to) {
            for (std::size_t i = begin; i < to; ++i) {
                if (node_of[i] != unusable) {
                    order_[next[c][node_of[i]]++] = {records_[i].position, static_cast<std::uint32_t>(i)};
                }
            }
        });
    }

    /// Splits the cells, level by level, until none is too full or a limit is reached.
    void grow() {
        std::vector<Cell> open = std::move(cells_), closed;
        while (!open.empty()) {
            std::vector<Plane> planes(open.size());
            parallel_for(open.size(), threads_, [&](std::size_t i) { planes[i] = choose_plane(open[i]); });
            limit_memory(open, planes);

            std::vector<std::size_t> middles(open.size());
            parallel_for(open.size(), threads_, [&](std::size_t i) { middles[i] = partition(open[i], planes[i]); });

            std::vector<Cell> children;
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (planes[i].axis == no_axis) {
                    closed.push_back(open[i]);
                } else {
                    const std::uint32_t first = split(open[i], planes[i], middles[i]);
                    children.push_back({first, open[i].begin, middles[i]});
                    children.push_back({first + 1, middles[i], open[i].end});
                }
            }
            open = std::move(children);
        }
        cells_ = std::move(closed);
    }

    /// Where to split a cell; no axis where it is to stay whole.
    Plane choose_plane(const Cell& cell) {
        if (count_of(cell) <= settings_.leaf_samples || cell.size() < 2 ||
            memory_of(cell).depth >= static_cast<std::uint32_t>(settings_.max_depth)) {
            return {};
        }
        if (count_of(cell) > settings_.uniform_factor * settings_.leaf_samples) {
            return plane_across(cell, no_axis);
        }
        const SplitEvidence evidence = evidence_for(cell);
        constexpr double beyond_chance = 5;
        return evidence.significance > beyond_chance && evidence.gain > settings_.variation
                   ? plane_across(cell, evidence.axis)
                   : Plane{};
    }

    /// The plane through the mean position, across the given axis or otherwise that of largest variance, both of a
    /// regular sample of the records.
    Plane plane_across(const Cell& cell, int axis) const {
        constexpr std::size_t enough = 1024;
        const std::size_t stride = std::max<std::size_t>(cell.size() / enough, 1);
        const Imath::V3d mean = mean_position(cell, stride);
        Imath::V3d variance(0, 0, 0);
        Vec3 lowest = order_[cell.begin].position;
        for (std::size_t i = cell.begin; i < cell.end; i += stride) {
            const Vec3& position = order_[i].position;
            const Imath::V3d d = Imath::V3d(position) - mean;
            variance += d * d;
            for (int a = 0; a < 3; ++a) {
                lowest[a] = std::min(lowest[a], position[a]);
            }
        }
        if (axis == no_axis) {
            axis = variance.x >= variance.y ? 0 : 1;
            axis = variance[axis] >= variance.z ? axis : 2;
        }
        const float position = static_cast<float>(mean[axis]);
        // Otherwise the positions are too close for a float between them, and one side would stay empty.
        return position > lowest[axis] ? Plane{axis, position} : Plane{};
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
        statistics = statistics.in_unit(std::max(view.unit, statistics.unit));
        std::array<LobeSums, max_lobes> earlier = statistics.lobe_sums();
        const LearnedLobes learned = find_lobes(start(region), earlier, view.observations,
                                                view.unit / statistics.unit * static_cast<double>(stride), seen.radius);
        statistics.keep(earlier);
        region = Region(region.reference(), learned.model.mixture, learned.model.inverse_distance, region.fluence(),
                        colours_of(learned), region.classical_share());
        const Vec3 mean = seen.offset / seen.located;
        return split_evidence(learned.model, learned.sums, {mean, seen.offset_square / seen.located - mean * mean});
    }

    /// The mean of every stride-th position.
    Imath::V3d mean_position(const Cell& cell, std::size_t stride) const {
        Imath::V3d sum(0, 0, 0);
        double count = 0;
        for (std::size_t i = cell.begin; i < cell.end; i += stride) {
            sum += Imath::V3d(order_[i].position);
            ++count;
        }
        return sum / count;
    }

    /// Withdraws the planes of the least used cells where memory does not suffice for all.
    void limit_memory(const std::vector<Cell>& open, std::vector<Plane>& planes) {
        const std::size_t most_cells = settings_.max_bytes / Field::bytes_per_cell();
        const std::size_t room = most_cells - std::min(most_cells, field_.size());
        std::vector<std::size_t> wanted;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (planes[i].axis != no_axis) {
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

    /// Moves the records below the plane to the front, keeping their order; returns where the others begin.
    std::size_t partition(const Cell& cell, const Plane& plane) {
        if (plane.axis == no_axis) {
            return cell.end;
        }
        const auto first = order_.begin() + static_cast<std::ptrdiff_t>(cell.begin);
        const auto last = order_.begin() + static_cast<std::ptrdiff_t>(cell.end);
        const auto middle = std::stable_partition(
            first, last, [&](const Entry& entry) { return entry.position[plane.axis] < plane.position; });
        return static_cast<std::size_t>(middle - order_.begin());
    }

    /// Turns a leaf into an inner node; both children inherit what it knows, each by its share of the new records.
    /// Returns the node of the first child.
    std::uint32_t split(const Cell& cell, const Plane& plane, std::size_t middle) {
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
        node.child = first & 0x3fffffffu;
        Field::Node leaf;
        leaf.child = region & 0x3fffffffu;
        field_.nodes_.push_back(leaf);
        leaf.child = other_region & 0x3fffffffu;
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
            statistics = statistics.in_unit(std::max(view.unit, statistics.unit));
            const LearnedLobes learned =
                fit_lobes(start(region), statistics.lobe_sums(), view, view.unit / statistics.unit, memory.radius);
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
                __builtin_prefetch(&record(next).position);
                __builtin_prefetch(&record(next).distance);
            }
            const Record& r = record(i);
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

    /// Stepwise expectation maximization: the sums of earlier fits stay, those of the observations are found anew in
    /// each round. Most rounds, which only have to find the neighbourhood, see a sample of the observations, large
    /// enough for their unequal weights (kish1965); the last one sees all.
    LearnedLobes fit_lobes(const LobeModel& model, std::array<LobeSums, max_lobes> earlier, const View& view,
                           double unit, double radius) const {
        constexpr double enough = 256;
        const std::span all(view.observations);
        double squares = 0;
        for (const Observation& o : all) {
            squares += static_cast<double>(sqr(o.weight));
        }
        const auto size = static_cast<double>(all.size());  // and the sum of the weights
        const auto stride = static_cast<std::size_t>(size * size / squares / enough);
        if (stride <= 1) {
            return find_lobes(model, earlier, all, unit, radius);
        }
        std::vector<Observation> sample;
        sample.reserve(all.size() / stride + 1);
        for (std::size_t i = 0; i < all.size(); i += stride) {
            sample.push_back(all[i]);
        }
        const double scale = size / static_cast<double>(sample.size());
        const LobeModel near = find_lobes(model, earlier, sample, unit * scale, radius).model;
        return improve(near, earlier, all, unit, 1, radius);
    }

    /// Lobes and their number; the earlier sums follow the number.
    LearnedLobes find_lobes(const LobeModel& model, std::array<LobeSums, max_lobes>& earlier,
                            std::span<const Observation> observations, double unit, double radius) const {
        constexpr int splitting_revisions = 2, revisions = 3;
        LearnedLobes learned = improve(model, earlier, observations, unit, settings_.max_iterations, radius);
        for (int i = 0; i < revisions; ++i) {
            // The shape of the records is to be seen from where the lobes are now.
            learned.sums = continued(earlier, expectation(learned.model, observations, unit));
            // The last one cleans up: it only merges.
            const int most = i < splitting_revisions ? settings_.most_lobes : learned.model.mixture.size();
            if (!revise_lobes(learned, earlier, most)) {
                break;
            }
            learned = improve(learned.model, earlier, observations, unit, (settings_.max_iterations + 1) / 2, radius);
        }
        return learned;
    }

    /// Rounds of expectation maximization, until the lobes hardly move.
    LearnedLobes improve(const LobeModel& model, const std::array<LobeSums, max_lobes>& earlier,
                         std::span<const Observation> observations, double unit, int rounds, double radius) const {
        LearnedLobes learned{model, earlier};
        for (int round = 0; round < rounds; ++round) {
            const std::array<LobeSums, max_lobes> last = learned.sums;
            learned.sums = continued(earlier, expectation(learned.model, observations, unit));
            learned.model = maximization(learned.sums, learned.model, settings_.priors, radius);
            if (round > 0 && movement(learned.sums, last) < settings_.tolerance * total_weight(learned.sums)) {
                break;
            }
        }
        return learned;
    }

    /// Chooses a new cell's reference point.
    void settle(const Cell& cell) {
        if (Field::Memory& memory = memory_of(cell); !memory.anchored) {
            anchor(field_.regions_[region_of(cell)], memory, Vec3(mean_position(cell, 1)));
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
        region =
            Region(reference, mixture, inverse_distance, region.fluence(), region.colours(), region.classical_share());
    }

    Field field_;
    std::span<const Record> records_;
    const FitSettings& settings_;
    int threads_;
    /// The usable records, those of a leaf side by side.
    std::vector<Entry> order_;
    std::vector<Cell> cells_;
    FitReport report_;
};

FitResult fit(const Field& previous, std::span<const Record> records, const FitSettings& settings, int threads) {
    validate(settings);
    return Fitting(previous, records, settings, threads).run();
}

}  // namespace wend::guide
