"""The library as other programs get it: installed as a CMake package, linked by the examples, added as a folder, packed.

`./motus build release motus_libraries` has made it before. Everything is written into BUILD/installed, always anew: a ccache
knows what has been compiled in the same place.
"""

import csv
import functools
import json
import math
import os
import re
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get("MOTUS_BUILD", ROOT / "build"))
RELEASE = BUILD / "release"
SCRATCH = BUILD / "installed"
PREFIX = SCRATCH / "prefix"
EXAMPLES = sorted(path.stem for path in (ROOT / "native" / "examples").glob("*.cpp"))
COMPILERS = ("g++", "clang++")
CCACHE = [name for name in ("ccache",) if shutil.which(name)]
FLAKES, WIDTH, HEIGHT = 1_000_000, 640, 320


def run(*command, **options):
    """A command's output; fails with it where the command fails."""
    done = subprocess.run(list(map(str, command)), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, **options)
    assert done.returncode == 0, done.stdout
    return done.stdout


def refusal(*command):
    """What a command says that fails, in one line."""
    done = subprocess.run(list(map(str, command)), text=True, capture_output=True, check=False)
    assert done.returncode != 0
    return " ".join((done.stdout + done.stderr).split())


def has(compiler):
    """Skips the test where this machine has no such compiler."""
    if not shutil.which(compiler):
        pytest.skip(f"no {compiler} here")
    return compiler


