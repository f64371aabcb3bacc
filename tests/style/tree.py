#!/usr/bin/env python3
"""Prints the figures of the source tree and fails where one is beyond its limit, naming each place.

A folder is one library (palp_library in its CMakeLists.txt). It includes what it links and links what
it includes: PUBLIC what its headers include, PRIVATE what only its sources do. Folders form no circle,
nor do files, a header and its source taken as one; no layer includes one above it.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYERS = ["haptics", "calibration", "pipeline", "data", "app"]  # each may include those before it
SUFFIXES = {".h", ".cpp", ".cxx"}
MOST_FILES = 25  # of production code in a folder
MOST_LINES = 350  # of a file
MOST_BODY = 60  # lines of a function's body
MOST_COMMENT = 3  # lines in a row; what a header documents may take more
MOST_README = 120  # lines
# of calibration, what pictures may know; the finite elements stay off line
RUN_TIME_CALIBRATION = {"calibration/tables", "calibration/figures"}


def sources(*roots):
    for root in roots:
        for path in sorted((ROOT / root).rglob("*")):
            if path.suffix in SUFFIXES:
                yield path


def folder(path):
    return path.parent.relative_to(ROOT).as_posix()


def included(path):
    """What is included of the tree, in whatever brackets, and whatever else stands in quotes."""
    inside = "|".join(LAYERS + ["tests"])
    found = re.findall(rf'^\s*#\s*include\s*(?:"([^"]+)"|<((?:{inside})/[^>]+)>)', path.read_text(), re.M)
    return [quoted or angled for quoted, angled in found]


def calls(text, function):
    """The words of every call of a CMake function, variables of the same file put in."""
    text = re.sub(r"#.*", "", text)
    for name, value in re.findall(r"\bset\((\w+)\s+([^)]*)\)", text):
        text = text.replace("${" + name + "}", value)
    for match in re.finditer(rf"\b{function}\(([^)]*)\)", text):
        yield re.split(r"[\s,<>]+", match[1])


def section(words, keyword):
    """What follows a keyword, up to the next one."""
    found, inside = set(), False
    for word in words:
        if word in ("SOURCES", "PUBLIC", "PRIVATE"):
            inside = word == keyword
        elif inside and word.startswith("palp::"):
            found.add(word.removeprefix("palp::"))
    return found


def libraries():
    """(name, folder, files or None, public, private) of each palp_library."""
    for path in sorted(ROOT.rglob("CMakeLists.txt")):
        if ".build" in path.parts or folder(path).split("/")[0] not in LAYERS:
            continue
        for words in calls(path.read_text(), "palp_library"):
            files = [(path.parent / word).resolve() for word in words if pathlib.Path(word).suffix in SUFFIXES]
            yield words[0], folder(path), files, section(words, "PUBLIC"), section(words, "PRIVATE")


def check_links(found):
    """What libraries include against what they link."""
    home = {}
    for name, where, files, _, _ in found:
        for file in files:
            home.setdefault(file.relative_to(ROOT).as_posix(), set()).add(name)
    everywhere = {where for _, where, _, _, _ in found}
    errors = []
    for name, where, files, public, private in found:
        used = {True: set(), False: set()}
        for file in files:
            for target in included(file):
                if target not in home:
                    if str(pathlib.Path(target).parent) not in everywhere | {"app"}:
                        errors.append(f"{file.relative_to(ROOT)}: includes {target}, of no library")
                elif name not in home[target]:
                    used[file.suffix == ".h"].add(frozenset(home[target]))
        for header, linked, word in ((True, public, "PUBLIC"), (False, private, "PRIVATE")):
            needed = used[header] if header else used[False] - used[True]
            for homes in needed:
                if not homes & linked and homes != {name}:
                    errors.append(f"{where}: palp::{name} includes {'|'.join(sorted(homes))}; "
                                  f"it must be {word} there")
            for library in linked:
                if not any(library in homes for homes in needed):
                    errors.append(f"{where}: palp::{name} links palp::{library} as {word} but "
                                  f"{'no header' if header else 'no source alone'} includes it")
    return errors


def graph(name_of, *roots):
    """Which folder or file, by the name of a path, includes which other, with a file that does."""
    arrows = {}
    for path in sources(*roots):
        place = path.relative_to(ROOT)
        for target in included(path):
            start, end = name_of(place), name_of(pathlib.PurePosixPath(target))
            if end != start:
                arrows.setdefault(start, {}).setdefault(end, place.as_posix())
    return arrows


def circles(arrows):
    """Those that reach themselves."""
    def reached(start):
        seen, todo = set(), list(arrows.get(start, ()))
        while todo:
            here = todo.pop()
            if here not in seen:
                seen.add(here)
                todo += arrows.get(here, ())
        return seen
    return [name for name in arrows if name in reached(name)]


def stray_links(found):
    """Links of libraries beside palp_library, which nothing would compare with their includes."""
    names = {f"palp_{name}" for name, *_ in found}
    for path in sorted(ROOT.rglob("CMakeLists.txt")):
        if ".build" not in path.parts:
            for words in calls(path.read_text(), "target_link_libraries"):
                if words[0] in names and any(word.startswith("palp::") for word in words[1:]):
                    yield f"{folder(path)}: {words[0]} links beside palp_library"


def scripts():
    for path in sorted(ROOT.rglob("*")):
        hidden = any(part.startswith(".") for part in path.relative_to(ROOT).parts)
        if path.is_file() and not hidden and path.suffix in ("", ".txt", ".cmake", ".in", ".sh"):
            yield path


def upward(arrows):
    found = []
    for start, ends in arrows.items():
        for end, file in ends.items():
            low, high = start.split("/")[0], end.split("/")[0]
            if high not in LAYERS:
                found.append(f"{file} includes what lies in {end}, no layer: name it from the root")
                continue
            forbidden = low == "pipeline" and high == "calibration" and end not in RUN_TIME_CALIBRATION
            if forbidden or LAYERS.index(high) > LAYERS.index(low):
                found.append(f"{file} includes {end}")
    return found


def bodies(path):
    """Lines of each function's body, by its first line; functions begin with a brace of their own."""
    start = None
    lines = path.read_text().splitlines()
    for number, line in enumerate(lines):
        indent = re.match(r"( {0,8})\{$", line)
        if indent and start is None:
            head = lines[number - 1]
            first = number - 1
            while first > 0 and lines[first - 1].strip() and not lines[first - 1].rstrip().endswith((";", "}", "{", ":", ">")):
                first -= 1
            opening = " ".join(re.sub(r"^\s*(///?|\*).*|//.*", "", line) for line in lines[first:number])
            if "(" in opening and not re.match(r"\s*(namespace|struct|class|enum|union)\b", opening):
                start = (number, indent[1], first)
        elif start and re.match(rf"{start[1]}\}}(\(.*\))?;?$", line):
            yield number - start[0] - 1, f"{path.relative_to(ROOT)}:{start[2] + 1}"
            start = None


