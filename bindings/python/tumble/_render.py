"""`render`: the trajectory as an animated loop in a window, in a notebook, or in a file. matplotlib is imported here only."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble._core import Parameters
from tumble._files import complete_file
from tumble._view import in_notebook

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

_ANIMATIONS = (".gif", ".mp4")
_PICTURES = (".png", ".svg", ".pdf")
_FRAMES_PER_SECOND = 25  # real time; GIF delays are whole hundredths of a second
_MAX_FRAMES = 2500  # 100 s; longer runs are shown faster than real time


def render(
    q: ArrayLike, params: Parameters | None = None, *, save: str | os.PathLike[str] | None = None
) -> Any:
    """Show the trajectory of the square as an animated loop (part 4).

    Parameters
    ----------
    q : array_like, shape (3, T)
        Poses (x, y, theta) [m, m, rad], a column each, as `simulate` returns them.
    params : Parameters, optional
        Uses l for the size of the square and dt for the pace. The document's values if left out.
    save : path, optional
        Write the picture here instead of showing it; works without a display. By its ending: .gif and .mp4 are
        animations in real time, .png, .svg and .pdf show many poses in one frame. An existing file is replaced, once
        the new one is complete.

    Returns
    -------
    None, Path or IPython.display.HTML
        With `save`, the path. In a notebook, the inline animation. In a window, None once it is closed. Without a
        display, the path of the GIF that was written instead, which is also printed.

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry, an unknown ending, or a file that cannot be written.
    """
    params = Parameters() if params is None else params
    poses = _as_poses(q)
    if save is not None:
        return _save(poses, params, Path(save))
    if in_notebook():
        from IPython.display import HTML

        animation, close = _animate(poses, params)
        html = HTML(animation.to_jshtml(fps=_FRAMES_PER_SECOND))
        close()
        return html
    if not _has_window():
        path = _save(poses, params, _free_name(Path("render.gif")))
        print(f"no window to show it in: the animation was saved as {path}")
        return path
    import matplotlib.pyplot as plt

    animation, close = _animate(poses, params)
    plt.show()
    close()
    return None


def _as_poses(q: ArrayLike) -> NDArray[np.float64]:
    if (masked := int(np.sum(np.ma.getmaskarray(q)))) > 0:  # type: ignore[no-untyped-call]
        raise ValueError(f"q: must have no masked entry, got {masked}")
    poses = np.asarray(q)
    if poses.dtype.kind not in "fiu":
        raise ValueError(f"q: must be an array of real numbers, got dtype {poses.dtype}")
    if poses.ndim != 2 or poses.shape[0] != 3 or poses.shape[1] == 0:
        raise ValueError(f"q: must have shape (3, T) with T >= 1, got {poses.shape}")
    if not np.isfinite(poses).all():
        row, column = np.argwhere(~np.isfinite(poses))[0]
        raise ValueError(f"q[{row}][{column}]: must be finite, got {poses[row, column]}")
    return poses.astype(np.float64)


def _has_window() -> bool:
    import matplotlib
    import matplotlib.pyplot as plt

    # pyplot has fallen back to a file-only backend if no display was found.
    backend = plt.get_backend().lower()
    return backend in {name.lower() for name in matplotlib.rcsetup.interactive_bk}


def _free_name(path: Path) -> Path:
    candidate, number = path, 2
    while candidate.exists():
        candidate = path.with_name(f"{path.stem}-{number}{path.suffix}")
        number += 1
    return candidate


def _save(poses: NDArray[np.float64], params: Parameters, path: Path) -> Path:
    ending = path.suffix.lower()
    if ending not in _ANIMATIONS + _PICTURES:
        raise ValueError(f"save: must end in {', '.join(_ANIMATIONS + _PICTURES)}, got {str(path)!r}")
    try:
        _write(poses, params, path)
    except OSError as error:  # a missing or read-only folder, a full disk
        raise ValueError(f"save: cannot write {str(path)!r}: {error.strerror or error}") from error
    except subprocess.CalledProcessError as error:  # ffmpeg, on a full disk for one
        raise ValueError(f"save: cannot write {str(path)!r}: ffmpeg failed ({error.returncode})") from error
    return path


def _write(poses: NDArray[np.float64], params: Parameters, path: Path) -> None:
    write = _write_animation if path.suffix.lower() in _ANIMATIONS else _write_picture
    with complete_file(path) as unfinished:
        write(poses, params, unfinished)


def _write_animation(poses: NDArray[np.float64], params: Parameters, path: Path) -> None:
    from matplotlib.animation import FFMpegWriter, PillowWriter

    if path.suffix.lower() == ".mp4" and not FFMpegWriter.isAvailable():
        raise ValueError("save: .mp4 needs the program ffmpeg; install it or save a .gif")
    animation, close = _animate(poses, params)
    writer = PillowWriter if path.suffix.lower() == ".gif" else FFMpegWriter
    animation.save(str(path), writer=writer(fps=_FRAMES_PER_SECOND))
    close()


def _write_picture(poses: NDArray[np.float64], params: Parameters, path: Path) -> None:
    from matplotlib.figure import Figure

    axes = Figure(figsize=(8, 5), layout="constrained").add_subplot()
    _set_view(axes, poses, params)
    shown = np.unique(np.linspace(0, poses.shape[1] - 1, 25).round().astype(int))
    for place, column in enumerate(shown):
        strength = 0.15 + 0.85 * (place + 1) / len(shown)
        axes.add_patch(_square(poses[:, column], params, alpha=strength, fill=False))
    axes.add_patch(_square(poses[:, -1], params))
    axes.plot(poses[0], poses[1], color="0.3", linewidth=0.8)
    axes.figure.savefig(path, dpi=150)


def _square(pose: NDArray[np.float64], params: Parameters, alpha: float = 1.0, fill: bool = True) -> Any:
    from matplotlib.patches import Polygon

    corners = _core.corner_positions(pose, params)
    return Polygon(corners, closed=True, alpha=alpha, facecolor="#9ec5e8" if fill else "none", edgecolor="#1f4e79")


def _set_view(axes: Axes, poses: NDArray[np.float64], params: Parameters) -> None:
    margin = params.l
    left, right = poses[0].min() - margin, poses[0].max() + margin
    bottom, top = min(0.0, poses[1].min() - margin), max(poses[1].max() + margin, margin)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom - 0.05 * (top - bottom), top)
    axes.set_aspect("equal", adjustable="datalim")
    axes.axhspan(-1e3 * (top - bottom), 0.0, color="0.85")
    axes.axhline(0.0, color="0.3")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


def _animate(poses: NDArray[np.float64], params: Parameters) -> tuple[FuncAnimation, Any]:
    """The animation, in real time, and a function that closes its figure."""
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation

    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    _set_view(axes, poses, params)
    last = poses.shape[1] - 1
    num_frames = int(min(max(np.ceil(last * params.dt * _FRAMES_PER_SECOND), 0), _MAX_FRAMES)) + 1
    columns = np.linspace(0, last, num_frames).round().astype(int)
    square = axes.add_patch(_square(poses[:, 0], params))
    mark = axes.plot([], [], "o", color="#c0392b", markersize=5)[0]  # on corner (-,-), to make turning visible
    path = axes.plot([], [], color="0.3", linewidth=0.8)[0]
    clock = axes.text(0.02, 0.95, "", transform=axes.transAxes, va="top")

    def draw(column: int) -> list[Any]:
        corners = _core.corner_positions(poses[:, column], params)
        square.set_xy(corners)
        mark.set_data([corners[0, 0]], [corners[0, 1]])
        path.set_data(poses[0, : column + 1], poses[1, : column + 1])
        clock.set_text(f"t = {column * params.dt:.2f} s")
        return [square, mark, path, clock]

    interval = 1000.0 / _FRAMES_PER_SECOND
    animation = FuncAnimation(figure, draw, frames=list(columns), interval=interval, blit=True, repeat=True)
    return animation, lambda: plt.close(figure)
