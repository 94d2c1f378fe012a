"""Blender's materials: their shader nodes as materials and media of the renderer."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ._blend_chalk import add_roughness
from ._blend_details import add_detail, add_tint, brush_of, conductor, linked_to, share_left, tell_of_facets, tell_of_films
from ._blend_fog import Fog, fog_of
from ._blend_glass import dielectric, glass_of, lets_through, mirror_of
from ._blend_hair import hair_of
from ._blend_nodes import Colour, Nodes, output_node
from ._blend_sheen import add_sheen, fibres
from ._blend_sides import of_one_side
from ._blend_subsurface import add_inside
from ._blend_sums import added
from ._blend_surface import Surface, is_nothing, reflecting
from ._blend_volumes import volume_parameters
from ._blend_wanted import Probe
from ._scene_reader import Brush, Look, SceneReader, Silent

if TYPE_CHECKING:
    from ._blend_bake import Bakery


def look_of(reader: SceneReader, material: Any, bakery: Bakery | None = None) -> Look:
    """Makes the material, and the medium inside, if they are not there yet. A shape without one is grey.

    Args:
        reader: of the scene.
        material: None: of a shape that has none.
        bakery: of the object, for what has no counterpart; None: that is left out.
    """
    key = material.name if material else " no material"
    if bakery is not None and material is not None:
        key += bakery.suffix(wants_of(reader, material, bakery))
    if key not in reader.materials:
        reader.materials[key] = _made(reader, material, key, bakery)
    return reader.materials[key]


def wants_of(reader: SceneReader, material: Any, bakery: Bakery) -> set[str]:
    """What a material wants of a bakery, by the words of `Probe`."""
    known = bakery.known_wants(material.name)
    if known is None:
        probe = Probe(bakery.name, bakery.uv_name)
        _made(Silent(reader), material, material.name, probe)
        known = probe.modes
        bakery.keep_wants(material.name, known)
    return known


def _made(reader: SceneReader, material: Any, key: str, bakery: Bakery | Probe | None) -> Look:
    if material is None:
        # As a new Principled BSDF.
        grey = {"string type": "principled", "float eta": 1.5, "float roughness": 0.5, "rgb reflectance": (0.8, 0.8, 0.8)}
        return _look(reader, key, Surface(grey), None)
    tree = material.node_tree
    if tree is None:
        return _look(reader, key, Surface({"string type": "diffuse", "rgb reflectance": (0.8, 0.8, 0.8)}), None)
    output = output_node(tree)
    if output is None:
        return _look(reader, key, reflecting(Surface()), None)
    nodes = Nodes(reader, f"material '{material.name}'", key, material, bakery)
    with nodes.aside():
        nodes.displacement = output.inputs["Displacement"] if nodes.source(output.inputs["Displacement"]) else None
    if nodes.displacement is not None and (bakery is None or material.displacement_method != "BUMP"):
        nodes.warn(output, "displacement is left out" if bakery is None else "displacement is taken as a bump")
    with nodes.aside():
        volume = nodes.shader(output.inputs["Volume"])
        fog = fog_of(reader, material.original) if volume and bakery is not None else None
        if fog is not None and bakery is not None:
            bakery.fill_inside(fog)
        medium = volume_parameters(nodes, volume) if volume and fog is None else None
    with nodes.aside():
        node = nodes.shader(output.inputs["Surface"])
        # What is nothing but a volume has no surface; what is nothing at all is black.
        surface = _surface(nodes, node) if node else Surface(is_clear=True) if volume else reflecting(Surface())
        surface = of_one_side(nodes, output, surface, _surface)
    if surface.alpha and not getattr(material, "use_transparent_shadow", True):
        nodes.warn(output, "transparent shadows that are switched off are there")
    picture = nodes.baked_light(output) if surface.shines_by_a_picture else None
    return _look(reader, key, surface, fog or medium, picture)


def _look(
    reader: SceneReader, key: str, surface: Surface, medium: Fog | dict[str, Any] | None, picture: dict[str, Any] | None = None
) -> Look:
    if isinstance(medium, dict):
        reader.make_medium(key, medium)
    shines = picture is not None or surface.emission.max() > 0
    emission = tuple(float(x) for x in surface.emission) if shines else None
    # Nothing around an inside is not there, and else it is black.
    if not surface.is_clear and not (medium is not None and is_nothing(surface)):
        surface = reflecting(surface)
    named = _name(reader, key, surface)
    if named is None and emission is None and medium is None:
        # Nothing is seen of it.
        return Look(None, shape_parameters={"float alpha": 0.0})
    if named is None and emission is not None:
        reader.builder.add("MakeNamedMaterial", key, {"string type": "diffuse", "rgb reflectance": (0, 0, 0)})
        named = key
    shown = picture["string filename"] if picture is not None else None
    view = "holdout" if surface.is_held_out else "hidden" if surface.is_hidden else ""
    shape = surface.alpha | ({"string cameraview": view} if view else {})
    inside = key if medium is not None else None
    fog = medium if isinstance(medium, Fog) else None
    return Look(
        named, emission, inside, fog, shape, _brush_of(surface), shown, _refracts(surface), _index_of(surface), surface.is_one_sided
    )


def _refracts(surface: Surface) -> bool:
    if surface.mixed is not None:
        return any(_refracts(part) for part in surface.mixed[:2])
    return surface.material is not None and lets_through(surface.material)


def _index_of(surface: Surface) -> float:
    """Of the glass that it is, or a part of it."""
    parts = surface.mixed[:2] if surface.mixed is not None else ()
    own = surface.material or {}
    if own.get("string type") == "dielectric":
        return float(own.get("float eta", 1.5))
    return next((index for index in map(_index_of, parts) if index != 1), 1.0)


def _brush_of(surface: Surface) -> Brush | None:
    parts = surface.mixed[:2] if surface.mixed is not None else ()
    return surface.brushed or next((brush for brush in map(_brush_of, parts) if brush), None)


def _name(reader: SceneReader, key: str, surface: Surface) -> str | None:
    """Of the material that is made for it; None for an interface."""
    if surface.mixed is not None:
        first, second, amount = surface.mixed
        names = [_name(reader, f"{key}/{i}", part) for i, part in enumerate((first, second))]
        if None in names:
            return next((name for name in names if name), None)
        reader.builder.add("MakeNamedMaterial", key, {"string type": "mix", "string materials": names} | amount)
        return key
    if surface.material is None:
        return None
    reader.builder.add("MakeNamedMaterial", key, surface.material)
    return key


def _surface_at(nodes: Nodes, socket: Any, depth: int) -> Surface:
    with nodes.aside():
        return _surface(nodes, nodes.shader(socket), depth)


def _surface(nodes: Nodes, node: Any, depth: int = 0) -> Surface:
    kinds = {
        "ShaderNodeBsdfPrincipled": _principled,
        "ShaderNodeBsdfDiffuse": _diffuse,
        "ShaderNodeBsdfAnisotropic": _glossy,
        "ShaderNodeBsdfGlossy": _glossy,
        "ShaderNodeBsdfMetallic": _metallic,
        "ShaderNodeBsdfSheen": _sheen,
        "ShaderNodeBsdfGlass": _glass,
        "ShaderNodeBsdfRefraction": _glass,
        "ShaderNodeBsdfTransparent": _transparent,
        "ShaderNodeBsdfTranslucent": _translucent,
        "ShaderNodeSubsurfaceScattering": _subsurface,
        "ShaderNodeEmission": _emission,
        "ShaderNodeBackground": _emission,
        "ShaderNodeHoldout": _held_out,
        "ShaderNodeBsdfHairPrincipled": _hair,
        "ShaderNodeBsdfHair": _as_matt,
        "ShaderNodeBsdfToon": _as_matt,
    }
    if node is None:
        return Surface()
    if depth > 32:
        nodes.warn(node, "shaders that are mixed more than 32 times are black")
        return Surface()
    if node.bl_idname == "ShaderNodeMixShader":
        return _mixed(nodes, node, depth)
    if node.bl_idname == "ShaderNodeAddShader":
        return added(nodes, node, *(_surface_at(nodes, socket, depth + 1) for socket in node.inputs[:2]))
    if node.bl_idname in kinds:
        return kinds[node.bl_idname](nodes, node)
    nodes.warn(node, f"{node.bl_idname.removeprefix('ShaderNode')} is taken as grey")
    return Surface({"string type": "diffuse", "rgb reflectance": (0.5, 0.5, 0.5)})


def _hair(nodes: Nodes, node: Any) -> Surface:
    return Surface(hair_of(nodes, node))


def _as_matt(nodes: Nodes, node: Any) -> Surface:
    nodes.warn(node, f"{node.bl_idname.removeprefix('ShaderNodeBsdf')} is taken as a diffuse surface of its colour")
    material: dict[str, Any] = {"string type": "diffuse"}
    nodes.add_to(material, node.inputs["Color"], "reflectance", "rgb")
    add_detail(nodes, node, material)
    return Surface(material)


def _principled(nodes: Nodes, node: Any) -> Surface:
    inputs = node.inputs
    tell_of_films(nodes, node)
    ior = max(nodes.number(inputs["IOR"]), 1e-3)
    emission, varies = _emitted(nodes, inputs["Emission Color"], inputs["Emission Strength"])
    material: dict[str, Any] = {"string type": "principled", "float eta": ior}
    nodes.add_to(material, inputs["Base Color"], "reflectance", "rgb")
    nodes.add_to(material, inputs["Metallic"], "metallic", "float")
    nodes.add_to(material, inputs["Roughness"], "roughness", "float")
    # Another level is another index.
    normal = ((ior - 1) / (ior + 1)) ** 2 * 2 * max(nodes.number(inputs["Specular IOR Level"]), 0)
    root = min(normal, 0.99) ** 0.5
    material["float eta"] = (1 + root) / (1 - root) if ior >= 1 else (1 - root) / (1 + root)
    if ior < 1:
        nodes.warn(node, "an IOR below 1 reflects otherwise than in Cycles, by up to 26 % in parts of a picture")
    add_tint(nodes, material, inputs["Specular Tint"], "speculartint")
    if "Diffuse Roughness" in inputs and material.get("float metallic") == 0:
        add_roughness(nodes, material, inputs["Diffuse Roughness"], inputs["Base Color"])
    coat = nodes.number(inputs["Coat Weight"])
    if coat > 0:
        nodes.add_to(material, inputs["Coat Weight"], "coat", "float")
        nodes.add_to(material, inputs["Coat Roughness"], "coatroughness", "float")
        material["float coateta"] = max(nodes.number(inputs["Coat IOR"]), 1e-3)
        add_tint(nodes, material, inputs["Coat Tint"], "coattint")
        if linked_to(nodes, inputs["Coat Normal"]) != linked_to(nodes, inputs["Normal"]):
            nodes.warn(node, "a coat has the normals of what it covers")
    has_sheen = add_sheen(nodes, material, inputs)
    emission = emission * share_left(nodes, node, coat, has_sheen, varies) if emission.max() > 0 else emission
    brushed = brush_of(nodes, node, inputs["Anisotropic"], inputs["Anisotropic Rotation"], material)
    add_detail(nodes, node, material)
    result = Surface(material, emission=emission, brushed=brushed)
    # Metal comes first, glass gets of the rest.
    transmission = min(nodes.number(inputs["Transmission Weight"]), 1.0)
    metallic = min(max(nodes.number(inputs["Metallic"]), 0.0), 1.0) if transmission > 0 else 0.0
    clear = transmission * (1 - metallic)
    for share, ours in ((1 - clear, "MULTI_GGX"), (clear, "GGX")):
        if share > 0:
            tell_of_facets(nodes, node, inputs["Roughness"], ours)
    if 0 < clear < 1:
        material.pop("texture metallic", None)
        material["float metallic"] = metallic / (1 - clear)
    waxen = nodes.known(inputs["Subsurface Weight"])
    if clear < 1 and (waxen is None or waxen[0] > 0):
        nodes.add_to(material, inputs["Subsurface Weight"], "subsurface", "float")
        names = {key: nodes.input(node, f"Subsurface {key.capitalize()}") for key in ("radius", "scale", "anisotropy")}
        is_skin = node.subsurface_method == "RANDOM_WALK_SKIN"
        names |= {"roughness": inputs["Roughness"], "ior": nodes.number(nodes.input(node, "Subsurface IOR")) if is_skin else material["float eta"]}
        add_inside(nodes, node, material, inputs["Base Color"], node.subsurface_method, names)
    if clear > 0:
        glass = dielectric(nodes, inputs["Roughness"], ior)
        # Of two boundaries the base colour.
        glass["rgb transmittance"] = np.sqrt(np.clip(nodes.colour(inputs["Base Color"]), 0, 1))
        add_detail(nodes, node, glass)
        if coat > 0:
            nodes.warn(node, "the coat of glass is left out")
        if has_sheen:
            nodes.warn(node, "the sheen of glass is left out")
        result = _blended(result, Surface(glass), clear, emission)
    result.shines_by_a_picture = varies
    if inputs["Alpha"].is_linked or inputs["Alpha"].default_value < 1:
        nodes.add_to(result.alpha, inputs["Alpha"], "alpha", "float")
    return result


def _blended(first: Surface, second: Surface, amount: float, emission: Colour) -> Surface:
    if amount >= 1 - 1e-6:
        second.emission = emission
        return second
    return Surface(mixed=(first, second, {"float amount": amount}), emission=emission)


def _diffuse(nodes: Nodes, node: Any) -> Surface:
    material: dict[str, Any] = {"string type": "diffuse"}
    if node.inputs["Roughness"].is_linked or node.inputs["Roughness"].default_value > 0:
        material = {"string type": "principled", "float specular": 0}
        nodes.add_to(material, node.inputs["Color"], "reflectance", "rgb")
        add_roughness(nodes, material, node.inputs["Roughness"], node.inputs["Color"])
    else:
        nodes.add_to(material, node.inputs["Color"], "reflectance", "rgb")
    add_detail(nodes, node, material)
    return Surface(material)


def _sheen(nodes: Nodes, node: Any) -> Surface:
    material = fibres(nodes, node)
    add_detail(nodes, node, material)
    return Surface(material)


def _metal(nodes: Nodes, node: Any, colour: str) -> Surface:
    material: dict[str, Any] = {"string type": "principled", "float metallic": 1.0}
    if colour:
        nodes.add_to(material, node.inputs[colour], "reflectance", "rgb")
    tell_of_films(nodes, node)
    tell_of_facets(nodes, node, node.inputs["Roughness"], "MULTI_GGX")
    nodes.add_to(material, node.inputs["Roughness"], "roughness", "float")
    brushed = brush_of(nodes, node, node.inputs["Anisotropy"], node.inputs["Rotation"], material)
    add_detail(nodes, node, material)
    return Surface(material, brushed=brushed)


def _glossy(nodes: Nodes, node: Any) -> Surface:
    mirror = mirror_of(nodes, node)
    if mirror is not None:
        return Surface(mirror)
    # It reflects its colour from everywhere: a metal whose edge is tinted so that it does not brighten, on average.
    surface = _metal(nodes, node, "Color")
    colour = nodes.known(node.inputs["Color"])
    if colour is None:
        nodes.warn(node, "a glossy surface whose colour varies is taken as a metal of that colour")
    elif surface.material is not None:
        colour = np.clip(np.broadcast_to(colour, 3), 0, 1)
        edge = (6 / 7) ** 5
        surface.material["rgb speculartint"] = 1 - 6 * (1 - colour) * edge * 6 / 49 / (colour + (1 - colour) * edge)
    return surface


def _metallic(nodes: Nodes, node: Any) -> Surface:
    if node.fresnel_type != "F82":
        surface = _metal(nodes, node, "")
        if surface.material is not None:
            surface.material |= conductor(*(nodes.colour(node.inputs[name]) for name in ("IOR", "Extinction")))
        return surface
    surface = _metal(nodes, node, "Base Color")
    if surface.material is not None:
        add_tint(nodes, surface.material, node.inputs["Edge Tint"], "speculartint")
    return surface


def _held_out(nodes: Nodes, node: Any) -> Surface:
    return Surface({"string type": "diffuse", "rgb reflectance": (0, 0, 0)}, is_held_out=True)


def _glass(nodes: Nodes, node: Any) -> Surface:
    return Surface(glass_of(nodes, node))


def _transparent(nodes: Nodes, node: Any) -> Surface:
    colour = nodes.known(node.inputs["Color"])
    if colour is not None and np.abs(colour - 1).max() < 1e-3:
        return Surface(is_clear=True)
    nodes.warn(node, "what is transparent and has a colour lets no light of lamps without a size through")
    # A pane that reflects nothing.
    material: dict[str, Any] = {"string type": "thindielectric", "float eta": 1.0}
    nodes.add_to(material, node.inputs["Color"], "transmittance", "rgb")
    return Surface(material)


def _translucent(nodes: Nodes, node: Any) -> Surface:
    material: dict[str, Any] = {"string type": "diffusetransmission", "rgb reflectance": (0, 0, 0)}
    nodes.add_to(material, node.inputs["Color"], "transmittance", "rgb")
    add_detail(nodes, node, material)
    return Surface(material)


def _subsurface(nodes: Nodes, node: Any) -> Surface:
    # It has no surface of its own.
    material: dict[str, Any] = {"string type": "principled", "float specular": 0, "float roughness": 1, "float subsurface": 1}
    nodes.add_to(material, node.inputs["Color"], "reflectance", "rgb")
    names = {key: nodes.input(node, key.capitalize()) for key in ("radius", "scale", "anisotropy", "roughness")}
    names["ior"] = nodes.number(nodes.input(node, "IOR"))
    add_inside(nodes, node, material, node.inputs["Color"], node.falloff, names)
    add_detail(nodes, node, material)
    return Surface(material)


def _emission(nodes: Nodes, node: Any) -> Surface:
    emission, varies = _emitted(nodes, node.inputs["Color"], node.inputs["Strength"])
    return Surface(emission=emission, shines_by_a_picture=varies)


def _emitted(nodes: Nodes, colour: Any, strength: Any) -> tuple[Colour, bool]:
    """What is shone with, and whether it varies: then a picture takes its place."""
    values = nodes.known(colour), nodes.known(strength)
    if any(value is not None and value.max() <= 0 for value in values):
        return np.zeros(3), False
    if nodes.bakery is not None and any(value is None for value in values):
        return np.ones(3), True
    return nodes.colour(colour) * nodes.number(strength), False


def _mixed(nodes: Nodes, node: Any, depth: int) -> Surface:
    first, second = (_surface_at(nodes, socket, depth + 1) for socket in node.inputs[1:3])
    by = node.inputs["Fac" if "Fac" in node.inputs else "Factor"]
    if depth == 0 and second.is_clear and nodes.is_of_camera_rays(by):
        return replace(first, is_hidden=True)
    factor = nodes.known(by)
    share = min(max(float(np.mean(factor)), 0.0), 1.0) if factor is not None else 0.5
    if factor is not None and share in (0.0, 1.0):
        return second if share == 1 else first
    if is_nothing(first) and is_nothing(second):
        return first
    emission = (1 - share) * first.emission + share * second.emission
    varies = first.shines_by_a_picture or second.shines_by_a_picture
    if first.is_held_out or second.is_held_out:
        nodes.warn(node, "a holdout in a mixture is black")
    amount: dict[str, Any] = {}
    nodes.add_to(amount, by, "amount", "float")
    if first.is_clear or second.is_clear:
        seen = second if first.is_clear else first
        if seen.is_clear:
            return seen
        texture = amount.get("texture amount")
        if texture is not None and second.is_clear:
            inverse = nodes._name()
            nodes.reader.builder.add("Texture", inverse, "float", "mix", {"float tex1": 1.0, "float tex2": 0.0, "texture amount": texture})
            texture = inverse
        alpha = {"texture alpha": texture} if texture is not None else {"float alpha": share if first.is_clear else 1 - share}
        if seen.alpha:
            nodes.warn(node, "of transparencies within each other the outermost counts")
        if varies:
            nodes.warn(node, "what shines by a picture and is transparent is darker where it is that")
        return Surface(seen.material, seen.mixed, seen.emission, alpha, shines_by_a_picture=varies, brushed=seen.brushed)
    varies = varies or (factor is None and nodes.bakery is not None and bool(emission.max() > 0))
    return Surface(mixed=(reflecting(first), reflecting(second), amount), emission=emission, shines_by_a_picture=varies)
