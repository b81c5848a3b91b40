"""Define the columns of a recording: names, shapes, units and frames, in one place for writer, reader and docs."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

SCHEMA_VERSION = 1
OVERLAPS_FILE = "overlaps.json"
"""What `drawn_overlaps` found, beside the streams."""
CAMERAS_FILE = "cameras.json"
"""Where each camera stands (`standing_cameras`), beside the streams."""
VALUES = 6
"""An intervention has so many numbers: a wrench, a displacement (m, rad), a change of velocity, or new parameter values."""

KINDS = ("force", "torque", "control", "pose", "velocity", "mocap", "constraint", "parameter")
"""The kinds of interventions."""


@dataclass(frozen=True)
class Column:
    """One column; `shape` is that of one row, so the column is (rows, *shape). Frames: world unless said otherwise."""

    name: str
    shape: tuple[int, ...]
    unit: str
    description: str
    dtype: str = "float64"

    @property
    def width(self) -> int:
        """The number of values in one row."""
        width = 1
        for size in self.shape:
            width *= size
        return width


def state_columns(sizes: Mapping[str, int], empty: bool = False) -> tuple[Column, ...]:
    """Columns of `state.arrows`: row n holds the state at time n and what derives from that same state.

    Args:
        sizes: `bodies` (all but the world), and MuJoCo's nq, nv, na, nu, nmocap, neq, ntendon, nsensordata,
            nplastic; `stressed`, the number of equalities where some are bonds.
        empty: also list the columns without numbers.

    Columns without numbers (no actuators, say) are left out of the file; the reader returns them with zero width.
    """
    b = sizes["bodies"]
    columns = (
        Column("time", (), "s", "simulated time"),
        Column("pos", (b, 3), "m", "body origins"),
        Column("quat", (b, 4), "1", "body orientations, w x y z"),
        Column("linvel", (b, 3), "m/s", "linear velocity of the body origins"),
        Column("angvel", (b, 3), "rad/s", "angular velocity"),
        Column("qpos", (sizes["nq"],), "m, rad, 1", "generalised positions"),
        Column("qvel", (sizes["nv"],), "m/s, rad/s", "generalised velocities"),
        Column("act", (sizes["na"],), "actuator's", "actuator activations"),
        Column("ctrl", (sizes["nu"],), "actuator's", "controls in force during the step that begins at this row"),
        Column("actuator_force", (sizes["nu"],), "N, N m", "actuator forces at this state"),
        Column("mocap_pos", (sizes["nmocap"], 3), "m", "mocap positions"),
        Column("mocap_quat", (sizes["nmocap"], 4), "1", "mocap orientations, w x y z"),
        Column("eq_active", (sizes["neq"],), "bool", "equality constraints switched on", "uint8"),
        Column("eq_residual", (sizes["neq"],), "m, rad", "norm of the constraint's violation; NaN while switched off"),
        Column("eq_force", (sizes["neq"],), "N, N m", "norm of the constraint's force; 0 while switched off"),
        Column(
            "eq_torque",
            (sizes["neq"],),
            "N m",
            "norm of a weld's torque; 0 while switched off, and for other constraints",
        ),
        Column(
            "eq_stress",
            (sizes.get("stressed", 0),),
            "Pa",
            "largest tension in each bond (`worldkit.breaking`); 0 while switched off, and for other constraints",
        ),
        Column("tendon_length", (sizes.get("ntendon", 0),), "m, rad", "tendon lengths"),
        Column("tendon_force", (sizes.get("ntendon", 0),), "N, N m", "tension by spring, damper and limit, no motors"),
        Column("plastic", (sizes["nplastic"],), "spring's", "plastic deformation state"),
        Column("sensordata", (sizes["nsensordata"],), "sensor's", "sensor readings"),
        Column("energy", (2,), "J", "potential (gravity and springs) and kinetic energy"),
        Column("linmom", (3,), "kg m/s", "linear momentum of all bodies that can move"),
        Column("angmom", (3,), "kg m^2/s", "angular momentum of those bodies about their common centre of mass"),
        Column("ncon", (), "1", "number of contacts", "int32"),
        Column("solver_niter", (), "1", "constraint solver iterations (the most over all islands)", "int32"),
    )
    return tuple(column for column in columns if column.width or empty)


CONTACT_COLUMNS = (
    Column("row", (), "1", "index of the state row", "int32"),
    Column("geom1", (), "1", "first geom, index into meta.geoms; -1 for a flex", "int32"),
    Column("geom2", (), "1", "second geom, index into meta.geoms; -1 for a flex", "int32"),
    Column("depth_m", (), "m", "penetration depth, positive when the geoms overlap; minus the gap otherwise"),
    Column("normal_force", (), "N", "force along the normal, pushing the geoms apart"),
    Column("force", (3,), "N", "total contact force on the second geom's body"),
    Column("position", (3,), "m", "contact point, midway between the surfaces"),
    Column("normal", (3,), "1", "unit vector from the first geom to the second"),
)
INTERVENTION_COLUMNS = (
    Column("time", (), "s", "time of the state that was acted on"),
    Column("kind", (), "", ", ".join(KINDS), "string"),
    Column("target", (), "", "body, body/joint, body/actuator, equality, or owner.parameter[element]", "string"),
    Column(
        "value",
        (VALUES,),
        "N, N m | control, force | m, rad | m/s, rad/s | 1, N, Pa | parameter's",
        "force and torque on the body; control and actuator force; displacement and rotation vector; change of linear "
        "and angular velocity; new state of the constraint, what it carried and, of a bond, its stress; first new values of the parameter; zero-padded",
    ),
    Column("work_j", (), "J", "work done on the system; 0 where none can be attributed"),
)
WARNING_COLUMNS = (
    Column("time", (), "s", "time of the state at which the engine warned"),
    Column("warning", (), "", "name of the warning", "string"),
    Column("count", (), "1", "how often, in this step", "int32"),
)
EDIT_COLUMNS = (
    Column("time", (), "s", "time of the state at which the model array was changed"),
    Column("row", (), "1", "index of the state row from which the new values hold", "int32"),
    Column("step", (), "1", "step from which they hold", "int32"),
    Column("array", (), "", "name of the model array", "string"),
    Column("index", (), "1", "index into the flattened array", "int32"),
    Column("value", (), "array's", "new value"),
)
INPUT_COLUMNS = (
    Column("step", (), "1", "step that the answer acts from on", "int32"),
    Column("entry", (), "1", "entry of the answer, counted through meta.inputs", "int32"),
    Column("value", (), "the input's", "value"),
)
FORETOLD_COLUMNS = (
    *INPUT_COLUMNS[:2],
    *(
        Column(f"error_{n}", (), "", f"byte {n} of the value's error, lowest first (`foretold`)", "uint8")
        for n in range(8)
    ),
)
"""How the file of wide answers holds the rows of `inputs`."""
MEDIUM_COLUMNS = (
    Column("step", (), "1", "step at which the points lay there", "int32"),
    Column("medium", (), "1", "which of meta.laws and, after these, meta.shown", "int32"),
    Column("point", (), "1", "which of its points", "int32"),
    Column("place", (3,), "m", "where it lay", "float32"),
    Column("colour", (), "sRGB", "red, green and blue as one number of 24 bits; -1: it has none of its own", "int32"),
)
BALANCE_COLUMNS = (
    Column("step", (), "1", "step at which the sums held", "int32"),
    Column("medium", (), "1", "which of meta.laws", "int32"),
    Column("mass", (), "kg", "of its points"),
    Column("momentum", (3,), "kg m/s", "of its points"),
    Column("energy", (), "J", "of motion, by weight, and what its law says is stored"),
    Column("weight", (), "J", "of that, by weight"),
    Column("stored", (), "J", "of that, stored, as its law says"),
    Column("volume", (), "m^3", "as its law says; 0 where it says none"),
    Column("held", (3,), "N s", "impulse that it gave to what stands fast, since the start"),
)
TABLES: Mapping[str, tuple[Column, ...]] = {
    "contacts": CONTACT_COLUMNS,
    "interventions": INTERVENTION_COLUMNS,
    "warnings": WARNING_COLUMNS,
    "edits": EDIT_COLUMNS,
    "inputs": INPUT_COLUMNS,
    "media": MEDIUM_COLUMNS,
    "balances": BALANCE_COLUMNS,
}
"""The tables beside the state, each in `<name>.arrows`."""
OF_MEDIA = ("media", "balances")
"""Those that only a world has with an author's law (`worldengine.inputs.declared_media`), or a solver that moves a flex."""
LATER = {("media", "colour"): -1}
"""Columns that an earlier version did not record, by table and name, and what stood in them then."""


def arrow_schema(columns: tuple[Column, ...]) -> Any:
    """The Arrow schema: fixed-size lists for rows of several numbers; unit, shape and meaning as field metadata."""
    import pyarrow as pa

    return pa.schema(
        [
            pa.field(
                column.name,
                pa.list_(pa.field("item", _arrow_type(column), nullable=False), column.width)
                if column.shape
                else _arrow_type(column),
                nullable=False,
                metadata={
                    "unit": column.unit,
                    "shape": ",".join(map(str, column.shape)),
                    "description": column.description,
                },
            )
            for column in columns
        ]
    )


def as_meta(columns: tuple[Column, ...]) -> list[dict[str, Any]]:
    """The columns as rows of `meta.json`."""
    return [{**asdict(column), "shape": list(column.shape)} for column in columns]


def from_meta(rows: list[dict[str, Any]]) -> tuple[Column, ...]:
    """The inverse of `as_meta`."""
    return tuple(Column(**{**row, "shape": tuple(row["shape"])}) for row in rows)


def _arrow_type(column: Column) -> Any:
    import pyarrow as pa

    return pa.string() if column.dtype == "string" else pa.from_numpy_dtype(column.dtype)
