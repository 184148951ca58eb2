"""All systems, in the order of the interface. Adding a system adds its folder and one line here."""

from . import ik, look_at, path

SYSTEMS = (
    path.SYSTEM,
    ik.SYSTEM,
    look_at.SYSTEM,
)
