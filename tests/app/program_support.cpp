#include "program_support.h"

#include <wend/app/program.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace wend::test {
namespace {

std::vector<const char*> with_program_name(const std::vector<std::string>& arguments) {
    std::vector<const char*> pointers{"wend"};
    for (const std::string& argument : arguments) {
        pointers.push_back(argument.c_str());
    }
    return pointers;
}

}  // namespace

nlohmann::json ProgramResult::json() const {
    const nlohmann::json parsed = nlohmann::json::parse(out, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << "standard output is not JSON: " << out << err;
    return parsed;
}

std::vector<std::string> keys(const nlohmann::json& object) {
    std::vector<std::string> names;
    for (const auto& [name, value] : object.items()) {
        names.push_back(name);
    }
    return names;
}

ProgramResult run_wend(const std::vector<std::string>& arguments) {
    const std::vector<const char*> argv = with_program_name(arguments);
    std::ostringstream out, err;
    ProgramResult result;
    result.status = run_program(static_cast<int>(argv.size()), argv.data(), out, err);
    result.out = out.str();
    result.err = err.str();
    return result;
}

std::string wend_program() {
    return WEND_PROGRAM;
}

WendProcess::WendProcess(const std::vector<std::string>& arguments, const ScratchFolder& folder)
    : terminal_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)), out_(folder.path() / "stdout.txt") {
    if (terminal_ < 0 || grantpt(terminal_) != 0 || unlockpt(terminal_) != 0) {
        throw std::runtime_error("there is no pseudo-terminal");
    }
    std::vector<const char*> argv = with_program_name(arguments);
    argv.push_back(nullptr);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, ptsname(terminal_), O_RDWR | O_NOCTTY, 0);
    const int failed =
        posix_spawn(&pid_, WEND_PROGRAM, &streams, nullptr, const_cast<char* const*>(argv.data()), environ);
    posix_spawn_file_actions_destroy(&streams);
    if (failed != 0) {
        close(terminal_);
        throw std::runtime_error("the program does not start: " WEND_PROGRAM);
    }
}

WendProcess::~WendProcess() {
    if (pid_ > 0) {
        signal(SIGKILL);
        wait();
    }
    close(terminal_);
}

void WendProcess::signal(int number) const {
    kill(pid_, number);
}

bool WendProcess::read_terminal() {
    char text[1024];
    ssize_t size = 0;
    do {
        size = read(terminal_, text, sizeof text);
    } while (size < 0 && errno == EINTR);
    // Where the other side is closed, a terminal answers with an error.
    err_.append(text, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return size > 0;
}

bool WendProcess::wait_for_progress() {
    seen_ = err_.size();
    while (err_.find("\r", seen_) == std::string::npos) {
        if (!read_terminal()) {
            return false;
        }
    }
    return true;
}

ProgramResult WendProcess::wait() {
    while (read_terminal()) {
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    ProgramResult result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result.out = read_text(out_);
    result.err = err_;
    return result;
}

ResourceLimit::ResourceLimit(int resource, std::uint64_t limit) : resource_(resource) {
    getrlimit(resource_, &old_);
    const rlimit lowered{std::min<rlim_t>(limit, old_.rlim_max), old_.rlim_max};
    if (setrlimit(resource_, &lowered) != 0) {
        throw std::runtime_error("a resource cannot be limited");
    }
}

ResourceLimit::~ResourceLimit() {
    setrlimit(resource_, &old_);
}

ResourceLimit ten_more_seconds_of_work() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {RLIMIT_CPU, static_cast<std::uint64_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + 12};
}

std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string small_scene(const std::string& world) {
    return R"(# A foggy room with a lamp.
Integrator "volpath" "integer maxdepth" [ 8 ]
MakeNamedMedium "fog" "string type" "homogeneous"
  "rgb sigma_a" [ 0.06 0.06 0.06 ] "rgb sigma_s" [ 0.5 0.4 0.3 ] "float g" [ 0.5 ]
MediumInterface "" "fog"
LookAt 0 1 5.2  0 1 0  0 1 0
Camera "perspective" "float fov" [ 32 ]
Sampler "sobol" "integer pixelsamples" [ 4 ]
PixelFilter "gaussian" "float xradius" [ 1.5 ] "float yradius" [ 1.5 ]
Film "rgb" "integer xresolution" [ 16 ] "integer yresolution" [ 12 ] "string filename" "room.exr"
WorldBegin
MediumInterface "fog" "fog"
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
Shape "trianglemesh" "point3 P" [ -1 0 -1  -1 0 1  1 0 1  1 0 -1 ] "integer indices" [ 0 1 2 0 2 3 ]
Shape "trianglemesh" "point3 P" [ -1 0 -1  1 0 -1  1 2 -1  -1 2 -1 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 12 12 12 ] "bool twosided" [ true ]
  Shape "trianglemesh" "point3 P" [ -0.5 1.9 -0.5  -0.5 1.9 0.5  0.5 1.9 0.5  0.5 1.9 -0.5 ]
    "integer indices" [ 0 2 1 0 3 2 ]
AttributeEnd
AttributeBegin
  Translate 0.4 0.4 0.2
  Material "conductor" "rgb reflectance" [ 0.8 0.5 0.3 ] "float roughness" [ 0.3 ]
  Shape "sphere" "float radius" [ 0.4 ]
AttributeEnd
)" + world;
}

}  // namespace wend::test
