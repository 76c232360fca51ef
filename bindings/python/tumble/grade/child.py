"""The process that runs student code: loads the submission, calls its functions, sends back what they return.

It talks JSON lines over a socket that the student code does not know of. The grading itself happens in the parent
process, which sees only results, so printed text cannot change a score. Code that looks for the socket can still lie
about a result; to get points by it, the lie has to be the right answer.
"""

from __future__ import annotations

import ast
import contextlib
import difflib
import importlib
import json
import os
import socket
import sys
import time
import traceback
from types import ModuleType
from typing import Any, TextIO

import numpy as np
from tumble import drop

from tumble.grade.codec import encode
from tumble.grade.guard import Sink, limit_resources, refuse_side_effects, silence_plots
from tumble.grade.inject import FUNCTIONS, Reference
from tumble.grade.parameters import read_parameters

_MODULE = "assignment_3"
_LONGEST_TEXT = 200


def main() -> None:
    """Run as ``python3 -m tumble.grade.child FD SECONDS FOLDER...`` by `tumble.grade.sandbox`."""
    connection = socket.socket(fileno=int(sys.argv[1]))
    stream = connection.makefile("rw", encoding="utf-8")
    seconds, folders = float(sys.argv[2]), sys.argv[3:]
    sys.argv = [f"{_MODULE}.py"]
    limit_resources(seconds)
    silence_plots()
    refuse_side_effects(folders)
    sink = Sink()
    sys.stdout = sys.__stdout__ = sink  # type: ignore
    # Warnings are not the student's prints, so they are not counted with them.
    sys.stderr = sys.__stderr__ = Sink()  # type: ignore
    # Whatever happens before this line is not the student's fault.
    _send(stream, {"ready": True})
    module, message = _load(sink)
    _send(stream, message)
    if module is not None:
        for line in stream:
            _answer(stream, json.loads(line), module, sink)
    # Not sys.exit: threads and exit handlers of the student's code must not hold up the grading.
    os._exit(0)


def _send(stream: TextIO, message: dict[str, Any]) -> None:
    stream.write(json.dumps(message) + "\n")
    stream.flush()


def _load(sink: Sink) -> tuple[ModuleType | None, dict[str, Any]]:
    shown = _silence_helpers()
    start = time.perf_counter()
    try:
        module = importlib.import_module(_MODULE)
    except BaseException as error:  # sys.exit and the like must not end the grading without a word
        return None, {"error": _error_text(error)}
    seconds = time.perf_counter() - start
    namespace = vars(module)
    return module, {
        "functions": {name: _find_function(namespace, name) for name in FUNCTIONS},
        "similar": {name: _similar(namespace, name) for name in FUNCTIONS},
        "parameters": read_parameters(namespace),
        "notes": _notes_on_loading(seconds, sink, shown),
        "doubts": _doubts(),
    }


def _silence_helpers() -> list[str]:
    """Replace the render functions of the helper files; returns the list that calls of them are added to."""
    shown: list[str] = []

    def render(*_: Any, **__: Any) -> None:
        shown.append("render")

    for name in ("assignment_3_render", "assignment_3_helper"):
        helper = importlib.import_module(name)
        helper.render = helper.assignment_3_render = render  # type: ignore[attr-defined]
    return shown


def _find_function(namespace: dict[str, Any], name: str) -> str | None:
    """The name under which a submission has a function; other capital letters are accepted."""
    if callable(namespace.get(name)):
        return name
    return next((key for key in namespace if key.lower() == name.lower() and callable(namespace[key])), None)


def _similar(namespace: dict[str, Any], name: str) -> str | None:
    own = [
        key
        for key, value in namespace.items()
        if getattr(value, "__module__", None) == _MODULE and callable(value)
    ]
    others = [key for key in own if key not in FUNCTIONS]
    return next(iter(difflib.get_close_matches(name, others, n=1, cutoff=0.7)), None)


