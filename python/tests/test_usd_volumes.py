"""Volumes of USD, against Beer and Lambert's law."""

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is not installed")
from pxr import Gf, UsdGeom, UsdLux, UsdVol  # noqa: E402
from usd_stage import Stage, middle  # noqa: E402

#: Around (130, 1, 1) to (134, 5, 6) its density is 1/2.
FILE = Path(__file__).resolve().parents[2] / "fuzz" / "corpus" / "vdb" / "zip.vdb"
EXTENT = np.array([(130, 1, 1), (134, 5, 6)], dtype=np.float64)


@pytest.mark.parametrize("turned", [False, True], ids=["along z", "along x"])
@pytest.mark.parametrize(
    ("scale", "parent", "axis", "metres"),
    [(1, 1, "Y", 1), (2, 1, "Y", 1), (0.5, 2, "Y", 1), (2, 1, "Z", 0.01)],
    ids=["plain", "larger", "within a scale", "centimetres"],
)
def test_a_volume_is_as_dense_for_each_unit_of_the_stage(tmp_path, scale, parent, axis, metres, turned):
    """Whatever its own scale. A black cloud before an even dome."""
    stage = Stage(tmp_path)
    UsdGeom.SetStageUpAxis(stage.stage, axis)
    UsdGeom.SetStageMetersPerUnit(stage.stage, metres)
    UsdLux.DomeLight.Define(stage.stage, "/dome")
    UsdGeom.XformCommonAPI(UsdGeom.Xform.Define(stage.stage, "/root")).SetScale(Gf.Vec3f(parent))
    volume = UsdVol.Volume.Define(stage.stage, "/root/cloud")
    field = UsdVol.OpenVDBAsset.Define(stage.stage, "/root/cloud/density")
    field.CreateFilePathAttr(str(FILE))
    field.CreateFieldNameAttr("density")
    volume.CreateFieldRelationship("density", field.GetPath())
    volume.CreateExtentAttr([tuple(map(float, corner)) for corner in EXTENT])
    UsdGeom.Gprim(volume).CreateDisplayColorAttr([(0, 0, 0)])
    placed = Gf.Matrix4d(1).SetTranslate(Gf.Vec3d(*-EXTENT.mean(axis=0)))
    placed *= Gf.Matrix4d(1).SetScale(scale)
    placed *= Gf.Matrix4d(1).SetRotate(Gf.Rotation(Gf.Vec3d(0, 1, 0), 90 if turned else 0))
    placed *= Gf.Matrix4d(1).SetTranslate(Gf.Vec3d(0, 0, -30 / parent))
    UsdGeom.Xformable(volume).AddTransformOp().Set(placed)
    # All but parallel rays through the middle.
    stage.camera.CreateHorizontalApertureAttr(0.02)
    stage.camera.CreateVerticalApertureAttr(0.02)
    through = np.ptp(EXTENT, axis=0)[0 if turned else 2] * scale * parent
    np.testing.assert_allclose(middle(stage.image(size=(3, 3))), np.exp(-0.5 * through), rtol=1e-4)
