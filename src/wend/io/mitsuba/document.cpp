#include <wend/io/mitsuba/document.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/tags.h>
#include <wend/io/mitsuba/version0.h>
#include <wend/io/mitsuba/xml_text.h>
#include <wend/io/pbrt/text_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace wend::mitsuba {
namespace {

constexpr int deepest_element = 64;
constexpr std::size_t most_attributes = 64;  // of an element
constexpr std::size_t deepest_include = 15, most_includes = 1000;
constexpr std::size_t most_bytes = std::size_t{256} << 20;
// What parameters may be called, and may add up to where their values take the places of their names.
constexpr std::size_t longest_name = 64, most_folders = 100;
constexpr std::size_t longest_value = std::size_t{1} << 20, most_substituted = std::size_t{64} << 20;
// Of pugixml's nodes and of ours together some 400 bytes each.
constexpr std::size_t most_markup = 10'000'000;

/// A file while it is read.
struct OpenFile {
    std::filesystem::path path;  ///< canonical; empty if the text is no file
    std::shared_ptr<const pbrt::SourceFile> source;
    const XmlText* text = nullptr;
    bool is_version0 = false;
};

class DocumentReader {
public:
    explicit DocumentReader(bool allow_includes) : allow_includes_(allow_includes) {}

    Document read(const std::filesystem::path& file) {
        document_.base_directory = file.parent_path();
        return finish(read_file(file, {}));
    }

    Document read(const std::string& text, const std::filesystem::path& folder, const std::string& name) {
        document_.base_directory = folder;
        return finish(read_text(text, {}, std::make_shared<pbrt::SourceFile>(pbrt::SourceFile{name, folder}), {}));
    }

private:
    Document finish(std::unique_ptr<Element> root) {
        if (root->tag != "scene") {
            throw InputError(root->place, fmt::format("expected <scene>, found <{}>", root->tag));
        }
        document_.root = std::move(root);
        return std::move(document_);
    }

    std::unique_ptr<Element> read_file(const std::filesystem::path& file, const pbrt::Location& place) {
        std::error_code ignored;
        const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, ignored);
        for (const OpenFile* open : open_) {
            if (open->path == canonical) {
                throw InputError(place, fmt::format("\"{}\" includes itself", file.string()));
            }
        }
        if (!open_.empty() && std::filesystem::is_fifo(file, ignored)) {
            throw InputError(place, fmt::format("\"{}\" is a pipe, which may never end", file.string()));
        }
        const std::string text = pbrt::read_text_file(file, place);
        document_.files.push_back(file);
        const auto source = std::make_shared<pbrt::SourceFile>(pbrt::SourceFile{file.string(), file.parent_path()});
        return read_text(text, canonical, source, place);
    }

