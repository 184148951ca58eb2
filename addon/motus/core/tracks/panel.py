"""What a panel shows of an input over time: how it is known, and the buttons that record it."""

import bpy
from bpy.app.handlers import persistent

from .. import handlers, ui
from ..translations import tr
from . import digest, recordings
from .operators import MOTUS_OT_track_clear, MOTUS_OT_track_record

_edits = [0]
_digests = {}
"""Type and name of a datablock -> (number of edits when it was looked at, its digest)."""


def draw(layout, track, **keywords):
    """A line about an original thing's track, and buttons. keywords: of motus.track_record, which name it."""
    outdated = is_outdated(track)
    ui.draw_message(layout, tr("{recorded}; it may be out of date").format(recorded=track.sentence) if outdated else track.sentence,
                    'ERROR' if not track.is_known else 'INFO')
    if track.reason is None:
        return
    row = layout.row(align=True)
    names = (MOTUS_OT_track_record.bl_idname, MOTUS_OT_track_clear.bl_idname) if track.recording else (
        MOTUS_OT_track_record.bl_idname,)
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
    place = id_data.bl_rna.identifier, id_data.name_full
    edits, found = _digests.get(place, (None, None))
    if edits != _edits[0]:
        if edits is None and len(_digests) >= digest.MOST:
            _digests.clear()
        found = digest.of(id_data)
        _digests[place] = _edits[0], found
    return found


@persistent
def _edited(*_):
    _edits[0] += 1


def _watched():
    found = bpy.app.handlers
    return tuple((one, _edited) for one in (found.depsgraph_update_post, found.undo_post, found.redo_post, found.load_post))


def register():
    """Give every datablock its list, and notice edits, after which recordings may be out of date."""
    setattr(bpy.types.ID, recordings.LIST, bpy.props.CollectionProperty(
        type=recordings.MOTUS_PG_recording, name="Recordings", override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'}))
    handlers.add(_watched())


def unregister():
    """Take that back."""
    handlers.remove(_watched())
    delattr(bpy.types.ID, recordings.LIST)
