"""Guide a renderer of your own: a path tracer in NumPy, two rooms joined by a door, the lamp in the far one.

All walks of a pass go on in step, one array row each. Between passes a field learns where light comes from, and
directions follow it. The picture stays the same in the mean; the noise falls.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from wend import guide

Array = npt.NDArray[np.float32]

# Rectangles across an axis: axis, place, ranges along the next two axes, albedo.
WALLS = [
    (0, 0.0, (0.0, 2.5), (0.0, 4.0), 0.6),
    (0, 6.0, (0.0, 2.5), (0.0, 4.0), 0.75),
    (1, 0.0, (0.0, 4.0), (0.0, 6.0), 0.75),
    (1, 2.5, (0.0, 4.0), (0.0, 6.0), 0.75),
    (2, 0.0, (0.0, 6.0), (0.0, 2.5), 0.75),
    (2, 4.0, (0.0, 6.0), (0.0, 2.5), 0.75),
    (0, 3.0, (0.0, 2.5), (0.0, 0.3), 0.75),
    (0, 3.0, (0.0, 2.5), (0.9, 4.0), 0.75),
    (0, 5.99, (0.6, 1.8), (0.2, 1.4), 0.0),  # the lamp
]
LAMP, LAMP_RADIANCE = len(WALLS) - 1, 15.0
BOUNDS = [[0.0, 0.0, 0.0], [6.0, 2.5, 4.0]]
ALBEDO = np.array([wall[4] for wall in WALLS], dtype=np.float32)


def intersect(origin: Array, direction: Array) -> tuple[npt.NDArray[np.intp], Array, Array]:
    """The nearest wall, the distance to it, and its normal against the ray."""
    distance = np.full((len(WALLS), len(origin)), np.inf, dtype=np.float32)
    with np.errstate(divide="ignore", invalid="ignore"):
        for i, (axis, place, first, second, _) in enumerate(WALLS):
            t = (place - origin[:, axis]) / direction[:, axis]
            p = origin + t[:, None] * direction
            a, b = p[:, (axis + 1) % 3], p[:, (axis + 2) % 3]
            inside = (a >= first[0]) & (a <= first[1]) & (b >= second[0]) & (b <= second[1]) & (t > 1e-4)
            distance[i, inside] = t[inside]
    nearest = distance.argmin(axis=0)
    axes = np.array([wall[0] for wall in WALLS])[nearest]
    normal = np.zeros_like(origin)
    rows = np.arange(len(origin))
    normal[rows, axes] = -np.sign(direction[rows, axes])
    return nearest, distance[nearest, rows], normal


def cosine_direction(normal: Array, u: Array) -> Array:
    """Directions around normals, in proportion to the cosine."""
    z = 2 * u[:, :1] - 1
    phi = 2 * np.pi * u[:, 1]
    r = np.sqrt(np.maximum(0, 1 - z[:, 0] ** 2))
    w: Array = normal * (1 + 1e-6) + np.stack([r * np.cos(phi), r * np.sin(phi), z[:, 0]], axis=1)
    return np.asarray(w / np.linalg.norm(w, axis=1, keepdims=True), dtype=np.float32)


def walk(
    origin: Array, direction: Array, rng: np.random.Generator, field: guide.Field, depth: int = 10
) -> tuple[Array, npt.NDArray[Any]]:
    """The radiance that walks bring back, and what the field learns from them."""
    n = len(origin)
    log = guide.PathRecorder(n)
    radiance, throughput = np.zeros(n, dtype=np.float32), np.ones(n, dtype=np.float32)
    alive = np.ones(n, dtype=bool)
    for bounce in range(depth):
        wall, distance, normal = intersect(origin, direction)
        log.meet(np.where(alive, distance, np.inf))
        found = np.where(alive & (wall == LAMP) & (normal[:, 0] < 0), LAMP_RADIANCE, 0).astype(np.float32)
        radiance += throughput * found
        log.gather(found[:, None])
        alive &= (wall != LAMP) & np.isfinite(distance)
        if bounce + 1 == depth or not alive.any():
            break
        origin = np.where(alive[:, None], origin + distance[:, None] * direction + 1e-4 * normal, origin)
        u = rng.random((n, 3), dtype=np.float32)
        direction = cosine_direction(normal, u[:, :2])
        share = np.ones(n, dtype=np.float32)
        guided = np.zeros(n, dtype=np.float32)
        if field.is_trained:
            # One-sample multiple importance sampling of the cosine and the field's product with it.
            share = field.classical_share(origin)
            product, _ = field.sample(origin, u[:, :2], lobes=guide.Lobes.cosine(), axis=normal)
            direction = np.where((u[:, 2] < share)[:, None], direction, product)
            guided = field.pdf(origin, direction, lobes=guide.Lobes.cosine(), axis=normal)
        cosine = np.maximum(0, (direction * normal).sum(axis=1)) / np.pi
        density = share * cosine + (1 - share) * guided
        weight = ALBEDO[wall] * cosine / np.maximum(density, 1e-20)
        chosen = field.is_trained
        log.scatter(alive, origin, direction, density, weight[:, None],
                    classical_density=cosine * chosen, guided_density=guided * chosen)
        throughput *= np.where(alive, weight, 0)
    return radiance, log.records()


def render(spp: int, seed: int, field: guide.Field, size: tuple[int, int] = (48, 27)) -> tuple[Array, npt.NDArray[Any]]:
    """Samples of all pixels, (spp, height, width), and the records."""
    width, height = size
    rng = np.random.default_rng(seed)
    x = np.arange(width) + rng.random((spp, height, width))
    y = np.arange(height)[:, None] + rng.random((spp, height, width))
    forward, right, down = np.array([0.67, -0.08, -0.74]), np.array([0.74, 0, 0.67]), np.array([0, -1, 0])
    w = forward + right * (1.6 * (x / width - 0.5))[..., None] + down * (0.9 * (y / height - 0.5))[..., None]
    w = (w / np.linalg.norm(w, axis=-1, keepdims=True)).reshape(-1, 3).astype(np.float32)
    eye = np.broadcast_to(np.array([0.4, 1.3, 3.6], dtype=np.float32), w.shape)
    radiance, records = walk(eye, w, rng, field)
    return radiance.reshape(spp, height, width), records


def learn(passes: int = 6) -> guide.Field:
    """A field of what walks found: each pass has twice the samples of the one before, and follows it."""
    field = guide.Field(BOUNDS)
    for k in range(passes):
        _, records = render(1 << k, 1000 + k, field)
        field = field.fit(records)
    return field


if __name__ == "__main__":
    classical, _ = render(64, 1, guide.Field(BOUNDS))
    guided, _ = render(64, 2, learn())
    for name, samples in (("classical", classical), ("guided", guided)):
        print(f"{name:9}  mean {samples.mean():.4f}, variance of a sample {samples.var(axis=0).mean():.4f}")
    gain = classical.var(axis=0).mean() / guided.var(axis=0).mean()
    error = np.sqrt((classical.var(axis=0).sum() + guided.var(axis=0).sum()) / 64) / classical[0].size
    assert abs(classical.mean() - guided.mean()) < 4 * error and gain > 1
    print(f"{gain:.1f} times less variance")
