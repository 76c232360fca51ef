"""save to .html and view, of trajectories and of records of the drop. The page here is a small one."""

import base64
import html
import re
import sys
import types
import webbrowser
import zlib
from pathlib import Path

import numpy as np
import pytest
from scene_samples import load
from tumble import _view, drop, simulate
from tumble._view import Page, find_page

PAGE = "<!doctype html><title>Tumble</title>\n<body><!--tumble-run--><script>run(\"&\")</script></body>\n"
START = ([0.0, 1.5, 0.5], [0.0, -0.2, 0.0])


@pytest.fixture(autouse=True)
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    page = tmp_path / "page/page.html"
    page.parent.mkdir()
    page.write_text(PAGE)
    monkeypatch.setenv("TUMBLE_PAGE", str(page))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "page"))  # of files without a name
    return page


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What a browser was asked to show."""
    addresses: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


@pytest.fixture
def notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    class ZMQInteractiveShell:
        pass

    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=ZMQInteractiveShell))


def texts_of(page: str) -> dict[str, bytes]:
    pattern = r'<script type="text/plain" class="tumble-file" data-name="([^"]*)">([A-Za-z0-9+/=]*)</script>'
    return {name: zlib.decompress(base64.b64decode(text, validate=True)) for name, text in re.findall(pattern, page)}


def test_a_trajectory_is_saved_as_a_page(tmp_path: Path) -> None:
    trajectory = simulate(load("dominoes"), duration=0.3, sample_every=10)
    assert trajectory.save(tmp_path / "run.html") == tmp_path / "run.html"
    trajectory.save(tmp_path / "run.csv"), trajectory.save(tmp_path / "run.contacts.csv")
    texts = texts_of((tmp_path / "run.html").read_text())
    assert list(texts) == ["scene.toml", "samples.csv", "contacts.csv"]
    assert texts["samples.csv"] == (tmp_path / "run.csv").read_bytes()
    assert texts["contacts.csv"] == (tmp_path / "run.contacts.csv").read_bytes()
    assert texts["scene.toml"].decode() == trajectory.scene.to_toml()
    trajectory.save(tmp_path / "other", format="HTML")
    assert (tmp_path / "other").read_bytes() == (tmp_path / "run.html").read_bytes()
    simulate(load("dominoes"), duration=0.3, contacts=False).save(tmp_path / "bare.html")
    assert list(texts_of((tmp_path / "bare.html").read_text())) == ["scene.toml", "samples.csv"]


def test_a_record_of_the_drop_is_saved_in_every_format(tmp_path: Path) -> None:
    record = drop.record(*START, params=drop.Parameters(mu=0.6, columns=100))
    for ending, start in {"png": b"\x89PNG", "svg": b"<?xml", "gif": b"GIF89a", "h5": b"\x89HDF", "csv": b"# tumble drop 1\n"}.items():
        assert record.save(tmp_path / f"drop.{ending}").read_bytes().startswith(start)
    record.save(tmp_path / "drop.html"), record.save(tmp_path / "drop.npz")
    assert texts_of((tmp_path / "drop.html").read_text()) == {"record.csv": (tmp_path / "drop.csv").read_bytes()}
    arrays = np.load(tmp_path / "drop.npz")
    for name in ("t", "q", "v", "gap", "corner", "residual", "kinetic", "potential"):
        assert np.array_equal(arrays[name], getattr(record, name)), name
    assert np.array_equal(arrays["z"], [record.f_n, record.f_t1, record.f_t2, record.slip_speed])
    assert list(arrays["mode_names"][arrays["mode"]]) == record.mode and arrays["mu"] == 0.6


def test_a_record_that_ended_early_is_saved(tmp_path: Path) -> None:
    record = drop.record([0.0, 10.0, 0.1], [1.0, -0.2, 3.0], params=drop.Parameters(columns=40, g=4e153, dt=0.4))
    assert record.status[-1] == "numerical"
    text = record.save(tmp_path / "drop.csv").read_text()
    assert f"\n# columns = 40\n# rows = {len(record.t)}\n# status = numerical\n" in text


def test_view_opens_a_browser(tmp_path: Path, opened: list[str]) -> None:
    trajectory = simulate(load("drop"), duration=0.1)
    path = tmp_path / "a run.html"
    assert trajectory.view(path) == path and opened == [path.as_uri()]
    trajectory.save(tmp_path / "same.html")
    assert path.read_bytes() == (tmp_path / "same.html").read_bytes()
    temporary = drop.record(*START).view()
    assert isinstance(temporary, Path) and opened[1:] == [temporary.as_uri()]
    assert list(texts_of(temporary.read_text())) == ["record.csv"]


def test_view_says_where_the_page_is_if_there_is_no_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    drop.record(*START).view(tmp_path / "drop.html")
    assert capsys.readouterr().out == f"no browser to show it in: the page was saved as {tmp_path}/drop.html\n"


def test_a_notebook_shows_the_page_in_place(tmp_path: Path, page: Path, notebook: None, opened: list[str]) -> None:
    record = drop.record(*START)
    shown = record.view()
    assert isinstance(shown, Page) and opened == [] and list(page.parent.iterdir()) == [page]
    frame = re.fullmatch(r'<iframe srcdoc="([^"<>]*)" style="[^"]*height: 640px[^"]*" allowfullscreen></iframe>', shown._repr_html_())
    assert frame and html.unescape(frame[1]) == shown.html
    record.save(tmp_path / "same.html")
    kept = record.view(tmp_path / "drop.html")
    assert isinstance(kept, Page) and kept.html == shown.html == (tmp_path / "same.html").read_text()
    assert (tmp_path / "drop.html").read_text() == shown.html


def test_what_cannot_be_viewed_is_refused_and_leaves_nothing(tmp_path: Path, page: Path, opened: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    record = drop.record(*START)
    with pytest.raises(ValueError, match="path: must end in .html, got 'drop.csv'"):
        record.view("drop.csv")
    page.write_text("no page")
    with pytest.raises(ValueError, match="page.html: is no page for runs"):
        record.view()
    monkeypatch.setenv("TUMBLE_PAGE", str(tmp_path / "none.html"))
    with pytest.raises(OSError, match="none.html: No such file or directory; `make viewer` builds it"):
        simulate(load("drop"), duration=0.1).view()
    assert list(page.parent.iterdir()) == [page] and opened == []


def test_where_the_page_is_looked_for(tmp_path: Path, page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert find_page() == page
    monkeypatch.delenv("TUMBLE_PAGE")
    package, prefix = tmp_path / "package", tmp_path / "prefix"
    monkeypatch.setattr(_view, "__file__", str(package / "_view.py"))
    monkeypatch.setattr(sys, "prefix", str(prefix))
    with pytest.raises(FileNotFoundError) as caught:
        drop.record(*START).save(tmp_path / "drop.html")
    assert f"there is none at {package}/tumble.html or {prefix}/share/tumble/tumble.html; `make viewer` builds it" in str(caught.value)
    drop.record(*START).save(tmp_path / "drop.csv")  # needs none
    for place in (prefix / "share/tumble/tumble.html", package / "tumble.html"):
        place.parent.mkdir(parents=True)
        place.write_text(PAGE)
        assert find_page() == place
