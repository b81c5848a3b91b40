"""Quantities in plain words: `0.6 m`, `0,6 m`, `6e-1 m`, `600 millimetres`, `60 feet`, `two thirds of a metre`, `900 °C`, `2 m/s²`.

A unit is a scale to SI and a dimension: the exponents of kilogram, metre, second, kelvin and ampere. Angles and shares are left out:
they are often shown by lengths and counts.
"""

import html
import re
import unicodedata
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

Dimension = tuple[int, int, int, int, int]
NONE: Dimension = (0, 0, 0, 0, 0)
KG, M, S, K, A = ((1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0), (0, 0, 0, 1, 0), (0, 0, 0, 0, 1))


class Unit(NamedTuple):
    """Its scale to SI, and its dimension."""

    scale: float
    dimension: Dimension

    def times(self, other: "Unit", power: int = 1) -> "Unit":
        """The unit that is this one times another to a power."""
        return Unit(
            self.scale * other.scale**power,
            tuple(a + power * b for a, b in zip(self.dimension, other.dimension, strict=True)),  # type: ignore[arg-type]
        )


ONE = Unit(1.0, NONE)


class Quantity(NamedTuple):
    """What a text says: its words, and the values that they may mean, each with its dimension."""

    said: str
    meant: tuple[tuple[float, Dimension], ...]


PREFIXES = {
    "k": 1e3,
    "h": 1e2,
    "d": 1e-1,
    "c": 1e-2,
    "m": 1e-3,
    "u": 1e-6,
    "μ": 1e-6,
    "n": 1e-9,
    "M": 1e6,
    "G": 1e9,
    "": 1.0,
}
SPELLED = {"kilo": 1e3, "hecto": 1e2, "deci": 1e-1, "centi": 1e-2, "milli": 1e-3, "micro": 1e-6, "nano": 1e-9, "mega": 1e6, "giga": 1e9, "": 1.0}  # fmt: skip
FORCE, ENERGY = (1, 1, -2, 0, 0), (1, 2, -2, 0, 0)
POWER, PRESSURE = (1, 2, -3, 0, 0), (1, -1, -2, 0, 0)
METRIC: dict[str, tuple[str, Unit]] = {
    "m": ("metre meter", Unit(1, M)),
    "g": ("gram gramme", Unit(1e-3, KG)),
    "s": ("second", Unit(1, S)),
    "N": ("newton", Unit(1, FORCE)),
    "J": ("joule", Unit(1, ENERGY)),
    "W": ("watt", Unit(1, POWER)),
    "Pa": ("pascal", Unit(1, PRESSURE)),
    "Hz": ("hertz", Unit(1, (0, 0, -1, 0, 0))),
    "V": ("volt", Unit(1, (1, 2, -3, 0, -1))),
    "A": ("ampere amp", Unit(1, A)),
    "T": ("tesla", Unit(1, (1, 0, -2, 0, -1))),
    "l": ("litre liter", Unit(1e-3, (0, 3, 0, 0, 0))),
    "L": ("litre liter", Unit(1e-3, (0, 3, 0, 0, 0))),
}
"""By symbol: its names, and the unit; each with every prefix."""
OTHERS: dict[str, Unit] = {
    **dict.fromkeys(("min", "mins", "minute", "minutes"), Unit(60, S)),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), Unit(3600, S)),
    **dict.fromkeys(("day", "days"), Unit(86400, S)),
    **dict.fromkeys(("micron", "microns"), Unit(1e-6, M)),
    **dict.fromkeys(("inch", "inches"), Unit(0.0254, M)),
    **dict.fromkeys(("ft", "foot", "feet"), Unit(0.3048, M)),
    **dict.fromkeys(("yd", "yds", "yard", "yards"), Unit(0.9144, M)),
    **dict.fromkeys(("mi", "mile", "miles"), Unit(1609.344, M)),
    **dict.fromkeys(("mph",), Unit(0.44704, (0, 1, -1, 0, 0))),
    **dict.fromkeys(("kph", "kmh"), Unit(1 / 3.6, (0, 1, -1, 0, 0))),
    **dict.fromkeys(("rpm",), Unit(1 / 60, (0, 0, -1, 0, 0))),
    **dict.fromkeys(("mps",), Unit(1, (0, 1, -1, 0, 0))),
    **dict.fromkeys(("kt", "knot", "knots"), Unit(0.514444, (0, 1, -1, 0, 0))),
    **dict.fromkeys(("t", "ton", "tons", "tonne", "tonnes"), Unit(1000, KG)),
    **dict.fromkeys(("kilo", "kilos"), Unit(1, KG)),
    **dict.fromkeys(("lb", "lbs", "pound", "pounds"), Unit(0.45359, KG)),
    **dict.fromkeys(("oz", "ounce", "ounces"), Unit(0.02835, KG)),
    **dict.fromkeys(("bar", "bars"), Unit(1e5, PRESSURE)),
    **dict.fromkeys(("atm", "atmosphere", "atmospheres"), Unit(101325, PRESSURE)),
    **dict.fromkeys(("psi",), Unit(6894.76, PRESSURE)),
    **dict.fromkeys(("K", "kelvin", "kelvins"), Unit(1, K)),
    **dict.fromkeys(("°C", "degrees celsius", "degree celsius", "celsius", "degrees centigrade"), Unit(1.0, K)),
    **dict.fromkeys(("°F", "degrees fahrenheit", "degree fahrenheit", "fahrenheit"), Unit(5 / 9, K)),
}
ZERO_K = {1.0: 273.15, 5 / 9: 255.372}
"""What is no difference of temperatures, in these scales, lies so much higher, K."""


