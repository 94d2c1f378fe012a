// A scene that a program gives directive by directive, with arrays as they are: no file, and no text in between.
#pragma once

#include <wend/io/pbrt/description.h>
#include <wend/io/pbrt/description_builder.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wend::pbrt {

/// Throws InputError for what a file of the same directives could not have either. The line of a place is the number of
/// the directive, from 1.
class DirectiveSequence {
public:
    /// `name` stands for the file in messages; file names are relative to the folder.
    DirectiveSequence(std::string name, const std::filesystem::path& folder);

    /// A directive with the texts, or the numbers, that stand before its parameters, and these; their places and colour
    /// spaces are filled in here. Include and Import are for files.
    void add(std::string_view directive, std::vector<std::string> texts, std::span<const double> numbers,
             std::vector<Parameter> parameters);
    /// At the end, once.
    Description finish();

private:
    std::shared_ptr<const SourceFile> file_;
    DescriptionBuilder builder_;
    int directives_ = 0;
};

}  // namespace wend::pbrt
