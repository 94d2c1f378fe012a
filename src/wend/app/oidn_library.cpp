#include <wend/app/oidn_library.h>

#include <wend/core/error.h>

#include <dlfcn.h>

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>
#include <type_traits>
#include <utility>

namespace wend {
namespace {

constexpr const char* library_name = "libOpenImageDenoise.so.2";

/// The library that the package pyoidn brought into a Python environment; empty where that has none.
std::filesystem::path library_of_environment(const std::filesystem::path& environment) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(environment / "lib", error), end; !error && entry != end;
         entry.increment(error)) {
        std::filesystem::path library = entry->path() / "site-packages/pyoidn/oidn/lib" / library_name;
        std::error_code ignored;
        if (std::filesystem::exists(library, ignored)) {
            return library;
        }
    }
    return {};
}

std::pair<std::string, void*> load_first(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
        if (void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
            return {file, handle};
        }
    }
    throw InputError(
        fmt::format("no Open Image Denoise: {} cannot be loaded; say where the library is (--oidn PATH, or WEND_OIDN), "
                    "or install it (pip install pyoidn)",
                    fmt::join(files, " or ")));
}

}  // namespace

std::vector<std::string> oidn_candidates(const std::filesystem::path& given) {
    const char* const named = std::getenv("WEND_OIDN");
    const std::filesystem::path only = given.empty() && named ? std::filesystem::path(named) : given;
    std::error_code ignored;
    if (!only.empty()) {
        return {std::filesystem::is_directory(only, ignored) ? (only / library_name).string() : only.string()};
    }
    std::vector<std::filesystem::path> environments;
    for (const char* const variable : {"VIRTUAL_ENV", "CONDA_PREFIX"}) {
        if (const char* const environment = std::getenv(variable)) {
            environments.emplace_back(environment);
        }
    }
    environments.push_back(std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().parent_path());
    std::vector<std::string> files{library_name};
    for (const std::filesystem::path& environment : environments) {
        const std::filesystem::path library = library_of_environment(environment);
        if (!library.empty()) {
            files.push_back(library.string());
        }
    }
    return files;
}

OidnLibrary::OidnLibrary(const std::vector<std::string>& files) {
    const auto [file, handle] = load_first(files);
    const auto find = [&file = file, handle = handle](const char* name, auto& function) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
        if (!function) {
            throw InputError(file + " is no Open Image Denoise of version 2: it lacks " + name);
        }
    };
    find("oidnNewDevice", new_device);
    find("oidnSetDeviceInt", set_device_int);
    find("oidnGetDeviceInt", get_device_int);
    find("oidnCommitDevice", commit_device);
    find("oidnReleaseDevice", release_device);
    find("oidnGetDeviceError", get_error);
    find("oidnNewFilter", new_filter);
    find("oidnSetSharedFilterImage", set_image);
    find("oidnSetFilterBool", set_bool);
    find("oidnCommitFilter", commit_filter);
    find("oidnExecuteFilter", execute);
    find("oidnReleaseFilter", release_filter);
}

}  // namespace wend
