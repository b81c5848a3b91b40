"""The shelf of expectations: the closed vocabulary of claims, and what each of them defines."""

from ...shelf import Attribute, Function, Shelf

EXPECTATIONS = Shelf(
    "worldwright.scan.objectives.expectations",
    {
        "Given": Attribute(type, "its arguments: a pydantic model, each field with a description that says its unit"),
        "measure": Attribute(Function, "(Trajectory, Given) -> Measured"),
        "GOOD": Attribute(tuple, "pairs of a function that makes a motion and arguments that hold of it"),
        "BAD": Attribute(tuple, "pairs of a function that makes a motion and arguments that fail on it"),
        "EVENT": Attribute(
            bool,
            "it comes true at a moment: false of a recording that ends before, so that it can be ordered and its "
            "cause tested",
            False,
        ),
        "LASTING": Attribute(
            bool, "it holds from the first instant on and its number need not move: no effect by itself", False
        ),
        "RESTS": Attribute(bool, "the bodies that it names are to be still at the end", False),
        "OF_MOVERS": Attribute(bool, "without a body's name it measures how all bodies move", True),
    },
)
