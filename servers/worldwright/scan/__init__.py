"""Scan: is the motion physically plausible, and does it do what the plan claims?

Two shelves over one recorded trajectory: `checks` (anomalies, which should never be seen) and `expectations` (measured
claims, which the plan says must be seen). `plots` draws what they measured.
"""
