"""What a run folder proves: passes, reports, verdicts, the journal, approvals."""
