"""NumPy, imported where it is first used: that takes longer than enabling the whole add-on."""

import importlib


class _Lazy:
    """Stands for a module until one of its names is asked for, and passes that on."""

    def __init__(self, name):
        self._name = name

    def __getattr__(self, name):
        value = getattr(importlib.import_module(self._name), name)
        setattr(self, name, value)  # found without this detour from now on
        return value


numpy = _Lazy("numpy")
