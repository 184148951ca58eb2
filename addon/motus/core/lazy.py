"""NumPy, imported at its first use, because the import takes longer than enabling the whole add-on."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any


class _Lazy:
    """Proxy of a module; imports the module at the first access to one of its attributes."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        value = getattr(importlib.import_module(self._name), name)
        setattr(self, name, value)  # later accesses do not call __getattr__
        return value


if TYPE_CHECKING:
    import numpy as numpy  # noqa: PLC0414  (the form by which type checkers know what a module hands on)
else:
    numpy = _Lazy("numpy")
