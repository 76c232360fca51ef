"""`-o run.html`: the run inside the page that plays it. The page here is a small one; the real one: tests/viewer."""

import base64
import os
import re
import shutil
import signal
import subprocess
import time
import zlib
from pathlib import Path

import pytest
from program import PROGRAM, ROOT, refuse, succeed, tumble

PAGE = "<!doctype html><title>Tumble</title>\n<body><!--tumble-run--><script>run()</script></body>\n"
SCENE = ROOT / "scenes/dominoes.toml"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "page.html").write_text(PAGE)
    monkeypatch.setenv("TUMBLE_PAGE", str(tmp_path / "page.html"))
    return tmp_path


def texts_of(path: Path) -> dict[str, bytes]:
    """What is in the page, by name, in its order."""
    pattern = r'<script type="text/plain" class="tumble-file" data-name="([^"]*)">([A-Za-z0-9+/=]*)</script>'
    found = re.findall(pattern, path.read_text())
    return {name: zlib.decompress(base64.b64decode(text, validate=True)) for name, text in found}


def test_a_run_is_in_the_page_as_in_its_tables(folder: Path) -> None:
    files = ["run.html", "run.csv", "run.contacts.csv"]
    words = ["--duration", "0.5", "--sample-every", "5"]
    text = succeed("run", SCENE, *words, *[w for file in files for w in ("-o", file)], cwd=folder)
    assert text.endswith("wrote run.html, run.csv, run.contacts.csv\n")
    texts = texts_of(folder / "run.html")
    assert list(texts) == ["scene.toml", "samples.csv", "contacts.csv"]
    assert texts["samples.csv"] == (folder / "run.csv").read_bytes()
    assert texts["contacts.csv"] == (folder / "run.contacts.csv").read_bytes()
    (folder / "again.toml").write_bytes(texts["scene.toml"])
    succeed("run", "again.toml", *words, "-o", "again.html", cwd=folder)
    assert texts_of(folder / "again.html") == texts
    title = re.search('title = "(.*)"', SCENE.read_text())
    assert title and f"<title>{title[1]}</title>" in (folder / "run.html").read_text()
    assert (folder / "run.html").read_text().endswith("<script>run()</script></body>\n")


def test_the_page_alone_keeps_contacts_unless_they_are_not_wanted(folder: Path) -> None:
    words = ["run", SCENE, "--duration", "0.1"]
    succeed(*words, "-o", "run.html", cwd=folder)
    succeed(*words, "--no-contacts", "-o", "bare.html", "-o", "run.csv", cwd=folder)
    assert list(texts_of(folder / "run.html")) == ["scene.toml", "samples.csv", "contacts.csv"]
    assert list(texts_of(folder / "bare.html")) == ["scene.toml", "samples.csv"]
    assert texts_of(folder / "bare.html")["samples.csv"] == (folder / "run.csv").read_bytes()


def test_titles_are_escaped(folder: Path) -> None:
    scene = 'tumble = 1\nduration = 0.01\ntitle = "<b>Fällt & rollt</b>"\n'
    succeed("run", "-", "-o", "run.html", cwd=folder, stdin=scene)
    assert "<title>&lt;b&gt;Fällt &amp; rollt&lt;/b&gt;</title>" in (folder / "run.html").read_text()
    succeed("run", "-", "-o", "other.html", cwd=folder, stdin="tumble = 1\nduration = 0.01\n")
    assert "<title>Tumble</title>" in (folder / "other.html").read_text()


def test_drops_and_their_records(folder: Path) -> None:
    succeed("drop", "--friction", "0.6", "-o", "drop.html", "-o", "drop.csv", cwd=folder)
    assert texts_of(folder / "drop.html") == {"record.csv": (folder / "drop.csv").read_bytes()}
    succeed("render", "drop.csv", "-o", "again.html", cwd=folder)
    assert (folder / "again.html").read_bytes() == (folder / "drop.html").read_bytes()
    printed = succeed("drop", "--friction", "0.6", "--quiet", "--format", "html", "-o", "/dev/stdout", cwd=folder)
    assert printed == (folder / "drop.html").read_text()


