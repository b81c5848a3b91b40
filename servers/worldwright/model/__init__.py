"""What passes between the servers: frozen data, and files in the run folder. Imports nothing above itself.

plan · scene · program · trajectory · evidence · finding · verdict, plus the run folder they live in.
"""
