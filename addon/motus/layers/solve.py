"""Solve the layers of a group of bones: read settings, masks and actions from Blender and call the native module once."""

from ..core import native, rigs
from ..core.declare import Problem
from ..core.file import stored
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from . import clips, live, mask
from .groups import LOOPED, PLAN

SOME_ARE_OFF = Problem("Some layers have no action, or one without keys for their bones: the list says which", blocking=False)
LOOPED_BONES = Problem("Drivers of bones or of layers read bones that layers move: layers leave these alone", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (SOME_ARE_OFF, LOOPED_BONES, BONES_CHANGED)

_AFTERS = {'STOP': 0.0, 'HOLD': 1.0, 'REPEAT': 2.0}
_EYE = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
_FORM = {"fingerprint": int, "bones": [str], "unknown": [str]}
"""Structure of the JSON text that groups.py stores in a group's data under PLAN."""


class Wired:
    """Rows of a group's bones in the rig's arrays; made anew when the rig changes.

    rows: {bone name: row} of all bones. text: JSON text of the group's PLAN.
    """

    def __init__(self, rig, rows, text):
        known = stored.parse(text, _FORM)
        self.still = rigs.still(rig, tuple(rows))
        self.rows = np.array([rows[name] for name in known["bones"]], np.int32)
        self.unknown = np.array([rows[name] for name in known["unknown"]], np.int32)
        self.parents = rigs.parents(rig, list(rows))
        self.places = rows
        self._stack = None, None

    @property
    def stack(self):
        """The native LayerStack for the rig's rest pose; made anew when the armature has been edited."""
        still, stack = self._stack
        if still is not self.still:  # rigs.plan() replaces self.still if the armature has been edited
            still = self.still
            stack = native.module.LayerStack(self.parents, still.rest, still.inheritance)
            self._stack = still, stack
        return stack


class Source:
    """Data of an evaluated rig's layers that change only by edits, so that they can be cached between frames.

    entries: settings of the L layers. playing: (action or None, slot) of each. modes: rotation modes of all bones. masks: (L, bones)
    weights of all bones in the masks. is_compared: whether a layer is compared with a different action. edited: index of the layer that is
    edited by its keys; None if there is none.
    """

    def __init__(self, rig, copy, wired):
        self.wired, self.reader = wired, rigs.Reader(rig, copy, wired.still)
        self.entries = list(rig.motus.layers.entries)
        self.playing = [(pointed(entry, "action"), entry.slot) for entry in self.entries]
        self._compared = [pointed(entry, "reference_action") if is_compared(entry) else None for entry in self.entries]
        self.is_compared = any(self._compared)
        self.modes = tuple(bone.rotation_mode for bone in rig.pose.bones)
        masks = [native.module.layer_mask(wired.parents, mask.chosen(rig, entry, wired.places), entry.feather) for entry in self.entries]
        self.masks = np.array(masks).reshape(len(masks), len(wired.places))
        self.edited = live.edited(rig)
        if self.edited is not None:
            names, entry = wired.still.names, self.entries[self.edited]
            masked = {name for name, weight in zip(names, self.masks[self.edited]) if weight > 0.0}
            self._edited = live.Edited(rig, entry, masked, names, self.modes)

    def clips(self):
        """List the Clip of each layer; None for a layer without an action. Not cached, because an action can be edited without the rig."""
        return [action and clips.clip_of(action, slot, self.wired.still.names, self.modes) for action, slot in self.playing]

    def references(self):
        """List the Clip of the action that each layer is compared with; None for a layer that needs none, or has none."""
        return [action and clips.clip_of(action, "", self.wired.still.names, self.modes) for action in self._compared]

    def put_edited(self, found, basis, frame):
        """Put the layer that is edited in the place of its Clip, and what lies beneath it into the own matrices of all bones.

        found: Clip or None of each layer. basis: (B, 16). Returns whether a layer is edited.
        """
        if self.edited is None or found[self.edited] is None:
            return False
        found[self.edited], rows, beneath = self._edited.at(found[self.edited], self.references()[self.edited], frame)
        basis[rows] = beneath
        return True


def solve(context):
    """Fill the context's arrays with the changes by which layers move the group's bones at the context's frame.

    Returns a Problem or None. A user's error never raises an exception.
    """
    text, looped = context.data.get(PLAN), context.data.get(LOOPED)
    rig = context.owner
    try:
        source = rigs.source(rig, context.copy, text, lambda rig, rows: Wired(rig, rows, text), Source)
    except KeyError:
        rigs.lay(context.copy, context.group, [], np.empty((0, 16), np.float32))
        return BONES_CHANGED
    wired = source.wired
    if len(wired.rows) != len(context.rotations):
        raise stored.Damaged("another number of members")
    found, basis = source.clips(), source.reader.own_basis()
    own, is_edited = basis, False
    if source.edited is not None:
        own = basis.copy()
        is_edited = source.put_edited(found, basis, context.frame)
    others = source.references() if source.is_compared else ()
    playing, settings, some_are_off = context.kept("playing", (source, *found, *others), lambda: _playing(context.settings, source, found))
    laid = np.empty((len(wired.rows), 16), np.float32)  # a new one, since other threads may read the present one
    playing.lay(context.frame, settings, basis, context.locations, context.rotations, context.scales, laid)
    if is_edited:
        native.module.layer_moves(own[wired.rows], laid, context.locations, context.rotations, context.scales)
    rigs.lay(context.copy, context.group, wired.rows, laid)
    if some_are_off:
        return SOME_ARE_OFF
    return LOOPED_BONES if looped else None


def _playing(settings, source, found):
    """(Playing of the layers with an effect, their rows of still_settings() with the rig's influence, whether some layers have no clip).

    found: Clip or None of each layer of the Source.
    """
    rows, values = acting(settings, found, settings.influence)
    return Playing(source, found, rows), values, any(clip is None or not clip.native.bones for clip in found)


def acting(settings, found, influence):
    """Return (indices of the layers with an effect, their rows of still_settings() with an influence of them all).

    found: Clip or None of each layer.
    """
    values = still_settings(settings.entries, found)
    values[:, WEIGHT] *= influence
    rows = [row for row, clip in enumerate(found) if clip is not None and values[row, WEIGHT] > 0.0]
    return rows, values[rows]


class Playing:
    """The layers of a Source that have an effect at a frame, prepared as arguments of the native LayerStack.solve().

    found: the Clip or None of each layer of the Source. rows: indices of the layers with an effect.
    """

    def __init__(self, source, found, rows):
        self._wired, self._masks = source.wired, source.masks[rows]
        self._clips = [found[row] for row in rows]
        self._asks_curves = any(clip.asks_curves for clip in self._clips)
        self._natives = [clip.native for clip in self._clips]
        played = [(source.entries[row], found[row]) for row in rows]
        frames = [reference_frame(entry, clip.frames) for entry, clip in played]
        others = source.references()
        self._references = [_reference(*pair, at, others[row]) for row, at, pair in zip(rows, frames, played)]
        self._laps = [_laps(*pair, at) for at, pair in zip(frames, played)]

    def lay(self, frame, settings, basis, locations, rotations, scales, laid):
        """Fill locations, rotations and scales with the layers' changes, and `laid`, (n, 16) float32, with the bones' changed matrices.

        frame: of the scene. settings: rows of still_settings() for the layers with an effect. basis: own matrices of all bones.
        """
        basis[self._wired.unknown] = _EYE
        stack, arguments = self._wired.stack, self._arguments(frame, settings)
        stack.solve(frame, basis, *arguments, self._wired.rows, locations, rotations, scales, laid, self._laps)

    def sources(self, frame, settings, basis, edited, wanted, rows):
        """Return what the clip of one layer has to say of bones, so that the layers make a wanted pose: LayerStack.sources().

        edited: index of the layer among those with an effect. wanted: (B, 16) float32, matrices of all bones. rows: of the bones.
        """
        return self._wired.stack.sources(frame, basis, *self._arguments(frame, settings), edited, wanted, rows, self._laps)

    def _arguments(self, frame, settings):
        """Return the arguments that solve() and sources() of the LayerStack share, between `basis` and `rows`."""
        given = [None] * len(self._clips)
        if self._asks_curves:
            frames = native.module.layer_moments(settings, frame)[:, 0].tolist()
            given = [clip.given(at) for at, clip in zip(frames, self._clips)]
        return self._natives, settings, self._masks, self._references, given


def is_compared(entry):
    """Whether a layer is compared with a pose of a different action."""
    return entry.mode == 'ADDITIVE' and entry.reference == 'ACTION'


def _reference(entry, clip, frame, other):
    """Return the pose that a layer is compared with, (n, 10); None for the rest pose, and for a layer that is not additive.

    frame: reference_frame(). other: Clip of the action that the layer is compared with, or None.
    """
    if is_compared(entry):
        return None if other is None else clips.pose_of(other, clip.native.bones, entry.reference_frame)
    return None if frame is None else clip.reference(frame)


def reference_frame(entry, frames):
    """Return the frame of its own action whose pose an additive layer subtracts. frames: (first, last) frame of the action.

    None for a layer that subtracts the rest pose or a pose of a different action, and for a layer that is not additive.
    """
    if entry.mode != 'ADDITIVE' or entry.reference in {'REST', 'ACTION'}:
        return None
    return entry.reference_frame if entry.reference == 'FRAME' else span(entry, frames)[0]


def _laps(entry, clip, reference):
    """Return Clip.laps() for the frames that a layer plays, in playing order. reference: frame of the reference pose, or None."""
    begin, end = span(entry, clip.frames)
    return clip.laps(end, begin, reference) if entry.speed < 0.0 else clip.laps(begin, end, reference)


def span(entry, frames):
    """Return (first, last) frame of the part of its action that a layer plays. frames: (first, last) frame of the whole action."""
    if not entry.use_range:
        return frames
    return entry.first_frame, max(entry.first_frame, entry.last_frame)


def still_settings(entries, found):
    """Return the settings of L layers for the native LayerStack, as an array (L, COLUMNS). found: Clip or None of each layer."""
    silent = silenced(entries)
    rows = [_numbers(entry, clip, is_silent) for entry, clip, is_silent in zip(entries, found, silent)]
    return np.array(rows, float).reshape(-1, COLUMNS)


def silenced(entries):
    """Return for each layer whether other layers are played alone, so that this one has no effect."""
    has_solo = any(entry.is_solo for entry in entries)
    return [has_solo and not entry.is_solo for entry in entries]


def _numbers(entry, clip, is_silent):
    first, last = span(entry, clip.frames) if clip else (1.0, 1.0)
    return (
        entry.start,
        first,
        last,
        entry.speed,
        _AFTERS[chosen(entry, "after")],
        entry.blend_in,
        entry.blend_out,
        0.0 if entry.is_muted or is_silent else entry.weight,
        entry.mode == 'ADDITIVE',
        entry.in_armature,
    )


COLUMNS, WEIGHT = 10, 7
"""Number of settings in the native LayerStack.SETTINGS, and the index of "weight" among them."""
