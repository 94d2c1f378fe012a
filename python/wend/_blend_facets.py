"""Of light that meets facets, how much they reflect once, and several times."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Colour = npt.NDArray[np.float64]

#: Where values are taken, from 0 to 1.
COSINES = np.linspace(0, 1, 65)


def reflected_once(roughness: float) -> Colour:
    """The share that facets that reflect all have reflected after they did so once, at these cosines: facets of the
    distribution GGX, drawn as they are seen (heitz2018)."""
    alpha = max(roughness, 1e-3) ** 2
    cosine = np.maximum(COSINES, 1e-3)[:, None, None]
    side = np.sqrt(1 - cosine**2)
    even = (np.arange(48) + 0.5) / 48
    radius, turn = np.sqrt(even)[:, None], 2 * np.pi * even
    length = np.sqrt((alpha * side) ** 2 + cosine**2)
    x, z = alpha * side / length, cosine / length
    across, up = radius * np.cos(turn), radius * np.sin(turn)
    share = 0.5 * (1 + z)
    up = (1 - share) * np.sqrt(1 - across**2) + share * up
    along = np.sqrt(np.maximum(1 - across**2 - up**2, 0))
    facet = np.stack([alpha * (along * x - up * z), alpha * across + 0 * x, np.maximum(along * z + up * x, 0)])
    facet /= np.maximum(np.linalg.norm(facet, axis=0), 1e-30)
    below = 2 * (side * facet[0] + cosine * facet[2]) * facet[2] - cosine

    def hidden(c: Colour) -> Colour:
        return np.asarray((np.sqrt(1 + alpha**2 * (1 / c**2 - 1)) - 1) / 2)

    seen = (1 + hidden(cosine)) / (1 + hidden(cosine) + hidden(np.clip(below, 1e-6, 1)))
    return np.asarray(np.where(below > 0, seen, 0).mean(axis=(1, 2)))


def brighter_by_several(colour: Colour, roughness: float) -> Colour:
    """A colour for each cosine: that of facets which reflect once what facets of this colour do in all (as Cycles has it,
    by the energy that is left)."""
    once = reflected_once(roughness)
    seen = once * COSINES
    mean = (seen[1:] + seen[:-1]).sum() * COSINES[1]  # of light that is even
    several = colour * mean / (1 - colour * (1 - mean))
    return np.asarray(colour * (1 + several * ((1 - once) / once)[:, None]))
