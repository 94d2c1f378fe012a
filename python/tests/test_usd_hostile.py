"""Stages that are broken or that lie: a clear error or what is left of them, and no crash, hang or heap of memory."""

import os
import pathlib
import random
import resource
import subprocess
import sys
import warnings

import numpy as np
import pytest

import wend

pytest.importorskip("pxr", reason="usd-core is absent")

import wend.usd  # noqa: E402

MESH = """def Mesh "m" {{
    point3f[] points = {points}
    int[] faceVertexCounts = {counts}
    int[] faceVertexIndices = {indices}
    uniform token subdivisionScheme = "{scheme}"
    {more}
}}
"""


def mesh(scheme="none", points="[(0,0,0),(1,0,0),(0,1,0)]", counts="[3]", indices="[0,1,2]", more=""):
    return MESH.format(scheme=scheme, points=points, counts=counts, indices=indices, more=more)


def instancer(indices="[0]", places="[(0,0,0)]", target="/p/s", more="", inner=""):
    return f"""def PointInstancer "p" {{
    rel prototypes = [<{target}>]
    int[] protoIndices = {indices}
    point3f[] positions = {places}
    {more}
    def Sphere "s" {{
    {inner}
    }}
}}
"""


def prim(kind, *lines, schemas=()):
    applied = f"(prepend apiSchemas = [{', '.join(map(repr, schemas))}])".replace("'", '"') if schemas else ""
    return "\n".join([f'def {kind} "x" {applied} {{', *lines, "}", ""])


def material(*lines, more=""):
    inputs = "\n".join(lines)
    return f"""def Material "m" {{
    token outputs:surface.connect = </m/s.outputs:surface>
    def Shader "s" {{
        uniform token info:id = "UsdPreviewSurface"
        {inputs}
        token outputs:surface
    }}
    {more}
}}
def Sphere "q" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
    rel material:binding = </m>
}}
"""


def texture(file, channel="rgb"):
    return f"""def Shader "t" {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @{file}@
        float3 outputs:{channel}
    }}
"""


def volume(file, extent=""):
    return f"""def Volume "v" {{
    {extent}
    rel field:density = </v/d>
    def OpenVDBAsset "d" {{
        asset filePath = @{file}@
    }}
}}
"""


def rendered(folder, text):
    """The picture, and what was warned of."""
    file = folder / "stage.usda"
    file.write_text("#usda 1.0\n" + text)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        scene = wend.usd.read(file, resolution=(8, 8), spp=1).scene()
        image = wend.render(scene, sampling="classical", progress=False).image
    return image, " ".join(str(warning.message) for warning in told)


ERRORS = {
    "no text": ("\0 def", r"stage.usda:2:1: parse error"),
    "points that are no numbers": (mesh(points="[(0,0,0),(1,0,0),(0,nan,inf)]"), "a vertex that is not finite"),
    "subdivided ones": (mesh("catmullClark", points="[(0,0,0),(1,0,0),(0,nan,inf)]"), "/m: error: .*NaN"),
    "points of text": (prim("Mesh", 'string points = "x"', "int[] faceVertexCounts = [3]"), "/x: error: .*'x'"),
    "a radius of text": (prim("Sphere", 'string radius = "x"'), "/x: error: .*'x'"),
    "an axis": (prim("Cylinder", 'uniform token axis = "Q"'), "/x: error: .*Q"),
    "a lens of nothing": (prim("Camera", "float focalLength = 0"), "/x: error: a camera needs apertures and a focal length above 0"),
    "a lens of no number": (prim("Camera", "float horizontalAperture = nan"), "/x: error: a camera needs"),
    "a flat camera": (
        prim("Camera", "double3 xformOp:scale = (0,0,0)", 'uniform token[] xformOpOrder = ["xformOp:scale"]'),
        "/x: error: .*[Ss]ingular",
    ),
    "a place of no number": (
        prim("Sphere", "double3 xformOp:translate = (nan,0,0)", 'uniform token[] xformOpOrder = ["xformOp:translate"]'),
        "/x: error: .*its place is no number",
    ),
    "a light of no number": (prim("SphereLight", "float inputs:intensity = nan"), "/x: error: .*a light of .*nan"),
    "an exposure": (prim("SphereLight", "float inputs:exposure = 1e30"), "/x: error: "),
    "a temperature": (
        prim("SphereLight", "bool inputs:enableColorTemperature = 1", "float inputs:colorTemperature = nan"),
        "/x: error: .*a colour temperature of nan",
    ),
    "an angle": (prim("DistantLight", "float inputs:angle = -20"), '"angle" must lie between 0 and 180 degrees, not -20'),
    "a profile": (
        prim("SphereLight", "asset inputs:shaping:ies:file = @absent.ies@", schemas=["ShapingAPI"]),
        "absent.ies: error: there is no such file",
    ),
    "an absent dome": (prim("DomeLight", "asset inputs:texture:file = @absent.exr@"), "absent.exr: error: "),
    "a dome without an end": (prim("DomeLight", "asset inputs:texture:file = @/dev/zero@"), "/dev/zero: error: there is no such file"),
    "a dome that is a folder": (prim("DomeLight", "asset inputs:texture:file = @/tmp@"), "/tmp: error: there is no such file"),
    "a copy of nothing": (instancer(target="/absent"), "/absent: error: what an instancer copies is not there"),
    "a flat prototype": (
        instancer(inner='double3 xformOp:scale = (0,0,0)\nuniform token[] xformOpOrder = ["xformOp:scale"]'),
        "error: .*[Ss]ingular",
    ),
    "an absent volume": (volume("absent.vdb"), "absent.vdb: error: "),
    "a volume without an end": (volume("/dev/zero"), "/dev/zero: error: there is no such file"),
    "a volume that is none": (volume("/etc/passwd", "float3[] extent = [(0,0,0),(1,1,1)]"), "/etc/passwd: error: neither"),
    "an extent of one corner": (volume("/etc/passwd", "float3[] extent = [(0,0,0)]"), "/v: error: "),
    "a colour of no number": (material("color3f inputs:diffuseColor = (nan,1,1)"), "a colour must be finite"),
    "a colour of text": (material('string inputs:diffuseColor = "x"'), "/q: error: "),
    "a picture that is none": (
        material("float inputs:roughness.connect = </m/t.outputs:r>", more=texture("/etc/passwd", "r")),
        "/etc/passwd: error: not a picture",
    ),
    "widths of no number": (
        prim(
            "BasisCurves", "point3f[] points = [(0,0,0),(1,0,0),(2,1,0),(3,0,0)]", "int[] curveVertexCounts = [4]",
            'float[] widths = [nan,1,1,1] (interpolation = "vertex")',
        ),
        "must not be below 0, but is nan",
    ),
}  # fmt: skip


