"""The list of the demo scenes. A new scene is added here only. Pure Python, so that `./motus demo` can read the list without Blender."""

from typing import NamedTuple


class DemoScene(NamedTuple):
    """A demo scene, and the pictures and film that `./motus demo` renders from it. Times are in seconds from the scene's start."""

    name: str  # name for `./motus demo` and its files, and the folder whose scene.build(context) builds the scene
    identifier: str  # value of the operator motus.demo_scene for this scene
    label: str
    description: str
    stills: tuple  # (camera, time), the most beautiful first
    film: tuple  # (time of its start, time of its end)
    loop: tuple  # (time of its start, time of its end): the seconds that the manual shows again and again
    ambience: float  # greatest distance at which ambient occlusion acts, m
    # For a stereo camera: format of each still and then of the film, as motus.stereo_output names it; "" renders from between the eyes,
    # "LEAST_SQUARES" makes the anaglyph by motus.stereo_combine, "VR180" shows half of a panorama to each eye.
    stereo: tuple = ()


# The first scene's still is rendered first, and its film is the one that `./motus demo` without a name makes.
SCENES = (
    DemoScene(
        name="flight",
        identifier="PATH",
        label="Banked Flight",
        description="An aeroplane on a curved course over a lake, with a chasing camera, and a train on the shore",
        stills=(("Wide Camera", 1.05), ("Fly-By Camera", 9.5), ("Chase Camera", 6.2)),
        film=(5.9, 9.8),  # timeline markers cut between cameras during the film
        loop=(5.9, 9.9),
        ambience=3.0,
    ),
    DemoScene(
        name="reach",
        identifier="IK",
        label="Reaching Pilot",
        description="A wooden figure whose hand and eyes follow a butterfly, while its feet and other hand stay put, and a daisy that stretches toward it",
        stills=(("Lookout Camera", 3.05), ("Lookout Camera", 4.4), ("Lookout Camera", 0.6)),
        film=(0.0, 9.0),
        loop=(1.0, 5.0),
        ambience=0.5,
    ),
    DemoScene(
        name="pull",
        identifier="PULL",
        label="Pulled from Clay",
        description="A landscape that rises from the sea and a face full of feeling, both pulled into shape and moved by pins",
        stills=(("Studio Camera", 4.1), ("Studio Camera", 5.2), ("Studio Camera", 1.6)),
        film=(0.0, 9.0),
        loop=(2.2, 6.2),
        ambience=1.0,
    ),
    DemoScene(
        name="pendulum",
        identifier="PENDULUM",
        label="Fan of Chaos",
        description="Double pendulums that start half a degree apart and soon go ways of their own, one of them alone, and "
        "one with other angles",
        stills=(("Hall Camera", 2.6), ("Hall Camera", 5.1), ("Hall Camera", 9.0)),
        film=(0.0, 12.0),
        loop=(0.0, 4.0),
        ambience=0.5,
    ),
    DemoScene(
        name="dynamics",
        identifier="DYNAMICS",
        label="Hopping Creature",
        description="A creature whose body, tail and antennae swing along with the few keys that make it hop",
        stills=(("Table Camera", 0.45), ("Table Camera", 1.0), ("Table Camera", 3.2)),
        film=(0.0, 110 / 24),
        loop=(0.0, 110 / 24),
        ambience=0.6,
    ),
    DemoScene(
        name="snow",
        identifier="SNOW",
        label="Winter Village",
        description="Snow that falls on a village at dusk, whose roofs, trees and meadows turn white, without a cache",
        stills=(("Evening Camera", 9.0), ("Evening Camera", 3.0), ("Evening Camera", 0.4)),
        film=(0.0, 10.0),
        loop=(7.2, 9.6),
        ambience=1.0,
    ),
    DemoScene(
        name="stereo",
        identifier="STEREO",
        label="Stereo Colonnade",
        description="An aeroplane between columns at several depths, filmed by a stereo camera that looks after it",
        stills=(("Stereo Camera", 4.0), ("Stereo Camera", 4.0), ("Stereo Camera", 7.4)),
        film=(1.5, 9.5),
        loop=(4.0, 6.9),
        ambience=2.0,
        stereo=("LEAST_SQUARES", "SIDEBYSIDE", "VR180", "ANAGLYPH"),
    ),
    DemoScene(
        name="chroma",
        identifier="CHROMA",
        label="Keyed Pilot",
        description="A pilot who was filmed before a green screen stands among columns while his aeroplane passes",
        stills=(("Place Camera", 1.8), ("Place Camera", 2.2), ("Place Camera", 0.9)),
        film=(0.0, 71 / 24),
        loop=(0.0, 2.0),
        ambience=2.0,
    ),
    DemoScene(
        name="layers",
        identifier="LAYERS",
        label="Walk on a Small Planet",
        description="A wooden pilot walks on a planet that turns beneath him, and throws an aeroplane, waves and jumps by layers of animation",
        stills=(("Planet Camera", 2.55), ("Planet Camera", 6.05), ("Planet Camera", 4.45)),
        film=(0.0, 9.0),
        loop=(1.0, 5.0),
        ambience=0.5,
    ),
    DemoScene(
        name="walker",
        identifier="WALKER",
        label="Spiders on the Wall",
        description="A spider goes over the stones of a garden and up an old wall, and her young go after her; toys go on a turntable",
        stills=(("Garden Camera", 4.4), ("Garden Camera", 9.0), ("Toy Camera", 10.5)),
        film=(0.0, 12.0),
        loop=(3.0, 7.0),
        ambience=0.5,
    ),
    DemoScene(
        name="chains",
        identifier="CHAINS",
        label="Windy Bridge",
        description="A dog whose tail, ears and leash fly in the wind waits at a rope bridge with flags, over which a spider comes",
        stills=(("Gorge Camera", 7.6), ("Gorge Camera", 4.0), ("Gorge Camera", 2.6)),
        film=(0.0, 8.0),
        loop=(4.0, 8.0),
        ambience=0.5,
    ),
    DemoScene(
        name="main",
        identifier="MAIN",
        label="Winter Flight",
        description="Eight systems at once: a pilot walks through the snow, throws an aeroplane and steers it, while lanterns swing "
        "and a spider comes to see",
        stills=(("Main Camera", 4.7), ("Main Camera", 10.8), ("Main Camera", 4.7)),
        film=(0.0, 11.0),
        loop=(3.0, 7.0),
        ambience=0.6,
        stereo=("", "", "ANAGLYPH", ""),
    ),
)
