// The processes that mpirun has started together.
#pragma once

#include <wend/core/ranks.h>

#include <cstdint>
#include <memory>

namespace wend {

/// This process and those started beside it to render one picture; null where it was started alone. There may be one at
/// a time, and one in the life of a process. Throws InputError where this program was built without MPI: each process
/// would render the whole picture, and all would write the same file.
std::unique_ptr<Ranks> ranks_of_job();

/// Bytes of memory that the largest of the processes has had so far; all ranks ask.
std::uint64_t most_memory_of(Ranks& ranks);

}  // namespace wend
