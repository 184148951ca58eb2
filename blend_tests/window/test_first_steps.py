"""The sidebar shows the hint where to begin until it is hidden."""

from unittest import mock

import bpy

import support
from window import window_support


def test_the_hint_is_drawn_until_it_is_hidden():
    support.disable()  # and enabled with preferences, which `blender --addons` does without
    support.enable()
    own = bpy.context.preferences.addons[support.module_name()].preferences
    sentences, ui = [], support.addon("core.interface.ui")
    with mock.patch.object(ui, "draw_message", lambda _layout, sentence, *_icon, **_width: sentences.append(sentence)):
        try:
            own.show_first_steps = True
            yield from window_support.open_tab("Motus")
            assert any("Demo Scene" in sentence for sentence in sentences), sentences

            with window_support.override():
                bpy.ops.motus.hide_first_steps()
            sentences.clear()
            drawn = window_support.drawn_panels("Motus")
            window_support.region('UI').tag_redraw()
            yield from window_support.until(lambda: drawn)
            assert drawn, "nothing was drawn again"
            assert not sentences, sentences
        finally:
            own.show_first_steps = False
