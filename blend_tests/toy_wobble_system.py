"""Wobble: noise on an object's own location. The small whole system along which docs/systems.md tells how to write one."""

import bpy

import support

core = support.addon("core")
interface, declared, ANIMATED = core.interface, core.settings.declared, core.settings.ANIMATED


# 1. Settings
class WobbleKeywords:
    amount: declared.number("Amount", "Greatest distance along each axis", 0.1, ANIMATED, min=0.0, max=1e4, subtype='DISTANCE')
    frequency: declared.number("Frequency", "Waves a second, in Hz", 1.0, tells_no_keys=True, min=0.0, max=1e3)
    seed: declared.whole("Seed", "Seed of the random values: each number gives a different motion", 0, min=0, max=1 << 30)
    influence: declared.factor("Influence", "Fraction of the wobble that moves the object", 1.0, ANIMATED)


class MOTUS_PG_wobble(WobbleKeywords, core.settings.SystemSettings, bpy.types.PropertyGroup):
    pass


ROWS = interface.rows.Rows(tuple(WobbleKeywords.__annotations__))
# 2. Solve
NO_AMOUNT = core.declare.Problem("The wobble has no amount", blocking=False)


def solve(context, amount, frequency, seed, influence):
    waves = context.frame / context.fps * frequency
    context.locations[0] = [influence * amount * core.native.module.noise1(waves, 3 * seed + axis) for axis in range(3)]
    return NO_AMOUNT if amount == 0.0 else core.declare.OK


# 3. Operators
class OfWobble(interface.operators.OfAnObject):
    object: interface.operators.object_keyword("Name of the object; empty takes the active one")
    modes = interface.operators.OBJECT_MODE
    needs_wobble = False

    @classmethod
    def found(cls, context, name):
        owner = interface.operators.named_or_active(context, name)
        core.refusals.check_local(owner)
        core.refusals.check_unbaked(owner, owner.motus.wobble)
        if cls.needs_wobble and not owner.motus.wobble.is_active:
            raise core.refusals.Refused(core.translations.tr("{object} does not wobble").format(object=owner.name))
        return owner


class MOTUS_OT_wobble_add(OfWobble, WobbleKeywords, bpy.types.Operator):
    bl_idname, bl_label, bl_description = "motus.wobble_add", "Wobble", "Add noise to the object's location"
    redo = (ROWS,)

    def run(self, context):
        owner = self.found(context, self.object)
        core.refusals.check_finite(self, ROWS.names)
        for name in ROWS.names:
            setattr(owner.motus.wobble, name, getattr(self, name))
        core.wiring.attach(SYSTEM, owner)


class MOTUS_OT_wobble_remove(OfWobble, bpy.types.Operator):
    bl_idname, bl_label, bl_description = "motus.wobble_remove", "Remove Wobble", "Leave the object at its own location"
    needs_wobble = True

    def run(self, context):
        owner = self.found(context, self.object)
        core.wiring.detach(SYSTEM, owner)
        core.blender.actions.remove(owner, ("motus.wobble.",))
        core.declare.forgetting.forget(SYSTEM, owner)


# 4. Panel
def draw(layout, context):
    interface.ui.draw_problem(layout, context, SYSTEM, context.object)
    ROWS.draw(interface.ui.split(layout), context.object.motus.wobble)


def draw_actions(layout, context):
    interface.ui.draw_bake(layout)
    layout.operator("motus.wobble_remove", text="Remove", icon='X').object = context.object.name


PANEL = interface.panels.SystemPanel(
    name="wobble",
    prefix="MOTUS_PT_wobble",
    label="Wobble",
    editors={"": interface.ui.Sidebar, "_constraint": interface.ui.ObjectConstraints},
    suits=lambda obj: True,
    is_used=lambda obj: obj.motus.wobble.is_active,
    draw=draw,
    actions=draw_actions,
    refresh=interface.panels.REFRESH,
    adders=("motus.wobble_add",),
)
# 5. System
SYSTEM = core.declare.System(
    name="wobble",
    label="Wobble",
    settings=MOTUS_PG_wobble,
    classes=(MOTUS_PG_wobble, MOTUS_OT_wobble_add, MOTUS_OT_wobble_remove, *interface.panels.classes(PANEL)),
    inputs=tuple(map(core.declare.Setting, ROWS.names)),
    solve=solve,
    problems=(NO_AMOUNT,),
    channels=lambda settings: frozenset({"location"}),
    is_relative=True,
    object_menu=("motus.wobble_add", "motus.wobble_remove"),
)
# 6. Spanish
INTERFACE = {
    "Wobble": "Bamboleo",
    "Greatest distance along each axis": "Mayor distancia en cada eje",
    f"Waves a second, in Hz{core.settings.NO_KEYS}": "Ondas por segundo, en Hz. No admite claves: todo el movimiento depende de ello",
    "Fraction of the wobble that moves the object": "Fracción del bamboleo que mueve el objeto",
    "Add noise to the object's location": "Suma ruido a la posición del objeto",
    "Leave the object at its own location": "Deja el objeto en su propia posición",
    "{object} does not wobble": "{object} no se bambolea",
    "The wobble has no amount": "El bamboleo no tiene cantidad",
}
OPERATORS = {"Wobble": "Bambolear", "Remove Wobble": "Quitar el bamboleo"}
