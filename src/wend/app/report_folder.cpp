#include <wend/app/report_folder.h>

#include <wend/core/error.h>
#include <wend/io/atomic_file.h>

namespace wend {

void make_report_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw InputError(Place{folder.string()}, "the folder cannot be made: " + error.message());
    }
    require_writable(folder / "index.html");
}

}  // namespace wend
