"""How a stage itself wants to be rendered: its RenderSettings, which its metadata name."""

from __future__ import annotations

from typing import Any

from pxr import UsdGeom, UsdRender, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._errors import InputError


def chosen(stage: Any) -> Any:
    """The prim; false where the stage does not say."""
    return UsdRender.Settings.GetStageRenderSettings(stage)


def camera_of(stage: Any) -> Any:
    """The one that is asked for; None for none that is there."""
    settings = chosen(stage)
    targets = settings.GetCameraRel().GetForwardedTargets() if settings else []
    prim = stage.GetPrimAtPath(targets[0]) if targets else None
    return prim if prim and prim.IsA(UsdGeom.Camera) else None


def resolution_of(stage: Any) -> tuple[int, int]:
    """Of the picture that the stage asks for, or what is usual here.

    Raises:
        InputError: for one that no picture has.
    """
    settings = chosen(stage)
    if not settings or not settings.GetResolutionAttr().HasAuthoredValue():
        return (640, 360)
    width, height = (int(side) for side in settings.GetResolutionAttr().Get())
    if width < 1 or height < 1:
        raise InputError(f"{settings.GetPath()}: error: a picture of {width} x {height}")
    return (width, height)


def aperture(stage: Any, width: float, height: float, resolution: tuple[int, int]) -> tuple[float, float]:
    """A camera's, as it is changed to the shape of the picture.

    Raises:
        InputError: for pixels of no shape.
    """
    settings = chosen(stage)
    policy = str(settings.GetAspectRatioConformPolicyAttr().Get()) if settings else "expandAperture"
    pixel = float(settings.GetPixelAspectRatioAttr().Get()) if settings else 1.0
    if not 0 < pixel < float("inf"):
        raise InputError(f"{settings.GetPath()}: error: a pixelAspectRatio of {pixel:g}")
    aspect = resolution[0] / resolution[1] * pixel
    if policy == "adjustPixelAspectRatio":
        return width, height
    is_wider = aspect > width / height
    if policy == "adjustApertureWidth" or (policy != "adjustApertureHeight" and is_wider == (policy != "cropAperture")):
        return height * aspect, height
    return width, width / aspect


def has_blur(stage: Any) -> bool:
    """Whether what moves is blurred."""
    settings = chosen(stage)
    names = ("disableMotionBlur", "instantaneousShutter")
    return not settings or not any(settings.GetPrim().GetAttribute(name).Get() for name in names)


def has_depth_of_field(stage: Any) -> bool:
    """Whether what is out of focus is blurred."""
    settings = chosen(stage)
    return not settings or not settings.GetPrim().GetAttribute("disableDepthOfField").Get()


def purposes(stage: Any) -> list[str]:
    """Of what is to be seen."""
    settings = chosen(stage)
    given = settings.GetIncludedPurposesAttr() if settings else None
    if not given or not given.HasAuthoredValue():
        return [UsdGeom.Tokens.default_, UsdGeom.Tokens.render]
    # What has no purpose is always there.
    return [UsdGeom.Tokens.default_, *(str(purpose) for purpose in given.Get() or [])]


def binding_purpose(stage: Any) -> Any:
    """Of materials that come before those for all purposes."""
    settings = chosen(stage)
    given = settings.GetMaterialBindingPurposesAttr() if settings else None
    if not given or not given.HasAuthoredValue():
        return UsdShade.Tokens.full
    return next(iter(given.Get() or []), UsdShade.Tokens.allPurpose)


def tell(reader: Any) -> None:
    """Of what is left out."""
    settings = chosen(reader.stage)
    if not settings:
        return
    window = settings.GetDataWindowNDCAttr().Get()
    if tuple(window) != (0, 0, 1, 1):
        reader.warn(settings.GetPrim(), "dataWindowNDC is left out: the whole picture is rendered")
    for target in settings.GetProductsRel().GetForwardedTargets():
        product = reader.stage.GetPrimAtPath(target)
        of_settings = UsdRender.SettingsBase(product)
        if not of_settings:
            continue
        known = UsdRender.SettingsBase.GetSchemaAttributeNames(False)
        names = [name for name in known if product.GetAttribute(name).HasAuthoredValue()]
        if of_settings.GetCameraRel().GetTargets():
            names.append("camera")
        if names:
            reader.warn(product, f"what a product asks for is left out: {', '.join(sorted(names))}")
