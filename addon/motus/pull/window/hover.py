"""Session for the mesh under the resting mouse of the tool: the mesh is read once, for the cursor and for the next stroke.

The session is dropped as soon as anything except a stroke changes the object, so that it is never outdated.
"""

import bpy
from bpy.app.handlers import persistent

from ...core.blender import handlers
from ...core.interface.view import toolbar, viewports
from ...core.refusals import Refused
from .. import fitting
from ..brush import Brush
from ..session.dab import Session
from . import stage

TOOL = "motus.pick_pull"
MODES = {'OBJECT', 'EDIT_MESH', 'SCULPT'}
MOST_IN_EDIT_MODE = 200000
"""Largest number of vertices of a mesh in Edit Mode that is read while the mouse only moves over it.

A larger edit mesh would cause a delay.
"""

_kept = {}
_wanted = {}


def register():
    """Add the handlers that drop the kept session when its object changes."""
    handlers.add(_watchers())


def unregister():
    """Remove the handlers and the timer of this module, and drop the kept session."""
    handlers.remove(_watchers())
    if bpy.app.timers.is_registered(_read):
        bpy.app.timers.unregister(_read)
    drop()


def is_tool_active(context):
    """Whether Pick & Pull is the active tool in the present mode."""
    return context.mode in MODES and toolbar.in_hand(context) == TOOL


def session(context):
    """Return the kept session of the active object, or ask a timer to read the object.

    None if the tool is not active, or the object is not read yet.
    """
    if not is_tool_active(context) or context.object is None:
        drop()
        return None
    key = _key(context.object)
    if _kept and _kept.get("key") != key:
        drop()
    if not _kept and _wanted.get("key") != key and not _is_large(context.object):
        # The object is read by a timer, since drawing must not change data.
        _wanted.update(key=key, object=context.object.name, scene=context.scene.name)
        if not bpy.app.timers.is_registered(_read):
            bpy.app.timers.register(_read, first_interval=0.0)
    return _kept.get("session")


def read_now(context):
    """Read the active object and keep its new session, for actions of the user. Raises Refused if it cannot be pulled."""
    fitting.fit(context.scene.motus.pull, context.object)
    made = Session(context, context.object, Brush.of(context.scene.motus.pull))
    keep(context, made)
    return made


def take(context):
    """Hand over the kept session for a new stroke; it is no longer kept then.

    Returns None if the session is not for the active object as it is now. Raises Refused if the object cannot be pulled.
    """
    if _kept.get("key") != _key(context.object):
        return None
    found = _kept.pop("session")
    drop()
    return found if found.begin_again(context, context.object, Brush.of(context.scene.motus.pull)) else None


def keep(context, done):
    """Keep the session of a finished stroke, so that the next stroke need not read the mesh. done: the session."""
    # Evaluate the stroke's own change first, so that all later updates are changes by something else.
    context.view_layer.update()
    drop()
    _kept.update(key=_key(context.object), session=done, object=context.object.name, data=context.object.data.name)


def drop():
    """Drop the kept session, and the request to read an object."""
    _kept.clear()
    _wanted.clear()


def _key(obj):
    return obj and (obj.name_full, obj.data.name_full if obj.data else "", obj.mode)


def _is_large(obj):
    return obj.mode == 'EDIT' and obj.type == 'MESH' and len(obj.data.vertices) > MOST_IN_EDIT_MODE


def _read():
    """Timer function, called once: reads the object that the cursor has asked for, and keeps its session."""
    wanted = dict(_wanted)
    obj, scene = bpy.data.objects.get(wanted.get("object", "")), bpy.data.scenes.get(wanted.get("scene", ""))
    if obj is None or scene is None or stage.current() is not None or _key(obj) != wanted["key"]:
        _wanted.clear()
        return
    fitting.fit(scene.motus.pull, obj)
    try:
        made = Session(bpy.context, obj, Brush.of(scene.motus.pull))
    except Refused:
        return  # the request is kept, so that reading is not tried again at each movement of the mouse
    drop()
    _kept.update(key=wanted["key"], session=made, object=obj.name, data=obj.data.name)
    viewports.redraw()


@persistent
def _on_update(_scene, depsgraph):
    if not _kept and not _wanted:
        return
    for update in depsgraph.updates:
        if update.id.name in {_kept.get("object"), _kept.get("data"), _wanted.get("object")} and (
            update.is_updated_geometry or update.is_updated_transform
        ):
            drop()
            return


@persistent
def _on_change(*_arguments):
    drop()


@persistent
def _on_load(*_arguments):
    stage.clear()
    drop()


def _watchers():
    found = bpy.app.handlers
    return (
        (found.depsgraph_update_post, _on_update),
        (found.undo_pre, _on_change),
        (found.redo_pre, _on_change),
        (found.load_pre, _on_change),
        (found.load_post, _on_load),
    )


classes = ()
