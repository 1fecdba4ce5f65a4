"""Stresses in a rocker-joint chain: its rolling pins, its plates, and what a history of loads leaves of their life.

rolling     rolling pins: pressure, shear below the surface, shakedown
pins        bending of a pin across the pack of plates
bearing     pressure of a pin in its hole by superposition
seating     how a pin with clearance seats in its hole
plate       a plate by finite elements: answers to unit forces, history of stress, peak
revolution  loads of a plate over a revolution of the chain, from a run
life        fatigue life around the rim of a plate
"""