def _notes_on_loading(seconds: float, sink: Sink, shown: list[str]) -> list[str]:
    guard = "put such calls under: if __name__ == '__main__':"
    notes = []
    tree = _syntax_tree()
    if names := sorted({*_calls_while_loading(tree), *shown}):
        notes.append(f"calls {', '.join(names)} as soon as it is imported; {guard}")
    if seconds > 1.0:
        notes.append(f"takes {seconds:.1f} s to import")
    if sink.characters:
        notes.append("prints while it is imported")
    return notes


def _doubts() -> list[str]:
    if _imports_tumble(_syntax_tree()):
        return ["imports tumble, which holds the solution: the points say nothing"]
    return []


def _syntax_tree() -> ast.Module:
    try:
        with open(f"{_MODULE}.py", "rb") as file:
            return ast.parse(file.read())
    except (OSError, SyntaxError, ValueError, MemoryError, RecursionError):
        return ast.Module([], [])


def _imports_tumble(tree: ast.Module) -> bool:
    for node in ast.walk(tree):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
        if any(name.split(".")[0] == "tumble" for name in names):
            return True
    return False


def _calls_while_loading(tree: ast.Module) -> list[str]:
    """Names of simulations and plots called at the top level of the submission, outside functions and `if` blocks."""
    watched = {"simulate", "step", "show", "render", "assignment_3_render"}
    names = []
    for statement in tree.body:
        if isinstance(statement, (ast.FunctionDef, ast.ClassDef, ast.If)):
            continue
        for node in ast.walk(statement):
            if isinstance(node, ast.Call):
                name = getattr(node.func, "id", None) or getattr(node.func, "attr", None)
                if name in watched:
                    names.append(name)
    return names


def _answer(stream: TextIO, request: dict[str, Any], module: ModuleType, sink: Sink) -> None:
    """Call one function on many states. Every result is sent at once, so that a crash costs only what follows it."""
    reference = Reference(drop.Parameters(**request["parameters"]), request["conventions"])
    namespace = vars(module)
    function = namespace[request["function"]]
    restore = reference.install(namespace, request["replaced"])
    for number, job in enumerate(request["jobs"]):
        reference.phi = job["phi"]
        _send(stream, {"number": number, **_run(function, job["arguments"], reference, sink)})
    restore()


def _run(function: Any, arguments: list[Any], reference: Reference, sink: Sink) -> dict[str, Any]:
    inputs = [np.array(argument, dtype=float) for argument in arguments]
    originals = [array.copy() for array in inputs]
    reference.used.clear()
    before = sink.characters
    message: dict[str, Any] = {}
    try:
        message["result"] = encode(function(*inputs))
    except BaseException as error:  # also SystemExit and MemoryError: the next state deserves its chance
        message["error"] = _error_text(error)
    message["changed"] = [
        index for index, (now, was) in enumerate(zip(inputs, originals)) if not _is_same(now, was)
    ]
    message["printed"] = sink.characters > before
    message["used"] = sorted(reference.used)
    return message


def _is_same(now: np.ndarray[Any, Any], was: np.ndarray[Any, Any]) -> bool:
    return now.shape == was.shape and bool(np.array_equal(now, was, equal_nan=True))


def _error_text(error: BaseException) -> str:
    """An exception in one line, with the line of the submission it comes from."""
    with contextlib.suppress(Exception):
        if isinstance(error, SyntaxError) and error.filename and error.filename.endswith(f"{_MODULE}.py"):
            return _one_line(f"{type(error).__name__} in line {error.lineno}: {error.msg}")
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if os.path.basename(frame.filename) == f"{_MODULE}.py"]
        place = f" in line {lines[-1]}" if lines else ""
        if isinstance(error, SystemExit):
            return f"calls exit(){place}"
        if isinstance(error, EOFError):
            return f"waits for keyboard input{place}"
        text = str(error)
        return _one_line(
            f"{type(error).__name__}{place}: {text}" if text else f"{type(error).__name__}{place}"
        )
    return type(error).__name__


def _one_line(text: str) -> str:
    flat = " ".join(text.split())
    return flat if len(flat) <= _LONGEST_TEXT else flat[: _LONGEST_TEXT - 3] + "..."


if __name__ == "__main__":
    main()
