// What subcommands that write pictures let one choose of OpenEXR files.
#pragma once

#include <wend/io/picture_format.h>

#include <string>

namespace CLI {
class App;
}

namespace wend {

struct PictureOptions {
    std::string names = "wend";
    std::string numbers = "float";
    bool alpha = false;

    void add_to(CLI::App& command);
    /// Throws InputError for what there is not.
    PictureFormat format() const;
};

}  // namespace wend
