"""Motion of the body bone, the common parent of a walker's legs, by its own animation.

It moves the hips, from which the reach of each leg is measured.
"""

import hashlib

from ..core import keeping, tracks
from ..core.animation import strips
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from ..core.tracks import in_world
from . import legs

_CARRIED = keeping.OfEvaluation(
    "matrices by which a walker's body bone moves its children",
    "the walker's rig; recomputed if the stamp of its action, its armature or the planned frames differ",
    "one for each walker whose body bone is moved by nothing but keys",
)


def moved(owner, times, digest):
    """Return (matrices (k, 4, 4), stamp) by which the body bone's own animation moves its children, in the owner's space.

    (None, None) if there is no body bone, or if it stays in its rest pose. The stamp is a hashable value; equal matrices have equal
    stamps. Constraints of the body bone and of its parents are ignored. owner: evaluated object that walks.
    times: (k,), frames. digest: hash that differs for different times.
    """
    body = legs.body(owner) if owner.pose else None
    if body is None:
        return None, None
    kept = _CARRIED.on(copies.of(owner))
    key = strips.together((digest, body.name, copies.stamp_of_data(owner), tracks.keys_stamp(owner)))
    if key is not None and kept.get("key") == key:
        return kept["moved"]
    chain = [body, *body.parent_recursive]
    own = [tracks.own_track(bone) for bone in chain]
    found = kept["moved"] = _moved(chain, own, times, digest)
    kept["key"] = key if all(track.rests_on_keys for track in own) else None
    return found


def _moved(chain, own, times, digest):
    if all(track.is_constant or not track.is_known for track in own):
        if all(bone.matrix_basis.is_identity for bone in chain):
            return None, None
        return _stamped(_posed(chain, [_present(bone) for bone in chain]), len(times))
    stamp = strips.together((digest, *map(in_world.rest_stamp, chain), *(track.stamp for track in own)))
    return tracks.kept_by(
        stamp,
        "walker body",
        lambda: _stamped(
            _posed(chain, [track.values(times).matrices if track.is_known else _present(bone) for bone, track in zip(chain, own)]),
            len(times),
        ),
    )


def _stamped(matrices, count):
    rest = np.eye(4)
    if (np.abs(matrices - rest) <= 1e-6 + 1e-5 * rest).all():
        return None, None
    return np.broadcast_to(matrices, (count, 4, 4)), hashlib.blake2b(np.ascontiguousarray(matrices), digest_size=16).digest()


def _present(bone):
    return np.array(bone.matrix_basis, float)[None]


def _posed(chain, bases):
    """Matrices (k, 4, 4), in the rig's space, that take the first bone of a chain from its rest pose to its pose at k times.

    chain: a PoseBone, followed by its parents up to the root. bases: for each of these bones, matrices (k, 4, 4) or (1, 4, 4) of its
    own location, rotation and scale; (1, 4, 4) if they are constant.
    """
    found = np.eye(4)[None]
    for bone, basis in zip(chain, bases):
        rest = np.array(bone.bone.matrix_local, float)
        found = rest @ basis @ np.linalg.inv(rest) @ found
    return found
