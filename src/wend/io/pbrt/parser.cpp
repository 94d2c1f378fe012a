#include <wend/io/pbrt/description_builder.h>
#include <wend/io/pbrt/parameter_reader.h>
#include <wend/io/pbrt/parser.h>
#include <wend/io/pbrt/token_stream.h>

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

namespace wend::pbrt {
namespace {

using Builder = DescriptionBuilder;

/// Reads directives with their arguments and hands them to a builder.
class Parser {
public:
    Parser(TokenStream tokens, std::filesystem::path base_directory)
        : tokens_(std::move(tokens)), builder_(std::move(base_directory)) {}

    Description parse();

private:
    // Where a directive may stand, relative to WorldBegin.
    enum class Where { before_world, in_world, anywhere };

    // What follows the name of a directive, and what to do with it.
    struct Plain {
        void (Builder::*act)(const Location&);
    };
    struct Named {  // "name"
        void (Builder::*act)(const std::string&, const Location&);
    };
    struct Typed {  // "type" and parameters
        void (Builder::*act)(std::string, ParameterSet, const Location&);
    };
    struct Numeric {  // so many numbers
        std::size_t count;
        void (Builder::*act)(std::span<const double>, const Location&);
    };
    struct Matrix {  // [ 16 numbers ]
        void (Builder::*act)(std::span<const double>, const Location&);
    };
    struct Special {
        void (Parser::*act)(const Location&);
    };
    struct Directive {
        Where where;
        std::variant<Plain, Named, Typed, Numeric, Matrix, Special> syntax;
    };

    static const std::unordered_map<std::string_view, Directive>& directives();

    void read_directives();
    void read_directive();

    void read(const Plain& syntax, const Location& place) { (builder_.*syntax.act)(place); }
    void read(const Named& syntax, const Location& place);
    void read(const Typed& syntax, const Location& place);
    void read(const Numeric& syntax, const Location& place);
    void read(const Matrix& syntax, const Location& place);
    void read(const Special& syntax, const Location& place) { (this->*syntax.act)(place); }

    void active_transform(const Location& place);
    void attribute(const Location& place);
    void import_file(const Location& place);
    void include(const Location& place);
    void medium_interface(const Location& place);
    void option(const Location& place);
    void texture(const Location& place);

    template <std::size_t n>
    std::array<double, n> next_numbers(std::size_t count = n);
    ParameterSet parameters(const Location& place) {
        return read_parameters(
            tokens_, place, builder_.colour_space(),
            [this](const Parameter& last, const Parameter& earlier) { builder_.warn_of_repeated(last, earlier); });
    }
    Location next_location() const { return tokens_.top().location(tokens_.peek()); }

