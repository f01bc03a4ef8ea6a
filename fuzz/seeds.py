"""Writes the seeds of a fuzz target into a folder, taken out of the scenes and of the tests."""

import json
import pathlib
import re
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TESTS = ROOT / "crates" / "tg-scene" / "tests" / "it"
STRING = r'"(?:[^"\\]|\\.)*"'


def scenes():
    """The scenes, and every malformed text of the tests, taken out of their macros."""
    texts = [path.read_text() for path in sorted((ROOT / "scenes").iterdir()) if path.suffix in (".toml", ".json")]
    good = {name: (TESTS / "data" / file).read_text() for name, file in
            [("Toml", "good.toml"), ("Json", "good.json"), ("Space", "space.toml")]}
    texts += good.values()
    for path in sorted((TESTS / "malformed").glob("*.rs")):
        source = path.read_text()
        for language, old, new in re.findall(rf"wrong!\(\s*\w+,\s*(\w+),\s*({STRING}) => ({STRING})", source):
            texts.append(good[language].replace(json.loads(old), json.loads(new)))
        texts += [json.loads(text) for text in re.findall(rf"whole ({STRING})", source)]
    return [text.encode() for text in texts]


def constants(name):
    """The string constants of a test of imports: a raw string, or one whose first line break is escaped."""
    source = (TESTS / "import" / name).read_text()
    found = re.findall(rf'const (\w+): &str = (?:r#"(.*?)"#|({STRING}));', source, re.DOTALL)
    plain = lambda text: json.loads(re.sub(r"\\\n\s*", "", text).replace("\n", "\\n")) if text else ""
    return {constant: raw or plain(text) for constant, raw, text in found}


def imports():
    """A byte for the format, then the text; tables are parted by the byte 0."""
    tables = constants("triples.rs")
    seeds = [b"\0" + b"\0".join(tables[table].encode() for table in ("NODES", "BARS", "CABLES"))]
    seeds += [b"\1" + text.encode() for text in constants("ntrt.rs").values()]
    return seeds + [b"\2" + text.encode() for text in constants("neutral.rs").values()]


def folders():
    """A byte for the file, then its content; checksums are zero under `cfg(fuzzing)`."""
    manifest = {
        "format": "tensegrity-results", "version": 2, "kind": "run", "title": "A mast", "complete": False,
        "interrupted": "now", "channels": [{"name": "time", "unit": "s", "group": "time"},
                                            {"name": "guy.tension", "unit": "N", "group": "tension"}],
        "documents": ["modes"], "settings": {"step": 1e-3}, "warnings": ["none"], "frames": 2, "crc32": 0,
    }
    point = {"position": [0.0, 1.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]}
    cable = {"ends": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "tension": 5.0, "length": 2.2, "rest": 2.1, "slack": False}
    frame = {"time": 1.0, "poses": [point], "cables": [cable], "crc32": 0}
    shape = {"label": "a", "stable": True, "energy": 1.0, "frame": frame}
    mode = {"label": "mode 1", "frequency": 1.0, "damping": None, "vertices": [[0, 0, 0], [0, 1, 0]],
            "ends": [[[0, 0, 0], [0, 1, 0]]]}
    parts = {"parts": [{"part": 0, "rows": 3, "checksum": 0}], "crc32": 0}
    state = {"rows": 3, "frames": 2, "last": 2.0, "value": {"method": {}, "state": {"t": 1.0, "q": [1, 2]}}, "crc32": 0}
    line = lambda value: json.dumps(value, separators=(",", ":")).encode() + b"\n"
    journal = b"TGJOURN2" + bytes([1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0]) + bytes(20) * 3
    files = [line(manifest), line(parts), bytes(3), journal, line(frame) * 2, line(state),
             line({"reference": frame, "list": [mode]}), line([shape]), line([])]
    return [bytes([number]) + content for number, content in enumerate(files)]


def states():
    """A byte for the scheme; two for a place and eight for its number. Place 0 is the time, those at the end are memory."""
    numbers = [0.0, -1.0, 1e-300, 1e16, 1e300, 0.5]
    edits = [struct.pack("<Hd", 7 * place, number) for place, number in enumerate(numbers)]
    return [bytes([scheme]) + b"".join(edits[:count]) for scheme in range(8) for count in range(len(edits) + 1)]


target, corpus = sys.argv[1], pathlib.Path(sys.argv[2])
seeds = {"scene": scenes, "import": imports, "folder": folders, "state": states}[target]()
for number, seed in enumerate(seeds):
    (corpus / f"seed-{number:03}").write_bytes(seed)
print(f"{target}: {len(seeds)} seeds")
