"""Blender's command line for an official Blender that is a module of Python: module_program.py FOLDER ARGUMENTS...

FOLDER is where pip has installed the module bpy. The arguments are those of the program `blender`, of which the ones are known that scripts, tests and
render farms start it with; an unknown one is refused. They act one after the other, as Blender has it, and so does the exit status: that of
sys.exit in a script, of --python-exit-code after an exception, 1 for a file that cannot be opened. A module begins with Blender's own preferences and
start-up file, with --factory-startup or without: that of 4.2 ends by a signal where it is to read those of the profile (wm.read_userpref).
Run with `python -s -P`, so that neither the user's packages nor this folder are found by what is imported.
"""

import atexit
import ctypes
import os
import shlex
import sys
import traceback
import types
from pathlib import Path

FREED = "165"
"""What memory is filled with once it is freed, with --debug-memory: a module is not given the allocator of Blender that does so."""
PROGRAM = "MOTUS_BLENDER_PROGRAM"
"""The environment variable in which scripts find the command that starts a Blender such as they run in: bpy.app.binary_path is empty."""
SWITCHES = {
    "-b",
    "--background",
    "--factory-startup",
    "-y",
    "--enable-autoexec",
    "-Y",
    "--disable-autoexec",
    "--version",
    "-v",
    "--debug-memory",
}
WITH_VALUE = {
    "--addons",
    "--python",
    "-P",
    "--python-expr",
    "--python-exit-code",
    "-t",
    "--threads",
    "-o",
    "--render-output",
    "-f",
    "--render-frame",
}
OF_A_SCENE = {
    "-s",
    "--frame-start",
    "-e",
    "--frame-end",
    "-F",
    "--render-format",
    "-E",
    "--engine",
    "-S",
    "--scene",
    "-x",
    "--use-extension",
}
ANIMATION = {"-a", "--render-anim"}


class Refused(Exception):
    """A command line that cannot be followed."""


def parsed(arguments):
    """[(option, value)], up to `--`, which ends the arguments for Blender; a file to open has the option ""."""
    found, rest = [], iter(arguments)
    for argument in rest:
        if argument == "--":
            break
        if argument in {"-c", "--command"}:
            found.append(("--command", list(rest)))
        elif argument in SWITCHES | ANIMATION:
            found.append((argument, None))
        elif argument in WITH_VALUE | OF_A_SCENE:
            value = next(rest, None)
            if value is None:
                raise Refused(f"{argument} wants a value behind it")
            found.append((argument, value))
        elif argument.startswith("-"):
            raise Refused(f"an official Blender, which is a module of Python, is not started with {argument} here")
        else:
            found.append(("", argument))
    options = {option for option, _ in found}
    if not options & {"-b", "--background", "--command", "--version", "-v"}:
        raise Refused("an official Blender is a module of Python here and has no window: start it with --background")
    return found


def frames_of(text, scene):
    """The frames of -f: numbers, ranges such as 1..5, and distances from the start or end of the scene such as +2 and -1."""
    for part in text.split(","):
        first, _, last = part.partition("..")
        ends = [_frame(end, scene) for end in (first, last or first)]
        yield from range(ends[0], ends[1] + 1)


def _frame(text, scene):
    distances = {"+": scene.frame_start, "-": scene.frame_end}
    return int(text) + distances.get(text[:1], 0)


