"""Find the order in which coordinates can be computed.

A node is one coordinate of one object, `(name, dof)`; an edge says that it is computed from another. Positions may not
depend on each other in a circle. A yaw may (two chairs that face each other, a bench pushed against the table it
faces): such a group is solved together, by iteration.
"""

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter

Node = tuple[str, str]


def groups(reads: Mapping[Node, Iterable[Node]]) -> list[list[Node]]:
    """Strongly connected groups of nodes, each before the groups that read it (Tarjan, without recursion).

    The order depends on the names alone, not on the order of the rows.
    """
    index: dict[Node, int] = {}
    low: dict[Node, int] = {}
    stack: list[Node] = []
    on_stack: set[Node] = set()
    found: list[list[Node]] = []
    for root in sorted(reads):
        if root in index:
            continue
        work = [(root, iter(sorted(reads[root])))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, children = work[-1]
            for child in children:
                if child not in reads:
                    continue
                if child not in index:
                    index[child] = low[child] = len(index)
                    stack.append(child)
                    on_stack.add(child)
                    work.append((child, iter(sorted(reads[child]))))
                    break
                if child in on_stack:
                    low[node] = min(low[node], index[child])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    group = []
                    while True:
                        member = stack.pop()
                        on_stack.discard(member)
                        group.append(member)
                        if member == node:
                            break
                    found.append(sorted(group))
    return found


def order_within(group: list[Node], reads: Mapping[Node, Iterable[Node]]) -> tuple[list[Node], list[Node] | None]:
    """The order of one group, with its yaws last, or the circle of positions that forbids any order.

    Returns:
        (order, None), or ([], circle) where each node of the circle reads the one before it.
    """
    members = set(group)
    hard = {
        node: sorted(r for r in reads[node] if r in members and r[1] != "yaw") for node in group if node[1] != "yaw"
    }
    try:
        order = list(TopologicalSorter(hard).static_order())
    except CycleError as error:
        return [], list(error.args[1])[:-1]
    yaws = {
        node: sorted(r for r in reads[node] if r in members and r[1] == "yaw") for node in group if node[1] == "yaw"
    }
    try:
        return order + list(TopologicalSorter(yaws).static_order()), None
    except CycleError as error:
        return [], list(error.args[1])[:-1]
