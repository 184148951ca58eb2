"""The picture of the Dynamics page: what each style makes of a step."""

import bpy
import numpy as np

import stage
import support

SECONDS, BEFORE = 2.0, 0.15
WIDE = 3.4  # of a graph, m; a step is one high
COLUMNS, ACROSS, DOWN = 4, 4.3, 3.4
PAPER, AXIS, STEP, LINE = (1.0, 1.0, 1.0), (0.55, 0.55, 0.58, 1.0), (0.30, 0.52, 0.85, 1.0), (0.86, 0.36, 0.06, 1.0)


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_styles(folder / "dynamics_styles.png")]


def _render_styles(file):
    styles = support.addon("dynamics.styles").STYLES
    native = support.addon("core.native").module
    scene = stage.new_scene(PAPER)
    axis, step, line = (stage.flat_material(name, color) for name, color in (("Axis", AXIS), ("Step", STEP), ("Line", LINE)))
    times = np.linspace(-BEFORE, SECONDS, 400)
    for index, (_, label, _, numbers) in enumerate(styles):
        left, low = ACROSS * (index % COLUMNS), -DOWN * (index // COLUMNS)
        x = left + WIDE * (times + BEFORE) / (SECONDS + BEFORE)
        stage.add_tube([(x[0], 0.0, low), (x[-1], 0.0, low)], 0.010, axis)
        stage.add_tube([(one, 0.0, low + height) for one, height in zip(x, (times >= 0.0).astype(float))], 0.016, step)
        stage.add_tube([(one, -0.1, low + height) for one, height in zip(x, native.step_response(times, *numbers))], 0.034, line)
        frequency, damping, response = numbers
        stage.add_text(label, (left + 0.5 * WIDE, 0.0, low - 0.72), 0.30)
        stage.add_text(f"f {frequency:g}   zeta {damping:g}   r {response:g}", (left + 0.5 * WIDE, 0.0, low - 1.08), 0.20)
    middle = (0.5 * (ACROSS * (COLUMNS - 1) + WIDE), 0.0, 0.42 - 0.5 * DOWN)
    stage.add_camera(scene, (middle[0], -10.0, middle[2]), middle, width=ACROSS * COLUMNS + 0.2)
    bpy.context.view_layer.update()
    return stage.render(scene, file, (1280, 530), samples=32)
