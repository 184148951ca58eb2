"""Render the demo scenes, as demo_plan.py says.

Run inside Blender with the add-on enabled:

    blender -b --python demo_film.py -- [NAME...] [--output FOLDER] [--quick]

Films are made by EEVEE, which is free of noise at the few samples a frame can have here. So are the stills, unless this
Blender can denoise what Cycles makes.
"""

import contextlib
import shutil
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))

import demo_plan


@dataclass(frozen=True)
class Quality:
    """What pictures look like where there is time enough."""

    still_width: int
    still_samples: int  # of EEVEE
    path_samples: int  # of Cycles, for a still
    still_seconds: float  # at most, for each still by Cycles
    film_width: int
    film_samples: int
    film_frames: float  # at most


FULL = Quality(1280, 8, 40, 60.0, 640, 4, float("inf"))
QUICK = Quality(320, 2, 4, 4.0, 160, 1, 4)


class Progress:
    """Prints lines with the time since the command began."""

    def __init__(self, began):
        self._began = began

    def seconds(self):
        return time.time() - self._began

    def say(self, text):
        minutes, seconds = divmod(int(self.seconds()), 60)
        print(f"[{minutes}:{seconds:02d}] {text}", flush=True)


def main():
    """Build the scenes and render them."""
    given = demo_plan.arguments(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    folder, quality = given.output.resolve(), QUICK if given.quick else FULL
    folder.mkdir(parents=True, exist_ok=True)
    progress = Progress(given.began)
    built, files = {}, []

    def show(demo):
        if demo.name not in built:
            built[demo.name] = build(demo, progress)
        bpy.context.window.scene = built[demo.name]

    def render(shot, width):
        scene = bpy.context.window.scene
        if shot.still == demo_plan.FILM:
            files.append(render_film(shot, scene, folder, quality, progress))
        else:
            files.append(render_still(shot, scene, folder, quality, progress, width))

    shots = demo_plan.plan(given.names, progress.seconds())
    demo_plan.follow(shots, quality.still_width, progress.seconds, show, render)
    progress.say(f"In {folder}: {', '.join(file.name for file in files)}")


def build(demo, progress):
    """The scene, in the window."""
    began = progress.seconds()
    if bpy.ops.motus.demo_scene(system=demo.identifier) != {"FINISHED"}:
        sys.exit("The demo scene could not be built")
    scene = bpy.context.window.scene
    progress.say(
        f"{demo.name}: a scene of {len(scene.objects)} objects and {scene.frame_end} frames, built in {progress.seconds() - began:.0f} s"
    )
    return scene


def _frame_at(scene, seconds):
    return scene.frame_start + round(seconds * scene.render.fps / scene.render.fps_base)


@contextlib.contextmanager
def _frames(scene, first, last, step=1):
    """Have the scene consist of these frames alone for a while."""
    kept = scene.frame_start, scene.frame_end, scene.frame_step
    scene.frame_start, scene.frame_end, scene.frame_step = first, last, step
    try:
        yield
    finally:
        scene.frame_start, scene.frame_end, scene.frame_step = kept


def set_size(scene, width):
    """Let pictures of the scene be so many pixels wide, and 16 to 9."""
    scene.render.resolution_x, scene.render.resolution_y = width, width * 9 // 16
    scene.render.resolution_percentage = 100


# --- stills ----------------------------------------------------------------------------------------------------------


def render_still(shot, scene, folder, quality, progress, width):
    """Write flight_01.png and so on; returns the file."""
    began = progress.seconds()
    is_panorama = bool(shot.scene.stereo) and shot.scene.stereo[shot.still] == "VR180"
    if not _use_cycles(scene, quality, shot.end - began, at_any_price=is_panorama):
        _use_eevee(shot.scene, scene, quality.still_samples, reflections=True)
    set_size(scene, width)
    set_format(scene, "PNG")
    camera, moment = shot.scene.stills[shot.still]
    file = folder / f"{shot.scene.name}_{shot.still + 1:02d}.png"
    cuts = _suspend_cuts(scene)
    scene.camera = scene.objects[camera]
    output = _set_stereo(shot, scene)
    frame = _frame_at(scene, moment)
    scene.frame_set(frame)
    scene.render.filepath = str(file)
    if output == "LEAST_SQUARES":
        _render_combined(scene, frame, file)
    else:
        bpy.ops.render.render(write_still=True)
    if output == "VR180":
        scene.camera.data.type, scene.camera.motus.stereo.convergence = "PERSP", "BUDGET"
    _resume_cuts(scene, cuts)
    progress.say(f"{file}: {width} pixels wide, {progress.seconds() - began:.0f} s")
    return file


def _set_stereo(shot, scene):
    """Let both eyes be written as the scene says, where its camera has two. Returns how that is, "" for one picture from between them."""
    output = shot.scene.stereo[shot.still] if shot.scene.stereo else ""
    scene.render.use_multiview = bool(output)
    if output == "VR180" and scene.render.engine != "CYCLES":
        output = "SIDEBYSIDE"  # EEVEE has no panorama
    if output == "VR180":
        scene.camera.motus.stereo.convergence = "DISTANCE"  # around a camera there is no budget of depth
    keywords = {"LEAST_SQUARES": {"format": "PAIR"}, "VR180": {"format": "SIDEBYSIDE", "use_360": True, "use_180": True}}
    if output:
        bpy.ops.motus.stereo_output(object=scene.camera.name, **keywords.get(output, {"format": output}))
    return output


def _render_combined(scene, frame, file):
    """Render both eyes at a frame, and write the least-squares anaglyph of them."""
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder, "eyes_"))
        with _frames(scene, frame, frame):
            bpy.ops.render.render(animation=True)
            bpy.ops.motus.stereo_combine(object=scene.camera.name, frame_start=frame, frame_end=frame)
        shutil.move(next(Path(folder).glob("*_anaglyph.png")), file)


