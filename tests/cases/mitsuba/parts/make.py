"""Writes the volumes, meshes and pictures beside it, which the scenes refer to: `python make.py`. Wants mitsuba."""

import struct
import zlib
from pathlib import Path

import mitsuba
import numpy as np

HERE = Path(__file__).parent


def write_volume(name: str, values: np.ndarray, low: tuple[float, ...], high: tuple[float, ...]) -> None:
    """`values` by z, y, x and channel."""
    depth, height, width, channels = values.shape
    head = b"VOL\x03" + struct.pack("<5i", 1, width, height, depth, channels) + struct.pack("<6f", *low, *high)
    (HERE / name).write_bytes(head + values.astype("<f4").tobytes())


def write_sky(name: str) -> None:
    """A picture by longitude and latitude, with a coloured sun to the left of its middle. Rows from below, as PFM has
    them."""
    row, column = np.mgrid[0:32, 0:64]
    longitude, latitude = (column + 0.5) / 64, (row + 0.5) / 32
    sun = 6 * np.exp(-(((longitude - 0.4) / 0.08) ** 2) - ((latitude - 0.3) / 0.12) ** 2)
    sky = np.stack([0.2 + sun, 0.3 + 0.6 * sun, 0.2 + 0.5 * (1 - latitude)], axis=-1)
    (HERE / name).write_bytes(b"PF\n64 32\n-1\n" + sky[::-1].astype("<f4").tobytes())


def write_serialized(name: str) -> None:
    """Two meshes, of version 4: a triangle, and a square with texture coordinates, in double precision."""

    def mesh(flags: int, arrays: list[np.ndarray], vertices: int, triangles: np.ndarray) -> bytes:
        body = struct.pack("<I", flags) + b"part\0" + struct.pack("<QQ", vertices, len(triangles))
        body += b"".join(a.tobytes() for a in arrays) + triangles.astype("<u4").tobytes()
        return struct.pack("<HH", 0x041C, 4) + zlib.compress(body)

    triangle = mesh(0x1000, [np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")], 3, np.array([[0, 1, 2]]))
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0.5], [-1, 1, 0]], "<f8")
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "<f8")
    square = mesh(0x2002, [corners, uvs], 4, np.array([[0, 1, 2], [0, 2, 3]]))
    table = struct.pack("<QQI", 0, len(triangle), 2)
    (HERE / name).write_bytes(triangle + square + table)


def write_pictures() -> None:
    """No two corners are alike, and no rotation or reflection leaves the mean over a part."""
    row, column = np.mgrid[0:12, 0:16]
    v, u = (row + 0.5) / 12, (column + 0.5) / 16
    picture = np.stack([u, v * (1 - u), 0.2 + 0.7 * (u > 0.6) * (v < 0.4)], axis=-1)
    tilt = np.stack([0.5 + 0.3 * np.sin(7 * u), 0.5 + 0.4 * np.sin(5 * v + 1), np.full_like(u, 0.9)], axis=-1)
    for name, values in (("picture.png", picture), ("picture.jpg", picture), ("normals.png", tilt)):
        bitmap = mitsuba.Bitmap((255 * values).astype(np.uint8))
        bitmap.write(str(HERE / name), quality=100 if name.endswith("jpg") else -1)


def write_few_pixels(name: str) -> None:
    """So few that what is between them is seen."""
    row, column, channel = np.mgrid[0:3, 0:4, 0:3]
    bitmap = mitsuba.Bitmap((25 * ((7 * row + 5 * column + 3 * channel) * 37 % 11)).astype(np.uint8))
    bitmap.write(str(HERE / name))


def write_measured(name: str) -> None:
    """A glossy reflection, redder towards the normal, in the format of measured ones with colours."""
    angles, size = np.linspace(0, 1.5, 6), 16
    v, u = np.mgrid[0:size, 0:size] / (size - 1)
    facet, azimuth = u**2 * np.pi / 2, (2 * v - 1) * np.pi
    lobe = np.exp(-((facet / 0.5) ** 2))
    cosines = [np.clip(np.sin(a) * np.sin(facet) * np.cos(azimuth) + np.cos(a) * np.cos(facet), 0, 1) for a in angles]
    visible = np.stack([lobe * c * u * np.sin(facet) + 1e-3 for c in cosines])
    colour = np.array([0.8, 0.5, 0.3])[:, None, None]
    rgb = 0.5 * np.stack([colour + (1 - colour) * (1 - c) ** 5 for c in cosines])
    arrays = {
        "theta_i": angles,
        "phi_i": np.zeros(1),
        "ndf": lobe,
        "sigma": np.array([[1, 1.6], [1, 1.6]]),
        "vndf": visible[None],
        "luminance": rgb.mean(axis=1)[None],
        "rgb": rgb[None],
    }
    fields = {"description": (1, np.frombuffer(b"made up", "u1")), "jacobian": (1, np.ones(1, "u1"))}
    fields |= {key: (10, values.astype("<f4")) for key, values in arrays.items()}
    head, data = b"tensor_file\0\1\0" + struct.pack("<I", len(fields)), b""
    start = len(head) + sum(13 + len(key) + 8 * values.ndim for key, (_, values) in fields.items())
    for key, (kind, values) in fields.items():
        head += struct.pack("<H", len(key)) + key.encode() + struct.pack("<HBQ", values.ndim, kind, start + len(data))
        head += struct.pack(f"<{values.ndim}Q", *values.shape)
        data += values.tobytes()
    (HERE / name).write_bytes(head + data)


