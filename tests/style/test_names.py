#!/usr/bin/env python3
"""Every test has a name of its own: of two of one name, one would have the labels of both."""
import collections
import pathlib
import re
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
HEAD = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.M)

places = collections.defaultdict(list)
for file in sorted(TESTS.rglob("*.cpp")):
    for suite, name in HEAD.findall(file.read_text()):
        places[f"{suite}.{name}"].append(str(file.relative_to(TESTS)))
twins = {name: files for name, files in places.items() if len(files) > 1}
for name, files in twins.items():
    print(f"{name}: two tests of one name, in {' and '.join(files)}")
print(f"{len(places)} names of tests")
sys.exit(bool(twins))