    TokenStream tokens_;
    Builder builder_;
};

const std::unordered_map<std::string_view, Parser::Directive>& Parser::directives() {
    constexpr Where options = Where::before_world;
    constexpr Where world = Where::in_world;
    constexpr Where anywhere = Where::anywhere;
    static const std::unordered_map<std::string_view, Directive> table = {
        {"Accelerator", {options, Typed{&Builder::accelerator}}},
        {"ActiveTransform", {anywhere, Special{&Parser::active_transform}}},
        {"AreaLightSource", {world, Typed{&Builder::area_light_source}}},
        {"Attribute", {anywhere, Special{&Parser::attribute}}},
        {"AttributeBegin", {world, Plain{&Builder::attribute_begin}}},
        {"AttributeEnd", {world, Plain{&Builder::attribute_end}}},
        {"Camera", {options, Typed{&Builder::camera}}},
        {"ColorSpace", {anywhere, Named{&Builder::colour_space}}},
        {"ConcatTransform", {anywhere, Matrix{&Builder::concat_transform}}},
        {"CoordinateSystem", {anywhere, Named{&Builder::coordinate_system}}},
        {"CoordSysTransform", {anywhere, Named{&Builder::coord_sys_transform}}},
        {"Film", {options, Typed{&Builder::film}}},
        {"Identity", {anywhere, Plain{&Builder::identity}}},
        {"Import", {world, Special{&Parser::import_file}}},
        {"Include", {anywhere, Special{&Parser::include}}},
        {"Integrator", {options, Typed{&Builder::integrator}}},
        {"LightSource", {world, Typed{&Builder::light_source}}},
        {"LookAt", {anywhere, Numeric{9, &Builder::look_at}}},
        {"MakeNamedMaterial", {world, Typed{&Builder::make_named_material}}},
        {"MakeNamedMedium", {anywhere, Typed{&Builder::make_named_medium}}},
        {"Material", {world, Typed{&Builder::material}}},
        {"MediumInterface", {anywhere, Special{&Parser::medium_interface}}},
        {"NamedMaterial", {world, Named{&Builder::named_material}}},
        {"ObjectBegin", {world, Named{&Builder::object_begin}}},
        {"ObjectEnd", {world, Plain{&Builder::object_end}}},
        {"ObjectInstance", {world, Named{&Builder::object_instance}}},
        {"Option", {options, Special{&Parser::option}}},
        {"PixelFilter", {options, Typed{&Builder::pixel_filter}}},
        {"ReverseOrientation", {world, Plain{&Builder::reverse_orientation}}},
        {"Rotate", {anywhere, Numeric{4, &Builder::rotate}}},
        {"Sampler", {options, Typed{&Builder::sampler}}},
        {"Scale", {anywhere, Numeric{3, &Builder::scale}}},
        {"Shape", {world, Typed{&Builder::shape}}},
        {"Texture", {world, Special{&Parser::texture}}},
        {"Transform", {anywhere, Matrix{&Builder::transform}}},
        {"TransformBegin", {world, Plain{&Builder::transform_begin}}},
        {"TransformEnd", {world, Plain{&Builder::transform_end}}},
        {"TransformTimes", {options, Numeric{2, &Builder::transform_times}}},
        {"Translate", {anywhere, Numeric{3, &Builder::translate}}},
        {"WorldBegin", {options, Plain{&Builder::world_begin}}},
    };
    return table;
}

Description Parser::parse() {
    read_directives();
    Description description = builder_.finish(next_location());
    description.files = tokens_.files();
    return description;
}

// Until the end of the main or imported file.
void Parser::read_directives() {
    while (true) {
        tokens_.leave_finished_includes();
        if (tokens_.peek().kind == Token::Kind::end) {
            return;
        }
        read_directive();
    }
}

void Parser::read_directive() {
    const Token token = tokens_.next();
    const Location place = tokens_.top().location(token);
    const auto entry = token.kind == Token::Kind::word ? directives().find(token.text) : directives().end();
    if (entry == directives().end()) {
        if (token.kind == Token::Kind::word && builder_.version3().skips(token.text, place)) {
            return;
        }
        throw InputError(place, fmt::format("expected a directive, found {}", describe(token)));
    }
    const Directive& directive = entry->second;
    if (directive.where == Where::before_world && builder_.in_world()) {
        throw InputError(place, fmt::format("{} is not allowed after WorldBegin", entry->first));
    }
    if (directive.where == Where::in_world && !builder_.in_world()) {
        throw InputError(place, fmt::format("{} is not allowed before WorldBegin", entry->first));
    }
    std::visit([&](const auto& syntax) { read(syntax, place); }, directive.syntax);
}

template <std::size_t n>
std::array<double, n> Parser::next_numbers(std::size_t count) {
    std::array<double, n> numbers{};
    for (std::size_t i = 0; i < count; ++i) {
        numbers[i] = tokens_.next_number();
    }
    return numbers;
}

void Parser::read(const Named& syntax, const Location& place) {
    (builder_.*syntax.act)(tokens_.next_string(), place);
}

void Parser::read(const Typed& syntax, const Location& place) {
    std::string type = tokens_.next_string();
    (builder_.*syntax.act)(std::move(type), parameters(place), place);
}

void Parser::read(const Numeric& syntax, const Location& place) {
    const auto numbers = next_numbers<9>(syntax.count);
    (builder_.*syntax.act)(std::span(numbers).first(syntax.count), place);
}

void Parser::read(const Matrix& syntax, const Location& place) {
    tokens_.expect(Token::Kind::open);
    const auto numbers = next_numbers<16>();
    tokens_.expect(Token::Kind::close);
    (builder_.*syntax.act)(numbers, place);
}

void Parser::active_transform(const Location&) {
    const Location place = next_location();
    const Token which = tokens_.next();
    if (which.is_word("StartTime")) {
        builder_.active_transform(ActiveTransform::start);
    } else if (which.is_word("EndTime")) {
        builder_.active_transform(ActiveTransform::end);
    } else if (which.is_word("All")) {
        builder_.active_transform(ActiveTransform::all);
    } else {
        throw InputError(place, fmt::format("expected StartTime, EndTime or All, found {}", describe(which)));
    }
}

void Parser::attribute(const Location& place) {
    const std::string target = tokens_.next_string();
    builder_.attribute(target, parameters(place), place);
}

void Parser::import_file(const Location& place) {
    tokens_.enter(tokens_.next_string(), place, TokenStream::Entry::import);
    builder_.begin_import(place);
    read_directives();
    builder_.end_import(next_location());
    tokens_.leave_import();
}

void Parser::include(const Location& place) {
    tokens_.enter(tokens_.next_string(), place, TokenStream::Entry::include);
}

void Parser::medium_interface(const Location& place) {
    const std::string interior = tokens_.next_string();
    const bool has_two = tokens_.peek().kind == Token::Kind::string;
    builder_.medium_interface(interior, has_two ? tokens_.next_string() : interior, place);
}

void Parser::option(const Location&) {
    builder_.option(read_option(tokens_, builder_.colour_space()));
}

void Parser::texture(const Location& place) {
    std::string name = tokens_.next_string();
    std::string kind = tokens_.next_string();
    std::string type = tokens_.next_string();
    builder_.texture(std::move(name), std::move(kind), std::move(type), parameters(place), place);
}

}  // namespace

Description parse_file(const std::filesystem::path& file) {
    return Parser(TokenStream(file), file.parent_path()).parse();
}

Description parse_string(std::string text, const std::filesystem::path& base_directory, std::string name,
                         const ParseOptions& options) {
    TokenStream tokens(std::move(text), std::move(name), base_directory, options.allow_includes);
    return Parser(std::move(tokens), base_directory).parse();
}

}  // namespace wend::pbrt
