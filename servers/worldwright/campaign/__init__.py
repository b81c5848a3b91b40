"""Campaigns: many worlds at once, each taken as far as its gates allow, and one table of what came of them.

| module | what it knows |
|---|---|
| `campaign_file` | the words of a campaign's YAML, and what is refused in it |
| `author_words`, `world_author` | who writes the worlds of prompts; a headless harness's session, from its start to its world |
| `author_folder`, `author_talk` | the project of its own that it works in; what it printed, as tokens, money and words |
| `plan_fields` | a number of a plan by its path, read and set |
| `points` | the worlds that axes and draws ask for, one after the other, never all at once |
| `campaign_store` | the folder: what stands on disk under which name |
| `world_row` | what is handed back of a world: one row |
| `one_world` | a world from its seed to its row, by the walk that `worldwright go` takes |
| `worker_processes`, `on_ray` | who does the work: our own processes, or Ray's tasks |
| `setting_out` | a file checked against its plans before a folder is made |
| `conducting` | the driver: hands out worlds, keeps to budgets, outlives a worker |
| `campaign_table`, `wall` | Parquet, CSV, and the page |
| `trajectories` | the recordings as a data set to train on, split by the draw's seed |
| `tools` | the same for an agent, lent to `stage` |

A world is addressed by the hash of what it is made of, so it is looked for before it is paid for; a row on disk is the only
proof that it is done. Whoever is killed in between (driver, worker, machine) leaves what was proven where it is found again.
"""
