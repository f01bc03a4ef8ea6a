"""The mast as `cargo xtask mast N` writes it: the same numbers for every tool."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SAMPLE = 0.01  # time between two samples of a trajectory [s]
SAMPLES = 201  # 2 s, the start included


@dataclass
class Mast:
    """Nodes: level s, corner j is node 3 s + j; level 0 is fixed, so are the anchors behind the last level."""

    stages: int
    gravity: np.ndarray
    nodes: np.ndarray
    bars: list  # dicts: nodes (lower, upper), length, mass
    cables: list  # dicts: nodes, k, c, rest_length
    converged: np.ndarray  # positions of the free nodes: sample, node, coordinate

    def is_free(self, node):
        """Whether a node is the upper end of a bar."""
        return 3 <= node < 3 * (self.stages + 1)

    def free_nodes(self):
        return range(3, 3 * (self.stages + 1))

    def bar_above(self):
        """The bar whose upper end a free node is."""
        return {bar["nodes"][1]: index for index, bar in enumerate(self.bars)}

    def parent(self, index):
        """The bar below a bar, None for the lowest."""
        return self.bar_above().get(self.bars[index]["nodes"][0])

    def frame(self, index):
        """Rotation matrix of a bar's frame: the third axis runs along the bar."""
        lower, upper = (self.nodes[node] for node in self.bars[index]["nodes"])
        along = (upper - lower) / np.linalg.norm(upper - lower)
        aside = np.cross([0.0, 0.0, 1.0], along)
        aside /= np.linalg.norm(aside)
        return np.column_stack([aside, np.cross(along, aside), along])


def read(folder, stages):
    """The mast of this many stages with its converged trajectory."""
    folder = Path(folder)
    scene = json.loads((folder / f"mast-{stages}.json").read_text())
    converged = json.loads((folder / f"mast-{stages}-converged.json").read_text())
    return Mast(
        stages=scene["stages"],
        gravity=np.array(scene["gravity"]),
        nodes=np.array(scene["nodes"]),
        bars=scene["bars"],
        cables=scene["cables"],
        converged=np.array(converged),
    )


def transverse_inertia(bar):
    """A thin bar about its centre [kg m^2]."""
    return bar["mass"] * bar["length"] ** 2 / 12


# A thin bar has no inertia about its axis. Tools with joint coordinates need some; nothing turns a bar about its axis, so
# any value gives the same motion.
AXIAL_INERTIA = 1e-6
