"""Open the mesh of an object for reading and writing, in the mode that the object is in."""

from ...core.refusals import Refused
from ...core.translations import tr
from .edit_mesh import EditMesh
from .object_mesh import ObjectMesh, problem


def open_mesh(obj):
    """Return an ObjectMesh or an EditMesh for an object, by its mode. Raises Refused if the mesh cannot be pulled."""
    sentence = problem(obj)
    if sentence:
        raise Refused(sentence)
    if obj.mode == 'EDIT':
        # Edits so far are in Blender's edit mesh alone; this call copies them into the mesh's arrays.
        obj.update_from_editmode()
        if len(obj.data.vertices) == 0:
            raise Refused(tr("{object} has no vertices").format(object=obj.name))
        return EditMesh(obj)
    return ObjectMesh(obj)
