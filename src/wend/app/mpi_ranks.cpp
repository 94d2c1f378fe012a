#include <wend/app/mpi_ranks.h>

#include <wend/core/error.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#ifdef WEND_MPI
#define OMPI_SKIP_MPICXX  // the old bindings for C++
#define MPICH_SKIP_MPICXX
#include <mpi.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#endif

namespace wend {
namespace {

/// Launchers of Open MPI, MPICH and Slurm tell the processes that they start.
bool was_started_beside_others() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        const char* const size = std::getenv(name);
        if (size && std::atoi(size) > 1) {
            return true;
        }
    }
    return false;
}

#ifdef WEND_MPI

/// Messages of many megabytes come and go with every pass. Memory that is given back after each has to be cleared by
/// the system for the next: a few per cent of all time.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

class MpiRanks : public Ranks {
public:
    MpiRanks() {
        keep_freed_memory();
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    }
    ~MpiRanks() override {
        // Others would be waited for that do not know of an error. The launcher ends them, and passes on the status.
        if (std::uncaught_exceptions() == exceptions_) {
            MPI_Finalize();
        }
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }

    std::vector<std::string> gather(std::string mine) override {
        std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_));
        const std::uint64_t size = mine.size();
        MPI_Request request;
        require(MPI_Iallgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request));
        wait(request);
        std::vector<std::string> all(sizes.size());
        all[static_cast<std::size_t>(rank_)] = std::move(mine);
        for (int rank = 0; rank < size_; ++rank) {
            std::string& said = all[static_cast<std::size_t>(rank)];
            said.resize(sizes[static_cast<std::size_t>(rank)]);
            in_messages(said, [&](char* bytes, int count) {
                require(MPI_Bcast(bytes, count, MPI_BYTE, rank, MPI_COMM_WORLD));
            });
        }
        return all;
    }

    std::vector<std::string> exchange(std::vector<std::string> mine) override {
        std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_)), others(sizes.size());
        std::transform(mine.begin(), mine.end(), sizes.begin(), [](const std::string& said) { return said.size(); });
        MPI_Request request;
        require(MPI_Ialltoall(sizes.data(), 1, MPI_UINT64_T, others.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request));
        wait(request);
        std::vector<std::string> all(sizes.size());
        std::vector<MPI_Request> requests;
        for (int rank = 0; rank < size_; ++rank) {
            const auto i = static_cast<std::size_t>(rank);
            if (rank == rank_) {
                all[i] = std::move(mine[i]);
                continue;
            }
            all[i].resize(others[i]);
            in_messages(all[i], [&](char* bytes, int count) {
                require(MPI_Irecv(bytes, count, MPI_BYTE, rank, 0, MPI_COMM_WORLD, &requests.emplace_back()));
            });
        }
        for (int step = 1; step < size_; ++step) {
            const int rank = (rank_ + step) % size_;
            in_messages(mine[static_cast<std::size_t>(rank)], [&](char* bytes, int count) {
                require(MPI_Isend(bytes, count, MPI_BYTE, rank, 0, MPI_COMM_WORLD, &requests.emplace_back()));
            });
        }
        require(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
        return all;
    }

    std::vector<std::uint64_t> sum(std::vector<std::uint64_t> mine) override {
        MPI_Request request;
        require(MPI_Iallreduce(MPI_IN_PLACE, mine.data(), static_cast<int>(mine.size()), MPI_UINT64_T, MPI_SUM,
                               MPI_COMM_WORLD, &request));
        wait(request);
        return mine;
    }

private:
    /// One message holds no more than an int can count.
    template <class Message>
    static void in_messages(std::string& text, const Message& message) {
        constexpr std::size_t most = std::size_t{1} << 28;
        for (std::size_t begin = 0; begin < text.size(); begin += most) {
            message(text.data() + begin, static_cast<int>(std::min(most, text.size() - begin)));
        }
    }
    /// Until all ranks have come so far. Unlike MPI's own waiting it leaves the core to others, which may be what is
    /// waited for where there are more ranks than cores; what that costs is a small part of the time that was waited.
    static void wait(MPI_Request& request) {
        using Clock = std::chrono::steady_clock;
        constexpr auto soon = std::chrono::microseconds(50), longest = std::chrono::microseconds(1000);
        const Clock::time_point start = Clock::now();
        for (int has_ended = 0;;) {
            require(MPI_Test(&request, &has_ended, MPI_STATUS_IGNORE));
            if (has_ended) {
                return;
            }
            if (const auto waited = Clock::now() - start; waited > soon) {
                std::this_thread::sleep_for(std::min<Clock::duration>(longest, waited / 8));
            }
        }
    }
    static void require(int error) {
        if (error != MPI_SUCCESS) {
            throw std::runtime_error("a rank is lost: the render ends; it can be resumed from its last checkpoint");
        }
    }

    int rank_ = 0, size_ = 1;
    int exceptions_ = std::uncaught_exceptions();
};

#endif

}  // namespace

std::unique_ptr<Ranks> ranks_of_job() {
    if (!was_started_beside_others()) {
        return nullptr;
    }
#ifdef WEND_MPI
    return std::make_unique<MpiRanks>();
#else
    throw InputError("this program was started beside others, as by mpirun, but built without MPI (libopenmpi-dev)");
#endif
}

std::uint64_t most_memory_of(Ranks& ranks) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    constexpr std::uint64_t unit = 1024;
    std::uint64_t most = 0;
    for (const std::string& said : ranks.gather(std::to_string(unit * static_cast<std::uint64_t>(used.ru_maxrss)))) {
        most = std::max<std::uint64_t>(most, std::stoull(said));
    }
    return most;
}

}  // namespace wend