@pytest.mark.parametrize("words", [["drop"], ["run", SCENE, "--duration", "1e5"]])
def test_a_page_that_cannot_be_used_is_refused_before_the_run(folder: Path, monkeypatch: pytest.MonkeyPatch, words: list[str]) -> None:
    for page in ("<html></html>", PAGE + PAGE):
        (folder / "page.html").write_text(page)
        assert "page.html: is no page for runs: the comment <!--tumble-run-->" in refuse(*words, "-o", "run.html", cwd=folder)
    monkeypatch.setenv("TUMBLE_PAGE", "none.html")
    message = refuse(*words, "-o", "run.csv", "-o", "run.html", cwd=folder)
    assert "cannot read none.html: No such file or directory; `make viewer` builds it" in message
    monkeypatch.delenv("TUMBLE_PAGE")
    (folder / "bin").mkdir()
    shutil.copy(PROGRAM, folder / "bin/tumble")
    copy = [str(folder / "bin/tumble"), *map(str, words), "-o", "run.html"]
    run = subprocess.run(copy, cwd=folder, capture_output=True, text=True, timeout=60)
    assert run.returncode == 2 and run.stderr.count("\n") == 1 and run.stdout == ""
    assert f"cannot read {folder}/share/tumble/tumble.html: No such file or directory" in run.stderr
    assert not (folder / "run.html").exists() and not (folder / "run.csv").exists()


def test_the_page_beside_the_program_is_found(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("TUMBLE_PAGE")
    (folder / "bin").mkdir()
    (folder / "share/tumble").mkdir(parents=True)
    shutil.copy(PROGRAM, folder / "bin/tumble")
    (folder / "page.html").rename(folder / "share/tumble/tumble.html")
    (folder / "linked").symlink_to("bin/tumble")
    subprocess.run([folder / "linked", "drop", "--quiet", "-o", "run.html"], cwd=folder, check=True, timeout=60)
    assert list(texts_of(folder / "run.html")) == ["record.csv"]


def test_files_are_replaced_only_by_force(folder: Path) -> None:
    (folder / "run.html").write_text("precious")
    assert "run.html: already exists; --force replaces it" in refuse("drop", "-o", "run.html", cwd=folder)
    assert (folder / "run.html").read_text() == "precious"
    succeed("drop", "--force", "-o", "run.html", cwd=folder)
    assert list(texts_of(folder / "run.html")) == ["record.csv"]
    assert sorted(path.name for path in folder.iterdir()) == ["page.html", "run.html"]


def test_a_disk_that_is_full_leaves_no_half_page(folder: Path) -> None:
    (folder / "full.html").symlink_to("/dev/full")
    run = tumble("drop", "-o", "full.html", cwd=folder)
    assert run.returncode == 2 and "full.html: No space left on device" in run.stderr


BOUNCING_BALL = """
tumble = 1
duration = 1e5
materials.default = { friction = 0.5, restitution = 1 }
bodies = [
  { name = "floor", kind = "fixed", shape = { half_plane = [0, 1] } },
  { name = "ball", shape = { disc = 0.1 }, mass = 1, position = [0, 1] },
]
"""


def test_an_interrupted_run_is_written(folder: Path) -> None:
    (folder / "long.toml").write_text(BOUNCING_BALL)  # few contacts, however far a fast machine gets
    process = subprocess.Popen(
        [PROGRAM, "run", "long.toml", "--sample-every", "100", "-o", "run.html"], cwd=folder, env=os.environ,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell may have switched it off
    )  # fmt: skip
    time.sleep(1.5)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130 and said.startswith(b"tumble: interrupted at ")
    texts = texts_of(folder / "run.html")
    assert b"\n# complete = no\n" in texts["samples.csv"] and b"\n# complete = no\n" in texts["contacts.csv"]
