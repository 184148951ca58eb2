"""Baking for every system: the motion that a system computes is written as keyframes, and can be made live again.

sampling.py reads transforms from the evaluated scene. keys.py writes and removes the keyframes. job.py bakes and unbakes everything that
the systems of an owner drive; an owner is an object whose settings a system solves. properties.py declares what an object stores while it
is baked, and state.py reads it.
"""

from .properties import MOTUS_PG_bake

classes = (MOTUS_PG_bake,)
