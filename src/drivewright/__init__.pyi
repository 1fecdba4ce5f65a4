"""What an editor sees of the package: the names of `__init__`, which are loaded when first used, with their types."""

from typing import Any, TypeAlias, overload

from drivewright import bearings as bearings
from drivewright import cams as cams
from drivewright import chains as chains
from drivewright import contact as contact
from drivewright import curves as curves
from drivewright import fatigue as fatigue
from drivewright import gears as gears
from drivewright import indexing as indexing
from drivewright import materials as materials
from drivewright import motion as motion
from drivewright import multibody as multibody
from drivewright import shafts as shafts
from drivewright import solids as solids
from drivewright import studies as studies
from drivewright import units as units
from drivewright._jit import by_reference as by_reference
from drivewright._jit import implements as implements
from drivewright._jit import kernel as kernel
from drivewright.errors import DrivewrightError as DrivewrightError
from drivewright.errors import InputError as InputError
from drivewright.errors import MissingExtra as MissingExtra
from drivewright.errors import SolverError as SolverError
from drivewright.errors import SpecError as SpecError
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.report.comparison import DesignComparison as DesignComparison
from drivewright.report.comparison import compare as compare
from drivewright.result import Result as Result
from drivewright.runner import run as run
from drivewright.scene import Scene as Scene
from drivewright.spec import MechanismSpec
from drivewright.spec import load as load
from drivewright.studies.advising import advise as advise
from drivewright.studies.optimisation import optimise as optimise
from drivewright.studies.study import Study as Study
from drivewright.studies.sweeps import open_study as open_study
from drivewright.studies.sweeps import sweep as sweep
from drivewright.studies.variation import linspace as linspace
from drivewright.studies.verification import verify as verify

Cam: TypeAlias = CamSpec
Indexer: TypeAlias = IndexerSpec
Linkage: TypeAlias = LinkageSpec
SeedlingPusher: TypeAlias = SeedlingPusherSpec
Shaft: TypeAlias = ShaftSpec
SilentChain: TypeAlias = SilentChainSpec

__version__: str
__all__: list[str]

@overload
def build(spec: Cam) -> CamModel: ...
@overload
def build(spec: Indexer) -> IndexerModel: ...
@overload
def build(spec: Linkage) -> LinkageModel: ...
@overload
def build(spec: SeedlingPusher) -> PusherModel: ...
@overload
def build(spec: Shaft) -> ShaftModel: ...
@overload
def build(spec: SilentChain) -> ChainModel: ...
@overload
def build(spec: MechanismSpec) -> Any: ...
