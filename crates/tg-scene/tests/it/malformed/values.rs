//! Numbers, expressions, vectors, files.

use super::wrong;

wrong!(
    unknown_parameter, Toml,
    "\"100 * h\"" => "\"100 * hh\"",
    4:27,
    "there is no parameter `hh`",
    "did you mean `h`?"
);
wrong!(
    circular_parameters, Json,
    "\"h\": 2" => "\"h\": \"k / 100\"",
    5:24,
    "the parameter `h` depends on itself",
    "these wait for each other: `h`, `k`"
);
wrong!(
    bad_expression, Toml,
    "\"100 * h\"" => "\"100 * (h\"",
    4:27,
    "`100 * (h` is no expression: a parenthesis is not closed",
    "numbers, parameters and + - * / % ^ sqrt(x) sin(x) ... make an expression"
);
wrong!(
    division_by_zero, Toml,
    "\"100 * h\"" => "\"100 / (h - 2)\"",
    4:27,
    "the value of `100 / (h - 2)` is inf",
    "a division by zero, or a function outside its range"
);
wrong!(
    function_as_parameter, Toml,
    "h = 2, k" => "sin = 2, h = 2, k",
    4:16,
    "`sin` cannot be the name of a parameter",
    "use letters, digits and _, and no function's name"
);
wrong!(
    unclosed_brace, Toml,
    "\"p {i}\"" => "\"p {i\"",
    13:61,
    "`p {i` opens a brace and does not close it",
    "braces hold an expression: \"name {i + 1}\""
);
wrong!(
    array_of_negative_count, Toml,
    "count = 2" => "count = -1",
    13:24,
    "the value is -1; it must be a whole number from 0 to 100000",
    ""
);
wrong!(
    array_of_half_a_copy, Json,
    "\"count\": 2" => "\"count\": 2.5",
    17:23,
    "the value is 2.5; it must be a whole number from 0 to 100000",
    ""
);
wrong!(
    array_beyond_measure, Toml,
    "count = 2" => "count = 1e9",
    13:24,
    "the value is 1000000000; it must be a whole number from 0 to 100000",
    ""
);
wrong!(
    three_components_in_the_plane, Toml,
    "gravity = [0, \"-g\"]" => "gravity = [0, 0, \"-g\"]",
    3:11,
    "expected 2 components, found 3",
    "scenes with dimension = 2 have x and y, with 3 x, y and z"
);
wrong!(
    three_coordinates_in_the_plane, Toml,
    "right = [1, 0]" => "right = [1, 0, 0]",
    5:37,
    "expected 2 coordinates, found 3",
    "scenes with dimension = 2 have x and y, with 3 x, y and z"
);
wrong!(
    rotation_in_the_plane, Toml,
    "inertia = { polar = 0.1 }" => "inertia = { polar = 0.1 }, rotation = { about = { axis = [0, 0, 1], angle = 1 } }",
    8:8,
    "a rotation in space does not fit the plane",
    "write angle = ... [rad]"
);
wrong!(
    angle_in_space, Space,
    "position = [0, 0, 3]" => "position = [0, 0, 3], angle = 1",
    4:46,
    "in space an angle needs an axis",
    "write rotation = { about = { axis = [0, 0, 1], angle = ... } }"
);
wrong!(
    polar_moment_in_space, Space,
    "principal = [1, 2, 2.5]" => "polar = 1",
    4:68,
    "a body in space has three moments of inertia",
    "principal = [I_x, I_y, I_z] or matrix = [[...], ...]"
);
wrong!(
    principal_moments_in_the_plane, Toml,
    "polar = 0.1" => "principal = [1, 1, 1]",
    8:103,
    "a body in the plane has one moment of inertia",
    "polar = I_z"
);
wrong!(
    ball_in_the_plane, Toml,
    "inertia = { polar = 0.1 }" => "shape = { sphere = 1 }",
    8:98,
    "this shape needs three dimensions",
    "in the plane: box or plate"
);
wrong!(
    bar_without_length, Toml,
    "ends = [[0, 0], \"high\"]" => "ends = [\"high\", \"high\"]",
    7:22,
    "the bar has no length",
    "its two ends are one point; move one"
);
wrong!(
    negative_mass, Toml,
    "mass = 1 }\nbodies" => "mass = -1 }\nbodies",
    7:47,
    "the value is -1; it must be positive",
    ""
);
wrong!(
    negative_mass_of_a_particle, Json,
    "\"at\": [3, 0], \"mass\": 1" => "\"at\": [3, 0], \"mass\": -1",
    17:95,
    "the value is -1; it must be positive",
    ""
);
wrong!(
    negative_stiffness, Toml,
    "stiffness = \"k\"" => "stiffness = -5",
    11:45,
    "the value is -5; it must not be negative",
    ""
);
wrong!(
    impossible_inertia, Space,
    "[1, 2, 2.5]" => "[1, 2, 3.5]",
    4:72,
    "the moments of inertia (1, 2, 3.5) kg m² violate the triangle inequality: I_x + I_y < I_z",
    "no distribution of mass has them, check that they are taken about the mass centre, and their digits"
);
wrong!(
    missing_inertia, Toml,
    ", inertia = { polar = 0.1 }" => "",
    8:8,
    "the body has no inertia",
    "add inertia = { ... }, or a shape"
);
wrong!(
    missing_mass, Toml,
    ", mass = 1 }\nbodies" => " }\nbodies",
    7:6,
    "the bar has no mass",
    "add mass, line_density, or density and radius"
);
wrong!(
    mass_given_twice, Toml,
    "mass = 1 }\nbodies" => "mass = 1, line_density = 2 }\nbodies",
    7:6,
    "the bar's mass is given twice",
    "keep one of mass, line_density and density"
);
wrong!(
    missing_file, Toml,
    "sine = { amplitude = 0.1, frequency = 2 }" => "file = { file = \"nowhere.csv\", value = \"a\" }",
    14:34,
    "nowhere.csv: ",
    "the path counts from the scene's folder"
);
wrong!(
    file_without_column, Json,
    "\"sine\": { \"amplitude\": 0.1, \"frequency\": 2 }" => "\"file\": { \"file\": \"record.csv\", \"value\": \"b\" }",
    19:67,
    "record.csv: there is no column \"b\"",
    "known here: `t`, `a`"
);
wrong!(
    file_with_text, Toml,
    "sine = { amplitude = 0.1, frequency = 2 }" => "file = { file = \"text.csv\", value = \"a\" }",
    14:34,
    "text.csv: line 3: \"one\" is no number",
    ""
);
wrong!(
    file_with_times_in_disorder, Toml,
    "sine = { amplitude = 0.1, frequency = 2 }" => "file = { file = \"unsorted.csv\", value = \"a\" }",
    14:34,
    "unsorted.csv: the table's time number 2 is 0.5 s, not after the one before it; sort the table and remove repeated times",
    ""
);
wrong!(
    times_in_disorder, Toml,
    "sine = { amplitude = 0.1, frequency = 2 }" => "table = { times = [0, 2, 1], values = [0, 1, 0] }",
    14:37,
    "the table's time number 2 is 1 s, not after the one before it",
    "sort the table and remove repeated times"
);
wrong!(
    ramp_without_time, Toml,
    "sine = { amplitude = 0.1, frequency = 2 }" => "ramp = { from = 0, to = 1, duration = 0 }",
    14:16,
    "the ramp lasts 0 s",
    "give a positive duration (for a jump there is no rate)"
);
wrong!(
    tension_beyond_the_spring, Toml,
    "rest = 2 }" => "tension = 1000 }",
    12:70,
    "a tension of 1000 N needs a rest length of -2.7639",
    "a cable of 2.236"
);
wrong!(
    push_beyond_axial_stiffness, Space,
    "tension = 5" => "tension = -200",
    5:67,
    "the axial stiffness does not hold this tension",
    ""
);
wrong!(
    axial_stiffness_of_a_reeled_cable, Space,
    "tension = 5" => "rest = { ramp = { from = 1, to = 2, duration = 1 } }",
    5:79,
    "an axial stiffness needs a constant positive rest length",
    "give stiffness [N/m] to cables that are reeled"
);
wrong!(
    rest_length_twice, Toml,
    "rest = 2 }" => "rest = 2, tension = 5 }",
    12:8,
    "the rest length is given in more than one way",
    "keep one of rest, rest_ratio, tension and force_density"
);
wrong!(
    no_rest_length, Toml,
    ", rest = 2 }" => " }",
    12:8,
    "the cable has no rest length",
    "give one of rest, rest_ratio, tension, force_density, here or in its group"
);
wrong!(
    no_stiffness, Toml,
    ", stiffness = \"k\"" => "",
    12:8,
    "the cable has no stiffness",
    "give stiffness [N/m] or axial_stiffness [N], here or in its group"
);
wrong!(
    unknown_signal, Toml,
    "factor = { signal = \"sway\" }" => "factor = { signal = \"swaying\" }",
    15:70,
    "there is no signal \"swaying\" above",
    "did you mean `sway`?"
);
wrong!(
    axis_without_direction, Space,
    "position = [0, 0, 3]" => "position = [0, 0, 3], rotation = { about = { axis = [0, 0, 0], angle = 1 } }",
    4:68,
    "the axis has no direction",
    ""
);
wrong!(
    matrix_that_does_not_rotate, Space,
    "position = [0, 0, 3]" => "position = [0, 0, 3], rotation = { matrix = [[1, 0, 0], [0, 2, 0], [0, 0, 1]] }",
    4:60,
    "rotation of the pose is not a rotation: RᵀR differs from the identity by 3.000e0, det R = 2.000000",
    "orthonormalise its columns and make them right-handed"
);
wrong!(
    flat_tetrahedron, Space,
    "box = [1, 1, 2]" => "tetrahedron = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]",
    3:40,
    "the four vertices lie in one plane",
    ""
);
wrong!(
    step_and_accuracy, Toml,
    "step = 0.01" => "step = 0.01, accuracy = 1e-3",
    16:47,
    "step and accuracy are both given",
    "keep one"
);
wrong!(
    spectral_radius_of_one, Toml,
    "step = 0.01" => "step = 0.01, scheme = \"generalized-alpha\", spectral_radius = 1",
    16:84,
    "the spectral radius is 1; it must be at least 0 and less than 1",
    "1 would damp nothing"
);
wrong!(
    unknown_scheme, Toml,
    "step = 0.01" => "step = 0.01, scheme = \"runge-kutta\"",
    16:45,
    "`runge-kutta` is not known here",
    "did you mean `runge-kutta-"
);
wrong!(
    tolerance_without_scheme, Toml,
    "step = 0.01" => "step = 0.01, tolerance = 1e-6",
    16:48,
    "the scheme symplectic has no error control",
    "leave tolerance out, or take scheme"
);
wrong!(
    tolerance_of_fixed_steps, Json,
    "\"step\": 0.01" => "\"step\": 0.01, \"scheme\": \"leapfrog\", \"tolerance\": 1e-6",
    21:76,
    "the scheme leapfrog has no error control",
    "leave tolerance out, or take scheme"
);
wrong!(
    tolerance_and_accuracy, Toml,
    "step = 0.01" => "scheme = \"runge-kutta-8\", tolerance = 1e-6, accuracy = 1e-3",
    16:61,
    "tolerance and accuracy are both given",
    "keep one"
);
wrong!(
    negative_tolerance, Toml,
    "step = 0.01" => "scheme = \"runge-kutta-8\", tolerance = -1e-6",
    16:61,
    "the value is -0.000001; it must be positive",
    ""
);
wrong!(no_step, Json, ", \"step\": 0.01" => "", 21:24, "the run has no step", "give step [s] or accuracy [m]");
wrong!(infinite, Toml, "h = 2" => "h = inf", 4:20, "the value is inf", "give a finite number");
