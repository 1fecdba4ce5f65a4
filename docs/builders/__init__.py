"""Builders of the documentation."""
