"""Draw lines, shaded areas and text in pixels, with shaders that every Blender from 3.4 on has."""

from ...blender import capabilities
from ...lazy import numpy as np

TEXT_SIZE = 11.0


def flat(points):
    """Convert points (n, 2) to the form that shaders take, (n, 3) float32 with z = 0."""
    points = np.asarray(points, np.float32)
    return np.concatenate([points, np.zeros((len(points), 1), np.float32)], axis=1)


def project(matrix, points):
    """Project world points (n, 3) into a region, (n, 2) from -1 to 1; None if a point is behind the viewer or there are none.

    matrix: perspective matrix of the view (RegionView3D.perspective_matrix).
    """
    matrix = np.array(matrix)
    clipped = points @ matrix[:, :3].T + matrix[:, 3]
    if len(clipped) == 0 or clipped[:, 3].min() <= 1e-6:
        return None
    return clipped[:, :2] / clipped[:, 3:4]


def to_window(region, matrix, points):
    """Project world points (n, 3) to pixels of the window, (n, 2); None if a point is behind the viewer or there are none.

    region: the region that shows the view. matrix: perspective matrix of the view (RegionView3D.perspective_matrix).
    """
    places = project(matrix, points)
    if places is None:
        return None
    return (places + 1.0) * (region.width / 2.0, region.height / 2.0) + (region.x, region.y)


def line(points, color, width):
    """Draw a line through points (n, 2), in pixels. color: (r, g, b, a). width: in pixels."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin(capabilities.line_shader(True))
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", width)
    shader.uniform_float("color", color)
    batch_for_shader(shader, 'LINE_STRIP', {"pos": flat(points)}).draw(shader)


def triangles(points, colors, indices):
    """Draw shaded triangles between points (n, 2), in pixels. colors: (n, 4). indices: of the triangles' points, (t, 3)."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    content = {"pos": flat(points), "color": np.asarray(colors, np.float32)}
    batch_for_shader(shader, 'TRIS', content, indices=np.asarray(indices, np.int32)).draw(shader)


def discs(points, radii, colors, corners=16):
    """Draw discs around points (n, 2), in pixels. radii: (n,) in pixels. colors: (n, 4). corners: of a disc's polygon."""
    angles = np.linspace(0.0, 2.0 * np.pi, corners, endpoint=False)
    rim = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    places = (np.asarray(points)[:, None, :] + np.asarray(radii)[:, None, None] * rim).reshape(-1, 2)
    fan = np.array([(0, corner, corner + 1) for corner in range(1, corners - 1)])
    indices = (corners * np.arange(len(points))[:, None, None] + fan).reshape(-1, 3)
    triangles(places, np.repeat(colors, corners, axis=0), indices)


def rectangle(low, high, color):
    """Draw a filled rectangle between two corners, (x, y) in pixels. color: (r, g, b, a)."""
    points = [low, (high[0], low[1]), high, (low[0], high[1])]
    triangles(points, [color] * 4, [(0, 1, 2), (0, 2, 3)])


def dots(points, colors, size):
    """Draw squares around points (n, 2), in pixels. colors: (n, 4). size: side of a square in pixels."""
    half = size / 2.0
    corners = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
    first = 4 * np.arange(len(points))[:, None]
    triangles(
        (np.asarray(points)[:, None, :] + corners).reshape(-1, 2),
        np.repeat(colors, 4, axis=0),
        np.concatenate([first + (0, 1, 2), first + (0, 2, 3)]),
    )


def text(lines, x, y, scale):
    """Draw lines of text below one another, from pixel (x, y) of the region on. scale: of the interface."""
    import blf

    font = 0
    size = TEXT_SIZE * scale
    blf.size(font, size)
    blf.enable(font, blf.SHADOW)
    blf.shadow(font, 3, 0.0, 0.0, 0.0, 0.8)
    blf.color(font, 1.0, 1.0, 1.0, 1.0)
    for index, content in enumerate(lines):
        blf.position(font, x, y - index * 1.4 * size, 0.0)
        blf.draw(font, content)
    blf.disable(font, blf.SHADOW)


def width(content, scale):
    """Width in pixels of one line of text that text() draws. scale: of the interface."""
    import blf

    blf.size(0, TEXT_SIZE * scale)
    return blf.dimensions(0, content)[0]
