//! A small deterministic source of generic complex numbers (SplitMix64, Steele, Lea & Flood 2014).

use num_complex::Complex64;

/// Deterministic for a given seed, the same on every machine.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A source started from `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform on the unit circle: what the gamma trick asks for.
    pub fn unit(&mut self) -> Complex64 {
        Complex64::from_polar(1.0, std::f64::consts::TAU * self.uniform())
    }

    /// Normal: real and imaginary part of variance 1/2 (Box & Muller).
    pub fn normal(&mut self) -> Complex64 {
        let r = (-(1.0 - self.uniform()).ln()).sqrt();
        self.unit() * r
    }
}
