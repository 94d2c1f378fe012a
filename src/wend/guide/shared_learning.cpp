#include <wend/guide/shared_learning.h>

#include <wend/core/parallel.h>
#include <wend/guide/field_bytes.h>
#include <wend/guide/scatter_fit.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace wend::guide {
namespace {

using Producers = std::span<const PathRecords>;

/// The next so many bytes of a message.
std::string_view take(std::string_view& message, std::size_t bytes) {
    ArchiveReader::require(bytes <= message.size());
    const std::string_view taken = message.substr(0, bytes);
    message.remove_prefix(bytes);
    return taken;
}

template <class T>
T value_at(std::string_view bytes, std::size_t index = 0) {
    T value;
    std::memcpy(static_cast<void*>(&value), bytes.data() + index * sizeof(T), sizeof(T));
    return value;
}

/// Records of one kind for one field, of which each process has some and gets those of its cells. They are many: each
/// is looked up in the tree once, and copied once before it is sent and once after.
template <class T>
class SharedRecords {
public:
    using Kind = const std::vector<T>& (PathRecords::*)() const;

    SharedRecords(const Field& field, Producers producers, Kind kind, int threads)
        : producers_(producers), kind_(kind), cells_(producers.size()) {
        parallel_for(producers.size(), threads, [&](std::size_t i) {
            const std::vector<T>& records = (producers[i].*kind)();
            cells_[i].reserve(records.size());
            for (const T& record : records) {
                cells_[i].push_back(static_cast<std::uint32_t>(FieldBytes::cell_at(field, record.position)));
            }
        });
    }

    /// Adds the records of each cell that this process has.
    void count(std::span<std::uint64_t> work) const {
        for (const std::vector<std::uint32_t>& of_producer : cells_) {
            for (const std::uint32_t cell : of_producer) {
                ++work[cell];
            }
        }
    }
    /// Writes those of the owner's cells: of each producer how many, then all of them with their cells.
    void send(std::string& message, std::span<const int> owners, int owner) const {
        std::vector<Part> parts;
        std::size_t count = 0;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const auto of_owner = [&](std::uint32_t cell) { return owners[cell] == owner; };
            if (const auto n = std::count_if(cells_[i].begin(), cells_[i].end(), of_owner); n > 0) {
                parts.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(n)});
                count += static_cast<std::size_t>(n);
            }
        }
        const std::uint64_t number = parts.size();
        message.reserve(message.size() + sizeof number + parts.size() * sizeof(Part) + count * sizeof(Placed));
        append(message, &number, 1);
        append(message, parts.data(), parts.size());
        for (const Part& part : parts) {
            for_each(part.producer, owners, owner, [&](const Placed& placed) { append(message, &placed, 1); });
        }
    }
    /// Takes what another has sent, up to where it ends in the message, which must live until gather().
    void receive(std::string_view& message) {
        const auto number = value_at<std::uint64_t>(take(message, sizeof(std::uint64_t)));
        ArchiveReader::require(number <= producers_.size());
        const std::string_view parts = take(message, number * sizeof(Part));
        for (std::size_t i = 0; i < number; ++i) {
            const auto part = value_at<Part>(parts, i);
            ArchiveReader::require(part.producer < producers_.size());
            told_.push_back({part.producer, take(message, part.count * sizeof(Placed))});
        }
    }

    /// What the owner, this process, has and was told of its cells, in the order of the producers.
    struct Gathered {
        std::vector<T> records;
        std::vector<std::uint32_t> cells;
    };
    Gathered gather(std::span<const int> owners, int owner) {
        std::vector<std::string_view> told(producers_.size());
        std::size_t count = 0;
        for (const Told& part : std::exchange(told_, {})) {
            told[part.producer] = part.placed;
            count += part.placed.size() / sizeof(Placed);
        }
        for (const std::vector<std::uint32_t>& of_producer : cells_) {
            count += of_producer.size();
        }
        Gathered all;
        all.records.reserve(count);
        all.cells.reserve(count);
        const auto add = [&](const Placed& placed) {
            ArchiveReader::require(placed.cell < owners.size());
            all.records.push_back(placed.record);
            all.cells.push_back(placed.cell);
        };
        for (std::size_t i = 0; i < producers_.size(); ++i) {
            for_each(i, owners, owner, add);
            for (std::size_t k = 0; k < told[i].size() / sizeof(Placed); ++k) {
                add(value_at<Placed>(told[i], k));
            }
        }
        cells_.clear();
        return all;
    }

private:
    struct Part {
        std::uint32_t producer, count;
    };
    struct Placed {
        std::uint32_t cell;
        T record;
    };
    struct Told {
        std::uint32_t producer;
        std::string_view placed;
    };

    template <class Value>
    static void append(std::string& message, const Value* values, std::size_t count) {
        message.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
    }
    /// What a producer of this process has in the owner's cells.
    template <class Visit>
    void for_each(std::size_t producer, std::span<const int> owners, int owner, const Visit& visit) const {
        const std::vector<T>& records = (producers_[producer].*kind_)();
        const std::vector<std::uint32_t>& cells = cells_[producer];
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (owners[cells[k]] == owner) {
                visit(Placed{cells[k], records[k]});
            }
        }
    }

    Producers producers_;
    Kind kind_;
    std::vector<std::vector<std::uint32_t>> cells_;  ///< of each producer, where its records are
    std::vector<Told> told_;
};

/// One of the two fields and what there is to learn for it, shared out.
class SharedField {
public:
    SharedField(const Field& before, Producers producers, SharedRecords<Record>::Kind arrived,
                SharedRecords<ScatterRecord>::Kind scattered, const FitSettings& settings, int threads)
        : before_(before),
          settings_(settings),
          threads_(threads),
          arrived_(before, producers, arrived, threads),
          scattered_(before, producers, scattered, threads) {}

