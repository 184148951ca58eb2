"""Demo scenes: examples that are built by the add-on's own public operators, each in a new scene."""

from .operators import MOTUS_MT_demo, classes

ADD_MENU = (MOTUS_MT_demo.__name__,)

__all__ = ("ADD_MENU", "classes")
