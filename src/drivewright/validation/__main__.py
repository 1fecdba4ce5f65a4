"""`python -m drivewright.validation > docs/validation.md` writes the page of the documentation."""

from drivewright.validation import page, sources

print(page(sources()), end="")