    std::size_t cells() const { return before_.size(); }
    /// Adds the records of each cell that this process has.
    void count(std::span<std::uint64_t> work) const {
        arrived_.count(work);
        scattered_.count(work);
    }
    /// Writes the records of those cells that the owner has.
    void send(std::string& message, std::span<const int> owners, int owner) const {
        arrived_.send(message, owners, owner);
        scattered_.send(message, owners, owner);
    }
    /// Takes what another has sent; see SharedRecords.
    void receive(std::string_view& message) {
        arrived_.receive(message);
        scattered_.receive(message);
    }

    /// Fits the cells of the owner, this process, with what it has and has received; how many cells that has made, or
    /// more than there may be.
    std::uint64_t fit(std::span<const int> owners, int owner) {
        const auto arrived = arrived_.gather(owners, owner);
        FitResult fitted = guide::fit(before_, arrived.records, arrived.cells, settings_, threads_);
        const auto scattered = scattered_.gather(owners, owner);
        next_ = fit_scattered(std::move(fitted.field), scattered.records, settings_.decay, threads_);
        return fitted.report.memory_limited ? most_cells() : next_->size() - before_.size();
    }
    /// Whether so many new cells are more than one fit would have made.
    bool exceeds_memory(std::uint64_t made) const { return before_.size() + made > most_cells(); }

    /// What was fitted of these cells.
    std::string branches(std::span<const std::uint32_t> cells) const {
        return FieldBytes::branches(*next_, before_, cells);
    }
    Field graft(std::span<const std::string> told) {
        return FieldBytes::graft(*std::exchange(next_, {}), before_, told);
    }

private:
    std::uint64_t most_cells() const { return settings_.max_bytes / Field::bytes_per_cell(); }

    const Field& before_;
    const FitSettings& settings_;
    int threads_;
    SharedRecords<Record> arrived_;
    SharedRecords<ScatterRecord> scattered_;
    std::optional<Field> next_;  ///< as this process knows it
};

/// Every process learns from all records: for fields that have no room left, which cells compete for.
Fields learn_from_all(const Fields& fields, std::vector<PathRecords> records, const FitSettings& settings, int threads,
                      Team& team) {
    ArchiveWriter mine;
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (records[i].size() > 0) {
            mine(static_cast<std::uint64_t>(i), std::exchange(records[i], {}));
        }
    }
    for (const std::string& told : team.gather(mine.take())) {
        ArchiveReader bytes(told);
        while (!bytes.empty()) {
            std::uint64_t i = 0;
            bytes(i);
            bytes.require(i < records.size());
            bytes(records[i]);
        }
    }
    return learn(fields, std::move(records), settings, threads);
}

/// The cells of an owner that there is work in.
std::vector<std::uint32_t> owned(std::span<const std::uint64_t> work, std::span<const int> owners, int owner) {
    std::vector<std::uint32_t> cells;
    for (std::uint32_t cell = 0; cell < work.size(); ++cell) {
        if (owners[cell] == owner && work[cell] > 0) {
            cells.push_back(cell);
        }
    }
    return cells;
}

}  // namespace

Fields learn_together(const Fields& fields, std::vector<PathRecords> records, int threads, Team& team,
                      const FitSettings& settings) {
    if (team.is_alone()) {
        return learn(fields, std::move(records), settings, threads);
    }
    SharedField surface(fields.surface, records, &PathRecords::surface, &PathRecords::surface_scattered, settings,
                        threads);
    SharedField volume(fields.volume, records, &PathRecords::volume, &PathRecords::volume_scattered, settings, threads);

    std::vector<std::uint64_t> work(surface.cells() + volume.cells(), 0);
    surface.count(std::span(work).first(surface.cells()));
    volume.count(std::span(work).last(volume.cells()));
    work = team.sum(std::move(work));
    const std::vector<int> owners = shares_of_ranks(work, team.size());
    const auto of_surface = std::span(owners).first(surface.cells()),
               of_volume = std::span(owners).last(volume.cells());

    std::vector<std::string> messages(static_cast<std::size_t>(team.size()));
    const auto own = static_cast<std::size_t>(team.rank());
    parallel_for(messages.size(), threads, [&](std::size_t rank) {
        if (rank != own) {
            surface.send(messages[rank], of_surface, static_cast<int>(rank));
            volume.send(messages[rank], of_volume, static_cast<int>(rank));
        }
    });
    messages = team.exchange(std::move(messages));
    for (std::size_t rank = 0; rank < messages.size(); ++rank) {
        if (rank != own) {
            std::string_view message = messages[rank];
            surface.receive(message);
            volume.receive(message);
            ArchiveReader::require(message.empty());
        }
    }

    const std::vector<std::uint64_t> made =
        team.sum({surface.fit(of_surface, team.rank()), volume.fit(of_volume, team.rank())});
    messages.clear();
    if (surface.exceeds_memory(made[0]) || volume.exceeds_memory(made[1])) {
        return learn_from_all(fields, std::move(records), settings, threads, team);
    }
    const auto grafted = [&](SharedField& field, std::span<const std::uint64_t> work_of_cells,
                             std::span<const int> owners_of_cells) {
        const auto cells = owned(work_of_cells, owners_of_cells, team.rank());
        return field.graft(team.gather(field.branches(cells)));
    };
    Field next_surface = grafted(surface, std::span(work).first(surface.cells()), of_surface);
    return {std::move(next_surface), grafted(volume, std::span(work).last(volume.cells()), of_volume)};
}

}  // namespace wend::guide
