"""What the tests of USD share: a stage with a camera, and what is seen of it."""

import warnings

from pxr import Gf, Usd, UsdGeom
import wend
import wend.usd


class Stage:
    """A stage in a file, with a camera at the origin that looks along -z and sees 90 degrees across."""

    def __init__(self, folder):
        self.file = folder / "stage.usda"
        self.stage = Usd.Stage.CreateNew(str(self.file))
        camera = UsdGeom.Camera.Define(self.stage, "/camera")
        camera.CreateHorizontalApertureAttr(20)
        camera.CreateVerticalApertureAttr(20)
        camera.CreateFocalLengthAttr(10)
        self.camera = camera

    def read(self, *, size=(9, 9), spp=16, **options):
        self.stage.GetRootLayer().Save()
        return wend.usd.read(self.file, resolution=size, spp=spp, **options)

    def sky(self):
        """Of radiance 1 everywhere."""
        self.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
        return self

    def told(self):
        """What it is warned of."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            self.read()
        return [str(w.message) for w in caught if w.category is wend.SceneWarning]

    def image(self, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", wend.SceneWarning)
            return wend.render(self.read(**options).scene(), sampling="classical", progress=False).image.copy()

    def look(self, towards):
        """The camera looks along +-x, +-y or +z."""
        degrees = {"+x": (0, -90, 0), "-x": (0, 90, 0), "+y": (90, 0, 0), "-y": (-90, 0, 0), "+z": (0, 180, 0)}[towards]
        UsdGeom.XformCommonAPI(self.camera).SetRotate(Gf.Vec3f(*degrees))

    def lamp(self, kind, place=(0, 0, -3), turn=(0, 180, 0), scale=(1, 1, 1), **inputs):
        """By default it shines at the camera."""
        prim = self.stage.DefinePrim("/lamp", kind)
        api = UsdGeom.XformCommonAPI(prim)
        api.SetTranslate(Gf.Vec3d(*place))
        api.SetRotate(Gf.Vec3f(*turn))
        api.SetScale(Gf.Vec3f(*scale))
        for name, value in inputs.items():
            prim.GetAttribute(f"inputs:{name}").Set(value)
        return prim

    def card(self, colour=(0.5, 0.5, 0.5), distance=2.0, half=10.0, path="/card"):
        mesh = UsdGeom.Mesh.Define(self.stage, path)
        h, z = half, -distance
        mesh.CreatePointsAttr([(-h, -h, z), (h, -h, z), (h, h, z), (-h, h, z)])
        mesh.CreateFaceVertexCountsAttr([4])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
        mesh.CreateSubdivisionSchemeAttr("none")
        mesh.CreateDisplayColorAttr([colour])
        return mesh


def middle(image):
    return image[image.shape[0] // 2, image.shape[1] // 2]


def coverage(stage, size=(80, 80)):
    """The share of the picture that black things take before a white sky."""
    sky = stage.stage.DefinePrim("/sky", "DomeLight")
    sky.GetAttribute("inputs:intensity").Set(1.0)
    return 1 - float(stage.image(size=size, spp=64)[:, :, 0].mean())
