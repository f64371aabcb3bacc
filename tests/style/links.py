#!/usr/bin/env python3
"""Every link from a page to a place in this repository leads somewhere."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def anchors(page):
    """The places in a page that its headings make."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


broken = []
pages = [page for page in ROOT.rglob("*.md") if ".build" not in page.parts]
for page in pages:
    for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if "://" not in link and (not target.exists() or anchor and anchor not in anchors(target)):
            broken.append(f"{page.relative_to(ROOT)}: {link} is not there")
print("\n".join(broken) or f"{len(pages)} pages, every link leads somewhere")
sys.exit(bool(broken))
