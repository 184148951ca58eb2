"""What `./motus demo` renders, in which order, and how long each part of it may take. Knows nothing of Blender.

demo_plan.py [NAME...]    ends with status 2, and a sentence, if there is no demo scene of that name
"""

import argparse
import collections
import runpy
import sys
import time
from pathlib import Path
from typing import NamedTuple

CLONE = Path(__file__).resolve().parents[2]
SCENES = runpy.run_path(str(CLONE / "addon" / "motus" / "demo" / "scenes.py"))["SCENES"]

TOTAL = 540.0  # seconds from the start of the command to the last picture: 10 minutes, less a reserve
LEAST = 150.0  # seconds for the pictures, however long building has taken
FILM_SHARE = 0.3  # of the seconds for the pictures
STILLS = 2  # of a scene, at most, where its name is not given
NARROWER = (960, 640)  # stills where there is no time for wider ones, pixels
NEVER = float("inf")
PATIENCE = 900.0  # seconds for a film at its best
FILM = -1


class Shot(NamedTuple):
    """A still of a scene, or its film."""

    scene: tuple  # of SCENES
    still: int  # index into the scene's stills; FILM: its film
    end: float  # seconds from the start of the command at which it has to be done
    is_optional: bool = False  # left out if there is no time for it


def arguments(words):
    """What the command line says; exits with a sentence if that cannot be done."""
    parser = argparse.ArgumentParser(prog="motus demo", add_help=False)
    parser.add_argument("names", nargs="*", metavar="NAME", help="render these scenes whole, however long it takes")
    parser.add_argument("--quick", action="store_true", help="small and rough, to see that everything works")
    parser.add_argument("--output", type=Path, default=CLONE / "out", help="folder for the pictures")
    parser.add_argument("--began", type=float, default=time.time(), help="when the command began, in seconds since 1970")
    given = parser.parse_args(words)
    known = [scene.name for scene in SCENES]
    for name in given.names:
        if name not in known:
            parser.exit(2, f"motus: there is no demo scene named {name}; there are: {', '.join(known)}\n")
    return given


def plan(names, spent, scenes=SCENES):
    """The shots in the order of rendering, `spent` seconds after the start of the command.

    With names, all stills and the film of those scenes, at any length. Without, one or two stills of every scene and the
    first one's film: what is left of the time is shared out equally among the scenes, and what a scene does not use is
    the next one's.
    """
    if names:
        return [
            Shot(scene, still, NEVER)
            for name in dict.fromkeys(names)
            for scene in scenes
            if scene.name == name
            for still in (*range(len(scene.stills)), FILM)
        ]
    seconds = max(TOTAL - spent, LEAST)
    share = (1.0 - FILM_SHARE) * seconds / len(scenes)
    stills = [
        Shot(scene, still, spent + place * share, is_optional=still > 0)
        for place, scene in enumerate(scenes, start=1)
        for still in range(min(len(scene.stills), STILLS))
    ]
    return [*stills, Shot(scenes[0], FILM, spent + seconds)]


def follow(shots, widest, clock, show, render):
    """Call show(scene) and render(shot, width) for each shot; clock() gives the seconds since the start of the command.

    A still is as wide as its time allows, judged by the two before it: a scene's first one compiles shaders, its second
    does not. An optional still that could not have the full width is left out. The width of a film is None.
    """
    costs = collections.deque(maxlen=2)  # seconds for a still one pixel wide
    widths = [widest, *(width for width in NARROWER if width < widest)]
    for shot in shots:
        cost = max(costs, default=0.0)
        if shot.is_optional and cost * widest**2 > shot.end - clock():
            continue
        show(shot.scene)
        if shot.still == FILM:
            render(shot, None)
            continue
        began = clock()
        width = max((width for width in widths if cost * width**2 <= shot.end - began), default=min(widths))
        render(shot, width)
        costs.append((clock() - began) / width**2)


def fit_film(seconds, cost, samples, fps, longest):
    """(frames, samples) of a film that may take so many seconds, where a frame of so many samples takes `cost` seconds.

    Fewer samples, down to half, if that makes the film longer; a second of film at least. Where it may take for ever it is
    as long as it can be, with fewer samples if these would take longer than PATIENCE.
    """
    fewer = max(samples // 2, 1)
    fitting = (number for number in range(samples, fewer, -1) if longest * cost * number / samples <= min(seconds, PATIENCE))
    samples, cost = next(((number, cost * number / samples) for number in fitting), (fewer, cost * fewer / samples))
    return int(min(longest, max(seconds / cost, fps))), samples


if __name__ == "__main__":
    arguments(sys.argv[1:])
