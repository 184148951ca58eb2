"""What the tests inside Blender share: the installed add-on, empty scenes, and fresh Blender processes."""

import atexit
import functools
import hashlib
import importlib
import json
import math
import os
import shlex
import shutil
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import addon_utils
import bpy
import numpy

TESTS = Path(__file__).resolve().parent
CLONE = TESTS.parent
LONGEST = 300
"""Seconds after which another Blender has failed that has not ended, or not done its piece of work."""
DONE = "motus: done with status "
"""What a Blender beside this one prints, with a number, after each piece of code."""


@functools.cache
def module_name():
    """Name of the add-on's package: an extension's lies below its repository (4.2 on), a legacy add-on's is its own."""
    names = {module.__name__ for module in addon_utils.modules(refresh=False)}
    return next(name for name in ("bl_ext.user_default.motus", "motus") if name in names)


def addon(path=""):
    """The installed package, or of it the module at `path`, such as "core.native"."""
    return importlib.import_module(f"{module_name()}.{path}" if path else module_name())


def is_enabled():
    return addon_utils.check(module_name())[1]


def enable():
    """Enables the add-on, without the hint where to begin, which would move what tests and pictures show; raises what its register() raised."""
    if not is_enabled():
        addon_utils.enable(module_name(), default_set=True, persistent=True, handle_error=_raise)
    if own := bpy.context.preferences.addons.get(module_name()):
        own.preferences.show_first_steps = False


def disable():
    addon_utils.disable(module_name(), default_set=True, handle_error=_raise)


def _raise(error):
    raise error


def about():
    """Lines that say what the tests are of: this Blender with its NumPy, and all bytes of the installed add-on."""
    folder = Path(addon().__file__).parent
    files = sorted(file for file in folder.rglob("*") if file.is_file() and "__pycache__" not in file.parts)
    blender = [bpy.app.version_string, str(bpy.app.build_hash), str(bpy.app.build_date), numpy.__version__]
    return blender + [f"{file.relative_to(folder)} {hashlib.sha256(file.read_bytes()).hexdigest()}" for file in files]


def register_systems(*toys):
    """Register the add-on once more, with these systems in its list."""
    _register_with(toys, toys)


def unregister_systems(*toys):
    """Take them out of its list again."""
    _register_with((), toys)


def _register_with(added, removed):
    systems = addon("systems")
    addon().unregister()
    systems.SYSTEMS = (*(one for one in systems.SYSTEMS if one not in removed), *added)
    addon().register()


def in_one_blender(test):
    """Marks a test or a class of them that is the same in every Blender: `./motus test` runs it in the newest alone."""
    test.in_one_blender = True
    return test


needs_translations = unittest.skipUnless(bpy.app.build_options.international, "this Blender is built without translations")
"""For a test, or a class of them, of texts in other languages."""


def program():
    """The command that starts a Blender such as this one; for a module of Python the launcher says it, as there is no such file."""
    return shlex.split(os.environ.get("MOTUS_BLENDER_PROGRAM", "")) or [bpy.app.binary_path]


def empty_scene():
    """A new file without objects; the add-on stays enabled.

    Read from a file of this Blender, which takes half of the time of factory settings: those are of an older one, and brought up to date each time.
    """
    bpy.ops.wm.read_homefile(filepath=_empty_file()[0], use_empty=True)


