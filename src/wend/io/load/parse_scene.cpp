#include <wend/io/load/parse_scene.h>

#include <wend/io/load/message_length.h>
#include <wend/io/mitsuba/reader.h>
#include <wend/io/pbrt/parser.h>

namespace wend {

pbrt::Description parse_scene(const std::filesystem::path& file) {
    const std::filesystem::path plain = file.extension() == ".gz" ? file.stem() : file;
    return with_readable_messages(
        [&] { return plain.extension() == ".xml" ? mitsuba::read_scene(file) : pbrt::parse_file(file); });
}

pbrt::Description parse_scene(const std::string& text, const std::filesystem::path& folder, const std::string& name) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool is_xml = first != std::string::npos && text[first] == '<';
    return with_readable_messages(
        [&] { return is_xml ? mitsuba::read_scene(text, folder, name) : pbrt::parse_string(text, folder, name); });
}

}  // namespace wend
