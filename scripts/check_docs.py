#!/usr/bin/python3
"""Check that the documentation is true: paths exist, links resolve, code runs.

- Repository paths in backticks in ARCHITECTURE.md, CONTRIBUTING.md and README.md exist.
- Every relative link of every *.md resolves.
- In README.md and docs/**/*.md every ```python block runs (as doctest if it starts with ">>>"), every ```cpp block
  with a main() compiles and runs, every ```sh block behind `<!-- run -->` runs, each in an empty folder. A block behind
  `<!-- output -->` is what the block before it prints.

Prints one line "file:line: what is wrong" for each fault and exits with 1 if there is one.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MAPS = ("ARCHITECTURE.md", "CONTRIBUTING.md", "README.md")
MADE = re.compile(r"^(build|build-.*|out|dist|node_modules)$")  # folders that are not in the repository
PATH = re.compile(r"^[\w.+*-]+(/[\w.+*-]+)*/?$")
LINK = re.compile(r"\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")
DOCTEST = "import doctest, sys; sys.exit(doctest.testfile('block.py', module_relative=False).failed > 0)"
SECONDS = 120  # a block that takes longer has failed


@dataclass
class Block:
    """A fenced block; `line` is that of its fence, `mark` the comment before it, "run" or "output"."""

    language: str
    text: str
    line: int
    mark: str


def parse(file: Path) -> tuple[list[tuple[int, str]], list[Block]]:
    """The numbered lines outside of fences, and the fenced blocks."""
    prose: list[tuple[int, str]] = []
    blocks: list[Block] = []
    inside: Block | None = None
    last = ""  # the last line that is not blank
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
        fence = line.strip().startswith("```")
        if inside is not None:
            if fence:
                blocks.append(inside)
                inside = None
            else:
                inside.text += line + "\n"
        elif fence:
            inside = Block(line.strip()[3:].strip(), "", number, last.removeprefix("<!-- ").removesuffix(" -->"))
        else:
            prose.append((number, line))
        last = line.strip() or last
    return prose, blocks


def markdown_files() -> list[Path]:
    """All *.md of the repository, without hidden and made folders."""
    files: list[Path] = []
    for folder, names, entries in os.walk(ROOT):
        names[:] = sorted(n for n in names if not n.startswith(".") and not MADE.match(n))
        files += [Path(folder) / entry for entry in sorted(entries) if entry.endswith(".md")]
    return files


def missing_path(word: str) -> bool:
    """True if the word looks like a path of this repository and nothing is there."""
    if not PATH.match(word) or ".." in word:
        return False
    first = word.split("/")[0]
    looks_like_path = ("/" in word and (ROOT / first).exists()) or word.endswith((".md", ".cff", ".toml"))
    return looks_like_path and not MADE.match(first) and next(ROOT.glob(word.rstrip("/")), None) is None


def broken_link(file: Path, target: str) -> bool:
    """True if a relative link leads nowhere."""
    return not re.match(r"^([a-z]+:|#)", target) and not (file.parent / target.split("#")[0]).exists()


def commands_of(block: Block, folder: Path, build: Path) -> list[list[str]]:
    """Writes the block into the folder; the commands that run it, none if it is only to be read."""
    if block.language == "python":
        (folder / "block.py").write_text(block.text, encoding="utf-8")
        return [[sys.executable, *(["-c", DOCTEST] if block.text.startswith(">>>") else ["block.py"])]]
    if block.language == "cpp" and re.search(r"\bmain\s*\(", block.text):
        (folder / "block.cpp").write_text(block.text, encoding="utf-8")
        library = str(build / "src" / "tumble" / "libtumble.a")
        return [["g++", "-std=c++20", f"-I{ROOT / 'src'}", "block.cpp", library, "-o", "block"], ["./block"]]
    if block.language == "sh" and block.mark == "run":
        return [["sh", "-euc", block.text]]
    return []


def run(block: Block, build: Path) -> tuple[str | None, str]:
    """Runs the block; what went wrong, or None, and what the block printed."""
    programs = os.pathsep.join([str(build / "bin"), str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PYTHONPATH": str(build / "python"), "MPLBACKEND": "Agg", "PATH": programs}
    printed = ""
    with tempfile.TemporaryDirectory() as folder:
        for command in commands_of(block, Path(folder), build):
            try:
                done = subprocess.run(command, cwd=folder, env=environment, timeout=SECONDS, text=True,
                                      stdin=subprocess.DEVNULL, capture_output=True)
            except subprocess.TimeoutExpired:
                return f"the {block.language} block takes longer than {SECONDS} s", printed
            printed = done.stdout
            if done.returncode != 0:
                said = (done.stdout + done.stderr).rstrip()
                return f"the {block.language} block fails with code {done.returncode}:\n{said}", printed
    return None, printed


def faults(build: Path) -> Iterator[str]:
    """All faults as "file:line: text"."""
    for file in markdown_files():
        name = file.relative_to(ROOT)
        prose, blocks = parse(file)
        for number, line in prose:
            if str(name) in MAPS:
                yield from (f"{name}:{number}: `{word}` does not exist"
                            for word in re.findall(r"`([^`]+)`", line) if missing_path(word))
            text = re.sub(r"`[^`]*`", "", line)
            yield from (f"{name}:{number}: the link to {target} leads nowhere"
                        for target in LINK.findall(text) if broken_link(file, target))
        if str(name) != "README.md" and name.parts[0] != "docs":
            continue
        printed = ""
        for block in blocks:
            if block.mark == "output":
                if block.text != printed:
                    yield f"{name}:{block.line}: the block before it prints\n{printed.rstrip()}"
                continue
            failure, printed = run(block, build)
            if failure:
                yield f"{name}:{block.line}: {failure}"


def main() -> int:
    """Print the faults; 1 if there are any."""
    parser = argparse.ArgumentParser(description="Check paths, links and code blocks of the documentation.")
    parser.add_argument("--build", type=Path, default=os.environ.get("TUMBLE_BUILD", ROOT / "build"))
    found = list(faults(Path(parser.parse_args().build).resolve()))
    print("\n".join(found) if found else "paths, links and code blocks of the documentation are good")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
