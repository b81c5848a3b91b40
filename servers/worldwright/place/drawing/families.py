"""Find things alike by name: `glass_1` … `glass_8` are one family, of one colour and named once in a crowd."""

import re
from collections import defaultdict
from collections.abc import Iterable

CROWD = 40
"""With more names than this, families are named once."""
_COUNTED = re.compile(r"(?:_(?:\d+[a-z]?|[a-z]\d*)|\d+)$")


def stem(name: str) -> str:
    """A name without its counting endings: `tree_a_11` is a `tree`."""
    while (shorter := _COUNTED.sub("", name)) != name and shorter:
        name = shorter
    return name


def captions(names: Iterable[str], marked: Iterable[str]) -> dict[str, str]:
    """The words at each named object: at all of a few; in a crowd, at one of each family and at all that are marked."""
    listed, marked = list(names), set(marked)
    if len(listed) <= CROWD:
        return {name: name for name in listed}
    families: dict[str, list[str]] = defaultdict(list)
    for name in listed:
        families[stem(name)].append(name)
    found = {name: name for name in listed if name in marked}
    for family, members in families.items():
        free = [name for name in members if name not in marked]
        if len(members) < 3:
            found |= {name: name for name in free}
        elif free:
            found[free[0]] = f"{family} ×{len(members)}"
    return found
