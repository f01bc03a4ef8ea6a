"""The mast in Exudyn: node coordinates with the bars' consistent mass, distance constraints, spring-dampers."""

import time

import exudyn
import numpy as np
from exudyn.utilities import (
    MarkerNodePosition,
    NodePoint,
    NodePointGround,
    ObjectConnectorDistance,
    ObjectConnectorSpringDamper,
    ObjectGenericODE2,
    SensorNode,
)

from measure import largest_distance, main, steps_per_sample
from scene import SAMPLE, SAMPLES

STEPS = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4]
SETTINGS = {"trapezoidal": STEPS, "generalised alpha": STEPS}
SOLVERS = {
    "trapezoidal": exudyn.DynamicSolverType.TrapezoidalIndex2,
    "generalised alpha": exudyn.DynamicSolverType.GeneralizedAlpha,
}


def system_of(mast):
    """The assembled system and a position sensor for each free node."""
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    nodes = [
        system.AddNode(
            NodePoint(referenceCoordinates=at) if mast.is_free(node) else NodePointGround(referenceCoordinates=at)
        )
        for node, at in enumerate(mast.nodes.tolist())
    ]
    markers = [system.AddMarker(MarkerNodePosition(nodeNumber=node)) for node in nodes]
    for bar in mast.bars:
        free = [node for node in bar["nodes"] if mast.is_free(node)]
        # Consistent mass of a thin bar; an end that stands still drops out.
        weights = np.array([[2.0, 1.0], [1.0, 2.0]]) if len(free) == 2 else np.array([[2.0]])
        system.AddObject(
            ObjectGenericODE2(
                nodeNumbers=[nodes[node] for node in free],
                massMatrix=np.kron(bar["mass"] / 6 * weights, np.eye(3)),
                forceVector=np.tile(bar["mass"] / 2 * mast.gravity, len(free)),
            )
        )
        ends = [markers[node] for node in bar["nodes"]]
        system.AddObject(ObjectConnectorDistance(markerNumbers=ends, distance=bar["length"]))
    for cable in mast.cables:
        system.AddObject(
            ObjectConnectorSpringDamper(
                markerNumbers=[markers[node] for node in cable["nodes"]],
                referenceLength=cable["rest_length"],
                stiffness=cable["k"],
                damping=cable["c"],
            )
        )
    sensors = [
        system.AddSensor(
            SensorNode(nodeNumber=nodes[node], storeInternal=True, outputVariableType=exudyn.OutputVariableType.Position)
        )
        for node in mast.free_nodes()
    ]
    system.Assemble()
    return system, sensors


def run(mast, variant, step, samples):
    system, sensors = system_of(mast)
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = SAMPLE * samples
    integration.numberOfSteps = steps_per_sample(step) * samples
    integration.verboseMode = 0
    integration.newton.useModifiedNewton = True
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = SAMPLE
    settings.parallel.numberOfThreads = 1
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    # The whole run is timed: a pause would be a restart, with new accelerations.
    before = time.process_time()
    solved = system.SolveDynamic(settings, solverType=SOLVERS[variant])
    seconds = time.process_time() - before
    if not solved:
        return None
    columns = [system.GetSensorStoredData(sensor)[:, 1:4] for sensor in sensors]
    positions = np.stack(columns, axis=1)
    error = largest_distance(positions, mast.converged[: len(positions)])
    return seconds * (SAMPLES - 1) / samples, error


if __name__ == "__main__":
    main("Exudyn", SETTINGS, run)
