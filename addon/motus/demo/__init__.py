"""Demo scenes: examples that the add-on's own public operators build, each in a new scene of its own."""

from .operators import MOTUS_MT_demo, classes

ADD_MENU = (MOTUS_MT_demo.__name__,)

__all__ = ("ADD_MENU", "classes")
