# SPDX-License-Identifier: Apache-2.0
"""Links of pages that lead nowhere."""
import re

CODE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


def anchors(page):
    """The parts of a page that a link can name: headings, as Markdown readers make names of them."""
    headings = re.findall(r"^#+ (.*)$", CODE.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken(pages):
    """`page: target` of each link of `pages` whose file, or part of a page, is not there."""
    found = []
    for page in pages:
        for target, part in re.findall(r"\]\(([^)#]*)(?:#([^)]*))?\)", CODE.sub("", page.read_text(encoding="utf-8"))):
            if "://" in target or target.startswith("mailto:"):
                continue
            place = page.parent / target if target else page
            if not place.exists() or (part and part not in anchors(place)):
                found.append(f"{page.name}: {target}#{part}" if part else f"{page.name}: {target}")
    return found
