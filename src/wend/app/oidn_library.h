// Open Image Denoise as a library that is looked for and loaded at run time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace wend {

/// Files that may be the library, to try in turn. `given`, a file or a folder, is the only one; so is what the
/// environment's WEND_OIDN names. Otherwise: the system's, and that which the package pyoidn brought into the Python
/// environments that are active (VIRTUAL_ENV, CONDA_PREFIX) or that the program lies in.
std::vector<std::string> oidn_candidates(const std::filesystem::path& given);

/// The functions of the library's interface for C, as its documentation has them.
struct OidnLibrary {
    using Object = void*;
    static constexpr int cpu = 1, three_floats = 3;

    Object (*new_device)(int) = nullptr;
    void (*set_device_int)(Object, const char*, int) = nullptr;
    int (*get_device_int)(Object, const char*) = nullptr;
    void (*commit_device)(Object) = nullptr;
    void (*release_device)(Object) = nullptr;
    int (*get_error)(Object, const char**) = nullptr;
    Object (*new_filter)(Object, const char*) = nullptr;
    void (*set_image)(Object, const char*, void*, int, std::size_t, std::size_t, std::size_t, std::size_t,
                      std::size_t) = nullptr;
    void (*set_bool)(Object, const char*, bool) = nullptr;
    void (*commit_filter)(Object) = nullptr;
    void (*execute)(Object) = nullptr;
    void (*release_filter)(Object) = nullptr;

    /// Loads the first of the files that can be loaded; it stays loaded, for threads of its own may end late. Throws
    /// InputError, in one sentence, where none can be, or where it is another library.
    explicit OidnLibrary(const std::vector<std::string>& files);
};

}  // namespace wend
