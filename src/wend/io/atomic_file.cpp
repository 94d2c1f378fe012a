#include <wend/io/atomic_file.h>

#include <wend/core/error.h>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace wend {
namespace {

/// A name that no other writer of the same target uses, in this process or another. Its extension stays that of the
/// target.
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
    std::random_device device;
    std::filesystem::path temporary = target;
    temporary.replace_filename(
        fmt::format(".{}-{:08x}{}", target.stem().string(), device(), target.extension().string()));
    return temporary;
}

/// What goes wrong names the file that was asked for, where the writer named the temporary.
void write_for(const std::filesystem::path& target, const std::filesystem::path& temporary,
               const std::function<void(const std::filesystem::path&)>& write) {
    try {
        write(temporary);
    } catch (const std::runtime_error& error) {
        const std::string from = temporary.string(), to = target.string();
        std::string message = error.what();
        for (std::size_t at = message.find(from); at != std::string::npos; at = message.find(from, at + to.size())) {
            message.replace(at, from.size(), to);
        }
        throw std::runtime_error(message);
    }
}

/// Gives the temporary the mode and, where that is allowed, the owner of what it replaces.
void take_over_mode(const std::filesystem::path& temporary, const std::filesystem::path& target) {
    struct stat status;
    if (::stat(target.c_str(), &status) == 0) {
        static_cast<void>(::chown(temporary.c_str(), status.st_uid, status.st_gid) == 0);
        ::chmod(temporary.c_str(), status.st_mode & 07777);
    }
}

void copy_into(const std::filesystem::path& device, const std::filesystem::path& file) {
    errno = 0;
    std::ifstream from(file, std::ios::binary);
    std::ofstream to(device, std::ios::binary);
    to << from.rdbuf();
    to.close();
    if (!to) {
        throw std::runtime_error(device.string() + ": cannot write: " + std::strerror(errno));
    }
}

// A signal handler can reach nothing but objects of static storage. More files than this are not written at once.
std::array<std::atomic<const char*>, 64> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

/// A file of which only its own name is known, removed in the end.
class Temporary {
public:
    explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {
        for (std::atomic<const char*>& slot : unfinished) {
            const char* free = nullptr;
            if (slot.compare_exchange_strong(free, path_.c_str())) {
                slot_ = &slot;
                break;
            }
        }
    }
    ~Temporary() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
        if (slot_) {
            *slot_ = nullptr;
        }
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::atomic<const char*>* slot_ = nullptr;
};

}  // namespace

bool is_device(const std::filesystem::path& target) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(target, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

std::filesystem::path behind_links(const std::filesystem::path& target) {
    constexpr int most_links = 40;
    std::filesystem::path path = target;
    std::error_code error;
    for (int i = 0; i < most_links && std::filesystem::is_symlink(path, error); ++i) {
        path = path.parent_path() / std::filesystem::read_symlink(path, error);
    }
    return path;
}

void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
    if (is_device(target)) {
        const Temporary temporary(temporary_beside(std::filesystem::temp_directory_path() / target.filename()));
        write_for(target, temporary.path(), write);
        copy_into(target, temporary.path());
        return;
    }
    const std::filesystem::path file = behind_links(target);
    const Temporary temporary(temporary_beside(file));
    write_for(target, temporary.path(), write);
    take_over_mode(temporary.path(), file);
    std::filesystem::rename(temporary.path(), file);
}

void write_atomically(const std::filesystem::path& target, std::string_view content) {
    write_atomically(target, [&](const std::filesystem::path& temporary) {
        errno = 0;
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        stream.close();
        if (!stream) {
            throw std::runtime_error(target.string() + ": cannot write: " + std::strerror(errno));
        }
    });
}

void remove_unfinished_files() noexcept {
    for (const std::atomic<const char*>& slot : unfinished) {
        if (const char* const file = slot) {
            ::unlink(file);
        }
    }
}

void require_writable(const std::filesystem::path& target) {
    std::error_code error;
    if (std::filesystem::is_directory(target, error)) {
        throw InputError(Place{target.string()}, "cannot be written: it is a folder");
    }
    if (is_device(target)) {
        if (::access(target.c_str(), W_OK) != 0) {
            throw InputError(Place{target.string()}, std::string("cannot be written: ") + std::strerror(errno));
        }
        return;
    }
    const std::filesystem::path file = behind_links(target);
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error)) {
        throw InputError(Place{target.string()}, "cannot be written: there is no folder " + folder.string());
    }
    const Temporary temporary(temporary_beside(file));
    errno = 0;
    if (!std::ofstream(temporary.path(), std::ios::binary).is_open()) {
        throw InputError(Place{target.string()}, std::string("cannot be written: ") + std::strerror(errno));
    }
}

}  // namespace wend
