// Textures of Mitsuba scenes.
#pragma once

#include <wend/io/mitsuba/directive.h>
#include <wend/io/mitsuba/spectra.h>
#include <wend/io/ply.h>

#include <map>
#include <string>
#include <tuple>

namespace wend::mitsuba {

/// How a "bitmap" goes on between its pixels, as pbrt calls it, and beyond them.
struct BitmapWays {
    std::string filter;  ///< "bilinear" or "point"
    std::string wrap;    ///< "repeat", "mirror" or "clamp"
};

/// Throws InputError for others.
BitmapWays ways_of_bitmap(const Object& texture);

/// Adds textures to the scene when they are first asked for.
class Textures {
public:
    /// The context must outlive this.
    explicit Textures(Context& context) : context_(context) {}

    /// What a property gives: a colour or number, or a texture of such; the fallback where it is absent. Throws
    /// InputError for a texture that there is not.
    ColourOrTexture colour(const Object& object, std::string_view name, const Rgb& fallback);
    NumberOrTexture number(const Object& object, std::string_view name, double fallback);

    /// A texture of an element, for a parameter of colours, or of numbers.
    TextureRef add_colours(const Element& texture) { return add(texture, "spectrum"); }
    TextureRef add_numbers(const Element& texture) { return add(texture, "float"); }
    /// Whose "mesh_attribute" textures are asked for from now on; null: a shape without any. It must outlive them.
    void set_mesh(const TriangleMeshData* mesh);
    /// Which of the meshes with attributes that is, from 1; 0: one without.
    int mesh_number() const { return mesh_ ? meshes_ : 0; }
    /// Of numbers: another times a factor, or 1 less another.
    TextureRef scaled(const TextureRef& texture, double factor, const pbrt::Location& place);
    TextureRef inverted(const TextureRef& texture, const pbrt::Location& place);
    /// Of numbers: 0 where a surface is seen from its front, 1 from its back.
    TextureRef behind(const pbrt::Location& place);

private:
    TextureRef add(const Element& texture, const std::string& kind);
    TextureRef add_made(const std::string& type, Parameters& p);
    void set_bitmap(const Object& texture, const std::string& kind, Parameters& p);
    void set_checkerboard(const Object& texture, const std::string& kind, Parameters& p);
    void set_volume(const Object& texture, const std::string& kind, Parameters& p);
    void set_attribute(const Object& texture, const std::string& kind, Parameters& p);

    Context& context_;
    std::map<std::tuple<const Element*, std::string, int>, TextureRef> known_;
    const TriangleMeshData* mesh_ = nullptr;
    int meshes_ = 0;
    std::string behind_;
    int depth_ = 0;
};

}  // namespace wend::mitsuba
