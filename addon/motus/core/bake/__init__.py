"""Baking, for every system: what it drives becomes keyframes, and comes back.

sampling.py takes the transforms off the evaluated scene, keys.py writes and removes the keyframes, operators.py is what
the user calls; properties.py is what an object remembers while it is baked.
"""

from ..interface.baking import MOTUS_OT_bake, MOTUS_OT_unbake
from .properties import MOTUS_PG_bake

classes = (MOTUS_PG_bake, MOTUS_OT_bake, MOTUS_OT_unbake)
