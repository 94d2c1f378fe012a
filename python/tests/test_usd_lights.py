"""Lights of USD that are shaped, have a picture, or an angle: in closed form, or by what their files say."""

import math

import numpy as np
import pytest
import wend

pytest.importorskip("pxr", reason="usd-core is absent")
pytestmark = pytest.mark.filterwarnings("ignore:.*no light:wend.SceneWarning")

from pxr import Gf, Sdf, UsdGeom, UsdLux, UsdShade  # noqa: E402

from usd_stage import Stage, middle  # noqa: E402
from wend import _ies  # noqa: E402


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


def test_distant_lights_with_an_angle_are_disks_of_the_sky(stage):
    # The disk itself: 60 degrees across, before a camera that sees 90.
    prim = stage.lamp("DistantLight", turn=(0, 180, 0), intensity=2.0, angle=60.0)
    seen = stage.image(size=(81, 81), spp=64)[:, :, 0]
    assert middle(seen) == pytest.approx(2, rel=1e-4)
    assert seen.mean() == pytest.approx(2 * math.pi * math.tan(math.radians(30)) ** 2 / 4, rel=0.01)
    # A card that faces it, of albedo 1/2: pi L sin² comes in. At 45 degrees all of the disk is still seen.
    stage.card()
    for tilt in (0, 45):
        UsdGeom.XformCommonAPI(prim).SetRotate(Gf.Vec3f(tilt, 0, 0))
        expected = 0.5 * 2 * math.sin(math.radians(30)) ** 2 * math.cos(math.radians(tilt))
        assert middle(stage.image(size=(5, 5), spp=1024)) == pytest.approx(np.full(3, expected), rel=0.02)


def test_rectangles_have_pictures_upright_for_who_looks_at_them(stage, tmp_path):
    picture = np.zeros((16, 32, 3), dtype=np.float32)
    picture[:8, :16] = (1, 0, 0)  # above, left
    picture[:8, 16:] = (0, 1, 0)
    picture[8:, :16] = (0, 0, 1)
    picture[8:, 16:] = (1, 1, 0)
    wend.Film.of(picture).save(tmp_path / "lamp.exr")
    prim = stage.lamp("RectLight", place=(0, 0, -2), width=4.0, height=4.0, intensity=3.0, color=Gf.Vec3f(1, 0.5, 1))
    prim.GetAttribute("inputs:texture:file").Set(Sdf.AssetPath(str(tmp_path / "lamp.exr")))
    image = stage.image(size=(8, 8), spp=16)
    assert image[1, 1] == pytest.approx((3, 0, 0), abs=1e-3)
    assert image[1, 6] == pytest.approx((0, 1.5, 0), abs=1e-3)
    assert image[6, 1] == pytest.approx((0, 0, 3), abs=1e-3)
    assert image[6, 6] == pytest.approx((3, 1.5, 0), abs=1e-3)


def ies_file(folder, vertical, horizontal, candela, multiplier=1.0, head="IESNA:LM-63-2002\n[TEST] none\n", tilt="NONE"):
    file = folder / "lamp.ies"
    rows = "\n".join(" ".join(str(x) for x in row) for row in candela)
    file.write_text(
        f"{head}TILT={tilt}\n"
        f"1 1000 {multiplier} {len(vertical)} {len(horizontal)} 1 2 0 0 0\n1 1 50\n"
        f"{' '.join(map(str, vertical))}\n{' '.join(map(str, horizontal))}\n{rows}\n"
    )
    return file


def test_photometric_files_are_read_and_completed(tmp_path):
    file = ies_file(tmp_path, [0, 45, 90], [0, 90], [[10, 20, 30], [40, 50, 60]], multiplier=2)
    profile = _ies.read(file)
    at = lambda v, h: float(profile.at(np.array(float(v)), np.array(float(h))))  # noqa: E731
    assert at(0, 0) == 20 and at(22.5, 0) == 30 and at(45, 45) == 70 and at(90, 90) == 120
    # A quarter stands for all four, and nothing is beyond.
    assert at(45, 135) == 70 and at(45, 180) == 40 and at(45, 270) == 100 and at(100, 0) == 0
    half = _ies.read(ies_file(tmp_path, [0, 90], [0, 90, 180], [[1, 1], [2, 2], [5, 5]]))
    assert float(half.at(np.array(10.0), np.array(270.0))) == 2 and float(half.at(np.array(10.0), np.array(180.0))) == 5
    whole = _ies.read(ies_file(tmp_path, [0, 90, 180], [0, 180, 360], [[1, 1, 1], [3, 3, 3], [1, 1, 1]]))
    assert float(whole.at(np.array(170.0), np.array(270.0))) == 2
    assert whole.mean() == pytest.approx(2, rel=1e-3)
    # cos² over the lower half: a mean of a third over that half.
    angles = np.arange(0, 91, 1)
    cosines = _ies.read(ies_file(tmp_path, angles, [0], [np.cos(np.radians(angles)) ** 2]))
    assert cosines.mean() == pytest.approx(1 / 3, rel=1e-3)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("IESNA\n", "no line TILT="),
        ("IESNA\nTILT=NONE\n1 2 x\n", "numbers alone"),
        ("IESNA\nTILT=NONE\n1 2\n", ":3: error: the numbers of a lamp are missing"),
        ("IESNA\nTILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90 0 1\n", "4 numbers are too few for 2 x 1"),
        ("IESNA\nTILT=NONE\n1 1 1 2 1 3 2 0 0 0\n1 1 1\n0 90 0 1 1\n", "type C"),
        ("IESNA\nTILT=NONE\n1 1 1 90000 90000 1 2 0 0 0\n1 1 1\n", "too many"),
        ("IESNA\nTILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n90 0 0 1 1\n", "do not grow"),
    ],
)
def test_broken_photometric_files_are_named(tmp_path, text, what):
    file = tmp_path / "broken.ies"
    file.write_text(text)
    with pytest.raises(wend.InputError, match="broken.ies") as told:
        _ies.read(file)
    assert what in str(told.value)
    with pytest.raises(wend.InputError, match="absent.ies"):
        _ies.read(tmp_path / "absent.ies")


