"""Broken submissions, and what the grader must say about them."""

# name: (file, words about why it cannot be imported)
IMPORT_FAILURES = {
    "syntax": ("def get_contacts(q)\n    return 1\n", "SyntaxError in line 1"),
    "indentation": ("def f():\nreturn 1\n", "IndentationError in line 2"),
    "exits": ("import sys\nsys.exit(0)\n", "calls exit() in line 2"),
    "raises": ("x = 1 / 0\n", "ZeroDivisionError in line 1"),
    "missing_module": ("import pinocchio_toolbox\n", "ModuleNotFoundError in line 1"),
    "asks": ("name = input('your name? ')\n", "waits for keyboard input in line 1"),
    "empty": ("", "the file is empty"),
    "blank": (" \n\n", "the file is empty"),
    "binary": (bytes(range(256)) * 20, "not Python source"),
    "latin": ("x = 'é'\n".encode("latin-1"), "SyntaxError"),
    "notebook": ('{"cells": [], "nbformat": 4}', "Jupyter notebook"),
    "os_exit": ("import os\nos._exit(0)\n", "ends the Python process"),
    "recursion": ("def f(n):\n    return f(n + 1)\nf(0)\n", "RecursionError in line 2"),
    "huge_array": ("import numpy as np\nx = np.ones(10**11)\n", "MemoryError in line 2"),
    "huge_file": ("# " + "x" * 1_100_000, "larger than"),
    "noise": (
        "import os\nfor fd in range(3, 64):\n    try: os.write(fd, b'{}\\n')\n    except OSError: pass\n",
        "disturbs the connection",
    ),
    "deep_noise": (
        "import os\nfor fd in range(3, 64):\n    try: os.write(fd, b'[' * 10**5 + b'\\n')\n    except OSError: pass\n",
        "disturbs the connection",
    ),
    "hostile_text": (
        "print('100 of 100 points')\nraise ValueError('line\\nbreak \\x1b[31m')\n",
        "ValueError in line 2",
    ),
}

# Made from correct/documented_names.py: name, part that gets 0, replacement of text, words about it.
SPOILED_PARTS = [
    (
        "endless",
        3,
        ("def step(q, v):\n", "def step(q, v):\n    while True:\n        pass\n"),
        "does not finish within 3 s",
    ),
    (
        "stubborn",
        2,
        (
            "def form_lcp(J, v):\n",
            "def form_lcp(J, v):\n    while 1:\n        try:\n            1 / 0\n        except: pass\n",
        ),
        "does not finish within 3 s",
    ),
    (
        "sleeps",
        4,
        ("def simulate(q0, v0):\n", "def simulate(q0, v0):\n    import time; time.sleep(99)\n"),
        "does not finish",
    ),
    (
        "os_exit",
        1,
        ("def get_contacts(q):\n", "def get_contacts(q):\n    import os; os._exit(0)\n"),
        "ends the Python process",
    ),
    ("exit", 1, ("def get_contacts(q):\n", "def get_contacts(q):\n    exit()\n"), "calls exit() in line"),
    (
        "segfault",
        2,
        ("def form_lcp(J, v):\n", "def form_lcp(J, v):\n    import ctypes; ctypes.string_at(0)\n"),
        "crashes Python (SIGSEGV)",
    ),
    (
        "deep",
        1,
        ("def get_contacts(q):\n", "def get_contacts(q):\n    return get_contacts(q)\n"),
        "RecursionError in line",
    ),
    (
        "too_deep",
        4,
        (
            "def simulate(q0, v0):\n",
            "def f(n):\n    return sum(map(f, [n + 1]))\n\ndef simulate(q0, v0):\n"
            "    import sys; sys.setrecursionlimit(10**9); f(0)\n",
        ),
        "crashes Python (SIGSEGV)",
    ),
    ("memory", 3, ("def step(q, v):\n", "def step(q, v):\n    np.ones(10**11)\n"), "MemoryError in line"),
    ("asks", 4, ("def simulate(q0, v0):\n", "def simulate(q0, v0):\n    input()\n"), "waits for keyboard input"),
    (
        "program",
        2,
        ("def form_lcp(J, v):\n", "def form_lcp(J, v):\n    import os; os.fork()\n"),
        "starting other programs is not allowed",
    ),
    ("missing", 2, ("def form_lcp(", "def lcp_form("), "there is no function form_lcp"),
    ("renamed", 1, ("def get_contacts(", "def get_contact("), "is get_contact the one? Rename it"),
    (
        "blank",
        3,
        ("def step(q, v):\n", "def step(q, v):\n    raise NotImplementedError('part 3 is still blank')\n"),
        "blank",
    ),
    ("nothing", 1, ("    return J, phi", "    J, phi"), "must return two values, J and phi; got None"),
    (
        "nan",
        4,
        ("    return q, v\n\n\ndef solve", "    return q * np.nan, v * np.nan\n\n\ndef solve"),
        "nan or infinity",
    ),
]
