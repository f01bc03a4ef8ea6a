"""The mast in Drake: a multibody plant with ball joints and linear spring-dampers, continuous in time."""

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    BallRpyJoint,
    FixedOffsetFrame,
    LinearSpringDamper,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder

from measure import main, sampled
from scene import AXIAL_INERTIA, SAMPLE, transverse_inertia

FIXED = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4]
SETTINGS = {
    "semi_explicit_euler": FIXED,
    "runge_kutta3": FIXED,
    "runge_kutta5": FIXED,
    "runge_kutta3, error control": [1e-3, 1e-4, 1e-5, 1e-6, 1e-7],
}


def inertia(bar):
    """About the lower node, in the bar's frame."""
    half, mass = bar["length"] / 2, bar["mass"]
    across = transverse_inertia(bar) / mass
    about_centre = UnitInertia(across, across, AXIAL_INERTIA / mass)
    to_centre = np.array([0.0, 0.0, half])
    return SpatialInertia(mass, to_centre, about_centre.ShiftFromCenterOfMass(to_centre))


def plant_of(mast):
    """The plant with each bar's body, and where each node is: (body, position in its frame)."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(time_step=0.0))
    plant.mutable_gravity_field().set_gravity_vector(mast.gravity)
    world = plant.world_body()
    place = {node: (world, mast.nodes[node]) for node in range(len(mast.nodes)) if not mast.is_free(node)}
    frames = {world.index(): np.eye(3)}
    bodies = []
    for index, bar in enumerate(mast.bars):
        lower, upper = bar["nodes"]
        body = plant.AddRigidBody(f"bar{index}", inertia(bar))
        below, at = place[lower]
        rotation = mast.frame(index)
        # No angle of the joint at the start: far from its singularity.
        turn = RotationMatrix(frames[below.index()].T @ rotation)
        plant.AddJoint(
            BallRpyJoint(
                f"ball{index}",
                plant.AddFrame(FixedOffsetFrame(f"seat{index}", below.body_frame(), RigidTransform(turn, at))),
                body.body_frame(),
            )
        )
        frames[body.index()] = rotation
        place[upper] = (body, np.array([0.0, 0.0, bar["length"]]))
        bodies.append(body)
    for cable in mast.cables:
        (body_a, at_a), (body_b, at_b) = (place[node] for node in cable["nodes"])
        plant.AddForceElement(
            LinearSpringDamper(body_a, at_a, body_b, at_b, cable["rest_length"], cable["k"], cable["c"])
        )
    plant.Finalize()
    return builder.Build(), plant, place


def run(mast, variant, dial, samples):
    diagram, plant, place = plant_of(mast)
    simulator = Simulator(diagram)
    controlled = variant.endswith("error control")
    config = SimulatorConfig(
        integration_scheme=variant.split(",")[0],
        max_step_size=SAMPLE if controlled else dial,
        accuracy=dial if controlled else 1e-3,
        use_error_control=controlled,
        publish_every_time_step=False,
    )
    ApplySimulatorConfig(config, simulator)
    simulator.Initialize()
    context = plant.GetMyContextFromRoot(simulator.get_context())
    world = plant.world_frame()
    nodes = [place[node] for node in mast.free_nodes()]

    def positions():
        return np.array(
            [plant.CalcPointsPositions(context, body.body_frame(), at, world)[:, 0] for body, at in nodes]
        )

    return sampled(lambda k: simulator.AdvanceTo(k * SAMPLE), positions, mast.converged, samples)


if __name__ == "__main__":
    main("Drake", SETTINGS, run)
