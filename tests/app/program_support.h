// Running the wend program from tests: inside this process, or as a child that signals can reach.
#pragma once

#include <tests/support/scratch_folder.h>

#include <sys/resource.h>
#include <sys/types.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace wend::test {

/// What a run of the program left.
struct ProgramResult {
    int status = -1;
    std::string out;
    std::string err;

    /// Standard output as JSON; fails the test where it is anything else.
    nlohmann::json json() const;
};

/// Of a JSON object, in its order.
std::vector<std::string> keys(const nlohmann::json& object);

/// Runs `wend ARGUMENTS...` inside this process.
ProgramResult run_wend(const std::vector<std::string>& arguments);

/// The program's file.
std::string wend_program();

/// `wend ARGUMENTS...` as a process of its own: standard output is caught in a file of the folder, standard error is a
/// terminal. Killed at the end if it still runs.
class WendProcess {
public:
    WendProcess(const std::vector<std::string>& arguments, const ScratchFolder& folder);
    ~WendProcess();
    WendProcess(const WendProcess&) = delete;
    WendProcess& operator=(const WendProcess&) = delete;

    void signal(int number) const;
    /// Waits until the process draws its progress (anew): it renders. False where it ends without.
    bool wait_for_progress();
    /// Waits for the end. The status is minus the signal's number where one ended it.
    ProgramResult wait();

private:
    /// More of what the process writes to its terminal; false at its end.
    bool read_terminal();

    pid_t pid_ = -1;
    int terminal_ = -1;
    std::string err_;
    std::size_t seen_ = 0;  ///< so much of `err_` is older than the last progress that was waited for
    std::filesystem::path out_;
};

/// A soft limit on what this process, or one that it starts, may take; the old one returns at the end.
class ResourceLimit {
public:
    /// `resource` is an RLIMIT_ of setrlimit().
    ResourceLimit(int resource, std::uint64_t limit);
    ~ResourceLimit();
    ResourceLimit(const ResourceLimit&) = delete;
    ResourceLimit& operator=(const ResourceLimit&) = delete;

private:
    int resource_;
    rlimit old_{};
};

/// Ends this process (SIGXCPU) where it takes more than about ten seconds of processor time from here on: a bound that
/// other load on the machine does not touch.
ResourceLimit ten_more_seconds_of_work();

std::string read_text(const std::filesystem::path& file);

/// A foggy room with a lamp, 16 x 12 pixels: surfaces and a volume. `world` is appended to it.
std::string small_scene(const std::string& world = "");

}  // namespace wend::test