class Session:
    """A Blender that follows its arguments."""

    def __init__(self, bpy, options):
        self.bpy = bpy
        self.error_status = next((int(value) for option, value in reversed(options) if option == "--python-exit-code"), 0)

    def follow(self, option, value):
        """Does what one argument asks for."""
        scene = self.bpy.context.scene
        match option:
            case "":
                self._open(value)
            case "--addons":
                self._enable(value.split(","))
            case "--python" | "-P":
                self._run(Path(value).read_text(encoding="utf-8"), value)
            case "--python-expr":
                self._run(value, "<string>")
            case "-y" | "--enable-autoexec" | "-Y" | "--disable-autoexec":
                self.bpy.context.preferences.filepaths.use_scripts_auto_execute = option in {"-y", "--enable-autoexec"}
            case "--version" | "-v":
                print(f"Blender {self.bpy.app.version_string}")
                raise SystemExit
            case "--command":
                raise SystemExit(self._command(value))
            case "-o" | "--render-output":
                scene.render.filepath = value
            case "-s" | "--frame-start":
                scene.frame_start = _frame(value, scene)
            case "-e" | "--frame-end":
                scene.frame_end = _frame(value, scene)
            case "-F" | "--render-format":
                scene.render.image_settings.file_format = value
            case "-E" | "--engine":
                scene.render.engine = value
            case "-x" | "--use-extension":
                scene.render.use_file_extension = value != "0"
            case "-S" | "--scene":
                self.bpy.context.window.scene = self.bpy.data.scenes[value]
            case "-f" | "--render-frame":
                for frame in frames_of(value, scene):
                    self._render(scene, frame, frame)
            case "-a" | "--render-anim":
                self._render(scene, scene.frame_start, scene.frame_end)

    def _open(self, path):
        self.bpy.ops.wm.open_mainfile(filepath=str(Path(path).resolve()))

    def _enable(self, names):
        import addon_utils

        for name in names:
            # Blender goes on where an add-on cannot be enabled, and prints why.
            addon_utils.enable(name, default_set=True, persistent=True)

    def _render(self, scene, first, last):
        kept = scene.frame_start, scene.frame_end
        scene.frame_start, scene.frame_end = first, last
        self.bpy.ops.render.render(animation=True, scene=scene.name)
        scene.frame_start, scene.frame_end = kept

    def _run(self, source, name):
        module = types.ModuleType("__main__")
        module.__dict__.update(__file__=name, __builtins__=__builtins__, bpy=self.bpy)
        sys.modules["__main__"] = module
        try:
            exec(compile(source, name, "exec"), module.__dict__)
        except Exception:
            traceback.print_exc()
            if self.error_status:
                raise SystemExit(self.error_status) from None

    @staticmethod
    def _command(arguments):
        """Commands of add-ons; Blender's own manager of extensions brings the one that there is."""
        if arguments[:1] != ["extension"]:
            raise Refused(f"--command knows extension alone, not {' '.join(arguments[:1])}")
        from bl_pkg.bl_extension_cli import cli_extension_handler

        return cli_extension_handler(arguments[1:])


def status_of(end):
    """The exit status that a SystemExit stands for; a text is printed, as Python does."""
    if end.code is None or isinstance(end.code, int):
        return end.code or 0
    print(end.code, file=sys.stderr)
    return 1


def keep_processors(count):
    """Lets the process use that many of its processors: a module counts its threads by these, and is not told another number."""
    if sys.platform != "win32":
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:count])
        return
    kernel, process = ctypes.windll.kernel32, ctypes.c_void_p(-1)
    own, all_there = ctypes.c_size_t(), ctypes.c_size_t()
    if not kernel.GetProcessAffinityMask(process, ctypes.byref(own), ctypes.byref(all_there)):
        raise OSError("Windows does not tell which processors may be used")
    bits = [1 << place for place in range(own.value.bit_length()) if own.value >> place & 1]
    kernel.SetProcessAffinityMask(process, ctypes.c_size_t(sum(bits[:count])))


def run(folder, arguments):
    """Starts Blender, and follows the arguments; returns the exit status."""
    try:
        options = parsed(arguments)
    except Refused as error:
        print(f"motus: {error}", file=sys.stderr)
        return 2
    own = [sys.executable, "-s", "-P", str(Path(__file__).resolve()), folder]
    if ("--debug-memory", None) in options and "MALLOC_PERTURB_" not in os.environ:
        os.execve(own[0], [*own, *arguments], os.environ | {"MALLOC_PERTURB_": FREED})
    for count in [int(value) for option, value in options if option in {"-t", "--threads"} and int(value)]:
        keep_processors(count)
    os.environ[PROGRAM] = shlex.join(own)
    sys.argv = [__file__, *arguments]
    sys.path.insert(0, folder)
    import bpy

    try:
        session = Session(bpy, options)
        for option, value in options:
            session.follow(option, value)
    except SystemExit as end:
        return status_of(end)
    except (Refused, RuntimeError, OSError) as error:
        print(f"motus: {error}", file=sys.stderr)
        return 1
    return 0


def main():
    """Ends the process at once after what was registered for its end: Python's own way out frees modules that Blender still uses."""
    status = run(sys.argv[1], sys.argv[2:])
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    if sys.platform == "win32":  # where os._exit, too, has libraries free what they hold
        ctypes.windll.kernel32.TerminateProcess(ctypes.c_void_p(-1), status)
    os._exit(status)


if __name__ == "__main__":
    main()
