"""The judge: films scored against a benchmark's criteria by someone who did not build them, and who sees nothing but film and criteria.

| module | what it knows |
|---|---|
| `criteria` | a scenario: its prompt, what must be seen, and the fields that are answered Yes or No |
| `published_set` | the published data set's own files, as tolerantly as they may be laid out |
| `eighty` | the eighty prompts of the reference's set; none of the criteria |
| `entrants` | which film belongs to which scenario |
| `exhibit` | what a judge is shown of a film: frames, a contact sheet, or the film |
| `judging_prompt` | the words that it is asked with, and what its answer says |
| `judges/` | the judges, one file each, behind one protocol |
| `one_call`, `patience` | a call to a server through its maker's client, and how it can fail; how often and when it is asked again |
| `headless` | a coding harness as the judge: a process of its own in an empty folder |
| `verdict_record` | what was shown, asked and answered, by hash, in a folder that no builder reads |
| `hearing` | every film before the judge, each vote paid once |
| `ballot` | votes counted, field by field; a tie is no answer |
| `intervals` | Wilson's interval, Fleiss' kappa |
| `tally` | SA, PC and both: per category and overall |
| `anchor_rows` | the published figures of the reference and of ten video models |
| `planted`, `calibration` | films with a known fault; how often a judge finds them, and whether it is fit |
| `staging_audit` | what share of the claimed outcomes emerged, was declared, or was only drawn |
| `scored_report` | all of it as Markdown, CSV and HTML |

Whoever builds sees no verdict: there is no tool of this for an agent, and records lie outside of projects and runs.
"""
