"""Progress bars, where tqdm is installed."""

from __future__ import annotations

from typing import Any


class Bar:
    """A bar from 0 to 1; nothing where it is not wanted or tqdm is not there."""

    def __init__(self, label: str, wanted: bool) -> None:
        self._bar: Any = None
        if wanted:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(
                total=1.0, desc=label, leave=False, bar_format="{desc} {percentage:3.0f}% |{bar}| {elapsed} {postfix}"
            )

    def update(self, fraction: float, detail: str = "") -> None:
        if self._bar is not None:
            self._bar.set_postfix_str(detail, refresh=False)
            self._bar.update(max(0.0, min(fraction, 1.0) - self._bar.n))

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
