"""The table that closes a run of CI: `python3 .ci/table.py FOLDER` prints it, and exits with 1 if a part failed.

FOLDER holds `parts` (a line each: name, exit code, seconds), `NAME.log` (all that the part printed) and, for test suites,
`NAME.xml` (what pytest found, in JUnit's form). A name with a dash before it is no suite. A suite without results failed.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

MOST = 40
"""So many failures of a part are named; the log has all of them."""
WIDE = 200
SLOWEST, LONG_S = 8, 20.0
"""So many of the slowest tests are named; none should take longer than that on an idle machine."""


def cases(report: Path) -> list[ElementTree.Element]:
    """The tests of a JUnit report; none if it is missing or was cut off."""
    try:
        return list(ElementTree.parse(report).getroot().iter("testcase"))
    except (OSError, ElementTree.ParseError):
        return []


def failures(found: list[ElementTree.Element]) -> list[str]:
    """Name and first error line of each test that failed."""
    named = []
    for case in found:
        for outcome in (*case.iter("failure"), *case.iter("error")):
            lines = (outcome.get("message") or outcome.text or "").strip().splitlines() or ["no message"]
            named.append(f"{case.get('classname')}::{case.get('name')}: {lines[0]}")
            break
    return named


def first_error(log: Path) -> str:
    """The line of a log that best says why a command without results of its own failed."""
    lines = [line.strip() for line in log.read_text(errors="replace").splitlines()] if log.exists() else []
    said = [line for line in lines if line]
    telling = [line for line in said if "error" in line.lower() or line.startswith("Would reformat")]
    return (telling or said or ["it printed nothing"])[0]


def slowest(folder: Path) -> list[str]:
    """The tests that took longest, of all suites; what takes long is the machine's affair too, so none fails by it."""
    taken = [(float(case.get("time") or 0), case) for report in folder.glob("*.xml") for case in cases(report)]
    taken.sort(key=lambda row: -row[0])
    over = sum(seconds > LONG_S for seconds, _ in taken)
    lines = [
        f"{seconds:7.1f} s  {case.get('classname')}::{case.get('name')}"[:WIDE] for seconds, case in taken[:SLOWEST]
    ]
    return [f"slowest ({over} over {LONG_S:.0f} s):", *lines] if taken else []


def main(folder: Path) -> int:
    """Print the table; the exit code."""
    told, bad = [], False
    parts = [line.split() for line in (folder / "parts").read_text().splitlines()]
    wide = max([14, *(len(name) + 2 for name, _, _ in parts)])
    print(f"\n{'part':<{wide}}{'ok':>8}{'failed':>8}{'skipped':>9}{'seconds':>9}")
    for name, code, seconds in parts:
        suite, name = not name.startswith("-"), name.lstrip("-")
        found = cases(folder / f"{name}.xml")
        wrong = failures(found)
        if not wrong and (code != "0" or (suite and not found)):
            wrong = [f"exit code {code}: {first_error(folder / f'{name}.log')}"]
        skipped = sum(case.find("skipped") is not None for case in found)
        good = sum(
            len(case) == 0 or all(part.tag.startswith("system-") or part.tag == "properties" for part in case)
            for case in found
        )
        counts = (good, len(wrong), skipped) if suite else ("", "yes" if wrong else "no", "")
        print(f"{name:<{wide}}{counts[0]:>8}{counts[1]:>8}{counts[2]:>9}{seconds:>9}")
        told += [f"{name}: {line}"[:WIDE] for line in wrong[:MOST]]
        told += [f"{name}: and {len(wrong) - MOST} more"] if len(wrong) > MOST else []
        bad = bad or bool(wrong)
    print("\n".join(["", *told, *slowest(folder)]))
    return int(bad)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