pytestmark = pytest.mark.filterwarnings("ignore:.*no camera:wend.SceneWarning")


@pytest.mark.parametrize("name", ERRORS)
def test_what_cannot_be_is_named(tmp_path, name):
    text, words = ERRORS[name]
    with pytest.raises(wend.InputError, match=words):
        rendered(tmp_path, text)


LEFT = {
    "a light of a plugin": (prim("PluginLight"), "/x: warning: a PluginLight is left out"),
    "an absent picture": (
        material("color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>", more=texture("absent.png")),
        "/m/t: warning: absent.png: there is no such file: its texture has its fallback",
    ),
    "a picture without an end": (
        material("color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>", more=texture("/dev/zero")),
        "/dev/zero: there is no such file",
    ),
    "tiles of nothing": (
        material("normal3f inputs:normal.connect = </m/t.outputs:rgb>", more=texture("<UDIM>")),
        "<UDIM>: there is no such file",
    ),
    "more corners than there are": (mesh(counts="[1000000000]"), "a mesh whose faces are not of its points"),
    "corners that overflow": (mesh(counts="[2147483647,2147483647,4]"), "a mesh whose faces are not of its points"),
    "fewer than none": (mesh(counts="[-3]"), "a mesh whose faces are not of its points"),
    "points beyond": (mesh(indices="[0,1,2000000000]"), "a mesh whose faces are not of its points"),
    "subdivided ones beyond": (mesh("catmullClark", indices="[0,1,2000000000]"), "a mesh whose faces are not of its points"),
    "holes beyond": (mesh(more="int[] holeIndices = [2000000000,-5]"), ""),
    "creases beyond": (
        mesh("catmullClark", more="int[] creaseIndices = [0,2000000000]\nint[] creaseLengths = [2]\nfloat[] creaseSharpnesses = [1]"),
        "creases",
    ),
    "creases without an end": (
        mesh("catmullClark", more="int[] creaseIndices = [0,1]\nint[] creaseLengths = [2000000000]\nfloat[] creaseSharpnesses = [1]"),
        "creases",
    ),
    "coordinates beyond": (
        mesh(more='texCoord2f[] primvars:st = [(0,0)] (interpolation = "faceVarying")\nint[] primvars:st:indices = [0,-5,2000000000]'),
        "",
    ),
    "faces of a subset beyond": (
        mesh(
            more="""def GeomSubset "g" {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [5,-1,2000000000]
        }"""
        ),
        "",
    ),
    "copies without places": (instancer("[0,0,0]"), "an instancer whose positions are not as many"),
    "copies of what is not there": (instancer("[5]"), "an instancer whose positions are not as many"),
    "copies of itself": (instancer(target="/p"), "what copies itself is left out"),
    "curves without an end": (
        prim("BasisCurves", "point3f[] points = [(0,0,0),(1,0,0)]", "int[] curveVertexCounts = [2000000000]"),
        "curves whose counts are not of their points",
    ),
    "light that takes away": (prim("SphereLight", "float inputs:intensity = -5"), "light that is negative is left out"),
    "a volume of itself": (prim("Volume", "rel field:density = </x>"), "a volume without a field 'density'"),
    "a material of itself": (
        material(
            "color3f inputs:diffuseColor.connect = </m/s.inputs:emissiveColor>",
            "color3f inputs:emissiveColor.connect = </m/s.inputs:diffuseColor>",
        ),
        "",
    ),
    "a reference to itself": ('def "a" (references = @stage.usda@</a>) {\n}\n', "of the composition is left out"),
    "a reference to nothing": ('def "a" (references = @absent.usda@) {\n}\n', "absent.usda"),
    "a layer of itself": ("(subLayers = [@stage.usda@])\n", "of the composition is left out"),
    "parents of each other": ('def "a" (inherits = </b>) {\n}\ndef "b" (inherits = </a>) {\n}\n', "of the composition is left out"),
    "no times": ("(startTimeCode = nan\nendTimeCode = inf)\n", ""),
    "a deep tree": ("".join(f'def "x{i}" {{\n' for i in range(2000)) + "}\n" * 2000, ""),
}  # fmt: skip


