#!/usr/bin/env python3
"""Other tools and this workspace on the prism mast, in one run on one machine.

    python3 benchmarks/peers/run.py --write

makes a virtual environment in target/bench with the versions of requirements.txt (a few hundred MB; --python names an
interpreter that has them already), lets `cargo xtask` write the scene and its converged trajectory, runs all tools in
turn, twice, and prints error against time for each size, then the ten lowest modes; --write puts the tables into
docs/performance.md. Takes about ten minutes.
"""

import argparse
import subprocess
import venv

from errors import tables
from modes import modes_table
from page import insert, machine
from workspace import HERE, target_folder


def interpreter(given):
    """A Python that has the tools."""
    if given:
        return given
    folder = target_folder() / "bench" / "peers"
    python = folder / "bin" / "python"
    if not python.exists():
        venv.create(folder, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
    return python


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", help="an interpreter that has the tools")
    parser.add_argument("--floor", help="source of the floor program (cargo xtask bench --help)")
    parser.add_argument("--stages", type=int, nargs="+", default=[2, 8, 32, 128])
    parser.add_argument("--limit", type=float, default=4.0, help="seconds of a run after which a curve ends")
    parser.add_argument("--passes", type=int, default=2)
    parser.add_argument("--only", choices=["errors", "modes"], help="one of the two comparisons")
    parser.add_argument("--write", action="store_true", help="write the tables into docs/performance.md")
    arguments = parser.parse_args()
    python = interpreter(arguments.python)
    sizes, passes = arguments.stages, arguments.passes
    if arguments.only != "modes":
        parts = [f"Measured on: {machine()}; runs of about {arguments.limit:g} s at most, passes: {passes}.\n"]
        for text in tables(python, sizes, arguments.limit, passes, arguments.floor):
            print(text + "\n", flush=True)
            parts.append(text + "\n")
        if arguments.write:
            insert("peers", "\n".join(parts))
    if arguments.only != "errors":
        text = f"Measured on: {machine()}; passes: {passes}.\n\n{modes_table(python, sizes, passes)}"
        print(text, flush=True)
        if arguments.write:
            insert("modes", text)


if __name__ == "__main__":
    main()
