#include <wend/io/load/artists_materials.h>

namespace wend {

PrincipledMaterial principled_surface(TextureLoader& textures, const pbrt::ParameterSet& p) {
    PrincipledMaterial material;
    material.base = textures.colour(p, "reflectance", Rgb(0.5f));
    material.metallic = textures.real(p, "metallic", 0);
    material.roughness = textures.real(p, "roughness", 0.5f);
    material.specular = textures.real(p, "specular", 1);
    material.coat = textures.real(p, "coat", 0);
    material.coat_roughness = textures.real(p, "coatroughness", 0.03f);
    material.anisotropy = textures.find_real(p, "anisotropy").value_or(-1);
    material.specular_tint = textures.find_colour(p, "speculartint", SpectrumKind::reflectance).value_or(-1);
    material.coat_tint = textures.find_colour(p, "coattint", SpectrumKind::reflectance).value_or(-1);
    material.diffuse_roughness = textures.find_real(p, "diffuseroughness").value_or(-1);
    material.sheen = textures.find_real(p, "sheen").value_or(-1);
    material.sheen_tint = textures.find_colour(p, "sheentint", SpectrumKind::reflectance).value_or(-1);
    material.sheen_roughness = textures.real(p, "sheenroughness", 0.5f);
    return material;
}

DisneyMaterial disney_surface(TextureLoader& textures, const pbrt::ParameterSet& p) {
    DisneyMaterial material;
    material.base = textures.colour(p, "reflectance", Rgb(0.5f));
    material.roughness = textures.real(p, "roughness", 0.5f);
    material.anisotropy = textures.real(p, "anisotropy", 0);
    material.metallic = textures.real(p, "metallic", 0);
    material.spec_trans = textures.real(p, "transmission", 0);
    material.spec_tint = textures.real(p, "speculartint", 0);
    material.sheen = textures.real(p, "sheen", 0);
    material.sheen_tint = textures.real(p, "sheentint", 0);
    material.flatness = textures.real(p, "flatness", 0);
    material.coat = textures.real(p, "coat", 0);
    material.coat_gloss = textures.real(p, "coatgloss", 0);
    material.transmits = textures.varies(material.spec_trans) || textures.mean(material.spec_trans).r > 0;
    return material;
}

DisneySheetMaterial disney_sheet(TextureLoader& textures, const pbrt::ParameterSet& p) {
    DisneySheetMaterial material;
    material.base = textures.colour(p, "reflectance", Rgb(0.5f));
    material.roughness = textures.real(p, "roughness", 0.5f);
    material.anisotropy = textures.real(p, "anisotropy", 0);
    material.spec_trans = textures.real(p, "transmission", 0);
    material.diff_trans = textures.real(p, "diffusetransmission", 0);
    material.spec_tint = textures.real(p, "speculartint", 0);
    material.sheen = textures.real(p, "sheen", 0);
    material.sheen_tint = textures.real(p, "sheentint", 0);
    material.flatness = textures.real(p, "flatness", 0);
    return material;
}

}  // namespace wend
