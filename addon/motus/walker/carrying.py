"""How the bone that a walker's legs hang on moves by its own animation, so that the reach of the legs is that of the real hips."""

import hashlib

from ..core import tracks
from ..core.animation import strips
from ..core.lazy import numpy as np
from . import legs


def moved(owner, times, digest):
    """((k, 4, 4), stamp): what the body bone's own animation and pose do to what hangs on it, in the evaluated owner's space.

    At times (k,), of which digest tells one array from another; (None, None) where it does nothing. Equal matrices have equal stamps.
    Constraints of the body bone and of the bones above are not looked at.
    """
    body = legs.body(owner) if owner.pose else None
    if body is None:
        return None, None
    chain = [body, *body.parent_recursive]
    own = [tracks.own_track(bone) for bone in chain]
    if all(track.is_constant or not track.is_known for track in own):
        return _stamped(_posed(chain, [_present(bone) for bone in chain]), len(times))
    stamp = strips.together((digest, *(track.stamp for track in own)))
    return tracks.kept_by(
        stamp,
        "walker body",
        lambda: _stamped(
            _posed(chain, [track.values(times).matrices if track.is_known else _present(bone) for bone, track in zip(chain, own)]),
            len(times),
        ),
    )


def _stamped(matrices, count):
    if np.allclose(matrices, np.eye(4), atol=1e-6):
        return None, None
    return np.broadcast_to(matrices, (count, 4, 4)), hashlib.blake2b(np.ascontiguousarray(matrices), digest_size=16).digest()


def _present(bone):
    return np.array(bone.matrix_basis, float)[None]


def _posed(chain, bases):
    """Matrices (k, 4, 4), in the rig's space, by which the lowest bone of a chain moves from its rest pose at k times.

    chain: PoseBones from the lowest one to the root. bases: own transforms (k or 1, 4, 4) of each bone.
    """
    found = np.eye(4)[None]
    for bone, basis in zip(chain, bases):
        rest = np.array(bone.bone.matrix_local, float)
        found = rest @ basis @ np.linalg.inv(rest) @ found
    return found
