#include <wend/core/contracts.h>
#include <wend/planar/albedo_inversion.h>
#include <wend/scene/texture.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// The pixel at (x, y), which may lie outside.
Rgb texel(const ImageTexture& t, int x, int y) {
    const Image& image = *t.image;
    const auto wrapped = [&](int i, int n) {
        if (t.wrap == ImageTexture::Wrap::repeat) {
            i %= n;
            return i < 0 ? i + n : i;
        }
        return std::clamp(i, 0, n - 1);
    };
    if (t.wrap == ImageTexture::Wrap::black && (x < 0 || y < 0 || x >= image.width || y >= image.height)) {
        return Rgb(0.0f);
    }
    return image.at(wrapped(x, image.width), wrapped(y, image.height));
}

Rgb bilinear(const ImageTexture& t, const Vec2& uv) {
    constexpr float far_away = 1e6f;  // keeps the conversion to int defined
    const float x = std::clamp(uv.x, -far_away, far_away) * static_cast<float>(t.image->width) - 0.5f;
    const float y = (1 - std::clamp(uv.y, -far_away, far_away)) * static_cast<float>(t.image->height) - 0.5f;
    const auto floor_of = [](float v) { return static_cast<int>(std::clamp(std::floor(v), -2e9f, 2e9f)); };
    const int x0 = floor_of(x);
    const int y0 = floor_of(y);
    const float fx = x - std::floor(x);
    const float fy = y - std::floor(y);
    return (texel(t, x0, y0) * (1 - fx) + texel(t, x0 + 1, y0) * fx) * (1 - fy) +
           (texel(t, x0, y0 + 1) * (1 - fx) + texel(t, x0 + 1, y0 + 1) * fx) * fy;
}

bool is_odd(float x) {
    return std::fmod(std::floor(x), 2.0f) != 0;
}

}  // namespace

TextureId Textures::add(Texture texture) {
    textures_.push_back(std::move(texture));
    return static_cast<TextureId>(textures_.size()) - 1;
}

const Rgb* Textures::constant(TextureId id) const {
    const auto* c = std::get_if<ConstantTexture>(&textures_[static_cast<std::size_t>(id)]);
    return c ? &c->value : nullptr;
}

Rgb Textures::evaluate(TextureId id, const TexturePoint& p) const {
    const Texture& texture = textures_[static_cast<std::size_t>(id)];
    if (const auto* c = std::get_if<ConstantTexture>(&texture)) {
        return c->value;
    }
    if (const auto* s = std::get_if<ScaleTexture>(&texture)) {
        return evaluate(s->texture, p) * evaluate(s->scale, p);
    }
    if (const auto* m = std::get_if<MixTexture>(&texture)) {
        const Rgb amount = evaluate(m->amount, p);
        return evaluate(m->first, p) * (Rgb(1.0f) - amount) + evaluate(m->second, p) * amount;
    }
    if (const auto* i = std::get_if<ImageTexture>(&texture)) {
        const Rgb value = bilinear(*i, i->mapping(p)) * i->scale;
        return i->invert ? Rgb(std::max(0.0f, 1 - value.r), std::max(0.0f, 1 - value.g), std::max(0.0f, 1 - value.b))
                         : value;
    }
    if (const auto* a = std::get_if<RelativeAlbedoTexture>(&texture)) {
        const Rgb reflectance = evaluate(a->reflectance, p);
        Rgb relative;
        for (int c = 0; c < 3; ++c) {
            relative[c] = a->albedo[c] > 0 ? (*a->albedo_of)(reflectance[c]) / a->albedo[c] : 0.0f;
        }
        return relative;
    }
    const auto& board = std::get<CheckerboardTexture>(texture);
    bool odd;
    if (board.dimensions == 3) {
        const Vec3 q = board.texture_from_world.point(p.position);
        odd = is_odd(q.x) ^ is_odd(q.y) ^ is_odd(q.z);
    } else {
        const Vec2 st = board.mapping(p);
        odd = is_odd(st.x) ^ is_odd(st.y);
    }
    return evaluate(odd ? board.odd : board.even, p);
}

}  // namespace wend
