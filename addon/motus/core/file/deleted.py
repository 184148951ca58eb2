"""Which objects were deleted: removed from all collections, while a pointer property still keeps them in the file.

An object that was appended along with another one and has never been in a collection counts as present. So do objects that are merely
hidden or excluded, as for Blender's own constraints. To tell a deleted object from an appended one, it is tracked since the file was
opened whether an object has been in a collection. When the file is saved, a custom property (KEY) marks the deleted objects.

Solvers run in Blender's threads, while the main thread may edit collections. Therefore is_deleted() only looks up an object's name,
and registers the name at the first call. A handler then searches the collections for the registered objects; if the result has
changed, Blender evaluates the object again.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..blender import handlers

KEY = "motus_deleted"
"""Custom property that marks an object which had been in a collection, but was in none when the file was saved."""

_stood: dict[str, bool] = {}
"""Name of each tracked local object -> whether it has been in a collection. Names, since undo invalidates references to objects."""
_deleted: set[str] = set()
_is_new = [False]
_changes = [0]
_MAIN_THREAD = threading.main_thread().ident


def is_deleted(obj: bpy.types.Object) -> bool:
    """Whether an object, original or evaluated, was taken out of all collections while a pointer keeps it in the file.

    Linked objects never count as deleted. For an object that is asked about for the first time, the result is False until a
    handler has searched the collections.
    """
    if obj.library:
        return False
    name = obj.name
    if name not in _stood:
        _ask(name)
    return name in _deleted


def watch(objects: Iterable[bpy.types.Object]) -> None:
    """Track from now on whether these objects are deleted; if one of them was not tracked before, search the collections at once.

    Must not be called while Blender evaluates the scene.
    """
    for obj in objects:
        is_deleted(obj)
    if _is_new[0]:
        look()


def which(objects: Iterable[bpy.types.Object]) -> list[int]:
    """Indices of the deleted objects in a sequence of objects: those for which is_deleted() is true."""
    return [index for index, obj in enumerate(objects) if is_deleted(obj)]


def changes() -> int:
    """Counter that increases whenever an object is found to be deleted, restored or renamed, which changes the result of is_deleted()."""
    return _changes[0]


def _ask(name: str) -> None:
    _stood.setdefault(name, False)
    _is_new[0] = True


def look(view_layer: Any = None) -> None:
    """Search the collections for all tracked objects, and tag an object for evaluation if it was deleted or restored.

    view_layer: objects that are visible in this view layer are known to be present, which makes the search faster.
    """
    _is_new[0] = False
    known: dict[str, Any] = {name: bpy.data.objects.get((name, None)) for name in list(_stood)}
    absent = _absent([obj for obj in known.values() if obj], view_layer)
    for name, obj in known.items():
        is_absent = obj in absent
        if obj is None:
            # The object is gone from the file: a later object with this name is a different one.
            _stood.pop(name, None)
            _changes[0] += 1
        elif not is_absent or KEY in obj:
            _stood[name] = True
        is_gone = is_absent and _stood[name]
        if is_gone != (name in _deleted):
            (_deleted.add if is_gone else _deleted.discard)(name)
            _changes[0] += 1
            if obj:
                obj.update_tag()


def _absent(objects: Iterable[bpy.types.Object], view_layer: bpy.types.ViewLayer | None) -> set[bpy.types.Object]:
    """Those of the objects that are in no collection. view_layer: objects visible in it are known to be present; None if there is none."""
    left = {obj for obj in objects if not (view_layer and obj.visible_get(view_layer=view_layer))}
    for owner in (*bpy.data.collections, *(scene.collection for scene in bpy.data.scenes)):
        if not left:
            break
        left.difference_update(owner.objects.values())
    return left


@persistent
def _updated(_scene: Any = None, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    # Blender renders animations in a separate thread, in which collections are not searched.
    if not _stood or threading.get_ident() != _MAIN_THREAD:
        return
    if _is_new[0] or depsgraph is None or have_collections_changed(depsgraph):
        look(depsgraph and depsgraph.view_layer)


def have_collections_changed(depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether objects may have been linked to or unlinked from collections since the last evaluation."""
    # A scene's own collection is part of the scene: Blender 3.4 reports no more than that the scene was updated.
    return depsgraph.id_type_updated('COLLECTION') or depsgraph.id_type_updated('SCENE')


@persistent
def _note(*_: Any) -> None:
    look()
    for name in _stood:
        obj: Any = bpy.data.objects[name, None]  # type: ignore[index]
        if name in _deleted:
            obj[KEY] = True
        else:
            obj.pop(KEY, None)


@persistent
def _loaded(*_: Any) -> None:
    _stood.clear()
    _deleted.clear()
    _changes[0] += 1
    objects: Any = bpy.data.objects
    for obj in objects:
        if KEY in obj and not obj.library:
            _ask(obj.name)
    if _stood:
        look()


def _watched() -> list[handlers.Pair]:
    found = bpy.app.handlers
    changing = found.depsgraph_update_post, found.frame_change_post, found.undo_post, found.redo_post, found.render_init
    return [(functions, _updated) for functions in changing] + [(found.save_pre, _note), (found.load_post, _loaded)]


def register() -> None:
    """Add handlers that search for deleted objects after changes of collections, and mark deleted objects in the saved file."""
    handlers.add(_watched())


def unregister() -> None:
    """Remove the handlers that search for deleted objects."""
    handlers.remove(_watched())
