"""What is added to a world gets a name of its own."""

from worldkit.naming import free


def test_the_first_name_that_nothing_has_is_taken():
    assert [free("skin", taken) for taken in ((), ("skin",), ("skin", "skin2"), ("skin2",))] == [
        "skin", "skin2", "skin3", "skin",
    ]  # fmt: skip


def test_there_is_always_one():
    class Full:
        """Has every name up to the one of the number one million."""

        def __contains__(self, name: object) -> bool:
            return str(name) != "skin1000000"

    assert free("skin", Full()) == "skin1000000"