def _units() -> dict[str, Unit]:
    found = dict(OTHERS)
    for symbol, (names, unit) in METRIC.items():
        found.update({prefix + symbol: Unit(unit.scale * by, unit.dimension) for prefix, by in PREFIXES.items()})
        for name, (prefix, by) in product(names.split(), SPELLED.items()):
            found.update(dict.fromkeys((prefix + name, prefix + name + "s"), Unit(unit.scale * by, unit.dimension)))
    return found | {"min": OTHERS["min"], "ft": OTHERS["ft"], "kt": OTHERS["kt"]}


UNITS = _units()
ANYHOW = {one.lower(): unit for one, unit in UNITS.items() if len(one) > 3} | {
    one.lower(): UNITS[one] for one in ("m", "km", "cm", "mm", "s", "ms", "kg", "g", "N", "kN", "Pa", "kPa", "Hz", "kHz", "°C", "°F", "l")
}  # fmt: skip
"""By small letters, where capitals tell nothing."""
ONES = {word: float(number) for number, word in enumerate(
    ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"]
)}  # fmt: skip
TENS = {
    word: 10.0 * (2 + n)
    for n, word in enumerate(["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"])
}
MANY = {"hundred": 1e2, "thousand": 1e3, "million": 1e6, "dozen": 12.0}
PARTS = {"half": 0.5, "halves": 0.5} | {
    word + end: 1.0 / by
    for word, by in (("third", 3), ("quarter", 4), ("fifth", 5), ("sixth", 6), ("eighth", 8), ("tenth", 10), ("hundredth", 100))
    for end in ("", "s")
}  # fmt: skip
ON_FEET = 8
"""`On its two feet`: in words no length up to so many."""

_ANY = "|".join(sorted(map(re.escape, {*UNITS, *ANYHOW}), key=len, reverse=True))
_ONE = rf"(?:{_ANY})(?![^\W\d_])"
_POWER = r"(?:\^?(-?[1-3]))?"
UNIT = re.compile(
    rf"(?:(?P<over>square|cubic)\s+)?(?P<first>{_ONE}){_POWER}"
    rf"(?P<more>(?:(?:\s?[/·⋅*]\s?|\s+per\s+(?:square\s+|cubic\s+)?|(?<=[Ng])\s(?=[ms]\b)|\s+an?\s+(?=hour)){_ONE}{_POWER})*)(?![\w^])",
    re.IGNORECASE,
)
MORE = re.compile(
    rf"(\s?[/·⋅*]\s?|\s+per\s+(?:square\s+|cubic\s+)?|\s+an?\s+|\s)({_ONE}){_POWER}",
    re.IGNORECASE,
)
FIGURES = re.compile(
    r"(?<![\w.,^])(?:(?P<mixed>\d+) (?=\d+/\d))?(?P<whole>\d{1,3}(?: \d{3})+(?![\d])|\d+(?:[.,]\d+)*|[.,]\d+)(?P<power>e[+-]?\d+|\s?[x×·⋅*]\s?10\^[+-]?\d+)?"
    r"(?:\s?/\s?(?P<under>\d+))?(?:\s?-\s?|\s*)(?:of\s+an?\s+)?",
    re.IGNORECASE,
)
_WORD = "|".join(sorted({*ONES, *TENS, *MANY, *PARTS}, key=len, reverse=True))
WORDS = re.compile(
    rf"\b(?P<words>(?:an?\s+)?(?:{_WORD})(?:(?:\s+and\s+|\s+point\s+|\s+|-)(?:an?\s+)?(?:{_WORD}))*)\b[\s-]+(?:of\s+)?(?:an?\s+)?"
    r"|\b(?P<one>an?)\s+(?=[a-z]*metre\b|[a-z]+meter\b|mile\b)",
    re.IGNORECASE,
)


