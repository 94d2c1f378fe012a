#include <wend/app/mpi_ranks.h>
#include <wend/core/error.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

#ifdef WEND_MPI
#define OMPI_SKIP_MPICXX  // the old bindings for C++
#define MPICH_SKIP_MPICXX
#include <mpi.h>
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

class MpiRanks : public Ranks {
public:
    MpiRanks() {
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

    std::vector<std::string> gather(const std::string& mine) override {
        std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_));
        const std::uint64_t size = mine.size();
        require(MPI_Allgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD));
        std::vector<std::string> all(sizes.size());
        for (int rank = 0; rank < size_; ++rank) {
            std::string& said = all[static_cast<std::size_t>(rank)];
            if (rank == rank_) {
                said = mine;
            } else {
                said.resize(sizes[static_cast<std::size_t>(rank)]);
            }
            // One message holds no more than an int can count.
            constexpr std::size_t most = std::size_t{1} << 28;
            for (std::size_t begin = 0; begin < said.size(); begin += most) {
                const auto count = static_cast<int>(std::min(most, said.size() - begin));
                require(MPI_Bcast(said.data() + begin, count, MPI_BYTE, rank, MPI_COMM_WORLD));
            }
        }
        return all;
    }

private:
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