def test_profiles_shape_spheres(stage, tmp_path):
    # A card below the light, 2 across from the camera; the light shines at it by the cosine of the angle off its axis.
    angles = np.arange(0, 181, 2)
    file = ies_file(tmp_path, angles, [0], [np.maximum(np.cos(np.radians(angles)), 0) * 7])
    stage.card()
    prim = stage.lamp("SphereLight", place=(0, 0, 0.5), turn=(0, 0, 0), radius=0.1, intensity=100.0)
    shaping = UsdLux.ShapingAPI.Apply(prim)
    shaping.CreateShapingIesFileAttr(str(file))
    image = stage.image(spp=16, size=(91, 91))
    straight = 0.5 / math.pi * 100 * math.pi * 0.01 / 2.5**2
    assert middle(image) == pytest.approx(np.full(3, 7 * straight), rel=5e-3)
    # At the side, x = 1: another cosine, with those of the card and the distance.
    column = 45 + round(1 / 2 * 45)
    x = (column - 45) / 91 * 4
    cosine = 2.5 / math.hypot(2.5, x)
    assert image[45, column] == pytest.approx(np.full(3, 7 * straight * cosine**4), rel=0.01)
    # Normalised, its mean over the sphere is one: that of the cosine is a quarter.
    shaping.CreateShapingIesNormalizeAttr(True)
    assert middle(stage.image(spp=16, size=(91, 91))) == pytest.approx(np.full(3, 4 * straight), rel=5e-3)
    # Half as wide.
    shaping.CreateShapingIesNormalizeAttr(False)
    shaping.CreateShapingIesAngleScaleAttr(0.5)
    narrow = stage.image(spp=16, size=(91, 91))[45, column]
    angle = math.acos(cosine)
    assert narrow == pytest.approx(np.full(3, 7 * straight * math.cos(2 * angle) * cosine**3), rel=0.01)


def test_focus_and_cones_shape_flat_lights(stage):
    stage.card()
    prim = stage.lamp("RectLight", place=(0, 0, 0.5), turn=(0, 0, 0), width=0.2, height=0.1, intensity=100.0)
    shaping = UsdLux.ShapingAPI.Apply(prim)
    shaping.CreateShapingFocusAttr(3.0)
    straight = 0.5 / math.pi * 100 * 0.02 / 2.5**2
    column = 45 + round(1 / 2 * 45)
    cosine = 2.5 / math.hypot(2.5, (column - 45) / 91 * 4)
    with pytest.warns(wend.SceneWarning, match="/lamp: warning: a light that is shaped is taken as a point"):
        stage.read()
    image = stage.image(spp=16, size=(91, 91))
    assert middle(image) == pytest.approx(np.full(3, straight), rel=5e-3)
    # Its own cosine, that of the focus, and those of the card and the distance.
    assert image[45, column] == pytest.approx(np.full(3, straight * cosine ** (4 + 3)), rel=0.01)
    shaping.CreateShapingFocusAttr(0.0)
    shaping.CreateShapingConeAngleAttr(20.0)
    image = stage.image(spp=16, size=(91, 91))
    assert middle(image) == pytest.approx(np.full(3, straight), rel=5e-3)
    assert image[45, 2] == pytest.approx((0, 0, 0), abs=1e-6)


