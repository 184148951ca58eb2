"""Makes the generated parts of the manual: the pages of operators and of what is kept, the table of all settings, and the pictures.

`./motus docs` runs it inside Blender, `./motus docs operators`, `./motus docs kept` or `./motus docs settings` for one of them alone, and
`./motus docs moving [NAME...]` for the moving pictures of the demo scenes, which take half an hour.

What is seen in a window is made by `./motus docs steps`, also the insets in the pictures of the demo scenes: steps.py.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "scripts"), str(HERE.parent / "blend_tests")]

import chains_pictures  # noqa: E402  (found by the line above)
import chroma_pictures  # noqa: E402
import demo_pictures  # noqa: E402
import drivers_pictures  # noqa: E402
import dynamics_pictures  # noqa: E402
import ik_pictures  # noqa: E402
import kept_page  # noqa: E402
import lattice_pictures  # noqa: E402
import layers_pictures  # noqa: E402
import look_at_pictures  # noqa: E402
import moving_pictures  # noqa: E402
import operator_page  # noqa: E402
import path_pictures  # noqa: E402
import pendulum_pictures  # noqa: E402
import pull_pictures  # noqa: E402
import settings_page  # noqa: E402
import snow_pictures  # noqa: E402
import stereo_pictures  # noqa: E402
import support  # noqa: E402
import walker_pictures  # noqa: E402

support.enable()
pictures = HERE / "pictures"
chosen = sys.argv[sys.argv.index("--") + 1 :]
if chosen[:1] == ["moving"]:
    for picture in moving_pictures.render_all(pictures, chosen[1:]):
        print(f"docs/pictures/{picture.name}")
    sys.exit()
pages = {"operators": ("operators.md", operator_page), "kept": ("kept.md", kept_page), "settings": ("settings.json", settings_page)}
for file, page in (pages[name] for name in chosen or pages):
    (HERE / file).write_text(page.text(), encoding="utf-8")
    print(f"docs/{file}")
if chosen:
    sys.exit()
for render in (
    path_pictures.render_all,
    layers_pictures.render_all,
    walker_pictures.render_all,
    ik_pictures.render_all,
    look_at_pictures.render_all,
    pull_pictures.render_all,
    lattice_pictures.render_all,
    drivers_pictures.render_all,
    dynamics_pictures.render_all,
    chains_pictures.render_all,
    pendulum_pictures.render_all,
    snow_pictures.render_all,
    stereo_pictures.render_all,
    chroma_pictures.render_all,
    demo_pictures.render_all,
):
    for picture in render(pictures):
        print(f"docs/pictures/{picture.name}")
