"""All systems, in the order of the interface. Adding a system adds its folder and one line here."""

from . import chains, chroma, drivers, dynamics, hand_over, ik, lattice, layers, look_at, path, pendulum, pull, snow, stereo, walker

SYSTEMS = (
    path.SYSTEM,
    layers.SYSTEM,
    walker.SYSTEM,
    ik.SYSTEM,
    look_at.SYSTEM,
    dynamics.SYSTEM,
    chains.SYSTEM,
    pull.SYSTEM,
    lattice.SYSTEM,
    pendulum.SYSTEM,
    pendulum.TRAILS,
    snow.SYSTEM,
    snow.COVER,
    stereo.SYSTEM,
    chroma.FEATURE,
    drivers.FEATURE,
    hand_over.FEATURE,
)
