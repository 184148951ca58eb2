"""Open the pulled mesh in the mode that its object is in."""

from ...core.refusals import Refused
from ...core.translations import tr
from .edit_mesh import EditMesh
from .object_mesh import ObjectMesh, problem


def open_mesh(obj):
    """Reader and writer of an object's mesh for the object's mode. Raises Refused if meshes.problem() gives a sentence."""
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
