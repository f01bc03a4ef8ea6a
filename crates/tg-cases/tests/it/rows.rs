use tg_cases::row::Rows;
use tg_cases::verify::CASES;

#[track_caller]
fn assert_every_number_holds(name: &str) {
    let case = CASES.into_iter().find(|case| case.name == name).unwrap();
    let rows = (case.rows)().unwrap();
    assert!(rows.len() > 30, "{name} checks only {} numbers", rows.len());
    let failed: Vec<_> = rows.iter().filter(|row| !row.pass).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.iter().all(|row| row.case == name && row.tolerance.is_finite()));
}

/// A test for each case: they run side by side.
macro_rules! cases {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            assert_every_number_holds(stringify!($name));
        })*

        #[test]
        fn every_case_has_its_test() {
            assert_eq!(CASES.map(|case| case.name), [$(stringify!($name)),*]);
        }
    };
}

cases!(example1, example2, example3, antiprism, mechanism, mast);

#[test]
fn a_row_holds_only_within_its_tolerance() {
    let mut rows = Rows::new("test");
    rows.near("inside", "m", (1.0, 1.05), "hand", 0.1);
    rows.near("outside", "m", (1.0, 1.2), "hand", 0.1);
    rows.near("not a number", "m", (f64::NAN, 1.0), "hand", 0.1);
    rows.below("too large", "m", 0.2, "hand", 0.1);
    rows.exact("count", (3, 3), "hand");
    let pass: Vec<bool> = rows.finish().iter().map(|row| row.pass).collect();
    assert_eq!(pass, [true, false, false, false, true]);
}
