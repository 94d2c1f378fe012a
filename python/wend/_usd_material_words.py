"""What shaders of surfaces call their inputs, and which of them have no counterpart here."""

from __future__ import annotations

#: What shaders of surfaces call the same things; the names that a shader has not are left out.
WORDS: dict[str, dict[str, str]] = {
    "UsdPreviewSurface": {
        "colour": "diffuseColor",
        "metal": "metallic",
        "roughness": "roughness",
        "ior": "ior",
        "coat": "clearcoat",
        "coat_roughness": "clearcoatRoughness",
        "shine_colour": "emissiveColor",
        "tint": "specularColor",
    },
    "ND_standard_surface_surfaceshader": {
        "colour": "base_color",
        "weight": "base",
        "metal": "metalness",
        "roughness": "specular_roughness",
        "ior": "specular_IOR",
        "specular": "specular",
        "opacity": "opacity",
        "coat": "coat",
        "coat_roughness": "coat_roughness",
        "coat_ior": "coat_IOR",
        "coat_colour": "coat_color",
        "tint": "specular_color",
        "chalk": "diffuse_roughness",
        "brushed": "specular_anisotropy",
        "sheen": "sheen",
        "sheen_colour": "sheen_color",
        "sheen_roughness": "sheen_roughness",
        "clear": "transmission",
        "clear_colour": "transmission_color",
        "clear_depth": "transmission_depth",
        "clear_scatter": "transmission_scatter",
        "clear_g": "transmission_scatter_anisotropy",
        "inside": "subsurface",
        "inside_colour": "subsurface_color",
        "inside_radius": "subsurface_radius",
        "inside_scale": "subsurface_scale",
        "inside_g": "subsurface_anisotropy",
        "shine": "emission",
        "shine_colour": "emission_color",
    },
    "ND_open_pbr_surface_surfaceshader": {
        "colour": "base_color",
        "weight": "base_weight",
        "metal": "base_metalness",
        "roughness": "specular_roughness",
        "ior": "specular_ior",
        "specular": "specular_weight",
        "opacity": "geometry_opacity",
        "coat": "coat_weight",
        "coat_roughness": "coat_roughness",
        "coat_ior": "coat_ior",
        "coat_colour": "coat_color",
        "tint": "specular_color",
        "chalk": "base_diffuse_roughness",
        "brushed": "specular_roughness_anisotropy",
        "sheen": "fuzz_weight",
        "sheen_colour": "fuzz_color",
        "sheen_roughness": "fuzz_roughness",
        "clear": "transmission_weight",
        "clear_colour": "transmission_color",
        "clear_depth": "transmission_depth",
        "clear_scatter": "transmission_scatter",
        "clear_g": "transmission_scatter_anisotropy",
        "inside": "subsurface_weight",
        "inside_colour": "subsurface_color",
        "inside_radius": "subsurface_radius",
        "inside_radii": "subsurface_radius_scale",
        "inside_g": "subsurface_scatter_anisotropy",
        "shine": "emission_luminance",
        "shine_colour": "emission_color",
    },
}


#: What has no counterpart, and the value at which it does nothing; none: it does so where nothing is connected.
NOT_HERE: dict[str, dict[str, float | None]] = {
    "UsdPreviewSurface": {"displacement": 0},
    "ND_standard_surface_surfaceshader": {
        "specular_rotation": 0,
        "transmission_dispersion": 0,
        "transmission_extra_roughness": 0,
        "coat_anisotropy": 0,
        "coat_affect_color": 0,
        "coat_affect_roughness": 0,
        "thin_film_thickness": 0,
        "thin_walled": 0,
        "normal": None,
        "coat_normal": None,
        "tangent": None,
    },
    "ND_open_pbr_surface_surfaceshader": {
        "transmission_dispersion_scale": 0,
        "coat_roughness_anisotropy": 0,
        "coat_darkening": 1,
        "thin_film_weight": 0,
        "geometry_thin_walled": 0,
        "geometry_normal": None,
        "geometry_coat_normal": None,
        "geometry_tangent": None,
        "geometry_coat_tangent": None,
    },
}

#: What is not OpenPBR's value where none is given.
COAT_ROUGHNESS = {"UsdPreviewSurface": 0.01, "ND_standard_surface_surfaceshader": 0.1}
COAT_IOR = {"ND_standard_surface_surfaceshader": 1.5}
SHEEN_ROUGHNESS = {"ND_standard_surface_surfaceshader": 0.3}
