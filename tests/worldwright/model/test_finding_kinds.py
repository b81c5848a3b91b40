"""Lines for what a scan found: each blocking one, and a crowd's remarks as one."""

from worldwright.model.finding import Anomaly, by_kind


def told(code: str, severity: str, body: str, measured: float, threshold: float = 0.1) -> Anomaly:
    return Anomaly(
        code=code,
        name="deep_penetration",
        severity=severity,
        body=body,
        window_s=(0.0, 1.0),
        measured=measured,
        threshold=threshold,
        unit="m",
        message="they overlap",
    )


def test_a_crowd_is_one_line_with_the_worst_in_front():
    crowd = [told("WS110", "warn", f"drop_{n}", 0.1 + n / 10) for n in range(1, 7)]
    (line,) = by_kind(crowd)
    assert line.startswith("warn WS110 deep_penetration: drop_6 ")
    assert line.endswith("; the same, less, of drop_1, drop_2, and 3 more")


def test_what_blocks_is_told_one_by_one_and_two_stay_two():
    found = [told("WS110", "blocking", f"drop_{n}", 1.0) for n in range(4)]
    found += [told("WS107", "warn", f"drop_{n}", 1.0) for n in range(2)]
    assert by_kind(found) == [str(one) for one in found]


def test_where_small_is_bad_the_worst_is_the_smallest():
    seen = [told("WS110", "warn", f"seen_{pixels}", pixels, 16) for pixels in (1, 5, 15.5)]
    for found in (seen, seen[::-1]):
        (line,) = by_kind(found)
        assert line.startswith("warn WS110 deep_penetration: seen_1 ")
    nothing = told("WS110", "warn", "nothing", 0.0, 16)
    assert by_kind([*seen, nothing])[0].startswith("warn WS110 deep_penetration: nothing ")
