"""What drags in the viewport share, without a window: how they end where scripts have removed what is dragged."""

import types
import unittest

import support


class Gone:
    """In the place of what is held, of an object that is there no more."""

    def restore(self):
        raise ReferenceError("StructRNA of type Object has been removed")

    def pull(self, _place):
        self.restore()


@support.in_one_blender
class GoneTest(unittest.TestCase):
    def test_the_drag_ends_and_says_why(self):
        for event in (types.SimpleNamespace(type='ESC', value='PRESS'), types.SimpleNamespace(type='LEFTMOUSE', value='RELEASE')):
            texts, reports = [], []
            drag = support.addon("core.interface.dragging.drag").PointDrag()
            drag._held, drag._has_moved, drag._finish = Gone(), True, lambda _context: Gone().restore()
            drag._travel = types.SimpleNamespace(is_confirmed_by=lambda _event: False, view=types.SimpleNamespace(tell=texts.append))
            drag.report = lambda kinds, sentence, reports=reports: reports.append((kinds, sentence))
            context = types.SimpleNamespace(workspace=types.SimpleNamespace(status_text_set=texts.append))
            self.assertEqual(drag.modal(context, event), {'CANCELLED'})
            self.assertEqual([kinds for kinds, _ in reports], [{'ERROR'}])
            self.assertEqual(set(texts), {None})
