"""Render the demo scenes: stills, then a short film of each. Run inside Blender with the add-on enabled:

    blender -b --python demo_film.py -- --output FOLDER [--quick] [--only flight|reach|pull]

A film is made by EEVEE, which is free of noise at the few samples a frame can have here; it is cut short where the
machine would not finish it in time. So are the stills, unless this Blender can denoise what Cycles makes.
"""

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import bpy



@dataclass(frozen=True)
class Show:
    """A demo scene, and what is taken of it."""

    name: str  # of the files
    system: str  # that motus.demo_scene shows
    stills: tuple  # camera, seconds into the scene
    film_start: float  # seconds into the scene
    film_end: float
    ambience: float  # m up to which things darken each other


SHOWS = (
    Show(
        # The markers cut between cameras on the way.
        "flight", "PATH", (("Wide Camera", 1.05), ("Fly-By Camera", 9.5), ("Chase Camera", 6.2)),
        film_start=5.9, film_end=9.8, ambience=3.0,
    ),
    Show(
        "reach", "IK", (("Lookout Camera", 3.05), ("Lookout Camera", 4.4), ("Lookout Camera", 0.6)),
        film_start=0.0, film_end=9.0, ambience=0.5,
    ),
    Show(
        "pull", "PULL", (("Studio Camera", 4.1), ("Studio Camera", 5.2), ("Studio Camera", 1.6)),
        film_start=0.0, film_end=9.0, ambience=1.0,
    ),
)


@dataclass(frozen=True)
class Quality:
    """What a run may cost."""

    still_width: int
    still_samples: int  # of EEVEE
    path_samples: int  # of Cycles, for a still
    still_seconds: float  # at most, for each still by Cycles
    film_width: int
    film_samples: int
    film_frames: int  # at most
    seconds: float  # for a scene: its film gets what its stills leave


FULL = Quality(1280, 8, 40, 60.0, 640, 4, 216, 300.0)
QUICK = Quality(640, 4, 8, 15.0, 320, 2, 24, 90.0)


class Progress:
    """Prints lines with the time since the start, and knows how long the present scene has taken."""

    def __init__(self):
        self._start = self._begin = time.monotonic()

    def begin(self):
        """The next scene's time starts now."""
        self._begin = time.monotonic()

    def spent(self):
        """Seconds that the present scene has taken."""
        return time.monotonic() - self._begin

    def seconds(self):
        return time.monotonic() - self._start

    def say(self, text):
        minutes, seconds = divmod(int(self.seconds()), 60)
        print(f"[{minutes}:{seconds:02d}] {text}", flush=True)


def main():
    """Build the scenes and render them."""
    folder, quality, shows = _arguments()
    folder.mkdir(parents=True, exist_ok=True)
    progress = Progress()
    for show in shows:
        progress.begin()
        scene = build(show, progress)
        render_stills(show, scene, folder, quality, progress)
        render_film(show, scene, folder, quality, progress)
    progress.say(f"Done: {folder}")


def build(show, progress):
    """The scene of a show, in the window."""
    progress.say(f"Building the scene of the {show.name}")
    if bpy.ops.motus.demo_scene(system=show.system) != {"FINISHED"}:
        sys.exit("The demo scene could not be built")
    scene = bpy.context.window.scene
    progress.say(f"{scene.name}: {len(scene.objects)} objects, {scene.frame_end} frames a lap")
    return scene


def _arguments():
    parser = argparse.ArgumentParser(prog="demo_film.py", description="Render Motus's demo scenes")
    parser.add_argument("--output", type=Path, required=True, help="folder for the pictures")
    parser.add_argument("--quick", action="store_true", help="small and rough, to see that everything works")
    parser.add_argument("--only", choices=[show.name for show in SHOWS], help="render this scene and no other")
    own = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    arguments = parser.parse_args(own)
    shows = [show for show in SHOWS if arguments.only in (None, show.name)]
    return arguments.output.resolve(), QUICK if arguments.quick else FULL, shows


def _frame_at(scene, seconds):
    return scene.frame_start + round(seconds * scene.render.fps / scene.render.fps_base)


def _set_size(scene, width):
    scene.render.resolution_x, scene.render.resolution_y = width, width * 9 // 16
    scene.render.resolution_percentage = 100


# --- stills ----------------------------------------------------------------------------------------------------------


def render_stills(show, scene, folder, quality, progress, count=None):
    """flight_01.png and so on: the first `count` stills of a show, or all of them."""
    if not _use_cycles(scene, quality):
        _use_eevee(show, scene, quality.still_samples, reflections=True)
    _set_size(scene, quality.still_width)
    _set_format(scene, "PNG")
    cuts = _suspend_cuts(scene)
    stills = show.stills[:count]
    for number, (camera, seconds) in enumerate(stills, start=1):
        scene.camera = scene.objects[camera]
        scene.frame_set(_frame_at(scene, seconds))
        scene.render.filepath = str(folder / f"{show.name}_{number:02d}.png")
        began = progress.seconds()
        bpy.ops.render.render(write_still=True)
        progress.say(f"Still {number} of {len(stills)}: {camera}, {progress.seconds() - began:.0f} s")
    _resume_cuts(scene, cuts)


