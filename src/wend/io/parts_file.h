// Files that hold the bytes of several values, one after another.
#pragma once

#include <wend/core/error.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// Writes a signature and the parts. The file appears whole or not at all.
void write_parts(const std::filesystem::path& file, std::string_view signature, std::span<const std::string> parts);

/// The content of such a file.
class PartsFile {
public:
    /// Throws InputError naming the file when it is missing, does not begin with the signature (it is then "no file of"
    /// `what`) or has not as many parts. Of the last ones, `optional` may be missing.
    PartsFile(const std::filesystem::path& file, std::string_view signature, std::size_t count, const std::string& what,
              std::size_t optional = 0);

    std::size_t size() const { return parts_.size(); }

    /// What `decode` makes of a part; its InputError is made to name the file.
    template <class Decode>
    auto decode(std::size_t part, Decode&& decode) const {
        try {
            return decode(parts_[part]);
        } catch (const InputError& error) {
            throw InputError(place_, error.what());
        }
    }

private:
    Place place_;
    std::string content_;
    std::vector<std::string_view> parts_;
};

}  // namespace wend
