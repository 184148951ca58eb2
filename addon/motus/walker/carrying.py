"""How the bone that a walker's legs hang on moves by its own animation, so that the reach of the legs is that of the real hips."""

from ..core import tracks
from ..core.lazy import numpy as np
from ..core.tracks import strips
from . import legs


def moved(owner, times, digest):
    """((k, 4, 4), stamp): what the body bone's own animation and pose do to what hangs on it, in the evaluated owner's space.

    At times (k,), of which digest tells one array from another; (None, None) where it does nothing. Constraints of the body bone and
    of the bones above are not looked at.
    """
    body = legs.body(owner) if owner.pose else None
    if body is None:
        return None, None
    chain = [body, *body.parent_recursive]
    own = [tracks.own_track(bone) for bone in chain]
    if all(track.is_constant or not track.is_known for track in own):
        found = _posed(chain, [_present(bone) for bone in chain])
        if np.allclose(found, np.eye(4), atol=1e-6):
            return None, None
        return np.repeat(found, len(times), axis=0), found.tobytes()
    stamp = strips.together((digest, *(track.stamp for track in own)))
    found = tracks.kept_by(stamp, "walker body", lambda: _posed(chain, [
        track.values(times).matrices if track.is_known else _present(bone) for bone, track in zip(chain, own)]))
    return found, stamp or found.tobytes()


def _present(bone):
    return np.array(bone.matrix_basis, float)[None]


def _posed(chain, bases):
    """(k, 4, 4) of bones from the lowest to the root, with own transforms (k or 1, 4, 4) each."""
    found = np.eye(4)[None]
    for bone, basis in zip(chain, bases):
        rest = np.array(bone.bone.matrix_local, float)
        found = rest @ basis @ np.linalg.inv(rest) @ found
    return found
