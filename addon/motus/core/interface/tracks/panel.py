"""What a panel shows of an input over time: how it is known, and the buttons that record it."""

import bpy

from ... import keeping
from ...blender import handlers
from ...tracks import digest, recordings
from ...translations import tr
from .. import ui
from .operators import MOTUS_OT_track_clear, MOTUS_OT_track_record

_digests = keeping.OfFile(
    "digests of what recordings were made from",
    "type and name of the datablock",
    most=256,
    until="the next edit, or another file is opened",
)


def draw(layout, track, **keywords):
    """A line about an original thing's track, and buttons. keywords: of motus.track_record, which name it."""
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
    """Whether what a recording was made from is not what it was, as far as that is known."""
    if track.reason is None or not track.recording:
        return False
    return track.recording.digest != _digest(track.id_data)


def _digest(id_data):
    """The digest of a datablock, found anew after an edit."""
    if _forget not in bpy.app.handlers.depsgraph_update_post:
        _digests.clear()
        handlers.add(_watched())
    place = id_data.bl_rna.identifier, id_data.name_full
    return _digests.made(place, lambda: digest.of(id_data))


def _forget(*_):
    # Not persistent: a file in which nobody has looked at a recording costs nothing.
    _digests.clear()


def _watched():
    found = bpy.app.handlers
    return tuple((one, _forget) for one in (found.depsgraph_update_post, found.undo_post, found.redo_post))


def register():
    """Give every datablock its list."""
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
