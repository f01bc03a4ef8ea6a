//! The program outside the workspace that builds and simulates a structure: compiled here as well, since a build of its own
//! takes two minutes.

include!("../../../../examples/downstream/pendulum/src/main.rs");

#[test]
fn pendulum_runs() {
    main().unwrap();
}
