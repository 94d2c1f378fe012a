// Running the wend program from tests: inside this process, or as a child that signals can reach.
#pragma once

#include <sys/types.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace wend::test {

/// A folder of its own for each test, removed at the end.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The path of a file in the folder, as an argument.
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    /// Writes a file into the folder; returns its path.
    std::string write(const std::string& name, std::string_view content) const;
    /// Names of all there is in the folder, hidden files included, in order.
    std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

/// What a run of the program left.
struct ProgramResult {
    int status = -1;
    std::string out;
    std::string err;

    /// Standard output as JSON; fails the test where it is anything else.
    nlohmann::json json() const;
};

/// Runs `wend ARGUMENTS...` inside this process.
ProgramResult run_wend(const std::vector<std::string>& arguments);

/// `wend ARGUMENTS...` as a process of its own, its streams caught in files of the folder. Killed at the end if it
/// still runs.
class WendProcess {
public:
    WendProcess(const std::vector<std::string>& arguments, const ScratchFolder& folder);
    ~WendProcess();
    WendProcess(const WendProcess&) = delete;
    WendProcess& operator=(const WendProcess&) = delete;

    void signal(int number) const;
    /// Waits until the process has a handler for this signal; false where it has none after ten seconds.
    bool wait_for_handler(int number) const;
    /// Waits for the end. The status is minus the signal's number where one ended it; -1000 after `seconds` in vain.
    ProgramResult wait(double seconds);

private:
    pid_t pid_ = -1;
    bool ended_ = false;
    std::filesystem::path out_;
    std::filesystem::path err_;
};

std::string read_text(const std::filesystem::path& file);

/// A foggy room with a lamp, 16 x 12 pixels: surfaces and a volume. `world` is appended to it.
std::string small_scene(const std::string& world = "");

}  // namespace wend::test