def _suspend_cuts(scene):
    """Take the cameras off the markers, so that a still can choose its own."""
    cuts = [(marker.name, marker.frame, marker.camera) for marker in scene.timeline_markers]
    scene.timeline_markers.clear()
    return cuts


def _resume_cuts(scene, cuts):
    for name, frame, camera in cuts:
        scene.timeline_markers.new(name, frame=frame).camera = camera


def _use_cycles(scene, quality, seconds, at_any_price):
    """Choose Cycles where this Blender has it, with a denoiser for the processor; says whether it does.

    at_any_price: without a denoiser too, if there is none.
    """
    try:
        scene.render.engine = "CYCLES"
    except TypeError:  # builds without it leave it out of the enum, which can only be asked this way
        return False
    settings = scene.cycles
    settings.use_denoising = True
    try:
        settings.denoiser = "OPENIMAGEDENOISE"
    except TypeError:
        if not at_any_price:
            return False
        settings.use_denoising = False
    settings.samples = quality.path_samples
    # The limit counts neither the preparation nor the denoising.
    settings.time_limit = min(quality.still_seconds, max(0.7 * seconds, 4.0))
    settings.use_adaptive_sampling = True
    settings.adaptive_threshold = 0.02
    settings.adaptive_min_samples = quality.path_samples // 3
    settings.max_bounces, settings.diffuse_bounces, settings.glossy_bounces = 4, 2, 2
    settings.caustics_reflective = settings.caustics_refractive = False
    settings.sample_clamp_indirect = 2.0
    return True


# --- film ------------------------------------------------------------------------------------------------------------