@pytest.mark.parametrize("name", LEFT)
def test_what_is_left_of_others_is_rendered(tmp_path, name):
    text, words = LEFT[name]
    image, told = rendered(tmp_path, text)
    assert np.isfinite(image).all() and words in told


def test_a_pipe_is_no_file(tmp_path):
    """Which would be waited for."""
    os.mkfifo(tmp_path / "pipe.exr")
    with pytest.raises(wend.InputError, match="pipe.exr: error: there is no such file"):
        rendered(tmp_path, prim("DomeLight", "asset inputs:texture:file = @pipe.exr@"))


def test_levels_are_bounded(tmp_path):
    file = tmp_path / "stage.usda"
    file.write_text("#usda 1.0\n" + mesh("catmullClark"))
    with pytest.warns(wend.SceneWarning, match="less than asked for"):
        text = wend.usd.read(file, subdivision=10**6).text()
    assert '"integer levels"' in text


def test_connections_in_a_circle_end(tmp_path):
    wend.Film.of(np.full((2, 2, 3), 0.5, dtype=np.float32)).save(tmp_path / "grey.exr")
    circle = """def Shader "u" {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </m/u.outputs:result>
        float2 outputs:result
    }
"""
    node = texture("grey.exr").replace("float3 outputs", "float2 inputs:st.connect = </m/u.outputs:result>\nfloat3 outputs")
    image, _ = rendered(tmp_path, material("color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>", more=node + circle))
    assert np.isfinite(image).all()


def changed(original, chance):
    """Cut off, or with bytes that are others, large, or repeated."""
    data = bytearray(original)
    if chance.random() < 0.25:
        return bytes(data[: chance.randrange(len(data))])
    for _ in range(chance.choice((1, 2, 8, 64))):
        i, kind = chance.randrange(len(data)), chance.random()
        if kind < 0.5:
            data[i] = chance.randrange(256)
        elif kind < 0.75:
            data[i : i + 8] = chance.choice((b"\xff" * 8, b"\0" * 8, b"\xff\xff\xff\x7f", (10**9).to_bytes(8, "little")))
        else:
            data[i:i] = data[i : i + chance.randrange(20)]
    return bytes(data)


def sample():
    """A small stage with some of everything that is an array."""
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    surface = UsdGeom.Mesh.Define(stage, "/m")
    surface.CreatePointsAttr([(i % 20, i // 20, 0) for i in range(400)])
    corners = [(i, i + 1, i + 21, i + 20) for i in range(379) if i % 20 != 19]
    surface.CreateFaceVertexCountsAttr([4] * len(corners))
    surface.CreateFaceVertexIndicesAttr([i for face in corners for i in face])
    UsdGeom.Camera.Define(stage, "/c").AddTranslateOp().Set((10, 10, 30))
    stage.DefinePrim("/l", "SphereLight")
    copies = UsdGeom.PointInstancer.Define(stage, "/p")
    UsdGeom.Sphere.Define(stage, "/p/s")
    copies.CreatePrototypesRel().AddTarget("/p/s")
    copies.CreateProtoIndicesAttr([0] * 10)
    copies.CreatePositionsAttr([(i, 0, 1) for i in range(10)])
    return stage


@pytest.mark.parametrize("extension", ["usda", "usdc"])
def test_changed_files_end_well(tmp_path, extension):
    """In a process of its own, which may not take more than it is given."""
    original = tmp_path / f"original.{extension}"
    sample().Export(str(original))

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
        resource.setrlimit(resource.RLIMIT_CPU, (120, 120))

    done = subprocess.run(
        [sys.executable, __file__, str(original)], capture_output=True, text=True, errors="replace", preexec_fn=limit
    )
    assert done.returncode == 0, done.stderr[-2000:]
    ends = done.stdout.split()
    assert len(ends) == 60 and set(ends) == {"error", "picture"}


def try_changes(file):
    """Of a file, with a line for each on how it ended."""
    chance, data = random.Random(1), file.read_bytes()
    for _ in range(60):
        changed_file = file.with_stem("changed")
        changed_file.write_bytes(changed(data, chance))
        try:
            image = wend.render(wend.usd.read(changed_file, resolution=(4, 4), spp=1).scene(), sampling="classical").image
            assert np.isfinite(image).all()
            print("picture")
        except wend.InputError:
            print("error")


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    try_changes(pathlib.Path(sys.argv[1]))
