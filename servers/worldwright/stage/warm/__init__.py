"""A warm start: processes of ours are forked from one that has loaded Python's and the simulator's modules already.

A pass starts a supervisor and an engine, and to load what they import costs most short ones more than the pass itself. A process
that starts many of them (`kept_warm.keep`) has one child, the nursery, that loads those modules once and then only forks:

- `kept_warm` asks it, over a socket that nobody else can reach; `letters` says how a request looks.
- `nursery` is that child (`newborn`: what those do first that it forks). It never reads a request: each is read by a process
  forked for it alone.
- `supervising` makes of such a process a job's supervisor, with a nursery of its own, forked before it knows anything.
- `joining` has an engine forked and confined: bubblewrap makes the sandbox as for a cold start, around a shell that only
  waits; `confining` joins its namespaces and gives up everything else, in the new process itself.

An author's program always starts cold: processes of one nursery share the layout of their memory, and a program whose result
depends on it would seem repeatable. Nothing is answered warm that would differ: where a loaded file has changed, the
environment asks for another interpreter, or anything fails, the process is started as ever. So it is everywhere but on Linux,
an engine at the sandbox's lower levels, and everything where `WORLDWRIGHT_WARM=0` asks for it.
"""
