# SPDX-License-Identifier: MIT
"""talus: what does a ray hit, when do shapes touch, where can an agent walk.

Takes a level's loose triangles as numpy arrays, in metres with y up.

>>> soup = talus.Soup(vertices, faces)
>>> soup.cast(origins, directions).t
>>> navmesh = talus.Navmesh.bake(vertices, faces, agent_radius=0.4)
>>> navmesh.shortest_path(start, goal).points
"""

from . import _talus
from ._poses import poses
from .characters import CHARACTER, CHARACTER_HIT, Characters, Moves
from .crowd import AgentStates, Crowd, CrowdReport, GroupState
from .decomposition import Decomposition, decompose
from .errors import Error
from .hull import Hull
from .level import Level, load
from .navmesh import Navmesh
from .navmesh_results import (
    JUMP_LINK,
    Audit,
    Finding,
    Link,
    Path,
    Paths,
    Places,
    Polygons,
    Reason,
    SurfaceHit,
    Walls,
    Why,
)
from .navmesh_settings import (
    WALKABLE_AREA,
    Box,
    Cylinder,
    Filter,
    Obstacle,
    Prism,
    Settings,
    Volume,
    default_settings,
)
from .picture import Picture
from .shapes import (
    CastHits,
    Contacts,
    Penetrations,
    Separations,
    Shape,
    box,
    capsule,
    cast,
    cone,
    contacts,
    convex,
    cylinder,
    distance,
    penetration,
    sphere,
    triangle,
)
from .soup import AllHits, Locations, NearestPoints, RayHits, Soup, SoupStats, SweepHits
from .versions import NavVersions, NavVersionsState
from .world import Route, World, WorldLoad, WorldPath, WorldPlaces, WorldRay, WorldState

__version__: str = _talus.version

__all__ = [
    "CHARACTER",
    "CHARACTER_HIT",
    "JUMP_LINK",
    "WALKABLE_AREA",
    "AgentStates",
    "AllHits",
    "Audit",
    "Box",
    "CastHits",
    "Characters",
    "Contacts",
    "Crowd",
    "CrowdReport",
    "Cylinder",
    "Decomposition",
    "Error",
    "Filter",
    "Finding",
    "GroupState",
    "Hull",
    "Level",
    "Link",
    "Locations",
    "Moves",
    "NavVersions",
    "NavVersionsState",
    "Navmesh",
    "NearestPoints",
    "Obstacle",
    "Path",
    "Paths",
    "Penetrations",
    "Picture",
    "Places",
    "Polygons",
    "Prism",
    "RayHits",
    "Reason",
    "Route",
    "Separations",
    "Settings",
    "Shape",
    "Soup",
    "SoupStats",
    "SurfaceHit",
    "SweepHits",
    "Volume",
    "Walls",
    "Why",
    "World",
    "WorldLoad",
    "WorldPath",
    "WorldPlaces",
    "WorldRay",
    "WorldState",
    "__version__",
    "box",
    "capsule",
    "cast",
    "cone",
    "contacts",
    "convex",
    "cylinder",
    "decompose",
    "default_settings",
    "distance",
    "load",
    "penetration",
    "poses",
    "sphere",
    "triangle",
]
