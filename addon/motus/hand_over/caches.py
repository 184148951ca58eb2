"""Caches of moving points: files in the PC2 format beside the .blend, which Blender's Mesh Cache modifier reads with its own means."""

import re
import struct

import bpy

from ..core.lazy import numpy as np

SHARE = 5e-4
"""Largest error between two samples of a cache, as a share of the extent of the motion, by which samples are left out."""
_HEADER = "<12siiffi"


class Folder:
    """Folder of the caches of one handed-over file.

    path: pathlib.Path in which they are written. name: of the folder beside the file, by which the file finds them.
    """

    def __init__(self, path, name):
        self.path, self.name, self._made = path, name, set()

    def add(self, obj, label, samples, times, per_frame, is_there):
        """Write a cache and give an object the Mesh Cache modifier that reads it. Samples between which Blender finds those left out stay.

        label: says what is in the cache. samples: (n, points, 3), evenly spaced in time. times: of the samples, in the keys' time. per_frame:
        number of samples in a frame. is_there: (n, points), where points matter; None for everywhere.
        """
        stride = _stride(samples, per_frame, is_there)
        samples, times = samples[::stride], times[::stride]
        self.path.mkdir(exist_ok=True)
        file = self._free(re.sub(r"[^\w\-]+", "_", label)) + ".pc2"
        step = times[1] - times[0]
        with open(self.path / file, "wb") as written:
            written.write(struct.pack(_HEADER, b"POINTCACHE2\0", 1, samples.shape[1], times[0], step, len(samples)))
            written.writelines(np.ascontiguousarray(sample, "<f4").tobytes() for sample in samples)
        modifier = obj.modifiers.new("Mesh Cache", 'MESH_CACHE')
        modifier.cache_format, modifier.filepath = 'PC2', f"//{self.name}/{file}"
        # The index of a sample is the frame times the scale, minus the start.
        modifier.frame_scale, modifier.frame_start = 1.0 / step, times[0] / step

    def read_where_written(self):
        """Let the modifiers read the caches where they are now, before the folder gets its name."""
        for obj in bpy.data.objects:
            for modifier in obj.modifiers:
                if modifier.type == 'MESH_CACHE' and modifier.filepath.startswith(f"//{self.name}/"):
                    modifier.filepath = str(self.path / modifier.filepath.rpartition("/")[2])

    def _free(self, name):
        found, number = name, 1
        while found.lower() in self._made:
            found, number = f"{name}_{number}", number + 1
        self._made.add(found.lower())
        return found


def _stride(samples, per_frame, is_there):
    """Largest distance of samples, a divisor of `per_frame`, at which straight lines between them are near enough to those left out.

    samples: (n, points, 3). per_frame: number of samples in a frame. is_there: (n, points), where points are to be looked at; None for all.
    """
    error = SHARE * float(np.ptp(samples.reshape(-1, 3), axis=0).max(initial=0.0))
    for found in (one for one in range(per_frame, 1, -1) if per_frame % one == 0):
        if (len(samples) - 1) % found == 0 and _is_near(samples, found, error, is_there):
            return found
    return 1


def _is_near(samples, stride, error, is_there):
    first, last = samples[:-1:stride], samples[stride::stride]
    known = True if is_there is None else is_there[:-1:stride] & is_there[stride::stride]
    for part in range(1, stride):
        off = np.abs(first + (last - first) * (part / stride) - samples[part::stride]).max(axis=2)
        if np.where(known, off, 0.0).max(initial=0.0) > error:
            return False
    return True