@pytest.mark.parametrize("kind", ["SphereLight", "Cube", "Mesh"])
def test_copies_of_what_shines_shine(stage, kind):
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/copies")
    thing = stage.stage.DefinePrim("/copies/thing", kind)
    if kind == "SphereLight":
        thing.GetAttribute("inputs:radius").Set(1.0)
        thing.GetAttribute("inputs:intensity").Set(3.0)
    else:
        if kind == "Mesh":
            mesh = UsdGeom.Mesh(thing)
            mesh.CreatePointsAttr([(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
            mesh.CreateFaceVertexCountsAttr([4])
            mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
            mesh.CreateSubdivisionSchemeAttr("none")
        material = UsdShade.Material.Define(stage.stage, "/glow")
        shader = UsdShade.Shader.Define(stage.stage, "/glow/s")
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set((3, 3, 3))
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set((0, 0, 0))
        shader.CreateInput("ior", Sdf.ValueTypeNames.Float).Set(1.0)
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        UsdShade.MaterialBindingAPI.Apply(thing).Bind(material)
    instancer.CreatePrototypesRel().AddTarget(thing.GetPath())
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(-3, 0, -6), (3, 0, -6)])
    image = stage.image(size=(36, 36), spp=16)[:, :, 0]
    # At distance 6 three pixels are a unit.
    assert image[17:19, 8:10] == pytest.approx(np.full((2, 2), 3), rel=1e-3)
    assert image[17:19, 26:28] == pytest.approx(np.full((2, 2), 3), rel=1e-3)
    assert image[17:19, 17:19] == pytest.approx(np.zeros((2, 2)), abs=1e-3)


def test_a_light_without_a_size_is_where_it_is_at_the_time(stage):
    stage.card()
    prim = stage.lamp("SphereLight", place=(0, 0, 0), turn=(0, 0, 0), radius=0.0, intensity=400.0, normalize=True)
    prim.GetAttribute("treatAsPoint").Set(True)
    place = UsdGeom.Xformable(prim).GetOrderedXformOps()[0]
    for time, z in ((1, -1.5), (2, -1.0), (3, 2.0)):
        place.Set(Gf.Vec3d(0, 0, z), time)
    intensity = prim.GetAttribute("inputs:intensity")
    intensity.Set(400.0, 1)
    intensity.Set(800.0, 3)
    stage.camera.CreateShutterOpenAttr(-0.5)
    stage.camera.CreateShutterCloseAttr(0.5)
    # It is normalised: a quarter of its strength is the intensity. One unit before the card.
    expected = 0.5 / math.pi * 600 / 4
    assert middle(stage.image(spp=64, size=(91, 91), time=2)) == pytest.approx(np.full(3, expected), rel=2e-3)


def test_rims_of_cones_fall_off_by_the_angle(stage):
    stage.card()
    prim = stage.lamp("SphereLight", place=(0, 0, 0.5), turn=(0, 0, 0), radius=0.1, intensity=100.0)
    shaping = UsdLux.ShapingAPI.Apply(prim)
    shaping.CreateShapingConeAngleAttr(40.0)
    shaping.CreateShapingConeSoftnessAttr(0.75)
    image = stage.image(spp=16, size=(91, 91))
    straight = 0.5 / math.pi * 100 * math.pi * 0.01 / 2.5**2
    for x in (0.2, 0.8, 1.2, 1.6):
        column = 45 + round(x / 2 * 45)
        x = (column - 45) / 91 * 4
        angle = math.degrees(math.atan2(x, 2.5))
        t = min(max((angle - 10) / 30, 0), 1)
        expected = straight * math.cos(math.radians(angle)) ** 3 * (1 - t * t * (3 - 2 * t))
        assert image[45, column] == pytest.approx(np.full(3, expected), rel=0.02)


@pytest.mark.parametrize("kind", ["SphereLight", "DiskLight", "RectLight", "CylinderLight"])
def test_mirrored_lights_shine_where_others_do(stage, kind):
    stage.card()
    prim = stage.lamp(kind, place=(0.5, 0.3, 0), turn=(0, 20, 0), intensity=10.0)
    as_it_is = stage.image(spp=256).mean()
    UsdGeom.XformCommonAPI(prim).SetScale(Gf.Vec3f(-1, 1, 1))
    assert stage.image(spp=256).mean() == pytest.approx(as_it_is, rel=0.02)
    assert as_it_is > 0.01


def test_lights_by_old_names_are_read(stage):
    prim = stage.lamp("RectLight")
    for name, kind, value in (
        ("intensity", "Float", 4.0), ("exposure", "Float", 1.0), ("color", "Color3f", (1, 0.5, 0.25)),
        ("width", "Float", 2.0), ("height", "Float", 20.0), ("normalize", "Bool", True),
    ):  # fmt: skip
        prim.CreateAttribute(name, getattr(Sdf.ValueTypeNames, kind)).Set(value)
    # What is said by the new name counts.
    prim.GetAttribute("inputs:height").Set(2.0)
    assert middle(stage.image()) == pytest.approx(np.array([2, 1, 0.5]), rel=1e-3)
    prim.GetAttribute("intensity").Set(8.0, 1)
    prim.GetAttribute("intensity").Set(16.0, 3)
    assert middle(stage.image(time=2)) == pytest.approx(np.array([6, 3, 1.5]), rel=1e-3)


def test_old_names_in_instances_are_named(stage):
    stage.stage.DefinePrim("/group")
    light = stage.stage.DefinePrim("/group/light", "RectLight")
    light.CreateAttribute("intensity", Sdf.ValueTypeNames.Float).Set(4.0)
    instance = stage.stage.DefinePrim("/instance")
    instance.GetReferences().AddInternalReference("/group")
    instance.SetInstanceable(True)
    with pytest.warns(wend.SceneWarning, match="/instance/light.*before USD 21.02"):
        stage.read()
