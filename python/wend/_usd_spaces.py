"""Whether colours of USD are encoded: by the name of their space, and by what a picture's file says."""

from __future__ import annotations

#: Colour spaces of pictures that are taken as they are: by the names of USD, MaterialX, and the configurations of ACES.
_LINEAR = (
    "", "raw", "data", "linear", "identity", "unknown", "none", "lin_rec709", "lin_rec709_scene", "lin_srgb", "linear srgb",
    "linear rec.709 (srgb)", "scene-linear rec.709-srgb", "utility - raw", "utility - linear - srgb",
    "utility - linear - rec.709",
)  # fmt: skip
_ENCODED = (
    "srgb", "srgb_texture", "srgb_rec709_scene", "srgb_tx", "srgb - texture", "srgb - display", "srgb texture",
    "srgb encoded rec.709 (srgb)", "input - generic - srgb - texture", "utility - srgb - texture",
)  # fmt: skip


def is_encoded_space(name: str) -> bool | None:
    """Whether colours of it are encoded by sRGB's curve; None for one that has another curve or other primaries."""
    name = name.lower()
    return True if name in _ENCODED else False if name in _LINEAR else None


def is_grey(file: str) -> bool:
    """Whether a picture has one channel, and perhaps an opacity; of PNG and JPEG files."""
    with open(file, "rb") as opened:
        head = opened.read(1 << 16)
    if head.startswith(b"\x89PNG"):
        return len(head) > 25 and head[25] in (0, 4)
    place = 2
    # JPEG: segments up to the one of the frame, which has the number of channels.
    while head.startswith(b"\xff\xd8") and place + 9 < len(head) and head[place] == 0xFF:
        if head[place + 1] in (0xC0, 0xC1, 0xC2):
            return head[place + 9] == 1
        place += 2 + int.from_bytes(head[place + 2 : place + 4], "big")
    return False


def has_bytes(file: str) -> bool:
    """Whether a picture's numbers are of 8 bits, which are read as sRGB."""
    name = file.lower()
    if name.endswith(".png"):
        with open(file, "rb") as opened:
            head = opened.read(25)
        return len(head) == 25 and head[24] <= 8
    return name.endswith((".jpg", ".jpeg", ".tga", ".bmp", ".qoi", ".gif"))
