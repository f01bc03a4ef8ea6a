"""The mast in MuJoCo: three chains of bars on ball joints, cables as spatial tendons."""

import mujoco
import numpy as np

from measure import main, sampled, steps_per_sample
from scene import AXIAL_INERTIA, transverse_inertia

STEPS = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4]
SETTINGS = {"Euler": STEPS, "RK4": STEPS}


def text(values):
    return " ".join(repr(float(value)) for value in values)


def quaternion(rotation):
    result = np.zeros(4)
    mujoco.mju_mat2Quat(result, rotation.flatten())
    return result


def bodies(mast, parents):
    """Nested body elements; each bar's frame is at its lower node, its upper node is a site."""
    children = {}
    for index, parent in enumerate(parents):
        children.setdefault(parent, []).append(index)

    def body(index):
        bar, parent = mast.bars[index], parents[index]
        rotation = mast.frame(index)
        if parent is None:
            position = mast.nodes[bar["nodes"][0]]
        else:
            position, rotation = [0, 0, mast.bars[parent]["length"]], mast.frame(parent).T @ rotation
        across, half = transverse_inertia(bar), bar["length"] / 2
        inner = "".join(body(child) for child in children.get(index, []))
        return (
            f'<body pos="{text(position)}" quat="{text(quaternion(rotation))}"><joint type="ball"/>'
            f'<inertial pos="0 0 {half}" mass="{bar["mass"]}" diaginertia="{across} {across} {AXIAL_INERTIA}"/>'
            f'<site name="node{bar["nodes"][1]}" pos="0 0 {bar["length"]}"/>{inner}</body>'
        )

    return "".join(body(index) for index in children[None])


def document(mast, integrator, step):
    """The scene in MJCF. A spring length of 0 to the rest length makes a cable that does not push."""
    above = mast.bar_above()
    parents = [above.get(bar["nodes"][0]) for bar in mast.bars]
    fixed = [node for node in range(len(mast.nodes)) if not mast.is_free(node)]
    sites = "".join(f'<site name="node{node}" pos="{text(mast.nodes[node])}"/>' for node in fixed)
    tendons = "".join(
        f'<spatial stiffness="{cable["k"]!r}" damping="{cable["c"]!r}" springlength="0 {cable["rest_length"]!r}">'
        f'<site site="node{cable["nodes"][0]}"/><site site="node{cable["nodes"][1]}"/></spatial>'
        for cable in mast.cables
    )
    return (
        f'<mujoco><option timestep="{step!r}" integrator="{integrator}" gravity="{text(mast.gravity)}">'
        '<flag contact="disable" constraint="disable"/></option><size memory="512M"/>'
        f"<worldbody>{sites}{bodies(mast, parents)}</worldbody><tendon>{tendons}</tendon></mujoco>"
    )


def run(mast, variant, step, samples):
    model = mujoco.MjModel.from_xml_string(document(mast, variant, step))
    data = mujoco.MjData(model)
    sites = [model.site(f"node{node}").id for node in mast.free_nodes()]
    count = steps_per_sample(step)

    def positions():
        # Positions of sites belong to the beginning of the last step otherwise.
        mujoco.mj_kinematics(model, data)
        return data.site_xpos[sites].copy()

    return sampled(lambda _: mujoco.mj_step(model, data, count), positions, mast.converged, samples)


if __name__ == "__main__":
    main("MuJoCo", SETTINGS, run)
