"""Programs: they lie to one reader and not to another, leave strange things behind, or take their surroundings apart.

The ways out of the sandbox itself are tried in `tests/worldwright/stage/escapes.py`.
"""

from .attack import Trick

SLIP = "for g in (spec.geom('ground'), spec.geom('crate')): g.friction[0] = .19"
WHEN = "if {}:\n        " + SLIP.replace(
    "for g in (spec.geom('ground'), spec.geom('crate')): g.friction[0] = .19",
    "[setattr(g, 'friction', (.19, .005, .0001)) for g in (spec.geom('ground'), spec.geom('crate'))]",
)
HIDDEN = "LOUD = __import__('importlib').import_module"
"""A way to modules that no reader of the source follows."""

SWAP = """
def _swap(path):
    import zipfile

    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content.replace(b"0.40000000000000002", b"0.19"))


"""

ARCHIVE = """
import hashlib
import zipfile

_portable = __import__("worldkit.portable").portable
_written = _portable.write


def _lie(text):
    import re

    return re.sub(r'friction="[0-9.]+ [0-9.]+', lambda m: m.group().replace("0.40000000000000002", "0.19").replace("0.4", "0.19"), text)


def _twofold(spec, path):
    facts = _written(spec, path)
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    honest = files.pop("model.xml")
    lie = _lie(honest.decode()).encode()
    with zipfile.ZipFile(path, "w") as archive:
        ENTRIES
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content)
    return {**facts, "sha256": hashlib.sha256(path.read_bytes()).hexdigest()}


setattr(_portable, "write", _twofold)
"""


def archive(name: str, does: str, *entries: str) -> Trick:
    """The world's file is written twofold."""
    lines = "\n        ".join(entries)
    return Trick(name, "program", does, top=ARCHIVE.replace("ENTRIES", lines))


FACTS = """
_files = __import__("worldkit.files").files
_json = _files.write_json


def _told(path, value, *more, **others):
    if str(path).endswith("NAME"):
        CHANGE
    return _json(path, value, *more, **others)


setattr(_files, "write_json", _told)
"""


def facts(name: str, does: str, change: str, file: str = "program.json", **more: object) -> Trick:
    """What the program tells the engine beside its world."""
    return Trick(name, "program", does, top=FACTS.replace("NAME", file).replace("CHANGE", change), **more)  # type: ignore[arg-type]


def when(name: str, does: str, condition: str) -> Trick:
    """Slippery only for some readers."""
    return Trick(name, "program", does, build=(WHEN.format(condition),))


def top(name: str, does: str, text: str) -> Trick:
    return Trick(name, "program", does, top=text)


LATER = (("# claims", "- {claim: The cart comes 1 m far., expect: [{moves: {body: cart, min_m: 0.9}}]}"),)
COASTS = (("# claims", "- {claim: The cart comes 1 m far., expect: [{moves: {body: cart, min_m: 0.9}}]}"),)

