"""Part of a panel about a track, an input over time: how its values are known, and the buttons that record them."""

import bpy

from ... import keeping
from ...blender import handlers
from ...tracks import digest, recordings
from ...translations import tr
from .. import ui
from .operators import MOTUS_OT_track_clear, MOTUS_OT_track_record

_digests = keeping.OfFile(
    "hashes of the animation from which recordings were made",
    "type and name of the recorded datablock",
    most=256,
    until="anything is edited, or a different file is opened",
)


def draw(layout, track, **keywords):
    """Draw a sentence about how a track of an original datablock is known, and the buttons that record and clear it.

    keywords: of the operator motus.track_record, which name the track.
    """
    sentence = track.sentence
    if is_outdated(track):
        sentence = tr("{recorded}; it may be out of date").format(recorded=sentence)
    ui.draw_message(layout, sentence, 'INFO' if track.is_known else 'ERROR')
    if track.reason is None:
        return
    row = layout.row(align=True)
    names = (MOTUS_OT_track_record.bl_idname, MOTUS_OT_track_clear.bl_idname) if track.recording else (MOTUS_OT_track_record.bl_idname,)
    for name in names:
        button = row.operator(name)
        for keyword, value in keywords.items():
            setattr(button, keyword, value)


def is_outdated(track):
    """Whether the data from which a track was recorded has changed since the recording, as far as Motus can tell."""
    if track.reason is None or not track.recording:
        return False
    return track.recording.digest != _digest(track.id_data)


def _digest(id_data):
    """Digest of the data from which recordings of a datablock are made; computed again after every edit."""
    if _forget not in bpy.app.handlers.depsgraph_update_post:
        _digests.clear()
        handlers.add(_watched())
    place = id_data.bl_rna.identifier, id_data.name_full
    return _digests.made(place, lambda: digest.of(id_data))


def _forget(*_):
    # The handler is not persistent: it costs nothing in a file whose recordings nobody has looked at.
    _digests.clear()


def _watched():
    found = bpy.app.handlers
    return tuple((one, _forget) for one in (found.depsgraph_update_post, found.undo_post, found.redo_post))


def register():
    """Add the list of recordings to all types of datablocks, as a collection property of bpy.types.ID."""
    setattr(
        bpy.types.ID,
        recordings.LIST,
        bpy.props.CollectionProperty(
            type=recordings.MOTUS_PG_recording, name="Recordings", override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'}
        ),
    )


def unregister():
    """Remove the lists of recordings from all datablocks, and the handlers that notice edits."""
    handlers.remove(_watched())
    delattr(bpy.types.ID, recordings.LIST)
