"""Records of walks, which the field learns from."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._arrays import Array, leading_shape

#: One record: what arrived at `position` along `direction`, as the native part has it in memory.
record_dtype = np.dtype(
    [
        ("position", np.float32, 3),
        ("direction", np.float32, 3),
        ("radiance", np.float32),
        ("density", np.float32),
        ("distance", np.float32),
        ("classical_density", np.float32),
        ("guided_density", np.float32),
        ("scattered", np.float32),
        ("colour", np.float32, 3),
    ]
)


def records(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    radiance: npt.ArrayLike,
    density: npt.ArrayLike,
    distance: npt.ArrayLike = np.inf,
    *,
    classical_density: npt.ArrayLike = 0,
    guided_density: npt.ArrayLike = 0,
    scattered: npt.ArrayLike = 0,
    colour: npt.ArrayLike = (1, 1, 1),
) -> npt.NDArray[Any]:
    """Records for `Field.fit`, of arrays that broadcast.

    Args:
        position: of the vertices, (N, 3), scene units.
        direction: towards where the radiance comes from, (N, 3), unit length.
        radiance: estimates of what arrives, (N,), a scalar such as the mean of the channels; those of 0 must not be
            left out.
        density: that the directions were drawn with, (N,), 1/sr, positive.
        distance: to the next vertex, (N,); infinite where there is none.
        classical_density: of the direction by your own sampling, (N,), where it was mixed with the guide's. This and
            the next two tell how both are best mixed.
        guided_density: by the guide, (N,).
        scattered: the scattering function with its cosine, times the radiance, (N,).
        colour: of the radiance in any scale, (N, 3).

    Returns:
        A structured array (N,) of `record_dtype`.
    """
    shape = np.broadcast_shapes(
        leading_shape(position, direction, colour), np.shape(radiance), np.shape(density), np.shape(distance)
    )
    result = np.zeros(shape, dtype=record_dtype)
    for name, value in (
        ("position", position),
        ("direction", direction),
        ("radiance", radiance),
        ("density", density),
        ("distance", distance),
        ("classical_density", classical_density),
        ("guided_density", guided_density),
        ("scattered", scattered),
        ("colour", colour),
    ):
        result[name] = value
    return result.reshape(-1)


class PathRecorder:
    """Records of many walks that go on in step, as NumPy renders them: one array of `count` walks.

    A walk tells of each direction that it draws (`scatter`), of every other factor of its weight (`weigh`) and of the
    radiance that it finds (`gather`), when it has them. `records` sweeps back from the ends. Radiances and weights have
    three channels, (count, 3), or broadcast to it.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._vertices: list[dict[str, Any]] = []

    def scatter(
        self,
        alive: npt.ArrayLike,
        position: npt.ArrayLike,
        direction: npt.ArrayLike,
        density: npt.ArrayLike,
        weight: npt.ArrayLike,
        *,
        classical_density: npt.ArrayLike = 0,
        guided_density: npt.ArrayLike = 0,
    ) -> None:
        """Directions drawn by the walks that are `alive`, (count,) of bool.

        Args:
            position, direction: (count, 3).
            density: of the directions, (count,), 1/sr.
            weight: the scattering function with its cosine over the density, (count, 3).
            classical_density, guided_density: by your own sampling and by the guide, where both were mixed.
        """
        n = self._count
        self._vertices.append(
            {
                "alive": np.broadcast_to(np.asarray(alive, dtype=bool), n).copy(),
                "position": np.broadcast_to(np.asarray(position, dtype=np.float32), (n, 3)).copy(),
                "direction": np.broadcast_to(np.asarray(direction, dtype=np.float32), (n, 3)).copy(),
                "density": np.broadcast_to(np.asarray(density, dtype=np.float32), n).copy(),
                "scattering": self._colours(weight),
                "classical_density": np.broadcast_to(np.asarray(classical_density, dtype=np.float32), n).copy(),
                "guided_density": np.broadcast_to(np.asarray(guided_density, dtype=np.float32), n).copy(),
                "distance": np.full(n, np.inf, dtype=np.float32),
                "since": np.ones((n, 3), dtype=np.float32),
                "gathered": np.zeros((n, 3), dtype=np.float32),
            }
        )

    def meet(self, distance: npt.ArrayLike) -> None:
        """How far the walks flew along the last directions until they met something; infinite for nothing."""
        if self._vertices:
            self._vertices[-1]["distance"][:] = distance

    def weigh(self, weight: npt.ArrayLike) -> None:
        """A factor of the weights since: transmittance over density of a flight, albedo, 1 / survival."""
        if self._vertices:
            self._vertices[-1]["since"] *= self._colours(weight)

    def gather(self, radiance: npt.ArrayLike) -> None:
        """Radiance found, with its weight of multiple importance sampling but without the throughput."""
        if self._vertices:
            last = self._vertices[-1]
            last["gathered"] += last["since"] * self._colours(radiance)

    def records(self) -> npt.NDArray[Any]:
        """One record a direction, walk by walk at each depth, of `record_dtype`."""
        arrived = np.zeros((self._count, 3), dtype=np.float32)
        made = []
        for vertex in reversed(self._vertices):
            # What the next vertex sent back along this direction, times all that the weight gained on the way.
            arrived = vertex["gathered"] + np.where(arrived != 0, vertex["since"], 0) * arrived
            alive = vertex["alive"]
            scalar = arrived.mean(axis=1)
            sent = vertex["scattering"] * arrived
            made.append(
                records(
                    vertex["position"],
                    vertex["direction"],
                    scalar,
                    vertex["density"],
                    vertex["distance"],
                    classical_density=vertex["classical_density"],
                    guided_density=vertex["guided_density"],
                    scattered=sent.mean(axis=1) * vertex["density"],
                    colour=arrived,
                )[alive & (vertex["density"] > 0)]
            )
            arrived = np.where(alive[:, None], sent, 0)
        return np.concatenate(made[::-1]) if made else np.zeros(0, dtype=record_dtype)

    def _colours(self, value: npt.ArrayLike) -> Array:
        return np.broadcast_to(np.asarray(value, dtype=np.float32), (self._count, 3)).copy()
