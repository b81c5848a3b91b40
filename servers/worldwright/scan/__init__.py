"""Scan: is the motion physically plausible, and does it do what the plan claims?

Two shelves over one recorded trajectory: `checks` (what should never be seen: anomalies) and `expectations` (what the
plan says must be seen: measured claims). `plots` draws what they measured.
"""
