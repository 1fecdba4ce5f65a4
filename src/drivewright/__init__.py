"""Drivewright: design, simulate and verify mechanical drives.

The names below are loaded when first used; importing the package costs next to nothing.
"""

from importlib import import_module

__version__ = "0.1.0"

_WHERE = {
    "DrivewrightError": "errors",
    "InputError": "errors",
    "MissingExtra": "errors",
    "SolverError": "errors",
    "SpecError": "errors",
    "Cam": "mechanisms.cam.spec:CamSpec",
    "Indexer": "mechanisms.indexer.spec:IndexerSpec",
    "Linkage": "mechanisms.linkage.spec:LinkageSpec",
    "Shaft": "mechanisms.shaft.spec:ShaftSpec",
    "SeedlingPusher": "mechanisms.seedling_pusher.spec:SeedlingPusherSpec",
    "SilentChain": "mechanisms.silent_chain.spec:SilentChainSpec",
    "DesignComparison": "report.comparison",
    "Result": "result",
    "Scene": "scene",
    "advise": "studies.advising",
    "build": "runner",
    "by_reference": "_jit",
    "compare": "report.comparison",
    "implements": "_jit",
    "kernel": "_jit",
    "load": "spec",
    "run": "runner",
    "Study": "studies.study",
    "linspace": "studies.variation",
    "open_study": "studies.sweeps",
    "optimise": "studies.optimisation",
    "sweep": "studies.sweeps",
    "verify": "studies.verification",
    "bearings": "bearings:",
    "cams": "cams:",
    "chains": "chains:",
    "contact": "contact:",
    "curves": "curves:",
    "fatigue": "fatigue:",
    "gears": "gears:",
    "indexing": "indexing:",
    "materials": "materials:",
    "motion": "motion:",
    "multibody": "multibody:",
    "shafts": "shafts:",
    "solids": "solids:",
    "studies": "studies:",
    "units": "units:",
}

__all__ = ["__version__", *sorted(_WHERE)]


def __getattr__(name):
    if name not in _WHERE:
        raise AttributeError(f"module 'drivewright' has no attribute {name!r}")
    module, colon, attribute = _WHERE[name].partition(":")
    imported = import_module(f"drivewright.{module}")
    return imported if colon and not attribute else getattr(imported, attribute or name)


def __dir__():
    return __all__
