"""Which objects were deleted: taken out of all collections, while a pointer property keeps them in the file.

One that came along with what was appended has never stood in a collection, and counts as present. So does what is merely
hidden or excluded, as for Blender's own constraints. The two are told apart by what was seen since the file was opened; when
it is saved, that is noted on the object, so that the file means the same wherever it is opened.
"""

import bpy
from bpy.app.handlers import persistent

from . import handlers

KEY = "motus_deleted"
"""Custom property of an object that stood in a collection, and did not any more when the file was saved."""
LARGE_SCENE = 8  # objects for each target

_seen = set()
"""Names of objects that were seen in a collection. Names, not references: undo invalidates those."""
_scene_sizes = {}
"""How many objects a scene had when they were last counted: only for the faster of two ways to the same answer."""


def saw(names):
    """Remember objects that stand in a collection."""
    _seen.update(names)


def was_somewhere(original):
    """Whether an object that stands in no collection has stood in one."""
    return original.name in _seen or KEY in original


def forget_removed():
    """Forget names that are free again: the next object of the name is another one."""
    _seen.intersection_update(bpy.data.objects.keys())


class Presence:
    """Which targets were deleted. Made anew for each solve; with `scene` it is faster for many targets."""

    def __init__(self, view_layer, scene=None):
        self._view_layer = view_layer
        self._scene = scene
        self._in_scene = None

    def deleted(self, targets):
        """Indices of those of the objects that were deleted."""
        names = [target.name for target in targets]
        present = self._names_in_scene(len(targets))
        unseen = self._not_in_view(targets) if present is None else [
            index for index, name in enumerate(names) if name not in present]
        if not unseen:
            saw(names)
            return unseen
        gone = [index for index in unseen if not self._is_somewhere(targets[index].original)]
        found = [index for index in gone if was_somewhere(targets[index].original)]
        saw(name for index, name in enumerate(names) if index not in gone)
        return found

    def _names_in_scene(self, count):
        """The names of all objects in the scene, where so many targets are worth it, else None."""
        if self._in_scene is None and self._scene and _scene_sizes.get(self._scene.name, 0) <= LARGE_SCENE * count:
            self._in_scene = set(self._scene.objects.keys())
            _scene_sizes[self._scene.name] = len(self._in_scene)
        return self._in_scene

    def _not_in_view(self, targets):
        # What can be seen is there.
        layer = self._view_layer
        return [index for index, target in enumerate(targets) if not target.original.visible_get(view_layer=layer)]

    def is_deleted(self, target):
        """The same for one object."""
        return bool(self.deleted([target]))

    @staticmethod
    def _is_somewhere(original):
        return original.library is not None or bool(original.users_collection)


@persistent
def _note(*_):
    for obj in bpy.data.objects:
        if obj.library:
            continue
        if obj.users_collection:
            obj.pop(KEY, None)
        elif was_somewhere(obj):
            obj[KEY] = True


@persistent
def _forget(*_):
    _seen.clear()


def _watched():
    return (bpy.app.handlers.save_pre, _note), (bpy.app.handlers.load_post, _forget)


def register():
    """Note before files are saved what is known of their objects."""
    handlers.add(_watched())


def unregister():
    """Stop that."""
    handlers.remove(_watched())
