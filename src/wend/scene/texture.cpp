#include <wend/scene/texture.h>

#include <wend/core/contracts.h>
#include <wend/planar/albedo_inversion.h>
#include <wend/scene/picture_lookup.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// The pixel at (x, y), which may lie outside.
Rgb texel(const ImageTexture& t, int x, int y) {
    const Image& image = *t.image;
    const auto repeated = [](int i, int n) {
        i %= n;
        return i < 0 ? i + n : i;
    };
    switch (t.wrap) {
        case ImageTexture::Wrap::repeat:
            return image.at(repeated(x, image.width), repeated(y, image.height));
        case ImageTexture::Wrap::mirror: {
            const int column = repeated(x, 2 * image.width), row = repeated(y, 2 * image.height);
            return image.at(std::min(column, 2 * image.width - 1 - column), std::min(row, 2 * image.height - 1 - row));
        }
        case ImageTexture::Wrap::black:
            if (x < 0 || y < 0 || x >= image.width || y >= image.height) {
                return Rgb(0.0f);
            }
            break;
        case ImageTexture::Wrap::octahedral_sphere:
            return octahedral_pixel(image, x, y);
        case ImageTexture::Wrap::clamp:
            break;
    }
    return image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
}

Rgb look_up(const ImageTexture& t, const Vec2& st) {
    // Keeps the conversion to int defined.
    constexpr float far_away = 1e6f, farthest_pixel = 2e9f;
    const auto in_pixels = [=](float x, int pixels) {
        const float near = std::isnan(x) ? 0.0f : std::clamp(x, -far_away, far_away);
        return std::clamp(near * static_cast<float>(pixels), -farthest_pixel, farthest_pixel);
    };
    const Vec2 place(in_pixels(st.x, t.image->width), in_pixels(1 - st.y, t.image->height));
    if (t.nearest) {
        return texel(t, static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
    }
    return bilinear(place, [&](int i, int j) { return texel(t, i, j); });
}

bool is_odd(float x) {
    return std::fmod(std::floor(x), 2.0f) != 0;
}

/// Whether a point lies in a dot: in some of the cells around the integers, by noise, there is one, moved a little.
bool is_in_dot(const Vec2& st) {
    constexpr float radius = 0.35f, most_shift = 0.5f - radius;
    const float s = std::floor(st.x + 0.5f), t = std::floor(st.y + 0.5f);
    if (!(perlin_noise(s + 0.5f, t + 0.5f) > 0)) {
        return false;
    }
    const Vec2 centre(s + most_shift * perlin_noise(s + 1.5f, t + 2.8f),
                      t + most_shift * perlin_noise(s + 4.5f, t + 9.8f));
    return sqr(st.x - centre.x) + sqr(st.y - centre.y) < sqr(radius);
}

/// The colours of marble along a wave, t in [0, 1]: a row of cubic Bezier curves, each of which shares all but one of
/// its points with the next.
Rgb marble_colour(float t) {
    constexpr int points = 9, curves = points - 3;
    constexpr float light = 1.5f;
    static const Rgb colours[points] = {{0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f},
                                        {0.5f, 0.5f, 0.5f},   {0.6f, 0.59f, 0.58f}, {0.58f, 0.58f, 0.6f},
                                        {0.58f, 0.58f, 0.6f}, {0.2f, 0.2f, 0.33f},  {0.58f, 0.58f, 0.6f}};
    const int first = std::clamp(static_cast<int>(t * curves), 0, curves - 1);
    const float u = t * curves - static_cast<float>(first), w = 1 - u;
    const Rgb* c = colours + first;
    return (c[0] * (w * w * w) + c[1] * (3 * u * w * w) + c[2] * (3 * u * u * w) + c[3] * (u * u * u)) * light;
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
    return std::visit([&](const auto& texture) { return value_of(texture, p); },
                      textures_[static_cast<std::size_t>(id)]);
}

Rgb Textures::value_of(const ScaleTexture& t, const TexturePoint& p) const {
    return evaluate(t.texture, p) * evaluate(t.scale, p);
}

Rgb Textures::value_of(const MixTexture& t, const TexturePoint& p) const {
    const Rgb amount = evaluate(t.amount, p);
    return evaluate(t.first, p) * (Rgb(1.0f) - amount) + evaluate(t.second, p) * amount;
}

Rgb Textures::value_of(const DirectionMixTexture& t, const TexturePoint& p) const {
    const float amount = std::abs(dot(p.normal, t.direction));
    return evaluate(t.first, p) * amount + evaluate(t.second, p) * (1 - amount);
}

Rgb Textures::value_of(const FacingTexture& t, const TexturePoint& p) const {
    const std::size_t last = t.values->size() - 1;
    const float place = std::clamp(p.facing, 0.0f, 1.0f) * static_cast<float>(last);
    const std::size_t below = std::min(static_cast<std::size_t>(place), last);
    const Rgb &a = (*t.values)[below], &b = (*t.values)[std::min(below + 1, last)];
    return a + (b - a) * (place - static_cast<float>(below));
}

Rgb Textures::value_of(const MeshTexture& t, const TexturePoint& p) const {
    const std::size_t first = 3 * (p.triangle % (t.indices->size() / 3));
    const auto corner = [&](std::size_t i) { return (*t.values)[(*t.indices)[first + i]]; };
    return corner(0) * (1 - p.of_corners.x - p.of_corners.y) + corner(1) * p.of_corners.x + corner(2) * p.of_corners.y;
}

Rgb Textures::value_of(const BilerpTexture& t, const TexturePoint& p) const {
    const Vec2 st = map_to_texture(t.mapping, p);
    return (t.v00 * (1 - st.x) + t.v10 * st.x) * (1 - st.y) + (t.v01 * (1 - st.x) + t.v11 * st.x) * st.y;
}

Rgb Textures::value_of(const ImageTexture& t, const TexturePoint& p) const {
    const Rgb picture = look_up(t, map_to_texture(t.mapping, p)) * t.scale;
    const Rgb value = t.invert ? Rgb(1.0f) - picture : picture;
    return {std::clamp(value.r, t.least, t.most), std::clamp(value.g, t.least, t.most),
            std::clamp(value.b, t.least, t.most)};
}

Rgb Textures::value_of(const CheckerboardTexture& t, const TexturePoint& p) const {
    bool odd;
    if (t.dimensions == 3) {
        const Vec3 q = t.texture_from_world.point(p.position);
        odd = is_odd(q.x) ^ is_odd(q.y) ^ is_odd(q.z);
    } else {
        const Vec2 st = map_to_texture(t.mapping, p);
        odd = is_odd(st.x) ^ is_odd(st.y);
    }
    return evaluate(odd ? t.odd : t.even, p);
}

Rgb Textures::value_of(const DotsTexture& t, const TexturePoint& p) const {
    return evaluate(is_in_dot(map_to_texture(t.mapping, p)) ? t.dot : t.ground, p);
}

Rgb Textures::value_of(const NoiseTexture& t, const TexturePoint& p) const {
    const Vec3 q = t.texture_from_world.point(p.position);
    switch (t.kind) {
        case NoiseTexture::Kind::fractal:
            return Rgb(fractal_noise(q, t.octaves));
        case NoiseTexture::Kind::wrinkled:
            return Rgb(turbulence(q, t.octaves));
        case NoiseTexture::Kind::windy:
            break;
    }
    constexpr Octaves wind{3, 0.5f}, waves{6, 0.5f};
    return Rgb(std::abs(fractal_noise(q * 0.1f, wind)) * fractal_noise(q, waves));
}

Rgb Textures::value_of(const MarbleTexture& t, const TexturePoint& p) const {
    const Vec3 q = t.texture_from_world.point(p.position) * t.scale;
    const float phase = q.y + t.displacement * fractal_noise(q, t.octaves);
    return marble_colour(0.5f + 0.5f * std::sin(phase));
}

Rgb Textures::value_of(const RelativeAlbedoTexture& t, const TexturePoint& p) const {
    const Rgb reflectance = evaluate(t.reflectance, p);
    Rgb relative;
    for (int c = 0; c < 3; ++c) {
        relative[c] = t.albedo[c] > 0 ? (*t.albedo_of)(reflectance[c]) / t.albedo[c] : 0.0f;
    }
    return relative;
}

}  // namespace wend
