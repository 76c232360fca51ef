"""Show a trajectory as an animation. You do not need to change this file."""

import os

import numpy as np

l = 0.2  # side of the square that is drawn [m]
FRAME_TIME = 0.02  # pause between two frames [s]


def assignment_3_render(traj):
    """Show the square moving along a trajectory, again and again, until the window is closed.

    Without a display the animation goes to the file trajectory.gif beside this script.

    Parameters
    ----------
    traj : array_like, shape (3, T)
        One column per time step: x [m], y [m], angle [rad] of the square.
    """
    traj = np.asarray(traj, dtype=float)
    if traj.ndim != 2 or traj.shape[0] != 3 or traj.shape[1] == 0:
        raise ValueError(f"traj: shape must be (3, T) with T > 0, got {traj.shape}")
    if not np.all(np.isfinite(traj)):
        raise ValueError("traj: every entry must be a finite number")

    # Loaded here, so that parts 1 to 4 also run where matplotlib is missing.
    import matplotlib
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation, PillowWriter

    figure, outline = _draw_scene(plt, traj)

    def show_column(k):
        outline.set_data(*_outline(traj[:, k]))
        return (outline,)

    frames = traj.shape[1]
    animation = FuncAnimation(figure, show_column, frames=frames, interval=1000 * FRAME_TIME, repeat=True)
    windowed = [name.lower() for name in matplotlib.rcsetup.interactive_bk]
    if matplotlib.get_backend().lower() in windowed:
        plt.show()
    else:
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "trajectory.gif")
        animation.save(path, writer=PillowWriter(fps=round(1 / FRAME_TIME)))
        print(f"There is no display to open a window on: the animation is in {path}")
    plt.close(figure)


render = assignment_3_render


def _draw_scene(plt, traj):
    """Figure with the ground; the limits hold the whole trajectory."""
    figure, axes = plt.subplots()
    x_low, x_high = traj[0].min() - 2 * l, traj[0].max() + 2 * l
    axes.plot([x_low, x_high], [0.0, 0.0], color="black")
    axes.set_xlim(x_low, x_high)
    axes.set_ylim(min(0.0, traj[1].min()) - l, traj[1].max() + l)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    (outline,) = axes.plot([], [], color="tab:blue", linewidth=2)
    return figure, outline


def _outline(q):
    """The closed outline of the square at q: x and y of the corners, the first one twice."""
    x, y, theta = q
    along = np.array([-1, 1, 1, -1, -1]) * l / 2
    across = np.array([-1, -1, 1, 1, -1]) * l / 2
    cos, sin = np.cos(theta), np.sin(theta)
    return x + cos * along - sin * across, y + sin * along + cos * across
