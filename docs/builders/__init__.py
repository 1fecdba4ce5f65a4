"""What docs/generate.py runs: each module makes one part of the site."""
