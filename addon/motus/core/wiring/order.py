"""Order proxies: how a driver waits for another object's deformed geometry.

A Follow Path constraint at influence 0 moves nothing, but makes Blender evaluate the curve's geometry before the
transform of the empty that carries it; a driver that declares that transform is then evaluated later still.
"""

import bpy

from ..system import Deformed


def proxy_for(system, settings):
    """The proxy of the curve that the system reads deformed, shared by all who read it; None without one."""
    names = [declared.of for declared in system.inputs if isinstance(declared, Deformed)]
    curve = getattr(settings, names[0]) if names else None
    if curve is None or curve.type != 'CURVE':
        return None
    name = f"Motus Order {curve.name}"
    for candidate in bpy.data.objects:
        if candidate.name.startswith(name) and candidate.library is None and _waits_for(candidate, curve):
            return candidate
    proxy = bpy.data.objects.new(name, None)
    constraint = proxy.constraints.new('FOLLOW_PATH')
    constraint.target = curve
    constraint.influence = 0.0
    return proxy


def release(settings):
    """Let go of the proxy; the last one to do so removes it."""
    proxy, settings.order_proxy = settings.order_proxy, None
    if proxy and proxy.users == 0:
        bpy.data.objects.remove(proxy)


def _waits_for(candidate, curve):
    return any(c.type == 'FOLLOW_PATH' and c.target == curve and c.influence == 0.0 for c in candidate.constraints)
