#!/usr/bin/env python3
"""Every type has a name of its own in its namespace: of two of one name, the linker takes the destructor
of one for both. Those of anonymous namespaces are their sources' own."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*)\n\{|^\} // namespace|"
                   r"^(?:struct|class|enum|enum class) (?:\[\[\w+\]\] )?(\w+)(?: final)?(?: :.*)?\n[{ ]", re.M)

places = collections.defaultdict(set)
for folder in ("haptics", "calibration", "pipeline", "data", "app"):
    for file in sorted((ROOT / folder).rglob("*")):
        if file.suffix not in (".h", ".cpp", ".cxx"):
            continue
        spaces = []
        for found in SPACE.finditer(file.read_text()):
            if found[0].startswith("}"):
                spaces.pop()
            elif found[2] is None:
                spaces.append(found[1])
            elif "" not in spaces:
                places["::".join([*spaces, found[2]])].add(str(file.relative_to(ROOT)))
twins = {name: files for name, files in places.items() if len(files) > 1}
for name, files in twins.items():
    print(f"{name}: two types of one name, in {' and '.join(sorted(files))}")
print(f"{len(places)} names of types")
sys.exit(bool(twins))
