"""The picture of the Motion Drivers page: what each function makes of six seconds."""

import bpy
import numpy as np

import stage
import support

FPS, SECONDS = 24.0, 6.0
WIDE, HIGH = 3.4, 0.7  # of a graph, and from its middle to a value of 1, m
COLUMNS, ACROSS, DOWN = 4, 4.3, 2.9
PAPER, AXIS, LINE = (1.0, 1.0, 1.0), (0.55, 0.55, 0.58, 1.0), (0.86, 0.36, 0.06, 1.0)
SHOWN = (
    ("Sine", "frequency 0.5", {"function": 'SINE', "frequency": 0.5, "phase": 0.0}),
    ("Triangle", "frequency 0.5", {"function": 'TRIANGLE', "frequency": 0.5, "phase": 0.0}),
    ("Saw", "frequency 0.5", {"function": 'SAW', "frequency": 0.5, "phase": 0.0}),
    ("Square", "frequency 0.5   share 0.3", {"function": 'SQUARE', "frequency": 0.5, "phase": 0.0, "share": 0.3}),
    ("Random Steps", "frequency 2", {"function": 'STEPS', "frequency": 2.0, "seed": 3, "blend": 0.0}),
    ("Random Steps", "frequency 2   blend 0.5", {"function": 'STEPS', "frequency": 2.0, "seed": 3, "blend": 0.5}),
    ("Noise", "speed 2", {"function": 'NOISE', "speed": 2.0, "seed": 1, "loop": 0}),
    ("Noise", "speed 2   loop 48", {"function": 'NOISE', "speed": 2.0, "seed": 1, "loop": 48}),
)


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_functions(folder / "drivers_functions.png")]


def _render_functions(file):
    sample = support.addon("drivers.preview").sample
    scene = stage.new_scene(PAPER)
    axis, line = (stage.flat_material(name, color) for name, color in (("Axis", AXIS), ("Line", LINE)))
    frames = np.linspace(0.0, FPS * SECONDS, 500, endpoint=False)
    for index, (label, numbers, keywords) in enumerate(SHOWN):
        left, middle = ACROSS * (index % COLUMNS), -DOWN * (index // COLUMNS)
        x = left + WIDE * frames / frames[-1]
        stage.add_tube([(x[0], 0.0, middle), (x[-1], 0.0, middle)], 0.010, axis)
        stage.add_tube([(one, -0.1, middle + HIGH * height) for one, height in zip(x, sample(keywords, frames, 1.0 / FPS))], 0.030, line)
        stage.add_text(label, (left + 0.5 * WIDE, 0.0, middle - HIGH - 0.42), 0.30)
        stage.add_text(numbers, (left + 0.5 * WIDE, 0.0, middle - HIGH - 0.76), 0.20)
    centre = (0.5 * (ACROSS * (COLUMNS - 1) + WIDE), 0.0, -0.35 - 0.5 * DOWN)
    stage.add_camera(scene, (centre[0], -10.0, centre[2]), centre, width=ACROSS * COLUMNS + 0.2)
    bpy.context.view_layer.update()
    return stage.render(scene, file, (1280, 460), samples=32)
