"""`make bench` runs everything that it is asked for, and prints one table, whatever misses its goal or breaks."""

import shutil
import subprocess
import sys
from pathlib import Path

BENCH = Path(__file__).parent / "bench"
FAKE = """\
import sys
from figures import Figure, report
sys.exit(report({}))
"""


def test_a_missed_goal_and_a_broken_bench_hide_nothing(tmp_path):
    for name in ("run.py", "figures.py"):
        shutil.copy(BENCH / name, tmp_path)
    (tmp_path / "a_slow.py").write_text(FAKE.format('Figure("slowness", 3.0, 1.5), Figure("width", 1.0, 2.0)'))
    (tmp_path / "b_broken.py").write_text("raise SystemExit(7)\n")
    (tmp_path / "c_speed.py").write_text(
        FAKE.format('Figure("speed", 4.0, 2.0, at_least=True), Figure("none", None, 1, "no GPU")')
    )
    ran = subprocess.run([sys.executable, str(tmp_path / "run.py")], capture_output=True, text=True)
    assert ran.returncode == 1, ran.stderr
    table = ran.stdout.splitlines()[-6:]
    assert [line.split()[0] for line in table] == ["slowness", "width", "speed", "none", "b_broken", "2"]
    assert "MISSED" in table[0] and " 2.00 " in table[0] and "met" in table[1] and "0.50  met" in table[2]
    assert (
        "not measured: no GPU" in table[3]
        and table[-1] == "2 figures meet their goals; 1 missed, 1 not measured, 1 benches broke"
    )
    good = subprocess.run([sys.executable, str(tmp_path / "run.py"), "c_speed"], capture_output=True, text=True)
    assert good.returncode == 0
    assert subprocess.run([sys.executable, str(tmp_path / "run.py"), "d"], capture_output=True).returncode == 2
