#include <wend/io/pbrt/parser.h>

#include <wend/io/pbrt/directives.h>
#include <wend/io/pbrt/parameter_reader.h>
#include <wend/io/pbrt/token_stream.h>

#include <fmt/format.h>

#include <array>
#include <span>
#include <utility>
#include <variant>

namespace wend::pbrt {
namespace {

/// Reads directives with their arguments and hands them to a builder.
class Parser {
public:
    Parser(TokenStream tokens, std::filesystem::path base_directory)
        : tokens_(std::move(tokens)), builder_(std::move(base_directory)) {}

    Description parse();

private:
    void read_directives();
    void read_directive();

    void read(const TypedDirective& syntax, const Location& place);
    void read(const NamedDirective& syntax, const Location& place);
    void read(const NumericDirective& syntax, const Location& place);
    void read(const PlainDirective& syntax, const Location& place) { (builder_.*syntax.act)(place); }
    void read(SpecialDirective syntax, const Location& place);

    void active_transform(const Location& place);
    void attribute(const Location& place);
    void import_file(const Location& place);
    void include(const Location& place);
    void medium_interface(const Location& place);
    void option(const Location& place);
    void texture(const Location& place);

    ParameterSet parameters(const Location& place) {
        return read_parameters(
            tokens_, place, builder_.colour_space(),
            [this](const Parameter& last, const Parameter& earlier) { builder_.warn_of_repeated(last, earlier); });
    }
    Location next_location() const { return tokens_.top().location(tokens_.peek()); }

    TokenStream tokens_;
    DescriptionBuilder builder_;
};

Description Parser::parse() {
    read_directives();
    Description description = builder_.finish(next_location());
    description.files = tokens_.files();
    description.is_for_pbrt = true;
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
    const Directive* directive = token.kind == Token::Kind::word ? find_directive(token.text) : nullptr;
    if (!directive) {
        if (token.kind == Token::Kind::word && builder_.version3().skips(token.text, place)) {
            return;
        }
        throw InputError(place, fmt::format("expected a directive, found {}", describe(token)));
    }
    require_place(*directive, builder_.in_world(), place);
    std::visit([&](const auto& syntax) { read(syntax, place); }, directive->syntax);
}

void Parser::read(const TypedDirective& syntax, const Location& place) {
    std::string type = tokens_.next_string();
    (builder_.*syntax.act)(std::move(type), parameters(place), place);
}

void Parser::read(const NamedDirective& syntax, const Location& place) {
    (builder_.*syntax.act)(tokens_.next_string(), place);
}

void Parser::read(const NumericDirective& syntax, const Location& place) {
    if (syntax.has_brackets) {
        tokens_.expect(Token::Kind::open);
    }
    std::array<double, NumericDirective::most> numbers{};
    for (std::size_t i = 0; i < syntax.count; ++i) {
        numbers[i] = tokens_.next_number();
    }
    if (syntax.has_brackets) {
        tokens_.expect(Token::Kind::close);
    }
    (builder_.*syntax.act)(std::span(numbers).first(syntax.count), place);
}

void Parser::read(SpecialDirective syntax, const Location& place) {
    switch (syntax) {
        case SpecialDirective::active_transform:
            return active_transform(place);
        case SpecialDirective::attribute:
            return attribute(place);
        case SpecialDirective::import:
            return import_file(place);
        case SpecialDirective::include:
            return include(place);
        case SpecialDirective::medium_interface:
            return medium_interface(place);
        case SpecialDirective::option:
            return option(place);
        case SpecialDirective::texture:
            return texture(place);
    }
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
