//! The papers' examples as regression runs, with independent reference models.
pub mod reference;
