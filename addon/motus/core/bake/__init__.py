"""Baking, for every system: what it drives becomes keyframes, and comes back.

sampling.py takes the transforms off the evaluated scene, keys.py writes and removes the keyframes, job.py does both
for all frames and owners; properties.py is what an object remembers while it is baked.
"""

from .properties import MOTUS_PG_bake

classes = (MOTUS_PG_bake,)
