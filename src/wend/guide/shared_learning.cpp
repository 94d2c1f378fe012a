#include <wend/core/parallel.h>
#include <wend/guide/field_bytes.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/shared_learning.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace wend::guide {
namespace {

using Producers = std::span<const PathRecords>;

/// Records of one kind for one process: those of each producer side by side.
template <class T>
struct Parcel {
    struct Part {
        std::uint32_t producer, count;
    };
    std::vector<Part> parts;
    std::vector<T> records;

    void add(std::size_t producer, const T& record) {
        if (parts.empty() || parts.back().producer != producer) {
            parts.push_back({static_cast<std::uint32_t>(producer), 0});
        }
        ++parts.back().count;
        records.push_back(record);
    }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& parcel) {
        bytes(parcel.parts, parcel.records);
        std::size_t count = 0;
        for (const Part& part : parcel.parts) {
            count += part.count;
        }
        bytes.require(count == parcel.records.size());
    }
};

/// All parcels in the order of the producers, each of which is in one of them.
template <class T>
std::vector<T> opened(std::span<const Parcel<T>> parcels) {
    struct Place {
        std::uint32_t producer;
        const T* first;
        std::size_t count;
    };
    std::vector<Place> places;
    std::size_t count = 0;
    for (const Parcel<T>& parcel : parcels) {
        const T* next = parcel.records.data();
        for (const auto& part : parcel.parts) {
            places.push_back({part.producer, next, part.count});
            next += part.count;
        }
        count += parcel.records.size();
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.producer < b.producer; });
    std::vector<T> all;
    all.reserve(count);
    for (const Place& place : places) {
        all.insert(all.end(), place.first, place.first + place.count);
    }
    return all;
}

/// Of each producer, the cells that its records are in.
template <class T>
std::vector<std::vector<std::uint32_t>> cells_of(const Field& field, Producers producers,
                                                 const std::vector<T>& (PathRecords::*kind)() const, int threads) {
    std::vector<std::vector<std::uint32_t>> cells(producers.size());
    parallel_for(producers.size(), threads, [&](std::size_t i) {
        const std::vector<T>& records = (producers[i].*kind)();
        cells[i].reserve(records.size());
        for (const T& record : records) {
            cells[i].push_back(static_cast<std::uint32_t>(FieldBytes::cell_at(field, record.position)));
        }
    });
    return cells;
}

/// One of the two fields and what there is to learn for it, shared out.
class SharedField {
public:
    SharedField(const Field& before, Producers producers, const Records& (PathRecords::*arrived)() const,
                const ScatterRecords& (PathRecords::*scattered)() const, const FitSettings& settings, int threads)
        : before_(before),
          producers_(producers),
          arrived_(arrived),
          scattered_(scattered),
          settings_(settings),
          threads_(threads),
          arrived_cells_(cells_of(before, producers, arrived, threads)),
          scattered_cells_(cells_of(before, producers, scattered, threads)) {}

    std::size_t cells() const { return before_.size(); }
    /// Adds the records of each cell that this process has.
    void count(std::span<std::uint64_t> work) const {
        for (const auto* cells : {&arrived_cells_, &scattered_cells_}) {
            for (const std::vector<std::uint32_t>& of_producer : *cells) {
                for (const std::uint32_t cell : of_producer) {
                    ++work[cell];
                }
            }
        }
    }
    /// Writes the records of those cells that the owner has.
    void send(ArchiveWriter& bytes, std::span<const int> owners, int owner) const {
        bytes(parcel(arrived_, arrived_cells_, owners, owner), parcel(scattered_, scattered_cells_, owners, owner));
    }
    /// Takes the records of its own cells, which need not be sent.
    void keep(std::span<const int> owners, int owner) {
        arrived_parcels_.push_back(parcel(arrived_, arrived_cells_, owners, owner));
        scattered_parcels_.push_back(parcel(scattered_, scattered_cells_, owners, owner));
    }
    /// Takes what another has sent.
    void receive(ArchiveReader& bytes) { bytes(arrived_parcels_.emplace_back(), scattered_parcels_.emplace_back()); }

    /// Fits with what was received; how many cells that has made, or more than there may be.
    std::uint64_t fit() {
        FitResult fitted =
            guide::fit(before_, opened<Record>(std::exchange(arrived_parcels_, {})), settings_, threads_);
        next_ = fit_scattered(std::move(fitted.field), opened<ScatterRecord>(std::exchange(scattered_parcels_, {})),
                              settings_.decay, threads_);
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

    template <class T>
    Parcel<T> parcel(const std::vector<T>& (PathRecords::*kind)() const,
                     const std::vector<std::vector<std::uint32_t>>& cells, std::span<const int> owners,
                     int owner) const {
        Parcel<T> parcel;
        std::size_t count = 0;
        for (const std::vector<std::uint32_t>& of_producer : cells) {
            count += static_cast<std::size_t>(std::count_if(of_producer.begin(), of_producer.end(),
                                                            [&](std::uint32_t cell) { return owners[cell] == owner; }));
        }
        parcel.records.reserve(count);
        for (std::size_t i = 0; i < producers_.size(); ++i) {
            const std::vector<T>& records = (producers_[i].*kind)();
            for (std::size_t k = 0; k < records.size(); ++k) {
                if (owners[cells[i][k]] == owner) {
                    parcel.add(i, records[k]);
                }
            }
        }
        return parcel;
    }

    const Field& before_;
    Producers producers_;
    const Records& (PathRecords::*arrived_)() const;
    const ScatterRecords& (PathRecords::*scattered_)() const;
    const FitSettings& settings_;
    int threads_;
    std::vector<std::vector<std::uint32_t>> arrived_cells_, scattered_cells_;
    std::vector<Parcel<Record>> arrived_parcels_;
    std::vector<Parcel<ScatterRecord>> scattered_parcels_;
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
        if (rank == own) {
            surface.keep(of_surface, team.rank());
            volume.keep(of_volume, team.rank());
            return;
        }
        ArchiveWriter bytes;
        surface.send(bytes, of_surface, static_cast<int>(rank));
        volume.send(bytes, of_volume, static_cast<int>(rank));
        messages[rank] = bytes.take();
    });
    messages = team.exchange(std::move(messages));
    for (std::size_t rank = 0; rank < messages.size(); ++rank) {
        if (rank == own) {
            continue;
        }
        const std::string message = std::exchange(messages[rank], {});
        ArchiveReader bytes(message);
        surface.receive(bytes);
        volume.receive(bytes);
        bytes.require(bytes.empty());
    }

    const std::vector<std::uint64_t> made = team.sum({surface.fit(), volume.fit()});
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