    std::unique_ptr<Element> read_text(const std::string& text, const std::filesystem::path& path,
                                       std::shared_ptr<const pbrt::SourceFile> source, const pbrt::Location& place) {
        bytes_ += text.size();
        markup_ += static_cast<std::size_t>(
            std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }));
        if (bytes_ > most_bytes || markup_ > most_markup) {
            throw InputError(place.file ? Place(place) : Place{source->name, 0, 0},
                             fmt::format("a scene is at most {} MiB of XML with {} elements and attributes",
                                         most_bytes >> 20, most_markup));
        }
        const XmlText xml(text, source->name);
        OpenFile file{path, std::move(source), &xml, false};
        open_.push_back(&file);
        const pugi::xml_node node = xml.root();
        file.is_version0 = is_version0(node);
        std::unique_ptr<Element> root = read_object(node, 1);
        open_.pop_back();
        return root;
    }

    pbrt::Location place_of(const pugi::xml_node& node) const {
        const auto [line, column] = open_.back()->text->line_and_column(node.offset_debug() - 1);
        return {open_.back()->source, line, column};
    }

    /// Whether the root element is of a version whose names were others.
    bool is_version0(const pugi::xml_node& root) const {
        const std::string_view version = root.attribute("version").value();
        if (version.empty() || !std::isdigit(static_cast<unsigned char>(version.front()))) {
            throw InputError(place_of(root),
                             fmt::format("<{}> needs the attribute \"version\", such as \"3.0.0\"", root.name()));
        }
        return version.starts_with("0.") || version.starts_with("1.");
    }

    /// The element alone, without its children.
    std::unique_ptr<Element> read_element(const pugi::xml_node& node) {
        auto element = std::make_unique<Element>();
        element->tag = node.name();
        element->place = place_of(node);
        for (const pugi::xml_attribute& attribute : node.attributes()) {
            // Each is compared with all before.
            if (element->attributes.size() == most_attributes) {
                throw InputError(element->place, fmt::format("an element has at most {} attributes", most_attributes));
            }
            if (element->has(attribute.name())) {
                throw InputError(element->place, fmt::format("the attribute \"{}\" is given twice", attribute.name()));
            }
            element->attributes.emplace_back(attribute.name(), substituted(attribute.value(), element->place));
        }
        if (open_.back()->is_version0) {
            rename_version0(*element);
        }
        return element;
    }

    /// An element that is an object or, in the end, what such a one has.
    std::unique_ptr<Element> read_object(const pugi::xml_node& node, int depth) {
        std::unique_ptr<Element> element = read_element(node);
        const TagKind kind = check_tag(*element);
        if (depth > deepest_element) {
            throw InputError(element->place, fmt::format("elements are nested more than {} deep", deepest_element));
        }
        if (kind != TagKind::object && kind != TagKind::transform) {
            refuse_children(node, *element);
            return element;
        }
        define(*element);
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element) {
                add_child(child, *element, kind, depth + 1);
            }
        }
        if (open_.back()->is_version0) {
            complete_version0(*element);
        }
        return element;
    }

    void add_child(const pugi::xml_node& node, Element& parent, TagKind parent_kind, int depth) {
        std::unique_ptr<Element> child = read_object(node, depth);
        const TagKind kind = check_tag(*child);
        if ((kind == TagKind::step) != (parent_kind == TagKind::transform)) {
            throw InputError(child->place, fmt::format("<{}> cannot be in <{}>", child->tag, parent.tag));
        }
        switch (kind) {
            case TagKind::include:
                return include(*child, parent);
            case TagKind::alias:
                return alias(*child);
            case TagKind::parameter:
                return set_parameter(*child);
            case TagKind::folder:
                return add_folder(*child);
            default:
                parent.children.push_back(std::move(child));
        }
    }

    void set_parameter(const Element& element) {
        const std::string_view name = element.attribute("name");
        if (name.empty() || name.size() > longest_name) {
            throw InputError(element.place,
                             fmt::format("the name of a parameter has 1 to {} characters", longest_name));
        }
        parameters_.try_emplace(std::string(name), element.attribute("value"));
    }

    void add_folder(const Element& element) {
        if (document_.folders.size() >= most_folders) {
            throw InputError(element.place, fmt::format("there are more than {} <path>", most_folders));
        }
        std::filesystem::path folder = find_file(document_, element.attribute("value"), element.place);
        std::error_code ignored;
        if (!std::filesystem::is_directory(folder, ignored)) {
            throw InputError(element.place, fmt::format("there is no folder \"{}\"", folder.string()));
        }
        document_.folders.insert(document_.folders.begin(), std::move(folder));
    }

    static void refuse_children(const pugi::xml_node& node, const Element& element) {
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element) {
                throw InputError(element.place, fmt::format("<{}> cannot be in <{}>", child.name(), element.tag));
            }
        }
    }

    void define(const Element& element) {
        const std::string_view id = element.attribute("id");
        if (!id.empty()) {
            define(std::string(id), element, element.place);
        }
    }

    void define(const std::string& id, const Element& element, const pbrt::Location& place) {
        const auto [known, is_new] = document_.ids.try_emplace(id, &element);
        if (!is_new) {
            throw InputError(place, fmt::format("the id \"{}\" is that of <{}> at {} already", id, known->second->tag,
                                                to_string(Place(known->second->place))));
        }
    }

    void alias(const Element& element) {
        const auto known = document_.ids.find(std::string(element.attribute("id")));
        if (known == document_.ids.end()) {
            throw InputError(element.place, fmt::format("nothing before has the id \"{}\"", element.attribute("id")));
        }
        define(std::string(element.attribute("as")), *known->second, element.place);
    }

    /// A scene's children come in its place; any other object itself does.
    void include(const Element& element, Element& parent) {
        if (!allow_includes_) {
            throw InputError(element.place, "this text may not include files");
        }
        if (open_.size() > deepest_include || ++includes_ > most_includes) {
            throw InputError(element.place, fmt::format("files include each other more than {} deep, or {} times",
                                                        deepest_include, most_includes));
        }
        std::unique_ptr<Element> root =
            read_file(find_file(document_, element.attribute("filename"), element.place), element.place);
        if (root->tag != "scene") {
            if (element.has("name")) {
                std::erase_if(root->attributes, [](const auto& a) { return a.first == "name"; });
                root->attributes.emplace_back("name", element.attribute("name"));
            }
            parent.children.push_back(std::move(root));
            return;
        }
        for (std::unique_ptr<Element>& child : root->children) {
            parent.children.push_back(std::move(child));
        }
    }

    /// A text with the values of parameters in the place of `$name`: of those that begin so, the longest name.
    std::string substituted(std::string_view text, const pbrt::Location& place) {
        std::string result;
        for (std::size_t dollar = text.find('$'); dollar != std::string_view::npos; dollar = text.find('$')) {
            const std::string_view rest = text.substr(dollar + 1);
            std::size_t length = std::min(rest.size(), longest_name);
            auto parameter = parameters_.end();
            for (; length > 0 && parameter == parameters_.end(); length -= parameter == parameters_.end() ? 1 : 0) {
                parameter = parameters_.find(rest.substr(0, length));
            }
            if (parameter == parameters_.end()) {
                throw InputError(place, fmt::format("\"${}\" is not defined: <default> gives a parameter its value",
                                                    rest.substr(0, longest_name)));
            }
            result.append(text.substr(0, dollar)).append(parameter->second);
            substituted_ += parameter->second.size();
            if (result.size() > longest_value || substituted_ > most_substituted) {
                throw InputError(place, "the values of parameters add up to far too long a text");
            }
            text = rest.substr(length);
        }
        return result.append(text);
    }

    bool allow_includes_;
    Document document_;
    std::vector<const OpenFile*> open_;
    std::map<std::string, std::string, std::less<>> parameters_;
    std::size_t bytes_ = 0, markup_ = 0, includes_ = 0, substituted_ = 0;
};

}  // namespace

Document read_document(const std::filesystem::path& file) {
    return DocumentReader(true).read(file);
}

Document read_document(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                       bool allow_includes) {
    return DocumentReader(allow_includes).read(text, folder, name);
}

std::filesystem::path find_file(const Document& document, std::string_view name, const pbrt::Location& place) {
    const std::filesystem::path path(name);
    if (path.is_absolute()) {
        return path;
    }
    std::vector<std::filesystem::path> folders{place.file ? place.file->directory : document.base_directory};
    folders.insert(folders.end(), document.folders.begin(), document.folders.end());
    folders.push_back(document.base_directory);
    for (const std::filesystem::path& folder : folders) {
        std::error_code ignored;
        if (std::filesystem::exists(folder / path, ignored)) {
            return folder / path;
        }
    }
    return folders.front() / path;
}

}  // namespace wend::mitsuba
