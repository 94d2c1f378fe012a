"""USD stages as scenes: `python -m wend.usd stage.usda --render picture.exr`, or `wend.usd.read(path)`.

Wants `usd-core` (`pip install 'wend[usd]'`). Lengths are the stage's. What has no counterpart here is told once for each
kind, as a `SceneWarning` with the prim's path.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import _wend
from ._builder import SceneBuilder
from ._errors import InputError
from ._progress import Bar
from ._scene_reader import Places, SceneReader

try:
    from pxr import Tf, Usd, UsdGeom, UsdVol  # type: ignore[import-not-found,import-untyped,unused-ignore]
except ImportError as error:
    raise ImportError("wend.usd wants usd-core: pip install 'wend[usd]'") from error

from . import _reader_command as command
from . import _usd_blender as blender
from . import _usd_camera as cameras
from . import _usd_lights as lights
from . import _usd_old_lights as old_lights
from . import _usd_materials as materials
from . import _usd_settings as settings
from . import _usd_skeletons as skeletons
from . import _usd_unread as unread
from ._usd_colours import COLOURS, coloured, display_colour
from ._usd_copies import Copies
from ._usd_curves import curve_segments
from ._usd_errors import named, reason
from ._usd_files import file_of
from ._usd_shapes import box_mesh, mesh_parts, primitive_mesh
from ._usd_subdivision import Refinement


def read(
    path: str | os.PathLike[str],
    *,
    time: float | None = None,
    camera: str | None = None,
    resolution: tuple[int, int] | None = None,
    spp: int = 64,
    maps: str | os.PathLike[str] | None = None,
    subdivision: int | None = None,
    progress: bool = False,
) -> SceneBuilder:
    """A stage as it is composed, in the terms of the renderer.

    Args:
        path: a .usda, .usdc, .usd or .usdz file.
        time: the time code; None: the stage's first frame, or its first sample where it names
            none, or its default values where it has no samples.
        camera: path of the camera's prim; None: the one of the stage's render settings, or the first, or a view of all.
        resolution: (width, height) of the picture; None: that of the stage's render settings, or 640 x 360. Its shape
            decides what the camera sees above and below, or at the sides, of its aperture.
        spp: samples per pixel.
        maps: folder for pictures that are made for the scene; None: one that goes away when the program ends.
        subdivision: how often edges of subdivision surfaces are halved; None: until they are two pixels long where the
            surface is nearest, 1 to 6 times, and 2 times for what is copied.
        progress: show a bar (tqdm).

    Raises:
        InputError: for a file that is no stage, or a camera that is not in it.

    Warns:
        SceneWarning: for what has no counterpart, each kind once, with the path of a prim.
    """
    try:
        stage = Usd.Stage.Open(os.fspath(path))
    except Tf.ErrorException as error:
        raise InputError(f"{os.fspath(path)}: error: {reason(error)}") from None
    except UnicodeDecodeError:
        # USD's own message quotes what is wrong.
        raise InputError(f"{os.fspath(path)}: error: its text is not UTF-8") from None
    if time is None:
        time = unread.first_time(stage, os.fspath(path))
    when = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)
    return _Reader(stage, os.fspath(path), when, maps, Refinement(subdivision)).read(camera, resolution, spp, progress)


class _Reader(SceneReader):
    def __init__(
        self, stage: Any, file: str, time: Any, maps: str | os.PathLike[str] | None, refinement: Refinement
    ) -> None:
        super().__init__(file, maps)
        self.file = file
        self.refinement = refinement
        self.stage = stage
        self.time = time
        #: when the shutter opens and when it closes; the time twice where nothing is blurred
        self.shutter = [time, time]
        self.transforms = [UsdGeom.XformCache(time)] * 2
        self.purposes = settings.purposes(stage)
        self.binding_purpose = settings.binding_purpose(stage)
        self.copies = Copies()
        self.unpacked: dict[str, str] = {}  #: files of packages
        self.pictures = 0  #: how many others were made
        self.has_light = False

    def warn(self, prim: Any, text: str) -> None:
        self.tell(str(prim.GetPath()), text)

    def read(self, path: str | None, resolution: tuple[int, int] | None, spp: int, progress: bool) -> SceneBuilder:
        add = self.builder.add
        resolution = resolution or settings.resolution_of(self.stage)
        eye = cameras.find(self, path)
        with named(eye or self.stage.GetPseudoRoot()):
            cameras.add(self, eye, resolution)
            settings.tell(self)
            old_lights.rename(self)
            skeletons.pose(self)
            film: dict[str, Any] = {"integer xresolution": resolution[0], "integer yresolution": resolution[1]}
            exposure = cameras.exposure(self, eye)
        if exposure != 1:
            film["float iso"] = 100 * exposure
        add("Film", "rgb", film)
        add("Sampler", "sobol", {"integer pixelsamples": spp})
        add("Integrator", "volpath", {"integer maxdepth": 64})
        add("WorldBegin")
        for error in getattr(self.stage, "GetCompositionErrors", list)():
            self.tell(str(error.rootSite.path), f"of the composition is left out: {error}".strip())
        prims = list(self.prims(self.stage.GetPseudoRoot()))
        bar = Bar(os.path.basename(self.file), progress)
        for i, prim in enumerate(prims):
            bar.update(i / len(prims), prim.GetName())
            with named(prim):
                self.add_prim(prim, self.world(prim), in_object=False)
        bar.close()
        if not self.has_light:
            self.warn(self.stage.GetPseudoRoot(), "no light: a grey sky of radiance 1 is put around")
            add("LightSource", "infinite", {"rgb L": (1, 1, 1)})
        return self.builder

    def world(self, prim: Any) -> Places:
        """Raises ValueError for places that are no numbers."""
        places = np.array([transforms.GetLocalToWorldTransform(prim) for transforms in self.transforms])
        if not np.isfinite(places).all():
            raise ValueError("its place is no number")
        return places

    def place_at_time(self, prim: Any, world: Places) -> Any:
        """At the time of the picture, as far as the prim is no copy; else where the shutter opens."""
        is_copy = not np.array_equal(self.world(prim), world)
        return world[0] if is_copy else np.array(UsdGeom.XformCache(self.time).GetLocalToWorldTransform(prim))

    def prims(self, root: Any) -> Iterator[Any]:
        """Those that are to be seen; what an instancer copies is left to it."""
        # What is copied may be below overs, so that it is not seen where it is.
        kept = Usd.PrimDefaultPredicate if root.IsDefined() else skeletons.with_overs()
        walk = iter(Usd.PrimRange(root, Usd.TraverseInstanceProxies(kept)))
        for prim in walk:
            imageable = UsdGeom.Imageable(prim)
            if imageable and not prim.IsPseudoRoot():
                if imageable.GetVisibilityAttr().Get(self.time) == UsdGeom.Tokens.invisible:
                    walk.PruneChildren()
                    continue
                if not self.is_for_renders(imageable):
                    # What is within it may be for another purpose, but for what is copied.
                    if prim.IsA(UsdGeom.PointInstancer):
                        walk.PruneChildren()
                    continue
            if prim.IsA(UsdGeom.PointInstancer):
                walk.PruneChildren()
            yield prim

    def is_for_renders(self, imageable: Any) -> bool:
        """By its purpose, and the visibility that some are given for that alone."""
        purpose = imageable.ComputePurpose()
        if purpose not in self.purposes:
            return False
        is_plain = purpose == UsdGeom.Tokens.default_
        return bool(is_plain or imageable.ComputeEffectiveVisibility(purpose, self.time) != UsdGeom.Tokens.invisible)

    def add_prim(self, prim: Any, world: Places, in_object: bool) -> None:
        unread.tell(self, prim)
        if lights.is_light(prim):
            self.has_light = lights.add(self, prim, world) or self.has_light
        elif prim.IsA(UsdGeom.Mesh):
            for part, faces in mesh_parts(self, prim, world[0], in_object):
                self.add_shape(prim, part, world, faces, in_object)
        elif prim.IsA(UsdGeom.BasisCurves):
            for segment in curve_segments(self, prim):
                self.add_shape(prim, prim, world, ("curve", segment), in_object)
        elif prim.IsA(UsdGeom.Sphere):
            radius = float(UsdGeom.Sphere(prim).GetRadiusAttr().Get(self.time))
            self.add_shape(prim, prim, world, ("sphere", {"float radius": radius}), in_object)
        elif prim.IsA(UsdVol.Volume):
            self.add_volume(prim, world)
        elif prim.IsA(UsdGeom.PointInstancer):
            self.copies.add(self, prim, world)
        elif prim.IsA(UsdGeom.Gprim):
            mesh = primitive_mesh(prim, self.time)
            if mesh is None:
                self.warn(prim, f"a {prim.GetTypeName()} is left out")
            else:
                self.add_shape(prim, prim, world, ("trianglemesh", mesh), in_object)

    def add_shape(
        self, prim: Any, bound: Any, world: Places, shape: tuple[str, dict[str, Any]], in_object: bool
    ) -> None:
        """`bound` is what a material may be bound to: the prim, or a subset of its faces."""
        kind, parameters = shape
        with self.builder.block():
            self.put(world)
            look = materials.look_of(self, prim, bound)
            given = parameters.pop(COLOURS, None)
            name = look.name
            if look.colours is not None:
                name = coloured(self, prim, look, given, parameters.get("integer indices"))
            self.builder.add("NamedMaterial", name)
            if look.medium is not None:
                self.builder.add("MediumInterface", look.medium, "")
            if look.has_pictures and "point2 uv" not in parameters:
                self.warn(prim, "a shape without texture coordinates has the pictures of its material somewhere")
            if "point2 uv" in parameters and not np.array_equal(look.frame, np.eye(3)):
                parameters["point2 uv"] = parameters["point2 uv"] @ look.frame[:2, :2].T + look.frame[:2, 2]
            if look.shine is not None:
                coordinates = parameters.get("point2 uv", 0)
                if "string filename" in look.shine and (np.min(coordinates) < -1e-4 or np.max(coordinates) > 1 + 1e-4):
                    self.warn(prim, "a picture that shines does not go on beyond its edges")
                self.builder.add("AreaLightSource", "diffuse", look.shine | {"bool alphaonce": True})
                self.has_light = True
            self.builder.add("Shape", kind, parameters | look.shape_parameters)

    def add_volume(self, prim: Any, world: Places) -> None:
        fields = UsdVol.Volume(prim).GetFieldPaths()
        field = self.stage.GetPrimAtPath(fields["density"]) if "density" in fields else None
        if not field or not field.IsA(UsdVol.OpenVDBAsset):
            self.warn(prim, "a volume without a field 'density' of OpenVDB is left out")
            return
        if len(fields) > 1:
            others = ", ".join(sorted(name for name in fields if name != "density"))
            self.warn(prim, f"of a volume's fields the density is taken, and left out are: {others}")
        if not np.allclose(UsdGeom.Xformable(field).GetLocalTransformation(self.time), np.eye(4)):
            self.warn(field, "a field lies in its volume as its file says, whatever place it has itself")
        asset = UsdVol.OpenVDBAsset(field)
        path = asset.GetFilePathAttr().Get(self.time)
        if not path:
            self.warn(prim, "a volume without a file is left out")
            return
        file = file_of(self, path)
        grid = asset.GetFieldNameAttr().Get(self.time) or "density"
        extent = UsdGeom.Boundable(prim).GetExtentAttr().Get(self.time) or _wend.volume_bounds(file, grid)
        colour = display_colour(prim, self.time)
        # A copy has its own: it lies where it was made.
        name = f"{prim.GetPath()} {len(self.builder)}"
        with self.builder.block():
            self.put(world)
            self.builder.add(
                "MakeNamedMedium",
                name,
                {
                    "string type": "nanovdb",
                    "string filename": file,
                    "string gridname": grid,
                    "rgb sigma_s": colour,
                    "rgb sigma_a": np.maximum(1 - np.asarray(colour), 0),
                    "float scale": blender.density_factor(prim, world[0]),
                },
            )
            self.builder.add("MediumInterface", name, "")
            self.builder.add("Material", "interface")
            self.builder.add("Shape", "trianglemesh", box_mesh(np.array(extent[0]), np.array(extent[1])))
        self.warn(prim, "a volume scatters as much as its density says, with the display colour as its albedo")


def main(arguments: list[str] | None = None) -> int:
    """What `python -m wend.usd` does; the exit status."""
    parser = argparse.ArgumentParser(prog="python -m wend.usd", description="render a USD stage, or write it as a pbrt scene")
    parser.add_argument("stage", help=".usda, .usdc, .usd or .usdz")
    parser.add_argument("--frame", type=float, help="time code (default: the first, or the default values)")
    parser.add_argument("--camera", metavar="PRIM", help="path of the camera (default: the one of the render settings, or the first)")
    parser.add_argument("--resolution", metavar="WxH", help="(default: that of the render settings, or 640x360)")
    parser.add_argument(
        "--subdivision", type=int, metavar="N", help="halve edges of subdivision surfaces N times (default: to two pixels)"
    )
    command.add_options(parser)
    options = command.parsed(parser, arguments)

    def convert() -> None:
        builder = read(
            options.stage,
            time=options.frame,
            camera=options.camera,
            resolution=command.size_of(options.resolution) if options.resolution else None,
            spp=options.spp,
            maps=command.maps_of(options.output),
            subdivision=options.subdivision,
            progress=True,
        )
        command.deliver(builder, options, options.output, options.render)

    return command.as_command(convert)


if __name__ == "__main__":
    sys.exit(main())
