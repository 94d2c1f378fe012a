#pragma once

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

}  // namespace wend::test