@functools.cache
def _empty_file():
    """(path of a file without objects, what deletes it at the end)."""
    folder = tempfile.TemporaryDirectory(prefix="motus-test-")
    path = str(Path(folder.name, "empty.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    return path, folder


def forget_notifiers():
    """Without a window Blender handles none of its notifiers, and looks through all of them for each datablock that it frees.

    The thousands of a long run made each new file five times as slow. Opening a file with its windows, not the start-up file, drops them.
    """
    bpy.ops.wm.open_mainfile(filepath=_empty_file()[0], load_ui=True)


def go_to(frame):
    """Go to a frame of the scene, sub-frames included."""
    whole = math.floor(frame)
    bpy.context.scene.frame_set(whole, subframe=frame - whole)


def link(name, data=None, location=(0.0, 0.0, 0.0), parent=None):
    """A new object in the scene."""
    obj = bpy.data.objects.new(name, data)
    obj.location, obj.parent = location, parent
    bpy.context.scene.collection.objects.link(obj)
    return obj


def key(holder, path, rows, index=-1):
    """Keys of a property: frame -> value."""
    for frame, value in rows.items():
        setattr(holder, path, value)
        holder.keyframe_insert(path, index=index, frame=frame)


def key_places(obj, rows):
    """Keys of an object's location: frame -> place."""
    key(obj, "location", rows)


def evaluated(thing):
    """The evaluated Object or PoseBone."""
    obj = thing.id_data.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return obj if thing == thing.id_data else obj.pose.bones[thing.name]


def differ(first, second, tolerance=1e-4, relative=0.0):
    """Keys under which two dictionaries of arrays have not the same numbers, or one has none.

    tolerance: how far two numbers may be apart that count as the same. relative: what is added to that, as a share of the number in `second`.
    """
    return {
        what
        for what in first.keys() | second.keys()
        if what not in first
        or what not in second
        or first[what].shape != second[what].shape
        or not (abs(first[what] - second[what]) <= tolerance + relative * abs(second[what])).all()
    }


def use_eevee(scene, engine, samples):
    """Has EEVEE render, drawn in software: without shadows, for which EEVEE (4.2 on) clears a large memory for each sample."""
    scene.render.engine = engine
    scene.eevee.taa_render_samples = samples
    if hasattr(scene.eevee, "shadow_pool_size"):
        scene.eevee.use_shadows, scene.eevee.shadow_pool_size = False, '16'


RENDERS = """
import bpy
scene = bpy.context.scene
scene.render.engine = 'BLENDER_WORKBENCH'
scene.render.resolution_x = scene.render.resolution_y = 8
bpy.ops.render.render()
print("RENDERED", flush=True)
"""


@functools.cache
def can_draw():
    """Whether a Blender without a window can draw with OpenGL or its like here.

    Where it cannot, EEVEE ends the process. So another one tries, with Workbench, which draws by the same means and has few shaders to compile.
    """
    status, output = run_blender(RENDERS, enabled=False)
    if status == 1:  # of an exception
        raise AssertionError(output)
    return "RENDERED" in output


def needs_drawing(test):
    """For a test that renders with EEVEE: skipped where nothing can be drawn without a window."""

    @functools.wraps(test)
    def drawn(self):
        if not can_draw():
            self.skipTest("no OpenGL: EEVEE ends the process")
        test(self)

    return drawn


class SceneTestCase(unittest.TestCase):
    """Each test starts in an empty scene, and has a temporary folder `self.folder`."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        forget_notifiers()

    def setUp(self):
        empty_scene()
        self._temporary = tempfile.TemporaryDirectory(prefix="motus-test-")
        self.addCleanup(self._delete_folder)
        self.folder = Path(self._temporary.name)
        self.addCleanup(self._assert_context_is_nobodys)

    def _delete_folder(self):
        """Deletes the temporary folder; Windows deletes no file that is open, as films of the scene are.

        tempfile takes what it may not delete for a folder, which then says that it is none: NotADirectoryError, or its like in wine.
        """
        try:
            self._temporary.cleanup()
        except OSError:
            empty_scene()
            self._temporary.cleanup()

    def _assert_context_is_nobodys(self):
        """That nothing was read which makes a scene the owner of bpy.context for good, as some Blenders do (docs/gotchas.md)."""
        self.assertIsNone(bpy.context.id_data)

    link, go_to = staticmethod(link), staticmethod(go_to)

    def assertRefused(self, part, operator, **keywords):
        """The operator refuses with a sentence in which the regular expression `part` is found."""
        with self.assertRaisesRegex(RuntimeError, part):
            operator(**keywords)

    def save(self, name="scene.blend"):
        """Saves a copy of the file into the test's folder; returns its path."""
        path = str(self.folder / name)
        bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
        return path

    def load(self, path, link, *names):
        """Appends or links objects into an empty scene; returns the first."""
        empty_scene()
        with bpy.data.libraries.load(path, link=link) as (_, wanted):
            wanted.objects = list(names)
        for one in wanted.objects:
            bpy.context.scene.collection.objects.link(one)
        return wanted.objects[0]

    def keep_preset(self, system):
        """Keeps the active object's settings of a system as a preset, for this test; gives what takes them up again."""
        name, menu = f"test{os.getpid()}", f"MOTUS_PT_{system}_presets"
        # Blender writes the preset's name over the panel's label.
        panel = getattr(bpy.types, menu)
        self.addCleanup(setattr, panel, "bl_label", panel.bl_label)
        self.assertEqual(getattr(bpy.ops.motus, f"{system}_preset_add")(name=name), {'FINISHED'})
        (kept,) = [path for folder in bpy.utils.preset_paths(f"motus/{system}") for path in Path(folder).glob(f"{name}.py")]
        self.addCleanup(kept.unlink)
        return lambda: bpy.ops.script.execute_preset(filepath=str(kept), menu_idname=menu)


def addon_folder(profile):
    """Where the add-on lies in a profile (a BLENDER_USER_RESOURCES folder)."""
    places = ("extensions/user_default/motus", "scripts/addons/motus")
    return next(Path(profile, place) for place in places if Path(profile, place).is_dir())


def copy_profile(folder):
    """Copies this Blender's profile to `folder`/profile, for a test that spoils the installed add-on; with what Python has compiled of it."""
    source, copy = Path(os.environ["BLENDER_USER_RESOURCES"]), Path(folder, "profile")
    shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__"))
    if _compiled(source).is_dir():
        shutil.copytree(_compiled(source), _compiled(copy))
    return copy


def _compiled(folder):
    """Where Blenders that tests start have compiled sources of a folder."""
    return Path(os.environ["PYTHONPYCACHEPREFIX"], *folder.absolute().parts[1:])


def _command(arguments, enabled, script):
    """Starts a Blender without a window that runs a script; an exception in the script ends it with status 1."""
    switch = ("--addons", module_name()) if enabled else ()
    return [*program(), "--background", *arguments, "--python-exit-code", "1", *switch, "--python", str(script)]


def _environment(profile):
    """That of this process; with another profile than this process's, unless it is None."""
    if profile is None:
        return dict(os.environ)
    kept = {name: value for name, value in os.environ.items() if not name.startswith("BLENDER_USER_")}
    return kept | {"BLENDER_USER_RESOURCES": str(profile)}


def run_blender(code, profile=None, arguments=("--factory-startup",), enabled=True):
    """Runs Python `code` in a fresh Blender without a window; returns (exit status, its output).

    For what a start of Blender, its end, a profile or an argument is part of; all else is run by run_beside(), which is quicker.
    `profile`: another profile than this process's. `enabled`: with the add-on switched on before the code runs.
    """
    with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
        script = Path(folder, "script.py")
        script.write_text(f"import sys; sys.path.insert(0, {str(TESTS)!r})\n{code}", encoding="utf-8")
        done = subprocess.run(
            _command(arguments, enabled, script),
            env=_environment(profile),
            text=True,
            timeout=LONGEST,
            check=False,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
    return done.returncode, done.stdout


class BlenderBeside:
    """Another Blender without a window, which runs pieces of code one after the other, each in Blender's own start-up file.

    It is started for the first piece, and again for the next one where a piece has ended it.
    """

    def __init__(self, profile=None, arguments=("--factory-startup",), enabled=True):
        self._command, self._environment = _command(arguments, enabled, TESTS / "beside.py"), _environment(profile)
        self._process = None

    def run(self, code):
        """Runs Python `code`; returns (0, or 1 after an exception, or the status with which Blender ended; what it has printed)."""
        if self._process is None or self._process.poll() is not None:
            self._start()
        timer = threading.Timer(LONGEST, self._process.kill)
        timer.start()
        try:
            self._process.stdin.write(json.dumps(code) + "\n")
            self._process.stdin.flush()
            lines = []
            for line in self._process.stdout:
                if line.startswith(DONE):
                    return int(line.removeprefix(DONE)), "".join(lines)
                lines.append(line)
        finally:
            timer.cancel()
        return self.close() or 1, "".join(lines)

    def close(self):
        """Ends it; returns its exit status."""
        if self._process is None:
            return 0
        with self._process as ended:
            self._process = None
            ended.stdin.close()
        return ended.returncode

    def _start(self):
        self._process = subprocess.Popen(
            self._command,
            env=self._environment,
            text=True,
            encoding="utf-8",
            errors="replace",
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )


@functools.cache
def _kept_beside(arguments, enabled):
    """The Blender in which all tests run such code; it ends with this one."""
    kept = BlenderBeside(arguments=arguments, enabled=enabled)
    atexit.register(kept.close)
    return kept


def run_beside(code, arguments=("--factory-startup",), enabled=True):
    """Runs Python `code` in another Blender without a window, in Blender's own start-up file; returns (0, or another status after an error; its output).

    That Blender serves all tests of a run that name the same arguments: what one of them has imported is there already. `enabled`: one with
    the add-on switched on.
    """
    return _kept_beside(arguments, enabled).run(code)
