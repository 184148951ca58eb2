"""What a command needs is installed on Debian 12 and 13, and elsewhere named in one line for the system's own package manager."""

import concurrent.futures
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

CI = Path(__file__).resolve().parents[1]
SYSTEMS = {
    "bookworm": 'ID=debian\nVERSION_CODENAME=bookworm\n',
    "trixie": 'ID=debian\nVERSION_CODENAME=trixie\n',
    "sid": 'ID=debian\nVERSION_CODENAME=forky\n',
    "ubuntu": 'ID=ubuntu\nID_LIKE=debian\nVERSION_CODENAME=noble\n',
    "mint": 'ID=linuxmint\nID_LIKE="ubuntu debian"\n',
    "fedora": 'ID=fedora\nVERSION_ID=43\n',
    "rocky": 'ID="rocky"\nID_LIKE="rhel centos fedora"\n',
    "arch": 'ID=arch\n',
    "manjaro": 'ID=manjaro\nID_LIKE=arch\n',
    "slackware": 'ID=slackware\n',
}
WANTED = "g++:no-such-program libglm-dev:/no/such/file catch2:/no/such/*/file clang-format:no-such-tool clang-tidy:no-such-tool"
APT = "sudo apt-get install g++ libglm-dev catch2 clang-format clang-tidy"
DNF = "sudo dnf install gcc-c++ glm-devel catch-devel clang-tools-extra"
PACMAN = "sudo pacman -S --needed gcc glm catch2 clang"
LINES = {
    "sid": APT,
    "ubuntu": APT,
    "mint": APT,
    "fedora": DNF,
    "rocky": DNF,
    "arch": PACMAN,
    "manjaro": PACMAN,
}


