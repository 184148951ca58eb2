"""Panel of snow, in the sidebar and in the object's constraint properties; shown for emitters."""

from ..core.file.pointers import pointed
from ..core.interface import panels, ui
from ..core.interface.tracks import panel as track_panel
from ..core.translations import tr
from . import births, colliders, flakes, landings, presets, rows, solve
from .build import is_emitter, system


def draw_main(layout, context):
    """Draw the emitter's problem if there is one, the menu of presets, and the settings of how many flakes are emitted."""
    emitter = context.object
    ui.draw_problem(layout, context, system(), emitter)
    button = layout.row()
    kind = presets.kind_of(emitter.motus.snow)
    label = {"text": kind, "text_ctxt": "*"} if kind else {}
    button.operator_menu_enum("motus.snow_preset", "preset", icon='PRESET', **label)
    rows.EMISSION.draw(ui.split(layout), emitter.motus.snow)
    if emitter.animation_data is not None:
        rate = births.rate_track(emitter)
        if not rate.is_constant:
            track_panel.draw(layout, rate, datablock=emitter.name, data_path=births.RATE, index=-1)


def draw_loop(layout, context):
    """Draw the frames over which the snowfall repeats, and the button that sets them to the scene's."""
    rows.LOOP.draw(ui.split(layout), context.object.motus.snow)
    layout.operator("motus.snow_loop", icon='FILE_REFRESH').object = context.object.name


def _draw_loop_switch(layout, context):
    layout.prop(context.object.motus.snow, "use_loop", text="")


def draw_emitter(layout, context):
    """Draw the settings of where flakes are born, and how the motion of the emitter, mesh or camera is known."""
    emitter = context.object
    settings = emitter.motus.snow
    column = ui.split(layout)
    for group in (rows.SHAPE, rows.SOURCE, rows.EXTENT):
        group.draw(column, settings)
    source = solve.source(emitter)
    if source is None:
        return
    moved = births.track(source, context.scene)
    if not moved.is_known or moved.extent is not None:
        track_panel.draw(layout, moved, datablock=source.name)


def draw_random(layout, context):
    """Draw the settings that vary flakes at random: speed, orientation, lifetime, size, colour, and the seed."""
    rows.RANDOM.draw(ui.split(layout), context.object.motus.snow)


def draw_steering(layout, context):
    """Draw the settings of how flakes steer and tumble as they fall."""
    rows.STEERING.draw(ui.split(layout), context.object.motus.snow)


def _draw_steering_switch(layout, context):
    layout.prop(context.object.motus.snow, "use_steering", text="")


def draw_air(layout, context):
    """Draw the settings of gravity, air drag, wind and turbulence, and how an animated wind is known."""
    emitter = context.object
    rows.AIR.draw(ui.split(layout), emitter.motus.snow)
    if emitter.motus.snow.drag > 0.0 and emitter.animation_data is not None:
        moved = [(axis, one) for axis, one in enumerate(births.wind_tracks(emitter)) if not one.is_constant]
        # One axis is drawn: an axis whose motion is not known comes first, since the artist has to record it.
        for axis, one in sorted(moved, key=lambda pair: pair[1].is_known)[:1]:
            track_panel.draw(layout, one, datablock=emitter.name, data_path=births.WIND, index=axis)


def draw_landing(layout, context):
    """Draw the colliders that flakes land on, the button that records them, and the behavior of landed flakes."""
    emitter = context.object
    settings = emitter.motus.snow
    column = ui.split(layout)
    rows.COLLIDERS.draw(column, settings)
    for entry in settings.more_colliders:
        if pointed(entry, "object") is not None:
            column.prop(entry, "object")
    if pointed(settings, "recorded") is not None:
        ui.draw_message(layout, tr("As they were on frame {frame}").format(frame=f"{settings.recorded_frame:g}"), 'REC')
        layout.operator("motus.snow_colliders_clear", icon='X').object = emitter.name
    elif colliders.are_any(settings):
        layout.operator("motus.snow_colliders_record", icon='REC').object = emitter.name
    rows.LANDING.draw(ui.split(layout), settings)


def draw_flakes(layout, context):
    """Draw the settings of the flakes' look, and the gradient of their colours."""
    settings = context.object.motus.snow
    rows.FLAKES.draw(ui.split(layout), settings)
    layout.label(text="Gradient")
    column = layout.column(align=True)
    for index, stop in enumerate(settings.stops):
        row = column.row(align=True)
        row.prop(stop, "position", text="", slider=True)
        row.prop(stop, "color", text="")
        button = row.operator("motus.snow_stop_remove", text="", icon='X')
        button.object, button.index = context.object.name, index
    column.operator("motus.snow_stop_add", icon='ADD').object = context.object.name


def draw_readouts(layout, context):
    """Draw the largest number of flakes, their memory, and the progress of the search for landing places."""
    count = flakes.most(context.object.motus.snow)
    if not count < flakes.MOST:
        return
    found = [
        ui.Readout(text="Flakes at Most", value=f"{count:,.0f}"),
        ui.Readout(text="Memory", value=f"{count * flakes.BYTES / 2**20:,.1f} MB"),
    ]
    done = landings.done(context.object)
    if done is not None:
        found.append(ui.Readout(text="Landings Found", value=f"{100.0 * done:.0f} %"))
    ui.draw_readouts(layout, found)


def draw_actions(layout, context):
    """Draw the button that removes the snow."""
    layout.operator("motus.snow_remove", text="Remove", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the buttons that add snow: from an emitter, from the active mesh's faces, or in the active camera's view."""
    layout.operator_context = 'INVOKE_DEFAULT'
    column = layout.column(align=True)
    column.operator("motus.snow_add", icon='ADD')
    obj = context.object
    on_mesh, in_view = column.row(align=True), column.row(align=True)
    on_mesh.enabled = obj is not None and obj.type == 'MESH'
    on_mesh.operator("motus.snow_add", text="Emit from Surface", icon='ADD').surface = obj.name if on_mesh.enabled else ""
    in_view.enabled = obj is not None and obj.type == 'CAMERA'
    in_view.operator("motus.snow_add", text="Emit in Camera View", icon='ADD').camera = obj.name if in_view.enabled else ""


PANEL = panels.SystemPanel(
    name="snow",
    prefix="MOTUS_PT_snow",
    label="Snow",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=lambda obj: True,
    is_used=is_emitter,
    draw=draw_main,
    parts=(
        panels.Part("emitter", "Emitter", draw_emitter, is_open=True),
        panels.Part("steering", "Steering", draw_steering, is_open=True, draw_header=_draw_steering_switch),
        panels.Part("air", "Forces", draw_air),
        panels.Part("landing", "Collision", draw_landing),
        panels.Part("random", "Random", draw_random),
        panels.Part("loop", "Loop", draw_loop, draw_header=_draw_loop_switch),
        panels.Part("flakes", "Flakes", draw_flakes, is_open=True),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = panels.classes(PANEL)
