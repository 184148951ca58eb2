"""The mesh that is pulled, as the mode that it is in wants it."""

from ...core.refusals import Refused
from ...core.translations import tr
from .edit_mesh import EditMesh
from .object_mesh import ObjectMesh, problem


def open_mesh(obj):
    """What reads and writes the object's mesh in the mode it is in. Raises Refused where meshes.problem() has a sentence."""
    sentence = problem(obj)
    if sentence:
        raise Refused(sentence)
    if obj.mode == 'EDIT':
        # What has been edited so far is in Blender's edit mesh alone; this puts it into the arrays.
        obj.update_from_editmode()
        if len(obj.data.vertices) == 0:
            raise Refused(tr("{object} has no vertices").format(object=obj.name))
        return EditMesh(obj)
    return ObjectMesh(obj)
