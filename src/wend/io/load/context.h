// What every part of the scene loader shares.
#pragma once

#include <wend/io/pbrt/description.h>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// What is understood but not done as asked, each kind once.
class Warnings {
public:
    /// Adds `file:line:column: warning: text`, unless the text was there before.
    void add(const Place& place, const std::string& text);
    /// One warning for each parameter that nobody asked for: once for a name in directives of this kind and type.
    void add_unused(std::string_view directive, const pbrt::Entity& entity);
    void add_unused(const std::string& owner, const pbrt::ParameterSet& parameters);
    /// Adds those of others in their order, unless the text was there before.
    void add_all(const Warnings& others);

    const std::vector<std::string>& all() const { return all_; }

private:
    void add(const std::string& text, const std::string& message);

    std::set<std::string> texts_;
    std::vector<std::string> all_;
    std::vector<std::size_t> text_lengths_;  ///< of all: what they end with
};

class LoadedParts;

struct LoadContext {
    std::filesystem::path base_directory;
    Warnings warnings;
    bool is_for_pbrt = false;  ///< pbrt::Description::is_for_pbrt
    /// That were read so far, in order.
    std::shared_ptr<std::set<std::filesystem::path>> files = std::make_shared<std::set<std::filesystem::path>>();
    /// Triangles that subdivision led to so far.
    double subdivided = 0;
    /// Of an earlier scene whose directives are the same but for parameters; null: there is none.
    const LoadedParts* earlier = nullptr;
    /// For later ones, being filled; null: there will be none.
    LoadedParts* parts = nullptr;
    /// Those whose content was taken from the earlier scene, and not read again.
    std::set<std::filesystem::path> kept_files{};
};

/// The existing file that a string parameter names. Throws InputError at the parameter if there is none, at the
/// directive if the parameter is missing.
std::filesystem::path required_file(const LoadContext& context, const pbrt::Entity& entity, std::string_view parameter);

/// "Shape "frob" is unknown; known are ...", with the directive's place.
[[noreturn]] void refuse_type(std::string_view directive, const pbrt::Entity& entity,
                              std::initializer_list<std::string_view> known);

/// A float parameter that must be finite and above 0, or finite and not below 0; InputError at its place otherwise.
float positive_float(const pbrt::ParameterSet& parameters, std::string_view name, float fallback);
float non_negative_float(const pbrt::ParameterSet& parameters, std::string_view name, float fallback);

}  // namespace wend
