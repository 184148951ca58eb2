"""Operator that combines the pictures of a pair that was rendered: as an anaglyph or side by side, with the floating window."""

from pathlib import Path

import bpy

from ..core.interface.operators import object_keyword
from ..core.interface.over_frames import OverFrames
from ..core.interface.rows import Row, Rows, is_one_of
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import anaglyph, floating, targets

FORMATS = (
    ('ANAGLYPH', "Anaglyph", "One picture for coloured glasses, in the colours that are nearest to the pair through them"),
    ('SIDEBYSIDE', "Side by Side", "Both eyes in one image, the left eye's on the left"),
)
LINEAR_FILES = {".exr", ".hdr"}
"""Endings of files whose colours are linear; the colours of other files are sRGB."""
EYES = "left", "right"
"""Names that Blender gives to the views of both eyes."""


def glasses_keyword():
    """Declare the keyword that chooses the glasses of an anaglyph."""
    return bpy.props.EnumProperty(
        name="Glasses", description="Glasses through which the anaglyph is seen", items=anaglyph.GLASSES, default='RED_CYAN'
    )


def linear(encoded):
    """Linear colours of sRGB ones, (...) float64."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.0) + 0.055) / 1.055) ** 2.4)


def encoded(linear):
    """Colours in sRGB of linear ones from 0 on, (...) float64."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1.0 / 2.4) - 0.055)


def _read(path):
    """Linear colours of a picture's file, (height, width, 3), the bottom row first. Raises Refused if it cannot be read."""
    if not path.is_file():
        raise Refused(tr("There is no picture {file}: choose Pair as the Stereo Output, and render the animation").format(file=path))
    try:
        image = bpy.data.images.load(str(path))
    except RuntimeError as error:
        raise Refused(str(error)) from error
    try:
        image.colorspace_settings.name = 'Non-Color'
        width, height = image.size[0], image.size[1]  # type: ignore[index]
        pixels = np.empty(width * height * image.channels, np.float32)
        if len(pixels) == 0:
            raise Refused(tr("{object} cannot be read as a picture").format(object=path.name))
        image.pixels.foreach_get(pixels)
        values = pixels.reshape(height, width, image.channels).astype(float)
    finally:
        bpy.data.images.remove(image)
    colours = values[..., :3] if values.shape[2] > 2 else np.repeat(values[..., :1], 3, axis=2)
    return colours if path.suffix.lower() in LINEAR_FILES else linear(colours)


def _write(path, colours):
    """Write linear colours, (height, width, 3), clipped to [0, 1], the bottom row first, as a PNG file."""
    height, width, _ = colours.shape
    image = bpy.data.images.new(path.name, width, height)
    try:
        values = np.ones((height, width, 4), np.float32)
        values[..., :3] = encoded(np.clip(colours, 0.0, 1.0))
        image.pixels.foreach_set(values.ravel())
        image.filepath_raw, image.file_format = str(path), 'PNG'
        image.save()
    finally:
        bpy.data.images.remove(image)


def _paths(render, frame, kind):
    """Files of a frame: the left eye's picture, the right eye's, and the combined one."""
    left, right = (Path(bpy.path.abspath(render.frame_path(frame=frame, view=view))) for view in EYES)
    both = Path(bpy.path.abspath(render.frame_path(frame=frame)))
    return left, right, both.with_name(f"{both.stem}_{kind.lower()}.png")


class MOTUS_OT_stereo_combine(OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_combine"
    bl_label = "Combine Pair"
    bl_description = "Make one picture of each pair that was rendered, with the floating window of the camera"
    bl_options = {'REGISTER'}
    redo = (Rows(("format", Row("glasses", when=is_one_of("format", 'ANAGLYPH')))), *OverFrames.redo)

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")
    format: bpy.props.EnumProperty(name="Format", description="How the images are written", items=FORMATS, default='ANAGLYPH')
    glasses: glasses_keyword()

    @classmethod
    def check_offer(cls, context):
        targets.rig_for(context, "")

    def steps(self, context, frames):
        camera = targets.rig_for(context, self.object)
        self._written = []
        return self._walk(context, camera, sorted({round(frame) for frame in frames}))

    def _walk(self, context, camera, frames):
        for index, frame in enumerate(frames):
            *eyes, both = _paths(context.scene.render, frame, self.format)
            left, right = map(_read, eyes)
            if left.shape != right.shape:
                raise Refused(tr("The pictures of both eyes have different sizes on frame {frame}").format(frame=frame))
            left, right = floating.masked(left, right, *floating.at(context, camera, frame))
            is_anaglyph = self.format == 'ANAGLYPH'
            _write(both, anaglyph.combined(left, right, self.glasses) if is_anaglyph else np.concatenate((left, right), axis=1))
            self._written.append(both)
            yield index + 1

    def result(self, context):
        self.report({'INFO'}, tr("{count} pictures in {folder}").format(count=len(self._written), folder=self._written[0].parent))


classes = (MOTUS_OT_stereo_combine,)