def write_dyed(name: str) -> None:
    """An octahedron with colours and a number at its corners, and a colour on each face."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    properties = "".join(f"property float {field}\n" for field in ("x", "y", "z", "r", "g", "b", "heat_0"))
    dyes = "".join(f"property float dye_{field}\n" for field in "rgb")
    head = f"element vertex 6\n{properties}element face 8\nproperty list uchar int vertex_indices\n{dyes}end_header\n"
    with (HERE / name).open("w") as file:
        file.write("ply\nformat ascii 1.0\n" + head)
        for i, corner in enumerate(corners):
            colour = (0.1 + 0.15 * i, 0.9 - 0.1 * i, 0.3 * (i % 3), 0.2 + 0.15 * i)
            file.write(" ".join(f"{value:g}" for value in corner + colour) + "\n")
        for i, face in enumerate(faces):
            dye = (0.1 * i + 0.1, 0.2 + 0.6 * (i % 2), 0.8 - 0.1 * i)
            file.write("3 " + " ".join(f"{value:g}" for value in face + dye) + "\n")


def write_lump(name: str) -> None:
    """A lumpy ball with texture coordinates, as .ply and as .obj."""
    rings = 12
    i, j = np.mgrid[0 : rings + 1, 0 : 2 * rings + 1]
    down, around = np.pi * i / rings, np.pi * j / rings
    r = 1 + 0.12 * np.sin(3 * down) * np.cos(4 * around)
    across = r * np.sin(down)
    places = np.stack([across * np.cos(around), across * np.sin(around), r * np.cos(down)], axis=-1).reshape(-1, 3)
    uvs = np.stack([j / (2 * rings), 1 - i / rings], axis=-1).reshape(-1, 2)
    first = (i[:-1, :-1] * (2 * rings + 1) + j[:-1, :-1]).reshape(-1, 1)
    below = first + 2 * rings + 1
    faces = np.concatenate([np.hstack([first, below, below + 1]), np.hstack([first, below + 1, first + 1])])
    header = "ply\nformat ascii 1.0\nelement vertex {}\n{}element face {}\nproperty list uchar int vertex_indices\nend_header\n"
    properties = "".join(f"property float {axis}\n" for axis in "xyzst")
    with (HERE / f"{name}.ply").open("w") as file:
        file.write(header.format(len(places), properties, len(faces)))
        file.writelines("{:g} {:g} {:g} {:g} {:g}\n".format(*p, *uv) for p, uv in zip(places, uvs, strict=True))
        file.writelines("3 {} {} {}\n".format(*face) for face in faces)
    with (HERE / f"{name}.obj").open("w") as file:
        file.writelines("v {:g} {:g} {:g}\n".format(*p) for p in places)
        file.writelines("vt {:g} {:g}\n".format(*uv) for uv in uvs)
        file.writelines("f {0}/{0} {1}/{1} {2}/{2}\n".format(*face) for face in faces + 1)


def main() -> None:
    random = np.random.default_rng(1)
    write_volume("density.vol", random.uniform(0.2, 2, (3, 4, 5, 1)), (-0.5, -0.5, 0), (1, 0.5, 1))
    write_volume("albedo.vol", random.uniform(0.3, 1, (3, 4, 5, 3)), (0, 0, 0), (1, 1, 1))
    write_sky("sky.pfm")
    write_serialized("meshes.serialized")
    write_pictures()
    write_few_pixels("few.png")
    write_measured("gloss.bsdf")
    write_dyed("dyed.ply")
    write_lump("lump")


if __name__ == "__main__":
    mitsuba.set_variant("scalar_rgb")
    main()