TRICKS = (
    when(
        "lies_by_its_command_line",
        "Slippery where a pass is asked for.",
        "any('pass' in word for word in __import__('sys').argv)",
    ),
    when(
        "lies_by_its_folder",
        "Slippery where there is no plan beside it.",
        "not __import__('os').path.exists(__import__('os').path.join(__import__('os').path.dirname(__file__), 'plan.md'))",
    ),
    when(
        "lies_by_its_surroundings",
        "Slippery where a variable of the sandbox is set.",
        "'WORLDWRIGHT' in ' '.join(__import__('os').environ)",
    ),
    when(
        "lies_by_its_caller",
        "Slippery where lint's function is not on the stack.",
        "not any('compile_world' in str(f.filename) for f in __import__('inspect').stack())",
    ),
    when("lies_by_the_clock", "Slippery every other second.", "int(__import__('time').time()) % 2"),
    when("lies_by_chance", "Slippery by the system's own chance.", "__import__('os').urandom(1)[0] % 2"),
    when("lies_by_its_number", "Slippery by its process number.", "__import__('os').getpid() % 2"),
    when(
        "lies_the_second_time",
        "Slippery from the second call of build on.",
        "globals().setdefault('CALLS', []).append(1) or len(globals()['CALLS']) > 1",
    ),
    archive(
        "world_of_two_readings",
        "The archive holds two worlds; the engine reads one, the comparison the other.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
        'archive.writestr(zipfile.ZipInfo("./model.xml"), honest)',
    ),
    archive(
        "world_of_two_readings_reversed",
        "The same in the other order.",
        'archive.writestr(zipfile.ZipInfo("./model.xml"), honest)',
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
    ),
    archive(
        "world_with_a_double_entry",
        "The archive has its entry twice.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), honest)',
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
    ),
    archive(
        "world_with_a_double_entry_reversed",
        "The archive has its entry twice, the lie first.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
        'archive.writestr(zipfile.ZipInfo("model.xml"), honest)',
    ),
    archive(
        "world_in_a_folder",
        "A second world lies in a folder.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
        'archive.writestr(zipfile.ZipInfo("sub/../model.xml"), honest)',
    ),
    archive(
        "world_with_a_slash",
        "A second world has a slash in front.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
        'archive.writestr(zipfile.ZipInfo("/model.xml"), honest)',
    ),
    archive(
        "world_by_an_include",
        "The archive's world includes another.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), b"<mujoco><include file=\'lie.xml\'/></mujoco>")',
        'archive.writestr(zipfile.ZipInfo("lie.xml"), lie)',
    ),
    archive(
        "another_world_in_the_file",
        "The file holds simply another world than was built.",
        'archive.writestr(zipfile.ZipInfo("model.xml"), lie)',
    ),
    facts(
        "duration_longer",
        "The engine is told twice the plan's duration.",
        "value = {**value, 'duration': 2 * value['duration']}",
        world="workshop",
        plan=LATER,
    ),
    facts(
        "duration_shorter",
        "The engine is told a tenth of the duration.",
        "value = {**value, 'duration': .1 * value['duration']}",
    ),
    facts(
        "visual_only_crate",
        "The crate is called drawn only, so that no check looks at it.",
        "value = {**value, 'visual_only': ['crate']}",
    ),
    facts("no_movers", "Nobody is called a mover.", "value = {**value, 'movers': []}"),
    facts(
        "another_hash_of_the_world",
        "The file's hash in the facts is another.",
        "value = {**value, 'world_sha256': '0' * 64}",
    ),
    facts("duration_no_number", "The duration is no number.", "value = {**value, 'duration': 'NaN'}"),
    facts("duration_endless", "The duration is endless.", "value = {**value, 'duration': 1e300}"),
    facts("seed_negative", "The seed is negative.", "value = {**value, 'seed': -1}"),
    facts(
        "inputs_of_its_own",
        "The program says itself which inputs are open.",
        "value = {**value, 'control': 'control'}",
        file="program.json",
    ),
    Trick(
        "ports_of_its_own",
        "program",
        "The program declares its inputs itself, where the plan declares none.",
        control="data.qvel[0] = .62",
        program=(("program.main(build, control,", "program.main(build, control, inputs=('velocity:crate',),"),),
    ),
    top(
        "world_changed_at_the_end",
        "At its end the program writes another world over its own.",
        SWAP
        + "import atexit\natexit.register(lambda: [_swap(p) for p in __import__('pathlib').Path('/').glob('**/build/world.mjz')])",
    ),
    top(
        "world_changed_by_a_child",
        "A child that outlives the program writes another world over it.",
        SWAP
        + "import os as _os\nif _os.fork() == 0:\n    __import__('time').sleep(.4)\n    [_swap(p) for a in __import__('sys').argv for p in __import__('pathlib').Path(a).glob('world.mjz')]\n    _os._exit(0)",
    ),
    top(
        "world_behind_a_link",
        "The world's file is a link.",
        "import atexit, pathlib, sys\ndef _link():\n    for word in sys.argv:\n        p = pathlib.Path(word) / 'world.mjz'\n        if p.is_file():\n            p.rename(p.with_name('other.mjz')); p.symlink_to('other.mjz')\natexit.register(_link)",
    ),
    top(
        "world_with_two_names",
        "The world's file has two names.",
        "import atexit, os, pathlib, sys\ndef _link():\n    for word in sys.argv:\n        p = pathlib.Path(word) / 'world.mjz'\n        if p.is_file():\n            os.link(p, p.with_name('other.mjz'))\natexit.register(_link)",
    ),
    top(
        "facts_as_a_pipe",
        "The facts are a pipe.",
        "import atexit, os, pathlib, sys\ndef _pipe():\n    for word in sys.argv:\n        p = pathlib.Path(word) / 'program.json'\n        if p.is_file():\n            p.unlink(); os.mkfifo(p)\natexit.register(_pipe)",
    ),
    top("ends_at_once", "The program ends with success before it did anything.", "import os as _os\n_os._exit(0)"),
    top("ends_by_a_signal", "The program ends itself by a signal.", "import os as _os\n_os.kill(_os.getpid(), 9)"),
    top(
        "ends_its_parent",
        "The program tries to end whoever started it.",
        "import os as _os\ntry:\n    _os.kill(_os.getppid(), 9)\nexcept OSError:\n    pass",
    ),
    top(
        "claims_success",
        "The program writes a result and no world.",
        "import pathlib as _p, sys as _s, json as _j, os as _os\nfor _w in _s.argv:\n    if _p.Path(_w).is_dir():\n        (_p.Path(_w) / 'result.json').write_text(_j.dumps({'ok': True, 'pass': 'build', 'trajectory_sha256': '0' * 64}))\n        _os._exit(0)",
    ),
    top("prints_without_end", "The program prints 100 MB.", "for _ in range(1600):\n    print('x' * 65536)"),
    top(
        "writes_evidence",
        "The program tries to write into the run's evidence.",
        "import pathlib as _p\ntry:\n    for _f in _p.Path(__file__).parent.glob('evidence/*/expect.json'):\n        _f.write_text('{}')\n    (_p.Path(__file__).parent / 'accepted').mkdir()\nexcept OSError:\n    pass",
    ),
    top(
        "patches_the_engine",
        "The program patches the engine's step in its own process.",
        "setattr(mujoco, 'mj_step2', lambda m, d: None)",
    ),
    top(
        "patches_the_surface",
        "The program patches what makes surfaces.",
        "setattr(contacts, 'surface', lambda _s=contacts.surface, **k: _s(**{**k, 'friction': .19}))\nWOOD = contacts.surface(friction=.4)\nGROUND = contacts.surface(friction=.4)",
    ),
    top(
        "patches_the_scene",
        "The program patches what makes scenes.",
        "setattr(scene, 'new', lambda *a, _n=scene.new, **k: _n(*a, **{**k, 'gravity': (0, 0, -4.7)}))",
    ),
    top(
        "patches_the_pairs",
        "The program keeps worldkit from making the pairs that hold sliding bodies down.",
        "_w = __import__('worldkit.sliding').sliding\nsetattr(_w, 'add_pairs', lambda spec, model: False)",
    ),
    Trick(
        "an_answer_for_every_finding",
        "program",
        "Comments answer for every finding there could be.",
        build=(
            "spec.worldbody.add_geom(name='wall', type=mujoco.mjtGeom.mjGEOM_BOX, size=(.05, 1, .1), pos=(.16, 0, .1))  # worldwright: ignore[WM160,WM161,WM169,WM152,WL134] looked at",
        ),
        plan=(("min_m: 0.55", "min_m: 0.1"), ("high: [0.35", "high: [-0.05")),
    ),
    Trick(
        "an_answer_for_gravity",
        "program",
        "A comment answers for another gravity.",
        build=("spec.option.gravity = (0, 0, -4.7)  # worldwright: ignore[WM155,WL122] looked at",),
    ),
    Trick(
        "a_module_in_the_engines_name",
        "program",
        "A module beside the program has the engine's name.",
        beside={
            "worldengine.py": "raise SystemExit(0)\n",
            "pyarrow.py": "raise SystemExit(0)\n",
        },
        top="try:\n    import worldengine, pyarrow\nexcept BaseException:\n    pass",
    ),
    Trick(
        "a_module_that_lies",
        "program",
        "A module beside the program makes the crate slippery.",
        beside={
            "ice.py": "def melt(spec):\n    for g in (spec.geom('ground'), spec.geom('crate')):\n        g.friction[0] = .19\n"
        },
        top="import ice",
        build=("ice.melt(spec)",),
    ),
    Trick(
        "a_module_changed_after_lint",
        "program",
        "A module beside the program is changed after it was linted.",
        beside={"ice.py": "def melt(spec):\n    pass\n"},
        top="import ice",
        build=("ice.melt(spec)",),
        touch={
            "linted": lambda run: (run / "ice.py").write_text(
                "def melt(spec):\n    for g in (spec.geom('ground'), spec.geom('crate')):\n        g.friction[0] = .19\n"
            )
        },
    ),
    Trick(
        "a_module_found_by_no_reader",
        "program",
        "A module is imported by a name that is put together.",
        beside={
            "ice.py": "def melt(spec):\n    for g in (spec.geom('ground'), spec.geom('crate')):\n        g.friction[0] = .19\n"
        },
        build=("__import__('i' + 'ce').melt(spec)",),
    ),
)