def _suspend_cuts(scene):
    """Take the cameras off the markers, so that a still can choose its own."""
    cuts = [(marker.name, marker.frame, marker.camera) for marker in scene.timeline_markers]
    scene.timeline_markers.clear()
    return cuts


def _resume_cuts(scene, cuts):
    for name, frame, camera in cuts:
        scene.timeline_markers.new(name, frame=frame).camera = camera


def _use_cycles(scene, quality):
    """Choose Cycles where this Blender has it, with a denoiser for the processor; says whether it does."""
    try:
        scene.render.engine = "CYCLES"
        settings = scene.cycles
        settings.denoiser = "OPENIMAGEDENOISE"
    except TypeError:  # builds without it leave it out of the enum, which can only be asked this way
        return False
    settings.use_denoising = True
    settings.samples = quality.path_samples
    settings.time_limit = quality.still_seconds
    settings.use_adaptive_sampling = True
    settings.adaptive_threshold = 0.02
    settings.adaptive_min_samples = quality.path_samples // 3
    settings.max_bounces, settings.diffuse_bounces, settings.glossy_bounces = 4, 2, 2
    settings.caustics_reflective = settings.caustics_refractive = False
    settings.sample_clamp_indirect = 2.0
    return True


# --- film ------------------------------------------------------------------------------------------------------------


def render_film(show, scene, folder, quality, progress):
    """flight.mp4 and so on, or numbered pictures where this Blender cannot write films."""
    _use_eevee(show, scene, quality.film_samples, reflections=False)
    _set_size(scene, quality.film_width)
    last = _frame_at(scene, show.film_end)
    frames = min(last - _frame_at(scene, show.film_start), quality.film_frames)
    frames = min(frames, _affordable_frames(scene, folder, last, quality, progress))
    whole_lap = scene.frame_start, scene.frame_end
    # The end is the best of it: a shorter film starts later.
    scene.frame_start, scene.frame_end = last - frames + 1, last
    film = _set_film_output(show, scene, folder)
    report = _frame_reporter(progress, frames)
    bpy.app.handlers.render_write.append(report)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_write.remove(report)
        scene.frame_start, scene.frame_end = whole_lap
    progress.say(f"Film: {film.name}, {frames} frames")


def _affordable_frames(scene, folder, last, quality, progress):
    """How many frames fit into the time that is left, by rendering one twice (the first time compiles shaders)."""
    _set_format(scene, "PNG")
    scene.render.filepath = str(folder / "film_test.png")
    for frame in (last - 1, last):
        scene.frame_set(frame)
        began = progress.seconds()
        bpy.ops.render.render(write_still=True)
        cost = max(progress.seconds() - began, 1e-3)
    Path(scene.render.filepath).unlink()
    progress.say(f"Film: {cost:.1f} s a frame")
    return max(scene.render.fps, int((quality.seconds - progress.spent()) / cost))


def _use_eevee(show, scene, samples, reflections):
    engines = scene.render.bl_rna.properties["engine"].enum_items
    scene.render.engine = next(item.identifier for item in engines if "EEVEE" in item.identifier)
    wanted = {
        "taa_render_samples": samples,
        "use_ssr": reflections,  # the mountains in the lake
        "use_gtao": True,
        "gtao_distance": show.ambience,
        "use_soft_shadows": True,
        "use_shadow_high_bitdepth": True,
        "shadow_cascade_size": "2048",
    }
    for name, value in wanted.items():
        if hasattr(scene.eevee, name):  # half of these went with the first EEVEE
            setattr(scene.eevee, name, value)


def _set_film_output(show, scene, folder):
    """Write H.264 where this Blender has the encoder, numbered pictures where not; returns the path."""
    if not bpy.app.build_options.codec_ffmpeg:
        _set_format(scene, "PNG")
        scene.render.filepath = str(folder / show.name / f"{show.name}_")
        return folder / show.name
    _set_format(scene, "FFMPEG")
    settings = scene.render.ffmpeg
    settings.format, settings.codec = "MPEG4", "H264"
    settings.constant_rate_factor, settings.ffmpeg_preset = "HIGH", "GOOD"
    settings.audio_codec = "NONE"
    scene.render.filepath = str(folder / f"{show.name}.mp4")
    return folder / f"{show.name}.mp4"


def _set_format(scene, file_format):
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "VIDEO" if file_format == "FFMPEG" else "IMAGE"
    settings.file_format = file_format
    settings.color_mode = "RGB"


def _frame_reporter(progress, frames):
    """A handler that says every twelfth frame."""
    done = 0

    def report(*_arguments):
        nonlocal done
        done += 1
        if done % 12 == 0:
            progress.say(f"Film: frame {done} of {frames}")

    return report


if __name__ == "__main__":
    main()
