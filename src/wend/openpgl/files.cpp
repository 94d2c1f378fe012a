#include <wend/openpgl/files.h>

#include <wend/core/error.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace wend::openpgl {

std::string read_file(const char* name) {
    std::ifstream in(name, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (!in) {
        throw InputError(std::string(name) + ": the file cannot be read");
    }
    return bytes;
}

void write_file(const char* name, const std::string& bytes) {
    const std::string beside = std::string(name) + ".part";
    std::error_code error;
    {
        std::ofstream out(beside, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) {
            std::filesystem::remove(beside, error);
            throw InputError(std::string(name) + ": the file cannot be written");
        }
    }
    std::filesystem::rename(beside, name, error);
    if (error) {
        const std::string reason = error.message();
        std::filesystem::remove(beside, error);
        throw InputError(std::string(name) + ": " + reason);
    }
}

}  // namespace wend::openpgl