class Needs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def bash(self, system, command, has_root=True):
        """(exit status, what is said) of a command on a system, where apt-get is only printed."""
        self.folder.joinpath("os-release").write_text(SYSTEMS[system], encoding="utf-8")
        script = f"""
            set -euo pipefail
            say() {{ printf 'motus: %s\\n' "$*"; }}
            fail() {{ say "$@"; exit 1; }}
            logged() {{ "${{@:2}}"; }}
            here='{CI.parent}' cache='{self.folder}'
            source {CI}/needs.sh
            source {CI}/choose_blender.sh
            source {CI}/platforms.sh
            os_release='{self.folder}/os-release'
            as_root() {{ {'[[ $1 == true ]] || echo "as root: $*"' if has_root else 'return 1'}; }}
            {command}
        """
        done = subprocess.run(["bash", "-c", script], text=True, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def test_elsewhere_one_line_says_what_to_install(self):
        for system, line in LINES.items():
            with self.subTest(system):
                status, said = self.bash(system, f"need {WANTED}; echo went on")
                self.assertEqual(status, 1)
                self.assertEqual(said, f"motus: this system lacks what Motus needs here; install it with: {line}\n")

    def test_an_unknown_system_goes_by_what_it_has(self):
        for program, line in (("apt-get", APT), ("dnf", DNF), ("pacman", PACMAN)):
            found = f'command() {{ [[ $2 == {program} ]]; }}'
            self.assertIn(line, self.bash("slackware", f"{found}; need {WANTED}")[1])
        said = self.bash("slackware", f"command() {{ false; }}; need {WANTED}")[1]
        self.assertIn("by your system's names for what Debian calls g++ libglm-dev", said)

    def test_debian_installs_what_is_missing(self):
        for system in ("bookworm", "trixie"):
            status, said = self.bash(system, f"need {WANTED} bash:bash; echo went on")
            self.assertEqual(status, 0, said)
            self.assertIn(
                "apt-get -o DPkg::Lock::Timeout=600 install -y -q --no-install-recommends g++ libglm-dev catch2 clang-format clang-tidy\n",
                said,
            )
            self.assertIn("went on", said)

    def test_two_clones_install_one_after_the_other(self):
        """The second finds what the first has installed."""
        there, log = self.folder / "there", self.folder / "log"
        command = f"""
            as_root() {{ [[ $1 == true ]] || echo "$*" >>'{log}'; [[ $* != *' install '* ]] || {{ sleep 1; touch '{there}'; }}; }}
            need 'g++:{there}'
        """
        with concurrent.futures.ThreadPoolExecutor() as pool:
            both = list(pool.map(lambda _: self.bash("bookworm", command), range(2)))
        self.assertEqual([status for status, _ in both], [0, 0], both)
        self.assertEqual(log.read_text(encoding="utf-8").count(" install "), 1)

    def test_two_clones_make_a_system_once(self):
        """While the first is in the midst of it, the second comes."""
        programs, roots, log = (self.folder / name for name in ("programs", "roots", "log"))
        programs.mkdir()
        making = f"""#!/bin/bash
            echo made >>'{log}'
            for _ in {{1..20}}; do [[ $(wc -l <'{log}') == 1 ]] || exit 9; sleep 0.1; done
            mkdir "${{@: -1}}/tmp"
        """
        for name, text in {"debootstrap": making, **dict.fromkeys(("mount", "umount", "chroot", "cp"), "#!/bin/sh\n")}.items():
            (programs / name).write_text(text, encoding="utf-8")
            (programs / name).chmod(0o755)
        environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
        command = ["bash", CI / "roots.sh", "--inside", roots, "sid"]
        with concurrent.futures.ThreadPoolExecutor() as pool:
            both = list(pool.map(lambda _: subprocess.run(command, env=environment, check=False, capture_output=True, text=True), range(2)))
        self.assertEqual([done.returncode for done in both], [0, 0], both)
        self.assertEqual(log.read_text(encoding="utf-8"), "made\n")

    def test_debian_without_root_says_what_to_install(self):
        status, said = self.bash("trixie", f"need {WANTED}", has_root=False)
        self.assertEqual((status, said), (1, f"motus: this system lacks what Motus needs here; install it with: {APT}\n"))

    def test_what_is_there_is_not_asked_for(self):
        command = f"need 'a:no-such|bash' 'b:/no/such|{CI}/need*.sh' c:bash; echo went on"
        self.assertEqual(self.bash("fedora", command), (0, "went on\n"))

    def test_what_can_be_done_without_is_not_asked_for_elsewhere(self):
        self.assertEqual(self.bash("fedora", f"wish {WANTED}; echo went on"), (0, "went on\n"))
        status, said = self.bash("trixie", f"wish {WANTED} || echo does without", has_root=False)
        self.assertEqual(status, 0)
        self.assertIn("does without", said)

    def test_packaging_for_other_systems_installs_what_it_can(self):
        """Wherever Debian's names are known; each platform says itself what it cannot be built without."""
        command = (
            "pinned() { echo it went on; return 1; }; build_needs=(); platform_needs=(maven:no-such-program); package_platforms linux-x64"
        )
        for system in ("bookworm", "trixie"):
            with self.subTest(system):
                self.assertRegex(self.bash(system, command)[1], "(?s)apt-get .*install .*maven\n.*it went on")
                self.assertRegex(self.bash(system, command, has_root=False)[1], "(?s)sudo apt-get install maven\n.*it went on")
        self.assertTrue(self.bash("fedora", command)[1].startswith("it went on"))

    def test_a_system_needs_no_second_one_of_its_kind(self):
        for system, made in {"bookworm": "trixie sid ", "trixie": "sid ", "ubuntu": "trixie sid "}.items():
            with self.subTest(system):
                self.assertEqual(self.bash(system, 'make_root() { printf "%s " "$1"; }; make_roots'), (0, made))

    def test_a_preset_is_skipped_that_lacks_a_compiler(self):
        """On any system, by what is there once it has been tried to install it."""
        lacking = "preset_needs[odd]='odd-compiler:no-such-program bash:bash'; has_preset odd"
        for system in SYSTEMS:
            with self.subTest(system):
                status, said = self.bash(system, lacking)
                self.assertEqual(
                    (status, said.splitlines()[-1]), (1, "motus: SKIPPED: the preset odd lacks what Debian calls odd-compiler")
                )
                self.assertEqual("installing by apt-get" in said, system in {"bookworm", "trixie"})
                self.assertEqual(self.bash(system, "has_preset release; echo built"), (0, "built\n"))

    def test_a_preset_is_skipped_that_this_processor_cannot_run(self):
        loader = self.folder / "loader"
        loader.write_text("#!/bin/sh\necho '  x86-64-v4'\necho '  x86-64-v3 (supported, searched)'\n", encoding="utf-8")
        loader.chmod(0o755)
        ask = f"loader='{loader}'; has_preset "
        self.assertEqual(self.bash("bookworm", ask + "x86-64-v3 && echo built"), (0, "built\n"))
        refusal = "motus: SKIPPED: this processor cannot run programs for x86-64-v4\n"
        self.assertEqual(self.bash("bookworm", ask + "x86-64-v4"), (1, refusal))
        self.assertEqual(self.bash("bookworm", "loader=/no/such/file; has_preset x86-64-v4"), (1, refusal))

    def test_what_blender_draws_with_comes_with_it(self):
        """Debian's package of Blender 4.3 asks for none of it, and ends by a signal where it is to render."""
        for needs in ("blender_needs", "official_needs", "test_needs"):
            for package in ("libegl1", "libgl1", "libgl1-mesa-dri"):
                with self.subTest(needs, package=package):
                    said = self.bash("trixie", f'is_there() {{ false; }}; need "${{{needs}[@]}}"')[1]
                    self.assertRegex(said, f"apt-get .*install .* {package}( |$)")
        self.assertIn("libegl1", self.bash("trixie", 'is_there() { false; }; default_blender() { echo chosen; }; drawing_blender')[1])

    def test_every_need_has_a_name_everywhere(self):
        """Names that only Debian has would be no help."""
        command = 'for pair in "${build_needs[@]}" "${test_needs[@]}" "${official_needs[@]}" "${lint_needs[@]}"; do install_line "${pair%%:*}"; done'
        for system in ("fedora", "arch"):
            for line in self.bash(system, command)[1].splitlines():
                self.assertNotRegex(line, r"-dev$|(?<!gcc-c)\+\+$|python3-venv|lib\w+\d$")
