"""Operators that go through frames in the window: whatever happens, no timer and no progress is left."""

import types
import unittest

import support

package = support.addon().__name__


class Recorder:
    """In place of the context, with a user who says OK to every question: notes the timers that run, whether progress is shown, and the status bar's text."""

    def __init__(self):
        self.timers, self.has_progress, self.status = set(), False, None
        self.window = object()
        self.scene = types.SimpleNamespace(frame_start=1, frame_end=3, frame_current=1, frame_subframe=0.0, use_preview_range=False)
        self.window_manager = types.SimpleNamespace(
            event_timer_add=self._add,
            event_timer_remove=self.timers.remove,
            modal_handler_add=lambda _operator: True,
            progress_begin=lambda _first, _last: self._show(True),
            progress_update=lambda _value: None,
            progress_end=lambda: self._show(False),
            invoke_props_dialog=lambda operator: operator.execute(self),
        )
        self.workspace = types.SimpleNamespace(status_text_set=lambda text: setattr(self, "status", text))

    def _add(self, _seconds, window):
        timer = object()
        self.timers.add(timer)
        return timer

    def _show(self, shown):
        self.has_progress = shown

    @property
    def is_tidy(self):
        return not self.timers and not self.has_progress and self.status is None


def stand_in(operator, steps):
    """Python that an operator's class has, without Blender's part of it; steps(): the generator that it goes through."""
    bases = tuple(base for base in operator.__bases__ if base.__module__.startswith(package))
    own = {name: value for name, value in vars(operator).items() if isinstance(value, types.FunctionType)}
    made = type("StandIn", bases, own)()
    made.properties = types.SimpleNamespace(is_property_set=lambda name: False)
    made.step, made.range, made.use_range, made.reports = 1.0, 'GIVEN', True, []
    made.steps = lambda _context, _frames: steps()
    made.report = lambda kinds, sentence: made.reports.append((kinds, sentence))
    made.result = lambda _context: None
    return made


def steps_that_raise(error, after, closed):
    """A generator that does `after` steps and then raises; notes in `closed` that it came to an end."""

    def steps():
        try:
            for done in range(after):
                yield done + 1
            raise error
        finally:
            closed.append(True)

    return steps


def operators():
    return (
        support.addon("core.interface.any_system.baking").MOTUS_OT_bake,
        support.addon("ik.checking.operators").MOTUS_OT_ik_check,
        support.addon("ik.matching.operators").MOTUS_OT_ik_match_fk,
        support.addon("core.interface.tracks.operators").MOTUS_OT_track_record,
    )


class TidyTest(unittest.TestCase):
    def assert_raises_tidily(self, operator, error, after, function):
        context, closed = Recorder(), []
        made = stand_in(operator, steps_that_raise(error, after, closed))
        with self.assertRaises(type(error)):
            function(made, context)
        self.assertTrue(context.is_tidy, (context.timers, context.has_progress, context.status))
        self.assertTrue(closed)

    @staticmethod
    def in_window(made, context):
        assert made.invoke(context, None) == {'RUNNING_MODAL'}
        assert context.timers and context.has_progress
        while made.modal(context, types.SimpleNamespace(type='TIMER')) == {'RUNNING_MODAL'}:
            pass

    def test_an_exception_in_the_window(self):
        for operator in operators():
            with self.subTest(operator.__name__):
                self.assert_raises_tidily(operator, ZeroDivisionError(), 2, self.in_window)

    def test_an_exception_at_once(self):
        for operator in operators():
            with self.subTest(operator.__name__):
                self.assert_raises_tidily(operator, ZeroDivisionError(), 0, lambda made, context: made.invoke(context, None))
                self.assert_raises_tidily(operator, ZeroDivisionError(), 1, lambda made, context: made.execute(context))

    def test_an_exception_in_the_report(self):
        for operator in operators():
            with self.subTest(operator.__name__):
                context = Recorder()
                made = stand_in(operator, lambda: (done for done in (1, 2)))
                made.result = lambda _context: 1 / 0
                with self.assertRaises(ZeroDivisionError):
                    self.in_window(made, context)
                self.assertTrue(context.is_tidy)

    def test_a_refusal_in_the_window(self):
        refused = support.addon("core.refusals").Refused
        for operator in operators():
            with self.subTest(operator.__name__):
                context, closed = Recorder(), []
                made = stand_in(operator, steps_that_raise(refused("Because"), 2, closed))
                self.in_window(made, context)
                self.assertTrue(context.is_tidy and closed)
                self.assertEqual(made.reports, [({'ERROR'}, "Because")])

    def test_escape(self):
        for operator in operators():
            with self.subTest(operator.__name__):
                context, closed = Recorder(), []
                made = stand_in(operator, steps_that_raise(ZeroDivisionError(), 9, closed))
                self.assertEqual(made.invoke(context, None), {'RUNNING_MODAL'})
                self.assertEqual(made.modal(context, types.SimpleNamespace(type='ESC')), {'CANCELLED'})
                self.assertTrue(context.is_tidy and closed)


class ProgressTest(unittest.TestCase):
    """By a clock that only goes on with the work, a hundredth of a second a step."""

    STEPS = 500

    def setUp(self):
        self.now = 0.0
        module = support.addon("core.interface.over_frames")
        clock = module.time
        module.time = types.SimpleNamespace(perf_counter=lambda: self.now)
        self.addCleanup(setattr, module, "time", clock)

    def steps(self):
        for done in range(self.STEPS):
            self.now += 0.01
            yield done + 1

    def shown(self, operator, run):
        """How often the progress was shown, which has windows drawn anew."""
        context, seen = Recorder(), []
        context.window_manager.progress_update = seen.append
        run(stand_in(operator, self.steps), context)
        return len(seen)

    def test_at_most_ten_redraws_a_second(self):
        for operator in operators():
            for name, run in (("window", TidyTest.in_window), ("script", lambda made, context: made.execute(context))):
                self.now = 0.0
                with self.subTest(operator.__name__, how=name):
                    shown = self.shown(operator, run)
                    self.assertLessEqual(shown, 10.0 * self.now)
                    self.assertGreater(shown, 5.0 * self.now, "the progress stands still")
