"""All systems, in the order of the interface. Adding a system adds its folder and one line here."""

from . import path

SYSTEMS = (
    path.SYSTEM,
)
