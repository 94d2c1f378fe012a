#include <wend/io/pbrt/parameter_reader.h>

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace wend::pbrt {
namespace {

struct Declaration {
    ParameterType type;
    std::string name;
};

Declaration read_declaration(const Lexer& lexer, const Token& token) {
    std::istringstream words(lexer.string(token));
    std::string type_name;
    std::string name;
    std::string excess;
    words >> type_name >> name >> excess;
    if (name.empty() || !excess.empty()) {
        throw InputError(lexer.location(token),
                         fmt::format("expected a parameter, \"type name\", found {}", describe(token)));
    }
    const auto type = parameter_type_named(type_name);
    if (!type) {
        throw InputError(lexer.location(token),
                         fmt::format("{}: unknown parameter type; known: {}", describe(token), parameter_type_names()));
    }
    return {*type, std::move(name)};
}

bool boolean(const Lexer& lexer, const Token& token) {
    const bool is_value = token.kind == Token::Kind::word || token.kind == Token::Kind::string;
    if (!is_value || (token.text != "true" && token.text != "false")) {
        throw InputError(lexer.location(token), fmt::format("expected true or false, found {}", describe(token)));
    }
    return token.text == "true";
}

// One bare value, or any number in brackets.
template <typename Read>
auto read_values(TokenStream& tokens, Read read) {
    std::vector<decltype(read(tokens.top(), Token()))> values;
    const Token first = tokens.next();
    if (first.kind != Token::Kind::open) {
        values.push_back(read(tokens.top(), first));
        return values;
    }
    for (Token token = tokens.next(); token.kind != Token::Kind::close; token = tokens.next()) {
        values.push_back(read(tokens.top(), token));
    }
    values.shrink_to_fit();
    return values;
}

std::vector<float> read_floats(TokenStream& tokens) {
    return read_values(tokens, [](const Lexer& lexer, const Token& token) { return lexer.float_number(token); });
}

std::vector<std::string> read_strings(TokenStream& tokens) {
    return read_values(tokens, [](const Lexer& lexer, const Token& token) { return lexer.string(token); });
}

// Names or numbers: the first value decides.
ParameterValues read_spectrum(TokenStream& tokens) {
    const Token first = tokens.peek();
    if (first.kind == Token::Kind::string) {
        return std::vector<std::string>{tokens.next_string()};
    }
    tokens.expect(Token::Kind::open);
    const bool named = tokens.peek().kind == Token::Kind::string;
    std::vector<std::string> names;
    std::vector<float> numbers;
    for (Token token = tokens.next(); token.kind != Token::Kind::close; token = tokens.next()) {
        if (named) {
            names.push_back(tokens.top().string(token));
        } else {
            numbers.push_back(tokens.top().float_number(token));
        }
    }
    return named ? ParameterValues(std::move(names)) : ParameterValues(std::move(numbers));
}

ParameterValues read_values_of(ParameterType type, TokenStream& tokens) {
    switch (type) {
        case ParameterType::integer:
            return read_values(tokens, [](const Lexer& lexer, const Token& token) { return lexer.integer(token); });
        case ParameterType::boolean:
            return read_values(tokens, boolean);
        case ParameterType::string:
        case ParameterType::texture:
            return read_strings(tokens);
        case ParameterType::spectrum:
            return read_spectrum(tokens);
        default:
            return read_floats(tokens);
    }
}

void check_whole_elements(const Parameter& parameter) {
    const std::size_t size = std::visit([](const auto& list) { return list.size(); }, parameter.values);
    const auto components = static_cast<std::size_t>(components_of(parameter.type));
    const bool numbers = std::holds_alternative<std::vector<float>>(parameter.values);
    if (size == 0) {
        throw InputError(parameter.place, fmt::format("\"{}\": the list of values is empty", parameter.name));
    }
    if (numbers && size % components != 0) {
        throw InputError(parameter.place, fmt::format("\"{}\": {} takes groups of {} numbers, but there are {}",
                                                      parameter.name, to_string(parameter.type), components, size));
    }
}

// The type of a bare value.
ParameterType type_of_value(const Token& token) {
    if (token.kind == Token::Kind::string) {
        return ParameterType::string;
    }
    if (token.is_word("true") || token.is_word("false")) {
        return ParameterType::boolean;
    }
    return token.text.find_first_of(".eE") == std::string_view::npos ? ParameterType::integer : ParameterType::real;
}

Parameter read_parameter(TokenStream& tokens, ColourSpace colour_space) {
    const Token token = tokens.next();
    Parameter parameter;
    parameter.place = tokens.top().location(token);
    parameter.colour_space = colour_space;
    Declaration declaration = read_declaration(tokens.top(), token);
    parameter.type = declaration.type;
    parameter.name = std::move(declaration.name);
    parameter.values = read_values_of(parameter.type, tokens);
    check_whole_elements(parameter);
    return parameter;
}

}  // namespace

Parameter read_option(TokenStream& tokens, ColourSpace colour_space) {
    const Token token = tokens.peek();
    const bool declares_a_type = token.kind == Token::Kind::string && token.text.find(' ') != std::string_view::npos;
    if (declares_a_type) {
        return read_parameter(tokens, colour_space);
    }
    Parameter option;
    option.place = tokens.top().location(token);
    option.colour_space = colour_space;
    option.name = tokens.next_string();
    option.type = type_of_value(tokens.peek());
    option.values = read_values_of(option.type, tokens);
    check_whole_elements(option);
    return option;
}

ParameterSet read_parameters(TokenStream& tokens, const Location& directive, ColourSpace colour_space,
                             const OnRepeated& on_repeated) {
    ParameterSet parameters(directive, colour_space);
    while (true) {
        tokens.leave_finished_includes();
        if (tokens.peek().is_word("Include")) {
            const Location place = tokens.top().location(tokens.next());
            tokens.enter(tokens.next_string(), place, TokenStream::Entry::include);
        } else if (tokens.peek().kind == Token::Kind::string) {
            Parameter parameter = read_parameter(tokens, colour_space);
            const Parameter last{parameter.type, parameter.name, parameter.place, parameter.colour_space, {}};
            if (const auto earlier = parameters.add(std::move(parameter))) {
                on_repeated(last, *earlier);
            }
        } else {
            return parameters;
        }
    }
}

}  // namespace wend::pbrt
