"""Blender's volumes: their shader nodes as media of the renderer."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from ._blend_nodes import Colour, Nodes, blackbody


class Values(Protocol):
    """What inputs are: constants, or arrays, a row for each of several places."""

    def number(self, socket: Any) -> Any: ...

    def colour(self, socket: Any) -> Any: ...


def volume_parameters(nodes: Nodes, node: Any) -> dict[str, Any] | None:
    """Of a shader node of a volume, the parameters of a medium of density 1 everywhere; None for one that is none."""
    found = coefficients(nodes, node, nodes)
    if found is None:
        return None
    scattering, absorption, emission, phase = found
    parameters: dict[str, Any] = {"rgb sigma_s": scattering, "rgb sigma_a": absorption} | phase
    if emission.max() > 0:
        # Here what shines is multiplied by what absorbs.
        if absorption.min() <= 0:
            nodes.warn(node, "a volume that shines and does not absorb shines by a small absorption")
            absorption = np.maximum(absorption, 1e-4)
            parameters["rgb sigma_a"] = absorption
        parameters["rgb Le"] = emission / absorption
    return parameters


#: Kelvin between the temperatures that colours are given for, and how many there are.
_STEP, _STEPS = 20.0, 601


def glow_parameters(
    nodes: Nodes, node: Any, grids: list[str], density: str, clipping: float, factor: float
) -> dict[str, Any]:
    """What a volume of a file shines with, whatever its density, as parameters of a medium "nanovdb".

    Args:
        nodes: of the material.
        node: its shader.
        grids: names of those in the file.
        density: the one of them that says how dense it is.
        clipping: the density below which there is no volume.
        factor: multiplies all of it.
    """
    if node.bl_idname == "ShaderNodeVolumePrincipled" and nodes.number(node.inputs["Blackbody Intensity"]) > 0:
        heat = node.inputs["Temperature Attribute"].default_value
        if heat in grids:
            kelvins = _STEP * np.arange(_STEPS)
            shine = _shine(nodes, node)[np.newaxis] + np.array([_black_body(nodes, node, kelvin) for kelvin in kelvins])
            return {
                "rgb glow": factor * np.maximum(shine, 0),
                "float glowstep": _STEP,
                "string temperaturename": heat,
                "float temperaturescale": nodes.number(node.inputs["Temperature"]),
            }
    found = coefficients(nodes, node, nodes)
    if found is None or found[2].max() <= 0:
        # pbrt would take a grid of temperatures for what shines.
        return {"string temperaturename": ""}
    # Where the grid is denser than the clipping: read as temperatures, of which 100 is the first that shines.
    return {
        "rgb glow": factor * np.array([np.zeros(3), found[2], found[2]]),
        "float glowstep": 100.0,
        "string temperaturename": density,
        "float temperaturescale": 100 / max(clipping, 1e-6),
    }


def _shine(values: Values, node: Any) -> Colour:
    strength = values.number(node.inputs["Emission Strength"])
    return np.asarray(values.colour(node.inputs["Emission Color"]) * strength if np.max(strength) > 0 else np.zeros(3))


def _black_body(nodes: Nodes, node: Any, kelvin: float) -> Colour:
    glow = nodes.number(node.inputs["Blackbody Intensity"])
    # Cycles' scale: of a body of one kelvin up to that of a black one, in megawatts.
    scale = 5.670373e-14 / np.pi * (1 - glow + glow * kelvin**4)
    return np.asarray(scale * nodes.colour(node.inputs["Blackbody Tint"]) * blackbody(kelvin))


#: Scattering, absorption, emission, and the phase function.
Coefficients = tuple[Colour, Colour, Colour, dict[str, Any]]


def _sums(parts: list[tuple[Any, Coefficients]]) -> tuple[Colour, Colour, Colour]:
    first, second, third = np.zeros(3), np.zeros(3), np.zeros(3)
    for weight, part in parts:
        first, second, third = first + weight * part[0], second + weight * part[1], third + weight * part[2]
    return first, second, third


def coefficients(nodes: Nodes, node: Any, values: Values, depth: int = 0) -> Coefficients | None:
    """Of a shader node of a volume, by what its inputs are: those of phase functions are `nodes`' constants."""
    zero = np.zeros(3)
    kind = node.bl_idname if node is not None else ""
    if depth > 32 or node is None:
        return None
    if kind == "ShaderNodeVolumePrincipled":
        density = np.maximum(values.number(node.inputs["Density"]), 0)
        colour = np.maximum(values.colour(node.inputs["Color"]), 0)
        dark = np.sqrt(np.maximum(values.colour(node.inputs["Absorption Color"]), 0))
        absorption = np.maximum(1 - colour, 0) * np.maximum(1 - dark, 0)
        shine = _shine(values, node)
        if nodes.number(node.inputs["Blackbody Intensity"]) > 0:
            shine = shine + _black_body(nodes, node, nodes.number(node.inputs["Temperature"]))
        return density * colour, density * absorption, shine, {"float g": nodes.number(node.inputs["Anisotropy"])}
    if kind == "ShaderNodeVolumeScatter":
        density, colour = np.maximum(values.number(node.inputs["Density"]), 0), values.colour(node.inputs["Color"])
        return density * np.maximum(colour, 0), zero, zero, _phase(nodes, node)
    if kind == "ShaderNodeVolumeAbsorption":
        density, colour = np.maximum(values.number(node.inputs["Density"]), 0), values.colour(node.inputs["Color"])
        return zero, density * np.clip(1 - colour, 0, None), zero, {}
    if kind == "ShaderNodeVolumeCoefficients":
        found = [values.colour(node.inputs[f"{name} Coefficients"]) for name in ("Scatter", "Absorption", "Emission")]
        return found[0], found[1], found[2], _phase(nodes, node)
    if kind == "ShaderNodeEmission":
        return zero, zero, values.colour(node.inputs["Color"]) * values.number(node.inputs["Strength"]), {}
    if kind in ("ShaderNodeAddShader", "ShaderNodeMixShader"):
        sockets = node.inputs[:2] if kind == "ShaderNodeAddShader" else node.inputs[1:3]
        parts = [_coefficients_at(nodes, socket, values, depth + 1) for socket in sockets]
        share = np.clip(values.number(node.inputs[0]), 0, 1) if kind == "ShaderNodeMixShader" else 0.0
        weights = (1 - share, share) if kind == "ShaderNodeMixShader" else (1.0, 1.0)
        there = [(weight, part) for weight, part in zip(weights, parts) if part is not None]
        if not there:
            return None
        phases = [part[3] for _, part in there if part[3]]
        if len(phases) > 1 and phases[0] != phases[1]:
            return _two_phases(nodes, node, there)
        return *_sums(there), phases[0] if phases else {}
    nodes.warn(node, f"{kind.removeprefix('ShaderNode')} as a volume is left out")
    return None


