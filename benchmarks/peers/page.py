"""Tables in docs/performance.md."""

import datetime
import os
import subprocess
from pathlib import Path

from workspace import HERE, ROOT

PAGE = ROOT / "docs" / "performance.md"


def digits(x):
    return "–" if x is None else f"{x:.1e}" if x < 1e-3 else f"{x:.2g}" if x < 100 else f"{x:.0f}"


def table(header, rows):
    """Markdown, the first column to the left."""
    lines = [f"| {' | '.join(header)} |", "|---|" + "---:|" * (len(header) - 1)]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows])


def machine():
    """One line: processor, cores, versions, date."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.split(": ")[1] for line in lines if line.startswith("model name")), "unknown processor")
    rustc = subprocess.check_output(["rustc", "--version"], text=True).strip()
    versions = ", ".join((HERE / "requirements.txt").read_text().split())
    return f"{model}, {os.cpu_count()} cores; {rustc}; {versions}; {datetime.date.today()}"


def insert(part, text):
    """Replaces what stands between the markers of a part of the page."""
    start, end = f"<!-- {part}: generated -->\n", f"<!-- {part}: end -->"
    before, rest = PAGE.read_text().split(start)
    after = rest.split(end)[1]
    PAGE.write_text(f"{before}{start}\n{text.strip()}\n\n{end}{after}")