def render_film(shot, scene, folder, quality, progress):
    """Write flight.mp4 and so on, or numbered pictures where this Blender cannot write films; returns the file.

    The whole scene if time does not count, otherwise as much of its best seconds as there is time for.
    """
    demo = shot.scene
    _use_eevee(demo, scene, quality.film_samples, reflections=False)
    set_size(scene, quality.film_width)
    first, last = (
        (scene.frame_start, scene.frame_end) if shot.end == demo_plan.NEVER else (_frame_at(scene, moment) for moment in demo.film)
    )
    cost = _frame_cost(scene, last, progress)
    # The end is the best of it: a shorter film starts later.
    longest = min(last - first + 1, quality.film_frames)
    frames, samples = demo_plan.fit_film(shot.end - progress.seconds(), cost, quality.film_samples, scene.render.fps, longest)
    cost *= samples / quality.film_samples
    scene.eevee.taa_render_samples = samples
    progress.say(f"{demo.name}: film of {frames} frames, {samples} samples, {cost:.1f} s each: {frames * cost / 60.0:.1f} minutes")
    film = _set_film_output(demo, scene, folder)
    _set_stereo(shot, scene)
    report = _frame_reporter(progress, frames)
    with _frames(scene, last - frames + 1, last):
        _render_animation("render_write", report)
    of_both_eyes = film.with_name(f"{film.stem}_L{film.suffix}")
    if demo.stereo and of_both_eyes.exists():  # Blender calls it after the left one
        of_both_eyes.replace(film)
    progress.say(f"{film}: {frames} frames")
    return film


def _frame_cost(scene, last, progress):
    """Seconds that a frame of the film takes, seen in the last three; the first of them compiles shaders as well."""
    times = []

    def note(*_arguments):
        times.append(progress.seconds())

    with tempfile.TemporaryDirectory() as folder, _frames(scene, last - 2, last):
        set_format(scene, "PNG")
        scene.render.filepath = str(Path(folder, "frame_"))
        _render_animation("render_post", note)
    return max((times[-1] - times[0]) / 2.0, 1e-3)


def _render_animation(event, handler):
    """Render the scene's frames; the handler is called at each event of this name."""
    handlers = getattr(bpy.app.handlers, event)
    handlers.append(handler)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        handlers.remove(handler)


def render_loop(demo, scene, folder, width, samples, step, progress):
    """Write every `step`-th frame of the scene's loop into a folder as numbered pictures; returns these in their order."""
    first, last = (_frame_at(scene, moment) for moment in demo.loop)
    _use_eevee(demo, scene, samples, reflections=False)
    set_size(scene, width)
    set_format(scene, "PNG")
    _set_stereo(demo_plan.Shot(demo, demo_plan.FILM, demo_plan.NEVER), scene)
    scene.render.filepath = str(folder / "frame_")
    with _frames(scene, first, last - 1, step):  # the frame at the end of a lap is the first one again
        _render_animation("render_write", _frame_reporter(progress, len(range(first, last, step))))
    return sorted(folder.glob("*.png"))


def _use_eevee(demo, scene, samples, reflections):
    engines = scene.render.bl_rna.properties["engine"].enum_items
    scene.render.engine = next(item.identifier for item in engines if "EEVEE" in item.identifier)
    wanted = {
        "taa_render_samples": samples,
        "use_ssr": reflections,  # the mountains in the lake
        "use_gtao": True,
        "gtao_distance": demo.ambience,
        "use_soft_shadows": True,
        "use_shadow_high_bitdepth": True,
        "shadow_cascade_size": "2048",
    }
    for name, value in wanted.items():
        if hasattr(scene.eevee, name):  # half of these went with the first EEVEE
            setattr(scene.eevee, name, value)


def _set_film_output(demo, scene, folder):
    """Write H.264 where this Blender has the encoder, numbered pictures where not; returns the path."""
    if not bpy.app.build_options.codec_ffmpeg:
        set_format(scene, "PNG")
        scene.render.filepath = str(folder / demo.name / f"{demo.name}_")
        return folder / demo.name
    set_format(scene, "FFMPEG")
    settings = scene.render.ffmpeg
    settings.format, settings.codec = "MPEG4", "H264"
    settings.constant_rate_factor, settings.ffmpeg_preset = "HIGH", "GOOD"
    settings.audio_codec = "NONE"
    scene.render.filepath = str(folder / f"{demo.name}.mp4")
    return folder / f"{demo.name}.mp4"


def set_format(scene, file_format):
    """Let the scene be rendered into files of this format, "FFMPEG" for a film."""
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