def _coefficients_at(nodes: Nodes, socket: Any, values: Values, depth: int) -> Coefficients | None:
    with nodes.aside():
        return coefficients(nodes, nodes.shader(socket), values, depth)


def _two_phases(nodes: Nodes, node: Any, parts: list[tuple[Any, Coefficients]]) -> Coefficients:
    scattering = [w * part[0] for w, part in parts]
    if any(np.ndim(s) > 1 for s in scattering):
        nodes.warn(node, "of two phase functions the shares are everywhere those of their means")
    weights = [float(np.mean(s)) for s in scattering]
    if all(set(part[3]) <= {"float g"} for _, part in parts):
        cosines = [part[3].get("float g", 0.0) for _, part in parts]
        phase: dict[str, Any] = {"string phase": "henyeygreensteinmixture", "float g": cosines, "float weights": weights}
        return *_sums(parts), phase
    nodes.warn(node, "of two phase functions the one that scatters more is taken")
    return *_sums(parts), parts[int(np.argmax(weights))][1][3]


def _phase(nodes: Nodes, node: Any) -> dict[str, Any]:
    kind = node.phase
    if kind == "HENYEY_GREENSTEIN":
        return {"float g": nodes.number(node.inputs["Anisotropy"])}
    if kind == "RAYLEIGH":
        return {"string phase": "rayleigh"}
    if kind == "DRAINE":
        anisotropy, alpha = nodes.number(node.inputs["Anisotropy"]), nodes.number(node.inputs["Alpha"])
        return {"string phase": "draine", "float g": anisotropy, "float alpha": alpha}
    if kind == "MIE":
        diameter = nodes.number(node.inputs["Diameter"])
        if not 5 <= diameter <= 50:
            nodes.warn(node, "droplets are taken as 5 to 50 micrometres wide")
        return {"string phase": "fog", "float diameter": min(max(diameter, 5.0), 50.0)}
    if kind == "FOURNIER_FORAND":
        index, back = max(nodes.number(node.inputs["IOR"]), 1.001), nodes.number(node.inputs["Backscatter"])
        return {"string phase": "fournierforand", "float index": index, "float slope": _slope(index, back)}
    nodes.warn(node, f"the phase function {kind} is taken as even")
    return {}


def _slope(index: float, back: float) -> float:
    """Of the sizes of particles that send this share backwards, by Fournier and Forand's function."""
    delta = 2 / (3 * (index - 1) ** 2)
    if abs(delta - 1) < 1e-6:
        delta = 1 + 1e-6
    power = -np.log(max(1 + 2 * back * (delta - 1), 1e-6)) / np.log(delta)
    return float(np.clip(3 - 2 * power, 3.0, 5.0))
