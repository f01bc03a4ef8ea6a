"""Ten lowest modes of the mast about its loaded equilibrium, from scipy: an independent model and solver.

Node coordinates x and bar forces λ; the equilibrium by Newton's method on the whole saddle-point system, the modes by
Lanczos' method on its inverse. Prints ω² [1/s²] and the processor seconds of factorisation and Lanczos alone.

    python modes.py FOLDER N

reads FOLDER/mast-N.json.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from scene import read

COUNT = 10
LEAST, BUDGET = 3, 0.5  # calls, seconds that are measured


class Members:
    """Bars or cables as pairs of nodes; derivatives with respect to all nodes, fixed ones are dropped later."""

    def __init__(self, pairs, nodes):
        self.pairs = np.array(pairs)
        self.size = 3 * nodes
        self.columns = 3 * self.pairs[:, :, None] + np.arange(3)

    def differences(self, x):
        return x[self.pairs[:, 1]] - x[self.pairs[:, 0]]

    def gradient(self, by_difference):
        """Rows d/dx of scalars whose derivative by the difference is given."""
        values = np.stack([-by_difference, by_difference], axis=1)
        rows = np.broadcast_to(np.arange(len(self.pairs))[:, None, None], values.shape)
        entries = values.ravel(), (rows.ravel(), self.columns.ravel())
        return sparse.csr_matrix(entries, shape=(len(self.pairs), self.size))

    def hessian(self, blocks):
        """Sum of the 3 × 3 blocks, second derivatives by the difference, spread to the nodes."""
        signs = np.array([[1.0, -1.0], [-1.0, 1.0]])
        values = signs[None, :, None, :, None] * blocks[:, None, :, None, :]
        rows = np.broadcast_to(self.columns[:, :, :, None, None], values.shape)
        columns = np.broadcast_to(self.columns[:, None, None, :, :], values.shape)
        entries = values.ravel(), (rows.ravel(), columns.ravel())
        return sparse.csr_matrix(entries, shape=(self.size, self.size))


class Structure:
    """Residual, stiffness, constraint Jacobian and mass over the free nodes' coordinates."""

    def __init__(self, mast):
        self.start = mast.nodes
        self.bars = Members([bar["nodes"] for bar in mast.bars], len(mast.nodes))
        self.cables = Members([cable["nodes"] for cable in mast.cables], len(mast.nodes))
        self.lengths = np.array([bar["length"] for bar in mast.bars])
        self.rates = np.array([cable["k"] for cable in mast.cables])
        self.rest = np.array([cable["rest_length"] for cable in mast.cables])
        self.free = np.concatenate([3 * node + np.arange(3) for node in mast.free_nodes()])
        weights = np.zeros(len(mast.nodes))
        masses = np.array([bar["mass"] for bar in mast.bars])
        np.add.at(weights, self.bars.pairs, masses[:, None] / 2)
        self.load = (weights[:, None] * mast.gravity).ravel()[self.free]
        # Consistent mass of thin bars: ∫ of linear shape functions.
        ends = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6
        blocks = masses[:, None, None, None, None] * ends[None, :, None, :, None] * np.eye(3)[None, None, :, None, :]
        rows = np.broadcast_to(self.bars.columns[:, :, :, None, None], blocks.shape)
        columns = np.broadcast_to(self.bars.columns[:, None, None, :, :], blocks.shape)
        mass = sparse.csr_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(self.bars.size,) * 2)
        self.mass = mass[self.free][:, self.free]

    def nodes(self, x):
        every = self.start.copy().ravel()
        every[self.free] = x
        return every.reshape(-1, 3)

    def evaluate(self, x, multipliers):
        """Residual force, constraints, stiffness with the bars' part, Jacobian."""
        nodes = self.nodes(x)
        d = self.cables.differences(nodes)
        length = np.linalg.norm(d, axis=1)
        tension = self.rates * (length - self.rest)
        assert (tension > 0).all(), "a cable is slack"
        along = d / length[:, None]
        force = self.cables.gradient(along).T @ tension
        outer = along[:, :, None] * along[:, None, :]
        density = tension / length
        elastic = (self.rates - density)[:, None, None] * outer + density[:, None, None] * np.eye(3)
        e = self.bars.differences(nodes)
        jacobian = self.bars.gradient(e)
        bar = multipliers[:, None, None] * np.eye(3)
        stiffness = self.cables.hessian(elastic) + self.bars.hessian(bar)
        residual = (force + jacobian.T @ multipliers)[self.free] - self.load
        constraints = ((e * e).sum(axis=1) - self.lengths**2) / 2
        return residual, constraints, stiffness[self.free][:, self.free], jacobian[:, self.free]


def saddle(stiffness, jacobian):
    return sparse.bmat([[stiffness, jacobian.T], [jacobian, None]], format="csc")


def equilibrium(structure):
    """Newton's method in steps of at most 2 cm; what it leaves is printed with the modes."""
    x, multipliers = structure.start.ravel()[structure.free], np.zeros(len(structure.lengths))
    for _ in range(200):
        residual, constraints, stiffness, jacobian = structure.evaluate(x, multipliers)
        system = saddle(stiffness, jacobian)
        step = splu(system).solve(-np.concatenate([residual, constraints]))
        damping = min(1.0, 0.02 / np.abs(step[: len(x)]).max())
        x = x + damping * step[: len(x)]
        multipliers = multipliers + damping * step[len(x) :]
        if damping == 1.0 and np.abs(step[: len(x)]).max() < 1e-14:
            break
    return structure.evaluate(x, multipliers)


def lowest(stiffness, jacobian, mass):
    """ω² of the lowest modes, ascending."""
    n, m = mass.shape[0], jacobian.shape[0]
    factors = splu(saddle(stiffness, jacobian))

    def solve(load):
        return factors.solve(np.concatenate([load, np.zeros(m)]))[:n]

    inverse = LinearOperator((n, n), solve)
    # A start that the constraints allow: nothing else is reached by the inverse.
    start = solve(mass @ np.random.default_rng(1).standard_normal(n))
    values, _ = eigsh(stiffness, k=COUNT, M=mass, sigma=0.0, OPinv=inverse, v0=start)
    return np.sort(values)


def main():
    structure = Structure(read(sys.argv[1], int(sys.argv[2])))
    residual, constraints, stiffness, jacobian = equilibrium(structure)
    times, start = [], time.process_time()
    while len(times) < LEAST or time.process_time() - start < BUDGET:
        before = time.process_time()
        values = lowest(stiffness, jacobian, structure.mass)
        times.append(time.process_time() - before)
    print(
        json.dumps(
            dict(
                modes=float(np.median(times)),
                omega_squared=values.tolist(),
                residual=float(max(np.abs(residual).max(), np.abs(constraints).max())),
            )
        )
    )


if __name__ == "__main__":
    main()
