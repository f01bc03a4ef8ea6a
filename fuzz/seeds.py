"""Writes the fuzzer's seeds into a folder: the scenes, and every malformed text of the tests, taken out of their macros."""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TESTS = ROOT / "crates" / "tg-scene" / "tests" / "it"
STRING = r'"(?:[^"\\]|\\.)*"'

corpus = pathlib.Path(sys.argv[1])
texts = [path.read_text() for path in sorted((ROOT / "scenes").iterdir()) if path.suffix in (".toml", ".json")]
good = {name: (TESTS / "data" / file).read_text() for name, file in
        [("Toml", "good.toml"), ("Json", "good.json"), ("Space", "space.toml")]}
texts += good.values()
for path in sorted((TESTS / "malformed").glob("*.rs")):
    source = path.read_text()
    for language, old, new in re.findall(rf"wrong!\(\s*\w+,\s*(\w+),\s*({STRING}) => ({STRING})", source):
        texts.append(good[language].replace(json.loads(old), json.loads(new)))
    texts += [json.loads(text) for text in re.findall(rf"whole ({STRING})", source)]
for number, text in enumerate(texts):
    (corpus / f"seed-{number:03}").write_text(text)
print(f"{len(texts)} seeds")
