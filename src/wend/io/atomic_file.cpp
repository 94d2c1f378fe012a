#include <wend/core/error.h>
#include <wend/io/atomic_file.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

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

}  // namespace

void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
    const std::filesystem::path temporary = temporary_beside(target);
    try {
        write(temporary);
        std::filesystem::rename(temporary, target);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
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

void require_writable(const std::filesystem::path& target) {
    std::error_code error;
    if (std::filesystem::is_directory(target, error)) {
        throw InputError(Place{target.string()}, "cannot be written: it is a folder");
    }
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error)) {
        throw InputError(Place{target.string()}, "cannot be written: there is no folder " + folder.string());
    }
    const std::filesystem::path temporary = temporary_beside(target);
    errno = 0;
    const bool opened = std::ofstream(temporary, std::ios::binary).is_open();
    const int reason = errno;
    std::filesystem::remove(temporary, error);
    if (!opened) {
        throw InputError(Place{target.string()}, std::string("cannot be written: ") + std::strerror(reason));
    }
}

}  // namespace wend
