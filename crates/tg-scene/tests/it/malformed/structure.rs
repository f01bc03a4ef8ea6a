//! Names, places, and what the laws of structures forbid.

use super::wrong;

wrong!(
    unknown_member, Toml,
    "[\"mast.to\", \"plate.origin\"]" => "[\"must.to\", \"plate.origin\"]",
    9:26,
    "there is no member \"must\"",
    "did you mean `mast`?"
);
wrong!(
    unknown_point_of_a_member, Json,
    "\"plate.tip\"" => "\"plate.top\"",
    20:30,
    "\"plate\" has no point \"top\"",
    "known here: `origin`, `tip`, `centre`"
);
wrong!(
    member_without_point, Toml,
    "at = \"plate.tip\"" => "at = \"plate\"",
    15:21,
    "\"plate\" is a member; which of its points?",
    "write \"plate.origin\", \"plate.tip\" or \"plate.centre\""
);
wrong!(
    one_end, Toml,
    "ends = [\"left\", \"mast.to\"]" => "ends = [\"left\"]",
    12:23,
    "a cable has two ends, not 1",
    ""
);
wrong!(
    three_ends, Toml,
    "ends = [[0, 0], \"high\"]" => "ends = [[0, 0], [1, 0], \"high\"]",
    7:22,
    "a bar has two ends, not 3",
    ""
);
wrong!(
    name_taken, Toml,
    "\"p {i}\"" => "\"p\"",
    13:61,
    "the name \"p\" is taken",
    "points, anchors and members have different names; in an array use its index: \"name {i}\""
);
wrong!(
    name_of_a_member_for_an_anchor, Json,
    "\"right\": [1, 0]" => "\"mast\": [1, 0]",
    8:13,
    "the name \"mast\" is taken",
    "points, anchors and members have different names; in an array use its index: \"name {i}\""
);
wrong!(
    place_is_a_point_of_space, Toml,
    "ends = [\"left\", \"mast.to\"]" => "ends = [\"high\", \"mast.to\"]",
    12:24,
    "\"high\" is a point of space, to which nothing can be attached",
    "make it an anchor, or name a point of a member"
);
wrong!(
    coordinates_for_a_place, Toml,
    "ends = [\"left\", \"mast.to\"]" => "ends = [[-1, 0], \"mast.to\"]",
    12:24,
    "a place is expected here, not coordinates",
    "name an anchor or a point of a member; anchors are points of the ground"
);
wrong!(
    cable_without_length, Toml,
    "ends = [\"left\", \"mast.to\"]" => "ends = [\"mast.to\", \"plate.origin\"]",
    12:8,
    "cable \"guy\" has zero length between basic point 1 of \"mast\" and basic point 0 of \"plate\"",
    "its direction is undefined: move an end"
);
wrong!(
    joint_apart, Toml,
    "[\"mast.to\", \"plate.origin\"]" => "[\"mast.to\", \"plate.tip\"]",
    9:8,
    "joint \"pin\": basic point 1 of \"mast\" and point [0.5, 0.0] of \"plate\" are 5.000e-1 m apart (allowed 5.8e-9 m)",
    "place the members so that they meet"
);
wrong!(
    joint_of_a_point_with_itself, Toml,
    "supports.foot" => "joints.again = { places = [\"mast.to\", \"plate.origin\"], joining = \"constrain\" }\nsupports.foot",
    10:8,
    "joint \"again\" joins a point with itself",
    "name the points of two or more different members"
);
wrong!(
    redundant_constraints, Toml,
    "supports.foot" => "supports.tip = { at = { on = \"mast\", at = [0.5] } }\nsupports.foot",
    10:10,
    "1 redundant constraint at tolerance 1e-8: support \"tip.y\" is implied by rigidity u·u of \"mast\"",
    "remove the joint or support that repeats another, or write redundancies = \"drop\" at the top"
);
wrong!(
    contradictory_supports, Toml,
    "supports.foot" => "supports.moved = { at = \"mast.from\", axes = \"x\", motion = { x = { signal = \"sway\" } } }\nsupports.foot",
    10:10,
    "supports \"moved\" and \"foot.x\" both prescribe the x component of basic point 0 of \"mast\", differently",
    "remove one"
);
wrong!(
    unknown_axis, Toml,
    "axes = \"xy\"" => "axes = \"xz\"",
    10:44,
    "there is no axis `z`",
    "axes of this scene: xy"
);
wrong!(
    motion_not_held, Toml,
    "axes = \"xy\"" => "axes = \"y\", motion = { x = 0.1 }",
    10:64,
    "the support moves along x, which it does not hold",
    "add the letter to `axes`"
);
wrong!(
    unknown_group, Json,
    "\"group\": \"guys\"" => "\"group\": \"guy\"",
    15:62,
    "the group \"guy\" is not declared under [groups]",
    "did you mean `guys`?"
);
wrong!(
    unknown_watched_point, Toml,
    "points = [\"mast.to\"]" => "points = [\"mast.top\"]",
    16:46,
    "\"mast\" has no point \"top\"",
    "did you mean `to`?"
);
wrong!(
    two_loads_in_one, Toml,
    "force = [1, 0]" => "force = [1, 0], moment = [1]",
    15:7,
    "a load is one of force, moment and joint_moments",
    "give exactly one"
);
wrong!(
    force_without_place, Toml,
    "at = \"plate.tip\", force" => "force",
    15:7,
    "the force has no place",
    "add at = ..."
);
wrong!(
    type_without_basis, Toml,
    "inertia = { polar = 0.1 }" => "inertia = { polar = 0.1 }, type = \"RRR\"",
    8:113,
    "a body of type RRR needs to know its basic points",
    "basis = [\"p1\", \"p2\", ...], then vectors [x, y, ...]"
);
wrong!(empty_name, Toml, "cables.guy" => "cables.\"\"", 12:8, "the name is empty", "");
wrong!(
    nothing_free, Toml,
    whole "version = 1\ndimension = 2\nbars.b = { ends = [[0, 0], [1, 0]], mass = 1 }\nsupports.a = { at = \"b.from\" }\nsupports.c = { at = \"b.to\" }\n",
    2:13,
    "the structure has no free coordinate",
    "add a member or free a support"
);
wrong!(
    no_members, Toml,
    whole "version = 1\ndimension = 2\nanchors.a = [0, 0]\n",
    2:13,
    "the structure has no free coordinate",
    "add a member or free a support"
);
