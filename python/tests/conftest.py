"""What the tests share: the program of the same build, and a small scene."""

import os
from pathlib import Path

import pytest

import wend

SCENES = Path(__file__).resolve().parents[2] / "scenes"
SMALL = (32, 18)


@pytest.fixture(scope="session")
def program() -> str:
    """The wend program, to compare with; WEND_PROGRAM names it."""
    name = os.environ.get("WEND_PROGRAM")
    if not name:
        pytest.skip("WEND_PROGRAM does not name the program")
    return name


@pytest.fixture(scope="session")
def demo() -> wend.Scene:
    return wend.load(SCENES / "demo.pbrt", resolution=SMALL)


GLOWING_ROOM = """
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "string filename" "furnace.exr"
Sampler "independent" "integer pixelsamples" 16
Integrator "volpath" "integer maxdepth" 1000
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0 0 0] "rgb sigma_s" [1 1 1] "float g" 0.5
AttributeBegin
  MediumInterface "fog" ""
  Material "interface"
  Translate 0 0 4
  Shape "sphere" "float radius" 2
AttributeEnd
"""


@pytest.fixture(scope="session")
def furnace() -> wend.Scene:
    """A ball of fog that absorbs nothing, under a white sky: every pixel is 1."""
    return wend.loads(GLOWING_ROOM)
