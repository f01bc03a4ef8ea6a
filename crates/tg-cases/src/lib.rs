//! The papers' examples as regression runs, with independent reference models.
