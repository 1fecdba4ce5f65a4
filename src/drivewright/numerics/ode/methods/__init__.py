"""Integration methods by name: one file each, whose `METHOD` describes it; a new file is a new method."""

import pkgutil
from importlib import import_module

from drivewright.numerics.ode.method import Method

METHODS: dict[str, Method] = {
    method.name: method for method in (import_module(f"{__name__}.{each.name}").METHOD for each in pkgutil.iter_modules(__path__))
}