def fresh(name):
    """An empty folder, the same in every run."""
    folder = SCRATCH / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def configure(source, folder, *options):
    """Runs CMake for a project of another program."""
    launcher = [f"-DCMAKE_CXX_COMPILER_LAUNCHER={name}" for name in CCACHE]
    return run("cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *launcher, *options)


def compile_source(compiler, name, text):
    """Compiles a source against the installed headers, with warnings as errors."""
    (SCRATCH / "sources").mkdir(exist_ok=True)
    (SCRATCH / "sources" / name).write_text(text, encoding="utf-8")
    flags = ("-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I", "prefix/include")
    run(*CCACHE, has(compiler), *flags, "-c", f"sources/{name}", "-o", "sources/object.o", cwd=SCRATCH)


def project(name, *lines, main=""):
    """A project of another program, in a fresh folder."""
    folder = fresh(name)
    (folder / "CMakeLists.txt").write_text(
        "\n".join(("cmake_minimum_required(VERSION 3.25)", "project(p LANGUAGES CXX)", *lines)) + "\n", encoding="utf-8"
    )
    (folder / "main.cpp").write_text(main, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def prefix():
    """The folder into which the package is installed."""
    fresh("prefix")
    run("cmake", "--install", RELEASE, "--prefix", PREFIX)
    return PREFIX


@pytest.fixture(scope="module")
def written(prefix):
    """Of each compiler, the folder with what the examples have written, which are built against the installed package."""

    @functools.cache
    def of(compiler):
        folder = fresh(f"examples-{compiler}")
        configure(ROOT / "native" / "examples", folder, f"-DCMAKE_CXX_COMPILER={has(compiler)}", f"-DCMAKE_PREFIX_PATH={prefix}")
        run("cmake", "--build", folder)
        for example in EXAMPLES:
            run(folder / example, folder / f"{example}.out")
        return folder

    return of


def rows(folder, example):
    """What an example wrote as a table: a dictionary of numbers a line."""
    with (folder / f"{example}.out").open(encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


@pytest.mark.parametrize("example", EXAMPLES)
def test_both_compilers_give_the_same(written, example):
    first, second = (((written(compiler)) / f"{example}.out").read_bytes() for compiler in COMPILERS)
    assert len(first) > 1000
    assert first == second


def test_the_examples_are_short():
    for example in EXAMPLES:
        lines = (ROOT / "native" / "examples" / f"{example}.cpp").read_text(encoding="utf-8").splitlines()
        assert len(lines) < 80, example


def test_the_camera_flies_the_whole_curve_and_banks(written):
    found = rows(written("g++"), "camera_on_path")
    assert [found[0][axis] for axis in "xyz"] == [0.0, 0.0, 2.0]
    assert [found[-1][axis] for axis in "xyz"] == pytest.approx([40.0, 0.0, 3.0], abs=1e-4)
    # The height of the camera's own X axis over the horizon is the sine of its roll, for a flight that is nearly level.
    rolls = [2.0 * (row["rotation_x"] * row["rotation_z"] - row["rotation_w"] * row["rotation_y"]) for row in found]
    assert 0.1 < max(map(abs, rolls)) < math.sin(0.7) + 0.05


def test_the_pendulum_keeps_its_energy(written):
    found = rows(written("g++"), "double_pendulum")
    assert len(found) == 60 * 24 + 1
    energies = [row["energy"] for row in found]
    assert max(energies) - min(energies) < 1e-4  # the file has six digits
    for row in found:
        assert math.hypot(row["x1"], row["z1"]) == pytest.approx(1.0, abs=1e-5)
        assert math.hypot(row["x2"] - row["x1"], row["z2"] - row["z1"]) == pytest.approx(0.7, abs=1e-5)


def followed(frequency, damping, response):
    """What follows the signal of the example at each hundredth of a second: y'' = w^2 (x - y) - 2 z w y' + r z w x', in small steps."""
    times, signal = (0.0, 0.5, 0.8, 2.0, 2.4, 4.0), (0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
    w, step, place, speed, found = math.tau * frequency, 1e-5, 0.0, 0.0, [0.0]
    for sample in range(400):
        piece = max(index for index in range(5) if times[index] <= sample / 100 + 1e-9)
        slope = (signal[piece + 1] - signal[piece]) / (times[piece + 1] - times[piece])
        for index in range(1000):
            wanted = signal[piece] + slope * (sample / 100 + index * step - times[piece])
            speed += step * (w * w * (wanted - place) - 2 * damping * w * speed + response * damping * w * slope)
            place += step * speed
        found.append(place)
    return found


@pytest.mark.parametrize(
    ("name", "settings"), [("overshooting", (2.5, 0.3, 0.0)), ("smooth", (1.5, 1.0, 0.0)), ("anticipating", (2.0, 0.6, -1.5))]
)
def test_outputs_follow_the_signal_by_their_equation(written, name, settings):
    assert [row[name] for row in rows(written("g++"), "follow_through")] == pytest.approx(followed(*settings), abs=1e-3)


def test_bones_keep_their_lengths_and_the_hand_meets_the_ball(written):
    for row in rows(written("g++"), "reach_and_look"):
        elbow, hand, ball = ([row[f"{name}_{axis}"] for axis in "xyz"] for name in ("elbow", "hand", "ball"))
        assert math.dist((0.2, 0.0, 1.4), elbow) == pytest.approx(0.32, abs=1e-5)
        assert math.dist(elbow, hand) == pytest.approx(0.28, abs=1e-5)
        if math.dist((0.2, 0.0, 1.4), ball) < 0.57:
            assert math.dist(hand, ball) < 1e-5


def test_a_million_flakes_are_in_the_picture(written):
    header, pixels = (written("g++") / "snowfall.out").read_bytes().split(b"255\n", 1)
    assert header == f"P5 {WIDTH} {HEIGHT} ".encode()
    assert len(pixels) == WIDTH * HEIGHT
    assert sum(255 - pixel for pixel in pixels) / 12 > 0.8 * FLAKES  # as good as all are within the picture


def test_feet_stand_on_the_hills(written):
    for row in rows(written("g++"), "hexapod"):
        for leg in range(1, 7):
            x, y, z = (row[f"{axis}{leg}"] for axis in "xyz")
            assert z > 0.25 * math.sin(1.3 * x) * math.cos(1.1 * y) - 0.01
    last = rows(written("g++"), "hexapod")[-1]
    for leg in range(1, 7):
        x, y, z = (last[f"{axis}{leg}"] for axis in "xyz")
        assert z == pytest.approx(0.25 * math.sin(1.3 * x) * math.cos(1.1 * y), abs=0.15)


def test_who_wants_a_curve_links_no_snow(written):
    symbols = run("nm", "-C", written("g++") / "camera_on_path")
    assert "motus::curve::" in symbols
    for other in ("snow", "walker", "bones", "mesh"):
        assert f"motus::{other}::" not in symbols


@functools.cache
def headers():
    """Installed headers, as programs include them."""
    return sorted(str(path.relative_to(PREFIX / "include")) for path in PREFIX.rglob("*.hpp"))


def includes(header):
    """What an installed header includes itself."""
    return re.findall(r'#include [<"]([^>"]+)[>"]', (PREFIX / "include" / header).read_text(encoding="utf-8"))


def reached_by(header):
    """What of the library an installed header includes, by itself or through others, and itself."""
    found, waiting = set(), [header]
    while waiting:
        one = waiting.pop()
        if one not in found and one.startswith("motus/"):
            found.add(one)
            waiting += includes(one)
    return found


def test_every_installed_header_compiles_alone(prefix):
    assert len(headers()) > 40
    for header in headers():
        compile_source("g++", f"{header.replace('/', '_')}.cpp", f'#include "{header}"\n#include "{header}"\n')


def test_all_installed_headers_compile_together_with_clang(prefix):
    compile_source("clang++", "all.cpp", "".join(f'#include "{header}"\n' for header in headers()))


def test_internal_headers_are_not_installed(prefix):
    internal = {str(path.relative_to(ROOT / "native" / "internal")) for path in (ROOT / "native" / "internal").rglob("*.hpp")}
    assert internal
    assert not internal & set(headers())
    for header in headers():
        assert reached_by(header) <= set(headers()), header


def test_installed_files_name_no_folder_of_this_machine(prefix):
    for path in filter(Path.is_file, prefix.rglob("*")):
        for folder in (ROOT, BUILD, Path.home()):
            assert f"{folder}/".encode() not in path.read_bytes(), path


def test_every_header_with_types_of_glm_checks_how_glm_is_configured(prefix):
    for header in headers():
        if any(name.startswith("glm/") for name in includes(header)):
            assert "motus/config.hpp" in reached_by(header), header


@pytest.mark.parametrize(
    "macro",
    [
        "GLM_FORCE_QUAT_DATA_WXYZ",
        "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES",
        *(f"GLM_FORCE_PRECISION_{level}_{kind}" for level in ("LOWP", "MEDIUMP") for kind in ("FLOAT", "DOUBLE", "INT")),
    ],
)
def test_glm_that_is_configured_otherwise_is_refused(prefix, macro):
    source = fresh("refused") / "one.cpp"
    source.write_text("#include <motus/curve/curve.hpp>\n", encoding="utf-8")
    said = refusal("g++", "-std=c++20", "-fsyntax-only", "-Wfatal-errors", f"-D{macro}", "-I", prefix / "include", source)
    assert "#error" in said
    assert "Motus needs" in said
    kind = re.sub("_(LOWP|MEDIUMP)_.*", "", macro)
    assert f"compile without {kind}" in said


def test_the_version_is_the_projects(prefix):
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    version = re.search(r"^project\(motus VERSION ([0-9.]+)", text, re.MULTILINE)[1]
    assert f'version = "{version}"' in (prefix / "include" / "motus" / "version.hpp").read_text(encoding="utf-8")
    major, minor, _ = map(int, version.split("."))
    for wanted, is_found in ((version, True), (f"{major}.{minor}", True), (f"{major}.{minor + 1}", False), (f"{major + 1}.0", False)):
        lines = (f"find_package(Motus {wanted} CONFIG)", "message(STATUS found=${Motus_FOUND}=)")
        said = configure(project("version", *lines), SCRATCH / "version" / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
        assert f"found={int(is_found)}=" in said, wanted


def test_an_unknown_component_is_refused(prefix):
    source = project("unknown", "find_package(Motus REQUIRED COMPONENTS curve rain)")
    said = refusal("cmake", "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    assert "Motus has no component rain" in said


def test_the_lines_of_the_readme_run(prefix):
    (lines,) = re.findall(r"```cpp\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    (wanted,) = re.findall(r"```cmake\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    source = project("readme", "add_executable(my_program main.cpp)", wanted, main=lines)
    configure(source, source / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", source / "build")
    assert run(source / "build" / "my_program").strip()


def test_as_a_folder_of_another_project():
    """No tests, benchmarks, Python and errors for warnings; the names of the targets are those of the package."""
    source = project(
        "folder",
        f"add_subdirectory({ROOT} motus)",
        "add_executable(p main.cpp)",
        "target_link_libraries(p PRIVATE Motus::core)",
        "add_executable(all_topics EXCLUDE_FROM_ALL main.cpp)",
        "target_link_libraries(all_topics PRIVATE Motus::motus)",
        main="#include <motus/core/numeric.hpp>\n#include <motus/version.hpp>\nint main() { return motus::version.empty(); }\n",
    )
    configure(source, source / "build")
    cache = (source / "build" / "CMakeCache.txt").read_text(encoding="utf-8")
    for option in ("TESTS", "BENCHMARKS", "PYTHON", "WERROR", "INSTALL"):
        assert f"MOTUS_{option}:BOOL=OFF" in cache, option
    commands = json.loads((source / "build" / "compile_commands.json").read_text(encoding="utf-8"))
    assert len(commands) > 80
    for entry in commands:
        assert "-Werror" not in entry["command"]
        assert not re.search(r"native/(tests|bench|bindings)/", entry["file"])
    run("cmake", "--build", source / "build", "--target", "p")
    run(source / "build" / "p")


def test_packages_for_debian_and_for_all():
    folder = fresh("packages")
    run("cpack", "--config", RELEASE / "CPackConfig.cmake", "-B", folder)
    (archive,) = folder.glob("*.tar.gz")
    with tarfile.open(archive) as file:
        names = [name.partition("/")[2] for name in file.getnames()]
    (debian,) = folder.glob("*.deb")
    contents = {"archive": names}
    if shutil.which("dpkg-deb"):
        fields = run("dpkg-deb", "--field", debian)
        assert "Package: libmotus-dev" in fields
        assert "libglm-dev" in fields
        contents["debian"] = [line.split()[-1].removeprefix("./usr/") for line in run("dpkg-deb", "--contents", debian).splitlines()]
    for kind, paths in contents.items():
        for end in ("include/motus/curve/curve.hpp", "include/motus/version.hpp", "libmotus_curve.a", "MotusConfig.cmake", "LICENSE"):
            assert any(path.endswith(end) for path in paths), (kind, end)
        for path in (path.strip("./") for path in paths):
            places = ("include/motus/", "lib/", "share/doc/motus/")
            assert any(place.startswith(path) or path.startswith(place) for place in places), (kind, path)
