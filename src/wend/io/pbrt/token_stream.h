// The tokens of a scene across its files: the main file, what it includes and what it imports.
#pragma once

#include <wend/io/pbrt/lexer.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace wend::pbrt {

/// A stack of open files. Tokens come from the innermost; the end of a file is a token, and the reader decides where an
/// included file may end (between directives and between parameters, but not within either).
class TokenStream {
public:
    /// How a file was entered: the text of an included file continues that of its includer, an imported file stands
    /// alone.
    enum class Entry { include, import };

    /// `base_directory` is where file names in the text are looked up.
    TokenStream(std::string text, std::string name, const std::filesystem::path& base_directory, bool allow_includes);
    explicit TokenStream(const std::filesystem::path& file);

    const Token& peek() const { return top().peek(); }
    Token next() { return sources_.back()->lexer.next(); }
    /// The innermost open file: turns its tokens into values and places.
    const Lexer& top() const { return sources_.back()->lexer; }

    std::string next_string() { return top().string(next()); }
    double next_number() { return top().number(next()); }
    /// Throws InputError unless the next token is of this kind (a bracket).
    void expect(Token::Kind kind);

    /// Opens a file named at `place`, looked up beside the main file, then beside the file that names it. Throws
    /// InputError if it is missing, already open (a cycle), or if files are nested too deeply or are too many.
    void enter(const std::string& file_name, const Location& place, Entry entry);
    /// All files that were opened so far.
    const std::vector<std::filesystem::path>& files() const { return files_; }

    /// Closes the included files that have been read to their end.
    void leave_finished_includes();
    /// Closes an imported file.
    void leave_import();

private:
    struct Source {
        Source(std::string text, std::shared_ptr<const SourceFile> file, Entry entry);

        std::string text;
        Lexer lexer;
        Entry entry;
        std::filesystem::path path;  // canonical; empty if the text is no file
        Location opened_at;
    };

    void refuse_cycle(const std::filesystem::path& path, const Location& place) const;

    std::filesystem::path base_directory_;
    bool allow_includes_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::unique_ptr<Source>> sources_;
};

/// Where a file named in a scene file is: beside the main file, as pbrt has it, or else beside the file that names it.
/// The path need not exist.
std::filesystem::path find_file(const std::string& name, const Location& place,
                                const std::filesystem::path& base_directory);

}  // namespace wend::pbrt
