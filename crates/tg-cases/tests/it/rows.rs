use tg_cases::row::Rows;
use tg_cases::verify::CASES;

#[test]
fn every_number_of_the_papers_holds() {
    for case in CASES {
        let rows = (case.rows)().unwrap();
        assert!(rows.len() > 30, "{} checks only {} numbers", case.name, rows.len());
        let failed: Vec<_> = rows.iter().filter(|row| !row.pass).collect();
        assert!(failed.is_empty(), "{failed:#?}");
        assert!(rows.iter().all(|row| row.case == case.name && row.tolerance.is_finite()));
    }
}

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
