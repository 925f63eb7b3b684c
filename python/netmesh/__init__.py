"""Time-optimal point meshing: conforming quality Delaunay meshes in 2 to 8 dimensions.

`mesh` makes a mesh of linear size with a bound on its quality, whatever the spread of the points.
`Delaunay`, `Voronoi`, `ConvexHull`, `griddata` and the interpolators have SciPy's names and meanings.
"""

from . import _errors
from ._clough_tocher import CloughTocher2DInterpolator
from ._convex_hull import ConvexHull
from ._delaunay import Delaunay
from ._domain import Domain, domain
from ._errors import (
    ArgumentTypeError,
    CancelledError,
    CapacityError,
    DegenerateInputError,
    DimensionError,
    Error,
    FileError,
    FormatError,
    GradientEstimationWarning,
    InternalError,
    InvalidArgumentError,
    LimitError,
    NonFiniteError,
    OutOfMemoryError,
    StateError,
)
from ._filtration import Filtration
from ._griddata import griddata
from ._interpolator import LinearNDInterpolator
from ._mesh import Mesh, mesh
from ._nearest import NearestNDInterpolator
from ._netmesh import VERSION as __version__
from ._netmesh import Progress
from ._part import Part
from ._repairs import close_holes, intersections, merge_points, odd_edges, triangulate_facets
from ._results import (
    CSR,
    Facets,
    Intersection,
    OddEdge,
    Placement,
    Quality,
    Report,
    Stats,
    VertexKind,
    Violation,
    VoronoiCells,
)
from ._shape import AlphaShape, FaceClass
from ._spatial import SpatialMesh, offset_hull, representatives, spatial_mesh
from ._surface import Surface, surface
from ._voronoi import Voronoi

__all__ = [
    "AlphaShape",
    "ArgumentTypeError",
    "CSR",
    "CancelledError",
    "CapacityError",
    "CloughTocher2DInterpolator",
    "ConvexHull",
    "DegenerateInputError",
    "Delaunay",
    "DimensionError",
    "Domain",
    "Error",
    "FaceClass",
    "Facets",
    "FileError",
    "Filtration",
    "FormatError",
    "GradientEstimationWarning",
    "InternalError",
    "Intersection",
    "InvalidArgumentError",
    "LimitError",
    "LinearNDInterpolator",
    "Mesh",
    "NearestNDInterpolator",
    "NonFiniteError",
    "OddEdge",
    "OutOfMemoryError",
    "Part",
    "Placement",
    "Progress",
    "Quality",
    "Report",
    "SpatialMesh",
    "StateError",
    "Stats",
    "Surface",
    "VertexKind",
    "Violation",
    "Voronoi",
    "VoronoiCells",
    "close_holes",
    "domain",
    "griddata",
    "intersections",
    "merge_points",
    "mesh",
    "odd_edges",
    "offset_hull",
    "representatives",
    "spatial_mesh",
    "surface",
    "triangulate_facets",
]

# Users see the exceptions where they import them from.
for _name in dir(_errors):
    _class = getattr(_errors, _name)
    if isinstance(_class, type) and _class.__module__ == _errors.__name__:
        _class.__module__ = __name__
