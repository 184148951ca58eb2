"""A release is made of a committed state whose changelog tells of it, for all platforms, with checksums and notes."""

import hashlib
import subprocess
import tempfile
import unittest
from pathlib import Path

import platforms
import release

CHANGELOG = """# Changelog

## [0.2.0] - {date}

### Added
- Something new.

## [0.1.0] - 2020-01-02

### Added
- Everything.
"""


class Release(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.clone = self.folder / "clone"
        subprocess.run(["git", "init", "--quiet", self.clone], check=True)
        self.commit("CHANGELOG.md", CHANGELOG.format(date="2021-03-04"))

    def git(self, *arguments):
        identity = ("-c", "user.name=Somebody", "-c", "user.email=somebody@example.org")
        return subprocess.run(["git", "-C", self.clone, *identity, *arguments], check=True, text=True, capture_output=True).stdout.strip()

    def commit(self, name, text):
        (self.clone / name).write_text(text, encoding="utf-8")
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "A state")

    def refusals(self, version="0.2.0"):
        return list(release.refusals(self.clone, version))

    def packages(self, *but):
        """A folder with all that is packaged, stand-ins as they are."""
        source = self.folder / "packages"
        source.mkdir()
        for platform in platforms.PLATFORMS.values():
            for name in release.files_of(platform, "0.2.0"):
                if name not in but:
                    (source / name).write_text(f"content of {name}", encoding="utf-8")
        return source

    def test_a_committed_and_dated_state_is_released(self):
        self.assertEqual(self.refusals(), [])

    def test_changed_and_new_files_are_named(self):
        (self.clone / "new.txt").write_text("new", encoding="utf-8")
        (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format(date="2021-03-05"), encoding="utf-8")
        self.assertEqual(self.refusals(), ["there are changes that are not committed: CHANGELOG.md, new.txt"])

    def test_a_version_without_a_section_is_refused(self):
        self.assertEqual(self.refusals("0.3.0"), ["CHANGELOG.md has no section of version 0.3.0, or an empty one"])
        self.commit("CHANGELOG.md", "## [0.3.0] - 2021-03-04\n\n## [0.2.0] - 2021-03-04\n\n- Something.\n")
        self.assertEqual(self.refusals("0.3.0"), ["CHANGELOG.md has no section of version 0.3.0, or an empty one"])
        # A part of the number is another version.
        self.assertEqual(len(self.refusals("0.2")), 1)

    def test_a_section_without_a_date_is_refused(self):
        self.commit("CHANGELOG.md", CHANGELOG.format(date="unreleased"))
        self.assertEqual(self.refusals(), ["the heading of version 0.2.0 in CHANGELOG.md has no date, but says unreleased"])

    def test_a_version_is_released_once(self):
        self.git("tag", "v0.2.0")
        self.assertEqual(self.refusals(), [])
        self.commit("more.txt", "more")
        (sentence,) = self.refusals()
        self.assertRegex(sentence, r"^v0\.2\.0 was released already, from commit [0-9a-f]{8}: raise the version")

    def test_all_platforms_with_checksums_and_notes(self):
        dist = self.folder / "release" / "0.2.0"
        source = self.packages()
        for _ in range(2):  # the second time over the first
            release.write(self.clone, "0.2.0", source, dist)
        names = sorted(path.name for path in dist.iterdir())
        self.assertEqual(names, sorted([*(path.name for path in source.iterdir()), release.NOTES, release.SUMS]))
        self.assertEqual(len(names), 4 * 4 + 2)
        done = subprocess.run(["sha256sum", "--check", "--strict", release.SUMS], cwd=dist, check=False, text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stdout.count(": OK")), (0, 17), done)
        self.assertIn(
            f"{hashlib.sha256((dist / release.NOTES).read_bytes()).hexdigest()}  {release.NOTES}\n", (dist / release.SUMS).read_text()
        )
        self.assertEqual([path.name for path in dist.parent.iterdir()], ["0.2.0"])

    def test_notes_tell_what_has_changed_and_which_file_to_take(self):
        dist = self.folder / "release" / "0.2.0"
        release.write(self.clone, "0.2.0", self.packages(), dist)
        notes = (dist / release.NOTES).read_text(encoding="utf-8")
        self.assertTrue(notes.startswith("# Motus 0.2.0\n\n2021-03-04\n\n### Added\n- Something new.\n\n## Which file\n"), notes)
        self.assertNotIn("Everything.", notes)
        self.assertIn("| `motus-0.2.0-windows_x64.zip` | Blender 4.2 and later, Windows, x86-64 |\n", notes)
        self.assertIn(f"commit {self.git('rev-parse', 'HEAD')}", notes)

    def test_a_file_that_was_not_made_is_named_and_nothing_is_left(self):
        source = self.packages("motus-0.2.0-macos_x64.zip")
        with self.assertRaisesRegex(SystemExit, r"these files were not made: motus-0\.2\.0-macos_x64\.zip$"):
            release.write(self.clone, "0.2.0", source, self.folder / "release" / "0.2.0")
        self.assertFalse((self.folder / "release").exists())
