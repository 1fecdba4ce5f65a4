"""Stresses in a rocker-joint chain: its rolling pins, its plates, and what a history of loads leaves of their life."""
