"""Shapes of bodies and of the fixed world, each drawn about the origin of its body. Lengths in m."""

from __future__ import annotations

from typing import Union

from numpy.typing import ArrayLike

from tumble import _core
from tumble._core import Shape

Angle = Union[float, str]
"""Radians, or text like "30 deg"."""

Shape.__doc__ = """The shape of a body or of a part of one; made by `square`, `polygon`, `disc` and the like, and constant.

Attributes
----------
area : float
    [m^2]; 0 for segments, half-planes and terrain.
centroid : tuple of float
    (x, y) [m].
polar_moment : float
    Integral of the squared distance from the centroid over the area [m^4]. Times density it is the moment of inertia.

Methods
-------
moved(position=(0, 0), angle=0)
    The same shape turned by `angle` [rad or "30 deg"] about the origin and then moved by `position` [m].
asdict()
    Its kind ("polygon", "ellipse", "half_plane", "terrain") and numbers. A polygon has `vertices` and `rounding`: all
    points within `rounding` of the convex hull of the vertices, so that a disc has one vertex and a capsule two.
"""


def square(side: float, *, rounding: float = 0.0) -> Shape:
    """A square.

    Parameters
    ----------
    side : float
        [m], 1e-12 to 1e12.
    rounding : float
        Radius of the corners [m], up to half of the side.

    Raises
    ------
    ValueError
        Naming the argument, its value and the allowed range. So do all functions here.

    >>> square(0.2)
    <Shape: polygon of 4 corners>
    >>> round(square(0.2).area, 12)
    0.04
    """
    return _core.square(side, rounding)


def rectangle(width: float, height: float, *, rounding: float = 0.0) -> Shape:
    """A rectangle; `width` along x, `height` along y, `rounding` the radius of its corners [m]. Sizes are outer ones."""
    return _core.rectangle(width, height, rounding)


def regular_polygon(corners: int, circumradius: float, *, rounding: float = 0.0) -> Shape:
    """A regular polygon of 3 to 1000 corners, the lowest side level.

    Its corners reach to `circumradius` [m], `rounding` [m] included. In scene files this is ``regular``.
    """
    return _core.regular_polygon(corners, circumradius, rounding)


def polygon(vertices: ArrayLike, *, rounding: float = 0.0) -> Shape:
    """A convex polygon.

    Parameters
    ----------
    vertices : array_like, shape (n, 2)
        Counter-clockwise [m], up to 1000. No vertex may lie on the line through its neighbours.
    rounding : float
        What the polygon grows by on all sides [m].

    Raises
    ------
    ValueError
        For vertices in clockwise order or a corner that points inwards, naming it: write a concave body as several
        convex parts.

    >>> triangle = polygon([(0, 0), (0.3, 0), (0, 0.3)])
    >>> round(triangle.area, 12)
    0.045
    """
    return _core.polygon(vertices, rounding)


def disc(radius: float) -> Shape:
    """A disc of this radius [m]."""
    return _core.disc(radius)


def ellipse(semi_axis_x: float, semi_axis_y: float) -> Shape:
    """An ellipse with these semi-axes [m], at most 1 : 1e6."""
    return _core.ellipse(semi_axis_x, semi_axis_y)


def capsule(length: float, radius: float) -> Shape:
    """The points within `radius` of a line along x; `length` is that between the centres of its ends [m]."""
    return _core.capsule(length, radius)


def segment(start: ArrayLike, end: ArrayLike) -> Shape:
    """A wall without thickness between two points (x, y) [m]."""
    return _core.segment(start, end)


def half_plane(normal: ArrayLike = (0.0, 1.0), offset: float = 0.0) -> Shape:
    """Ground without end, for fixed bodies.

    Parameters
    ----------
    normal : array_like, shape (2,)
        Out of the solid; any length but 0. (0, 1) is level ground.
    offset : float
        Solid is where normal . p <= offset, for the normal of length 1 [m].
    """
    return _core.half_plane(normal, offset)


def terrain(points: ArrayLike) -> Shape:
    """Ground along a polyline, for fixed and kinematic bodies.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        [m], 2 to 100 000. The ground is to the right: below, for points from left to right. Its edges must not cross;
        this is not checked.
    """
    return _core.terrain(points)
