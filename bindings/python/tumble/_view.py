"""Runs as pages: where the page is, and how it is shown. `make viewer` builds it."""

from __future__ import annotations

import html
import os
import sys
import tempfile
import webbrowser
from collections.abc import Callable
from pathlib import Path
from typing import Union

_FRAME_HEIGHT = 640  # px, in a notebook


def find_page() -> Path:
    """The page that runs are put into: that of TUMBLE_PAGE, else that of this package, else that of the installation.

    Raises FileNotFoundError if there is none.
    """
    if named := os.environ.get("TUMBLE_PAGE"):
        return Path(named)
    places = [Path(__file__).with_name("tumble.html"), Path(sys.prefix, "share/tumble/tumble.html")]
    for place in places:
        if place.is_file():
            return place
    looked = " or ".join(str(place) for place in places)
    raise FileNotFoundError(f"page: an .html needs the page that shows it, and there is none at {looked}; `make viewer` builds it")


class Page:
    """A page with a run inside. A notebook shows it in place.

    Attributes
    ----------
    html : str
        The whole page.
    """

    def __init__(self, text: str) -> None:
        self.html = text

    def _repr_html_(self) -> str:
        style = f"width: 100%; height: {_FRAME_HEIGHT}px; border: 0"
        return f'<iframe srcdoc="{html.escape(self.html)}" style="{style}" allowfullscreen></iframe>'

    def __repr__(self) -> str:
        return f"<Page: {len(self.html)} characters; a notebook shows it>"


def view(save: Callable[[Path], Path], path: Union[str, os.PathLike[str], None]) -> Union[Path, Page]:
    """Show the page that `save` writes, in the notebook or in a browser."""
    if path is None and in_notebook():
        with tempfile.TemporaryDirectory() as folder:
            return Page(_text_of(save(Path(folder, "run.html"))))
    if path is not None and Path(path).suffix.lower() != ".html":
        raise ValueError(f"path: must end in .html, got {str(path)!r}")
    target = Path(path) if path is not None else _new_file()
    try:
        save(target)
    except BaseException:
        if path is None:
            target.unlink()
        raise
    return Page(_text_of(target)) if in_notebook() else _show_in_browser(target)


def _text_of(file: Path) -> str:
    return file.read_bytes().decode()


def _show_in_browser(file: Path) -> Path:
    if not webbrowser.open(file.resolve().as_uri()):
        print(f"no browser to show it in: the page was saved as {file}")
    return file


def _new_file() -> Path:
    handle, name = tempfile.mkstemp(prefix="tumble-", suffix=".html")
    os.close(handle)
    return Path(name)


def in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return type(shell).__name__ == "ZMQInteractiveShell"