def quantities(text: str) -> Iterator[Quantity]:
    """Each quantity that a text of Markdown says, in order of how it is written: in figures, then in words."""
    plain = _plain(text)
    for found in FIGURES.finditer(plain):
        values = _figures(found["whole"], found["power"], found["under"])
        more = float(found["mixed"] or 0)
        yield from _with_unit(plain, found, tuple(more + value for value in values), found.end())
    for found in WORDS.finditer(plain):
        value = 1.0 if found["one"] else _words(found["words"])
        if value > ON_FEET or not re.match(r"f(ee|oo)t", plain[found.end() :], re.IGNORECASE):
            yield from _with_unit(plain, found, (value,), found.end())


def _plain(text: str) -> str:
    """Without marks of Markdown, entities, other forms of letters, and raised figures."""
    raised = re.sub("[⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda found: "^" + found[0], html.unescape(text))
    spaced = re.sub("(?<=[0-9])(?=[¼-¾⅐-⅞])", " ", raised)
    plain = unicodedata.normalize("NFKC", spaced).translate({0x2212: "-", 0x2044: "/", 0x2011: "-", 0x2010: "-"})
    plain = "".join(letter for letter in plain if unicodedata.category(letter) != "Cf")
    return re.sub(r"(?<!\w)[*_`~]+|[*_`~]+(?!\w)", "", plain.replace("**", "").replace("\\", ""))


def _with_unit(plain: str, found: re.Match[str], values: tuple[float, ...], end: int) -> Iterator[Quantity]:
    unit = UNIT.match(plain, end)
    if unit is None or not values or _unit(unit["first"]) is None:
        return
    power = {"square": 2, "cubic": 3}.get((unit["over"] or "").lower(), 1)
    whole = ONE.times(_unit(unit["first"]) or ONE, int(unit[3] or power))
    for link, name, raised in MORE.findall(unit["more"]):
        inner = 2 if "square" in link else 3 if "cubic" in link else 1
        under = "/" in link or "per" in link.lower() or link.strip().lower() in ("a", "an")
        whole = whole.times(_unit(name) or ONE, int(raised or inner) * (-1 if under else 1))
    meant = [(value * whole.scale, whole.dimension) for value in values]
    if whole.dimension == K and "K" not in unit["first"] and "elvin" not in unit["first"]:
        meant += [(value + ZERO_K.get(whole.scale, 0.0), K) for value, _ in meant]
    yield Quantity(plain[found.start() : unit.end()], tuple(meant))


def _unit(name: str) -> Unit | None:
    """None where the capitals are another's: `3 a` is no current."""
    return UNITS.get(name) or ANYHOW.get(name.lower())


def _figures(whole: str, power: str | None, under: str | None) -> tuple[float, ...]:
    """The numbers that figures may mean: a comma may stand before a fraction or between thousands."""
    bare = whole.replace(" ", "")
    ways = {bare if "." in bare else bare.replace(",", "."), bare.replace(".", "").replace(",", ".")}
    if re.fullmatch(r"\d{1,3}(,\d{3})+(\.\d*)?", bare):
        ways.add(bare.replace(",", ""))
    if "," not in bare and bare.count(".") < 2:
        ways = {bare}
    by = float("1e" + re.sub(r".*10\^|^e", "", power.strip().lower())) if power else 1.0
    values = []
    for way in sorted(ways):
        try:
            values.append(float(way) * by / float(under or 1))
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
    return tuple(values)


def _words(words: str) -> float:
    """`two and a half`, `two thirds`, `twenty-five`, `three hundred`, `a quarter`."""
    total, group, place = 0.0, 0.0, 0.0
    for word in re.split(r"[\s-]+", words.lower()):
        if word == "point":
            place = 0.1
        elif place and word in ONES:
            group, place = group + place * ONES[word], place / 10
        elif word == "and":
            total, group = total + group, 0.0
        elif word in PARTS or word in MANY:
            group = (PARTS.get(word) or MANY[word]) * (group or 1.0)
        elif word not in ("a", "an"):
            group += ONES.get(word) or TENS.get(word) or 0.0
    return total + group
