"""The shelf of anomaly checks: one implausible signature each, with its formula, its threshold and its cases.

A check defines `CODE` (`WS1xx`), `NEEDS` (channels, dotted), `check(trajectory, context) -> Iterator[Sign]`, and the
cases `GOOD` and `BAD`: functions that make a `Case`. With `WHOLE = True` it is given each rigid assembly as one body (see
`scan.wholes`). Missing channels skip the check, and the report says which.
"""
