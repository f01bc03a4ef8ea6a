//! The text itself: grammar, keys, kinds of values.

use super::wrong;

wrong!(
    misspelt_key, Toml,
    "mass = 1 }\nbodies" => "mas = 1 }\nbodies",
    7:40,
    "unknown key `mas`",
    "did you mean `mass`?"
);
wrong!(
    misspelt_key_in_json, Json,
    "\"gravity\": [0" => "\"gravty\": [0",
    4:3,
    "unknown key `gravty`",
    "did you mean `gravity`?"
);
wrong!(
    misspelt_section, Toml,
    "supports.foot" => "suports.foot",
    10:1,
    "unknown key `suports`",
    "did you mean `supports`?"
);
wrong!(
    misspelt_enumeration, Toml,
    "law = \"linear\"" => "law = \"liner\"",
    11:23,
    "`liner` is not known here",
    "did you mean `linear`?"
);
wrong!(
    misspelt_signal, Toml,
    "sine = {" => "sinus = {",
    14:18,
    "`sinus` is not known here",
    "did you mean `sine`?"
);
wrong!(
    text_for_a_list, Toml,
    "translate = [1, 0]" => "translate = \"x\"",
    13:39,
    "expected a list, found the text \"x\"",
    ""
);
wrong!(
    list_for_a_number, Json,
    "\"duration\": 1" => "\"duration\": [1]",
    21:24,
    "expected a number or an expression in quotes, found a list",
    ""
);
wrong!(
    truth_for_a_number, Toml,
    "mass = 1 }\nbodies" => "mass = true }\nbodies",
    7:47,
    "expected a number or an expression in quotes, found `true`",
    ""
);
wrong!(
    fractional_version, Toml,
    "version = 1" => "version = 1.5",
    1:11,
    "expected a whole number, found the number 1.5",
    ""
);
wrong!(
    missing_key, Json,
    "\"places\": [\"mast.to\", \"plate.origin\"]" => "",
    12:22,
    "the key `places` is missing",
    ""
);
wrong!(
    missing_version, Toml,
    "version = 1\n" => "",
    1:1,
    "the key `version` is missing",
    "a scene begins with version = 1 and dimension = 2 or 3"
);
wrong!(
    key_twice, Toml,
    "mass = 1 }\nbodies" => "mass = 1, mass = 2 }\nbodies",
    7:50,
    "the key `mass` stands here a second time",
    "remove one of the two"
);
wrong!(
    key_twice_in_json, Json,
    "\"version\": 1," => "\"version\": 1, \"version\": 1,",
    2:17,
    "the key `version` stands here a second time",
    "remove one of the two"
);
wrong!(
    key_and_alias, Toml,
    "rest = 2 }" => "rest = 2, rest_length = 2 }",
    12:70,
    "`rest` is given twice (a key and its alias count as one)",
    "remove one of the two"
);
wrong!(
    section_and_alias, Toml,
    "cables.guy" => "strings.x = { ends = [\"right\", \"mast.to\"], group = \"guys\", rest = 2 }\ncables.guy",
    13:1,
    "`cables` is given twice (a key and its alias count as one)",
    "remove one of the two"
);
wrong!(
    version_2, Toml,
    "version = 1" => "version = 2",
    1:11,
    "this program reads version 1 of scenes, not 2",
    ""
);
wrong!(
    dimension_4, Json,
    "\"dimension\": 2" => "\"dimension\": 4",
    3:16,
    "a scene has 2 or 3 dimensions, not 4",
    ""
);
wrong!(
    date, Toml,
    "version = 1" => "version = 1\ntitle = 2026-01-01",
    2:9,
    "a date is not expected here",
    "a scene has no dates; put text in quotes"
);
wrong!(
    integer_overflow, Toml,
    "mass = 1 }\nbodies" => "mass = 9223372036854775808 }\nbodies",
    7:47,
    "the integer does not fit 64 bits",
    "write it as 1.0e30"
);
wrong!(
    negative_version, Json,
    "\"version\": 1" => "\"version\": -1",
    2:14,
    "expected a whole number, found the number -1",
    ""
);
wrong!(
    type_of_space_in_the_plane, Toml,
    "inertia = { polar = 0.1 }" => "inertia = { polar = 0.1 }, type = \"RUVW\"",
    8:113,
    "coordinate type RUVW spans 3 directions and describes no member of 2D space",
    "use RUV, RRV or RRR for a body, RU or RR for a bar, R for a particle"
);
wrong!(
    two_shapes, Space,
    "{ box = [1, 1, 2] }" => "{ box = [1, 1, 2], sphere = 1 }",
    3:24,
    "expected one of `box`, `rectangle`, `cylinder`, `ball`, `sphere`, `tetrahedron`, `plate`, `polygon`, and just one",
    ""
);
wrong!(
    null, Json,
    "\"h\": 2" => "\"h\": null",
    5:24,
    "expected a number or an expression in quotes, found null",
    ""
);
wrong!(not_toml, Toml, whole "<scene version=\"1\"/>", 1:8, "key with no value, expected `=`", "");
wrong!(not_json, Json, whole "version = 1", 1:1, "Unexpected word", "");
wrong!(
    truncated_json, Json,
    whole "{ \"version\": 1,\n  \"dimension\": 2,\n  \"bars\": {",
    3:11,
    "Unterminated object",
    ""
);
wrong!(
    trailing_comma, Json,
    whole "{ \"version\": 1, \"dimension\": 2, }",
    1:31,
    "Trailing commas are not allowed",
    ""
);
wrong!(
    empty_toml, Toml,
    whole "",
    1:1,
    "the key `version` is missing",
    "a scene begins with version = 1 and dimension = 2 or 3"
);
wrong!(empty_json, Json, whole "", 1:1, "the file is empty", "");
wrong!(list_for_a_scene, Json, whole "[1, 2]", 1:1, "expected a table, found a list", "");
wrong!(
    second_table, Toml,
    whole "version = 1\ndimension = 2\n[bars.b]\nends = [[0, 0], [1, 0]]\nmass = 1\n[bars.b]\nmass = 2\n",
    6:7,
    "the key `b` stands here a second time",
    "remove one of the two"
);
