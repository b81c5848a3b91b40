"""Motions with known answers, by topic: the cases of expectations. `analytic` holds those that all share."""