def comments(path):
    """Lines of each run of whole-line comments, without those that document a header."""
    run, block = 0, False
    sign = r"\s*//(?!/)" if path.suffix == ".h" else r"\s*//" if path.suffix in SUFFIXES else r"\s*#(?!!)"
    opening = r"\s*/\*(?!\*)" if path.suffix == ".h" else r"\s*/\*"
    for number, line in enumerate(path.read_text().splitlines() + [""]):
        begins = path.suffix in SUFFIXES and re.match(opening, line)
        if block or begins or re.match(sign, line):
            run += 1
            block = "*/" not in line and bool(block or begins)
        elif run:
            yield run, f"{path.relative_to(ROOT)}:{number - run + 1}"
            run = 0


def longest(found, limit):
    """The largest value, and each that is beyond the limit with its place; the largest one if none is."""
    found = sorted(found, reverse=True)
    beyond = [one for one in found if one[0] > limit]
    if len(beyond) < 2:
        return found[0][0], found[0][1]
    return found[0][0], "\n  ".join([""] + [f"{value} {place}" for value, place in beyond])


def main():
    found = list(libraries())
    arrows = graph(lambda path: path.parent.as_posix(), *LAYERS)
    sizes = {}
    for path in sources(*LAYERS):
        sizes.setdefault(folder(path), []).append(path)
    files = [(len(paths), name) for name, paths in sizes.items()]
    everything = list(sources(*LAYERS, "tests"))
    lines = [(len(path.read_text().splitlines()), path.relative_to(ROOT).as_posix()) for path in everything]
    readme = len((ROOT / "README.md").read_text().splitlines())
    links = check_links(found) + list(stray_links(found))
    loops = circles(graph(lambda path: path.parent.as_posix(), *LAYERS, "tests"))
    up = upward(arrows)
    pairs = circles(graph(lambda path: path.with_suffix("").as_posix(), *LAYERS, "tests"))

    rows = [
        ("folders", (len(sizes), ""), None),
        ("files in the largest folder", longest(files, MOST_FILES), MOST_FILES),
        ("folders in a circle", (len(loops), ", ".join(loops)), 0),
        ("files in a circle", (len(pairs), ", ".join(pairs)), 0),
        ("includes that point up", (len(up), "; ".join(up)), 0),
        ("includes across a wall", (len(links), "\n  ".join([""] + links)), 0),
        ("lines of the longest function",
         longest((body for path in everything for body in bodies(path)), MOST_BODY), MOST_BODY),
        ("lines of the longest file", longest(lines, MOST_LINES), MOST_LINES),
        ("lines of the longest comment",
         longest((run for path in [*everything, *scripts()] for run in comments(path)), MOST_COMMENT), MOST_COMMENT),
        ("lines of README.md", (readme, ""), MOST_README),
    ]
    failed = False
    for name, (value, where), limit in rows:
        beyond = limit is not None and value > limit
        failed |= beyond
        print(f"{name:32}{value:6}" + ("" if limit is None else f"  of {limit}") +
              ("  BEYOND ITS LIMIT" if beyond else "") + (f"  {where}" if where else ""))
    return failed


if __name__ == "__main__":
    sys.exit(main())
