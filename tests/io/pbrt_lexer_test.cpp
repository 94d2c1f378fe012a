#include <tests/io/pbrt_support.h>
#include <wend/io/pbrt/lexer.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wend::pbrt {
namespace {

using Kind = Token::Kind;

Lexer lexer_of(std::string_view text) {
    return Lexer(text, std::make_shared<const SourceFile>(SourceFile{"t.pbrt", {}}));
}

double number_in(std::string_view text) {
    Lexer lexer = lexer_of(text);
    return lexer.number(lexer.next());
}

TEST(PbrtLexer, SplitsWordsStringsAndBrackets) {
    Lexer lexer = lexer_of("Shape\"a b\"[1 2.5]# comment [\r\nEnd#x");
    const std::vector<std::pair<Kind, std::string>> expected = {
        {Kind::word, "Shape"}, {Kind::string, "a b"}, {Kind::open, "["},  {Kind::word, "1"},
        {Kind::word, "2.5"},   {Kind::close, "]"},    {Kind::word, "End"}};
    for (const auto& [kind, text] : expected) {
        const Token token = lexer.next();
        EXPECT_EQ(token.kind, kind);
        EXPECT_EQ(token.text, text);
    }
    EXPECT_EQ(lexer.next().kind, Kind::end);
    EXPECT_EQ(lexer.next().kind, Kind::end);
}

TEST(PbrtLexer, CountsLinesAndColumnsFromOne) {
    Lexer lexer = lexer_of("a\n  \"b\" c\n#d\n\n\te");
    const std::vector<std::pair<int, int>> expected = {{1, 1}, {2, 3}, {2, 7}, {5, 2}};
    for (const auto& [line, column] : expected) {
        const Token token = lexer.next();
        EXPECT_EQ(token.line, line);
        EXPECT_EQ(token.column, column);
    }
}

TEST(PbrtLexer, PeekingDoesNotConsume) {
    Lexer lexer = lexer_of("a b");
    EXPECT_TRUE(lexer.peek().is_word("a"));
    EXPECT_TRUE(lexer.next().is_word("a"));
    EXPECT_TRUE(lexer.peek().is_word("b"));
}

TEST(PbrtLexer, ReplacesEscapes) {
    Lexer lexer = lexer_of(R"("a\"b\\c\td\ne\'")");
    EXPECT_EQ(lexer.string(lexer.next()), "a\"b\\c\td\ne'");
    EXPECT_EQ(lexer.peek().kind, Kind::end);
}

TEST(PbrtLexer, ReadsNumbers) {
    EXPECT_EQ(number_in("-12"), -12);
    EXPECT_EQ(number_in("+3"), 3);
    EXPECT_EQ(number_in(".5"), 0.5);
    EXPECT_EQ(number_in("5."), 5);
    EXPECT_EQ(number_in("-1.25e-2"), -0.0125);
    EXPECT_EQ(number_in("1e-400"), 0);
    Lexer lexer = lexer_of("2147483647 -2147483648 1e-60");
    EXPECT_EQ(lexer.integer(lexer.next()), 2147483647);
    EXPECT_EQ(lexer.integer(lexer.next()), -2147483647 - 1);
    EXPECT_EQ(lexer.float_number(lexer.next()), 0);
}

TEST(PbrtLexer, RefusesWhatIsNoFiniteNumber) {
    for (const char* text : {"nan", "inf", "-inf", "1e400", "1x", "--1", "+-1", "+", "\"1\"", "[", "0x10", ""}) {
        EXPECT_THROW(number_in(text), InputError) << text;
    }
    for (const char* text : {"1.5", "1e3", "2147483648", "-2147483649", "99999999999999999999", "one"}) {
        Lexer lexer = lexer_of(text);
        EXPECT_THROW(lexer.integer(lexer.next()), InputError) << text;
    }
    Lexer lexer = lexer_of("1e39");
    EXPECT_THROW(lexer.float_number(lexer.next()), InputError);
}

TEST(PbrtLexer, ErrorsNameTheirPlace) {
    EXPECT_EQ(message_of([] { lexer_of("\n \"abc\n\""); }),
              "t.pbrt:2:2: error: the string has no closing quote on its line");
    EXPECT_PRED2(contains, message_of([] {
                     Lexer lexer = lexer_of("  \"ab\\q\"");
                     lexer.string(lexer.next());
                 }),
                 "t.pbrt:1:6: error: unknown escape");
    EXPECT_EQ(message_of([] { number_in("\n\n abc"); }), "t.pbrt:3:2: error: expected a number, found \"abc\"");
    EXPECT_EQ(message_of([] { number_in("  "); }), "t.pbrt:1:3: error: expected a number, found the end of the file");
}

TEST(PbrtLexer, MessagesStayPrintableAndShort) {
    const std::string message = message_of([] { number_in(std::string(1000, '\x01')); });
    EXPECT_LT(message.size(), 150u);
    EXPECT_EQ(message.find('\x01'), std::string::npos);
}

TEST(PbrtLexer, KnowsByteOrderMarks) {
    EXPECT_EQ(number_in("\xef\xbb\xbf"
                        "7"),
              7);
    EXPECT_THROW(lexer_of("\xff\xfe"
                          "7"),
                 InputError);
}

}  // namespace
}  // namespace wend::pbrt
