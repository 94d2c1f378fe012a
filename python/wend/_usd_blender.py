"""What Blender's exporter writes and means otherwise than USD has it. What it wrote is known by the layer's documentation.

Its own reader undoes all of this. Found with Blender 5.0.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import numpy.typing as npt

Matrix = npt.NDArray[np.float64]

#: Blender's sky, by whose rows points are turned, if it is not: pole along z, middle along x.
_SKY = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])


def wrote(attribute: Any) -> bool:
    """Whether the attribute's value is Blender's."""
    return bool(attribute) and any(_is_of_blender(spec.layer) for spec in attribute.GetPropertyStack()[:1])


def defined(prim: Any) -> bool:
    """Whether the prim is Blender's, whatever was said of it afterwards."""
    return any(_is_of_blender(spec.layer) for spec in prim.GetPrimStack() if spec.typeName)


def _is_of_blender(layer: Any) -> bool:
    found = re.match(r"Blender v?(\d+)\.(\d+)", layer.documentation)
    return found is not None and (int(found[1]), int(found[2])) >= (4, 1)


def sun_factor(reader: Any, light: Any) -> float:
    """A quarter of the strength is written."""
    if not wrote(light.GetIntensityAttr()):
        return 1.0
    reader.warn(light.GetPrim(), "a sun of Blender's is four times as strong as is written")
    return 4.0


def has_no_temperature(light: Any) -> bool:
    """It is said to be coloured by its temperature, always; where it is not, none is written, which in USD is 6500 K."""
    return wrote(light.GetEnableColorTemperatureAttr()) and not light.GetColorTemperatureAttr().HasAuthoredValue()


def inner_angle(softness: Any, cone: float) -> float | None:
    """Of a cone, in degrees; Blender's softness is a part of the cosine. None for others' cones."""
    if not wrote(softness):
        return None
    edge = np.cos(np.radians(cone))
    return float(np.degrees(np.arccos(min(edge + float(softness.Get()) * (1 - edge), 1.0))))


def unscaled(prim: Any, world: Matrix) -> Matrix:
    """Places of a light that Blender does not scale with its object: a sphere."""
    if not defined(prim):
        return world
    result = world.copy()
    result[:, :3, :3] /= np.maximum(np.linalg.norm(result[:, :3, :3], axis=2, keepdims=True), 1e-30)
    return result


def stretch(prim: Any, world: Matrix) -> Matrix | None:
    """By what a light's cone is squeezed along its axes; None where it is round, or not Blender's."""
    scale = np.asarray(np.linalg.norm(world[0, :3, :3], axis=-1), dtype=np.float64)
    return np.maximum(scale, 1e-30) if defined(prim) and np.ptp(scale) > 1e-3 * scale.max() else None


def density_factor(prim: Any, world: Matrix) -> float:
    """A volume of Blender's is as dense for each unit of its own; `world` is where it is."""
    volume = abs(float(np.linalg.det(world[:3, :3]))) if defined(prim) else 1.0
    return volume ** (-1 / 3) if volume > 0 else 1.0


def is_unseen(reader: Any, prim: Any) -> bool:
    """Blender's lamps are not seen, unless it is asked for, which is not written."""
    if not defined(prim):
        return False
    reader.warn(prim, "a lamp of Blender's is not seen by the camera, and in nobody's way, as there")
    return True


def turned_sky(reader: Any, prim: Any, local: Matrix) -> Matrix:
    """What turns a dome within its parent. Where nodes do not turn it, no turn is written, not even that of its axes."""
    if not defined(prim) or not np.allclose(local, np.eye(4), atol=1e-6):
        return np.eye(4)
    reader.warn(prim, "the sky of Blender's has its pole along z there")
    return _SKY


def specular(inputs: Any) -> float:
    """A factor of the reflectance, which preview surfaces have no word for; 1/2 is plain."""
    given = inputs.shader.GetInput("specular")
    return 2 * float(inputs.constant("specular", 0.5)) if given and wrote(given.GetAttr()) else 1.0


def is_matt(inputs: Any) -> bool:
    """Whether a preview surface is Blender's diffuse node: a principled one has an index, too. Its roughness, 0, is none
    of a coat's."""
    shader = inputs.shader
    colour = shader.GetInput("diffuseColor")
    written = colour and wrote((colour.GetValueProducingAttributes() or [colour.GetAttr()])[0])
    return bool(written) and not any(shader.GetInput(name) for name in ("ior", "metallic", "specular"))
