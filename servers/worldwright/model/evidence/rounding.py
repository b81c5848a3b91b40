"""What the world's file holds rounded, in the words of a pass's account and of the report."""

from collections.abc import Mapping
from typing import Any

MOST = 5


def told(summary: Mapping[str, Any]) -> str:
    """One line on a pass's `rounded`, largest first; empty when the file's world is the built one bit for bit."""
    rows = summary.get("rounded")
    if not isinstance(rows, Mapping) or not rows:
        return ""
    listed = sorted(((float(apart), str(name)) for name, apart in rows.items()), reverse=True)
    more = f" and {len(listed) - MOST} more" if len(listed) > MOST else ""
    named = ", ".join(f"{name} by {apart:.1g}" for apart, name in listed[:MOST])
    return f"rounded in the world's file, which is what counts: {named}{more} of its size"
