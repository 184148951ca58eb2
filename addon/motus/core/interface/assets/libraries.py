"""The user's asset libraries: an asset is written into one as a small file, which never takes the place of another."""

from pathlib import Path

import bpy

from ...refusals import Refused
from ...translations import tr

FOLDER = "Motus"
"""Folder of a library that has the files with assets."""


def folder_of(context, name):
    """Folder of the user's asset library of this name. Raises Refused if there is no such library, or if its folder is gone."""
    library = context.preferences.filepaths.asset_libraries.get(name)
    if library is None:
        raise Refused(tr("There is no asset library {library}").format(library=name))
    folder = Path(bpy.path.abspath(library.path))
    if not library.path or not folder.is_dir():
        raise Refused(tr("The asset library {library} has no folder: {folder}").format(library=name, folder=library.path))
    return folder


def claim(folder, name):
    """Make an empty file for an asset in a library; returns its path. Raises Refused if such a file exists, or cannot be made.

    folder: of the library. name: of the asset.
    """
    path = folder / FOLDER / f"{bpy.path.clean_name(name)}.blend"
    try:
        path.parent.mkdir(exist_ok=True)
        path.open("xb").close()
    except FileExistsError as error:
        raise Refused(tr("{file} exists already: choose a different name").format(file=error.filename)) from None
    except OSError as error:
        _refuse(error)
    return path


def write(holder, path):
    """Write an asset into its file, or remove the file and raise Refused. holder: object that is the asset. path: from claim()."""
    try:
        bpy.data.libraries.write(str(path), {holder}, fake_user=True, compress=True)
    except (OSError, RuntimeError) as error:
        path.unlink()
        _refuse(error)


def _refuse(error):
    raise Refused(tr("The asset library cannot be written to: {reason}").format(reason=str(error).strip())) from None


def show_new(context):
    """Have Blender read the asset libraries again in the asset browsers and viewports of all windows, since a file has come."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type not in {'FILE_BROWSER', 'VIEW_3D'}:
                continue
            with context.temp_override(window=window, area=area):
                if bpy.ops.asset.library_refresh.poll():  # type: ignore[call-arg]
                    bpy.ops.asset.library_refresh()
