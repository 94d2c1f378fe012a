#include <wend/io/pbrt/token_stream.h>

#include <wend/io/pbrt/text_file.h>

#include <fmt/format.h>

#include <utility>

namespace wend::pbrt {
namespace {

constexpr std::size_t deepest_nesting = 64;
// A few small files that include each other twice, level by level, would otherwise keep the reader busy for ever.
constexpr std::size_t most_files = 100'000;

}  // namespace

std::filesystem::path find_file(const std::string& name, const Location& place,
                                const std::filesystem::path& base_directory) {
    std::error_code ignored;
    const std::filesystem::path beside_main = base_directory / name;
    if (place.file && !std::filesystem::exists(beside_main, ignored)) {
        const std::filesystem::path beside = place.file->directory / name;
        if (std::filesystem::exists(beside, ignored)) {
            return beside;
        }
    }
    return beside_main;
}

TokenStream::Source::Source(std::string text_, std::shared_ptr<const SourceFile> file, Entry entry_)
    : text(std::move(text_)), lexer(text, std::move(file)), entry(entry_) {
}

TokenStream::TokenStream(std::string text, std::string name, const std::filesystem::path& base_directory,
                         bool allow_includes)
    : base_directory_(base_directory), allow_includes_(allow_includes) {
    auto file = std::make_shared<const SourceFile>(SourceFile{std::move(name), base_directory});
    sources_.push_back(std::make_unique<Source>(std::move(text), std::move(file), Entry::import));
}

TokenStream::TokenStream(const std::filesystem::path& file)
    : TokenStream(read_text_file(file, Place{file.string()}), file.string(), file.parent_path(), true) {
    std::error_code ignored;
    sources_.back()->path = std::filesystem::weakly_canonical(file, ignored);
    files_.push_back(file);
}

void TokenStream::expect(Token::Kind kind) {
    const Token token = next();
    if (token.kind != kind) {
        throw InputError(top().location(token),
                         fmt::format("expected {}, found {}", describe({kind, {}}), describe(token)));
    }
}

void TokenStream::refuse_cycle(const std::filesystem::path& path, const Location& place) const {
    for (const auto& source : sources_) {
        if (source->path == path && !path.empty()) {
            const std::string where = source->opened_at.file ? "it was opened at " + to_string(Place(source->opened_at))
                                                             : std::string("it is the main file");
            throw InputError(place, fmt::format("\"{}\" includes itself: {}", path.string(), where));
        }
    }
}

void TokenStream::enter(const std::string& file_name, const Location& place, Entry entry) {
    if (!allow_includes_) {
        throw InputError(place, "other files may not be included here");
    }
    const std::filesystem::path path = find_file(file_name, place, base_directory_);
    std::error_code ignored;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, ignored);
    refuse_cycle(canonical, place);
    if (std::filesystem::is_fifo(path, ignored)) {
        throw InputError(place, fmt::format("\"{}\" is a pipe, which may never end", path.string()));
    }
    if (sources_.size() >= deepest_nesting) {
        throw InputError(place, fmt::format("files are included more than {} deep", deepest_nesting));
    }
    if (files_.size() > most_files) {
        throw InputError(place, fmt::format("more than {} files are included", most_files));
    }
    auto file = std::make_shared<const SourceFile>(SourceFile{path.string(), path.parent_path()});
    auto source = std::make_unique<Source>(read_text_file(path, place), std::move(file), entry);
    source->path = canonical;
    source->opened_at = place;
    sources_.push_back(std::move(source));
    files_.push_back(path);
}

void TokenStream::leave_finished_includes() {
    while (peek().kind == Token::Kind::end && sources_.back()->entry == Entry::include) {
        sources_.pop_back();
    }
}

void TokenStream::leave_import() {
    sources_.pop_back();
}

}  // namespace wend::pbrt
