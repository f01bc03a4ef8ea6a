//! Table 1, the conversion matrices of (3), (8), (11), and conversions of coordinates.

use crate::common::{Random, distance};
use tg_coords::{CoordType, CoordsError};

/// Y as the paper means it: (3) with its misprints mended, (8) and (11) as printed.
fn printed(t: CoordType) -> Vec<Vec<f64>> {
    let rows: &[&[i32]] = match t {
        CoordType::Ruvw => &[&[1, 0, 0, 0], &[0, 1, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]],
        CoordType::Rrvw => &[&[1, 0, 0, 0], &[-1, 1, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]],
        CoordType::Rrrw => &[&[1, 0, 0, 0], &[-1, 1, 0, 0], &[-1, 0, 1, 0], &[0, 0, 0, 1]],
        CoordType::Rrrr => &[&[1, 0, 0, 0], &[-1, 1, 0, 0], &[-1, 0, 1, 0], &[-1, 0, 0, 1]],
        CoordType::Ruv => &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        CoordType::Rrv => &[&[1, 0, 0], &[-1, 1, 0], &[0, 0, 1]],
        CoordType::Rrr => &[&[1, 0, 0], &[-1, 1, 0], &[-1, 0, 1]],
        CoordType::Ru => &[&[1, 0], &[0, 1]],
        CoordType::Rr => &[&[1, 0], &[-1, 1]],
        CoordType::R => &[&[1]],
    };
    rows.iter().map(|row| row.iter().map(|&x| f64::from(x)).collect()).collect()
}

#[test]
fn the_name_spells_the_nodes() {
    for t in CoordType::ALL {
        let letters: Vec<char> = t.name().chars().collect();
        assert_eq!(t.nodes(), letters.len());
        assert_eq!(t.points(), letters.iter().filter(|&&c| c == 'R').count());
        assert_eq!(t.vectors(), letters.len() - t.points());
        assert_eq!(t.span(), letters.len() - 1);
        for (a, letter) in letters.iter().enumerate() {
            assert_eq!(t.is_point(a), *letter == 'R');
        }
        assert_eq!(t.to_string(), t.name());
        assert_eq!(t.name().to_lowercase().parse::<CoordType>().unwrap(), t);
    }
    assert_eq!(format!("{:>6}", CoordType::Rr), "    RR");
}

/// Table 1: number of coordinates 12, 6, 6, 4 and degrees of freedom 6, 3, 5, 3.
#[test]
fn coordinates_less_constraints_are_the_degrees_of_freedom() {
    let dof = |t: CoordType, d: usize| t.nodes() * d - t.span() * (t.span() + 1) / 2;
    for t in CoordType::ALL {
        match t.span() {
            3 => assert_eq!((t.nodes() * 3, dof(t, 3)), (12, 6)),
            2 => assert_eq!((t.nodes() * 2, dof(t, 2)), (6, 3)),
            1 => assert_eq!((t.nodes() * 3, dof(t, 3), dof(t, 2)), (6, 5, 3)),
            _ => assert_eq!((dof(t, 3), dof(t, 2)), (3, 2)),
        }
        assert_eq!(t.fits(3), t.span() != 2);
        assert_eq!(t.fits(2), t.span() != 3);
    }
}

#[test]
fn conversion_matrices_are_the_papers() {
    for t in CoordType::ALL {
        let y = t.conversion();
        let expected = printed(t);
        assert_eq!(y.len(), expected.len());
        for (i, row) in expected.iter().enumerate() {
            assert_eq!(y.row(i), row.as_slice(), "{t}");
        }
        assert_eq!(t.standard().span(), t.span());
        assert_eq!(t.standard().points(), 1);
    }
}

#[test]
fn conversions_agree_with_the_matrices_and_come_back() {
    let random = &mut Random(1);
    for from in CoordType::ALL {
        let nodes = random.nodes::<3>(from.nodes());
        let standard = from.convert(from.standard(), &nodes).unwrap();
        for (row, node) in printed(from).iter().zip(&standard) {
            let expected =
                row.iter().zip(&nodes).fold(nalgebra::Vector3::zeros(), |sum, (y, q)| sum + q * *y);
            assert!((node - expected).amax() < 1e-15);
        }
        for to in CoordType::ALL {
            let converted = from.convert(to, &nodes);
            if from.span() != to.span() {
                assert_eq!(converted, Err(CoordsError::Span { from, to }));
                continue;
            }
            let converted = converted.unwrap();
            assert!(distance(&to.convert(from, &converted).unwrap(), &nodes) < 1e-15);
            // Both describe the same standard coordinates.
            let again = to.convert(to.standard(), &converted).unwrap();
            assert!(distance(&again, &standard) < 1e-15);
        }
    }
}

#[test]
fn wrong_lists_and_names_are_refused() {
    let nodes = Random(2).nodes::<2>(2);
    assert_eq!(
        CoordType::Rrr.convert(CoordType::Ruv, &nodes),
        Err(CoordsError::NodeCount { coord_type: CoordType::Rrr, expected: 3, found: 2 })
    );
    let error = "RUW".parse::<CoordType>().unwrap_err();
    assert!(error.to_string().contains("`RUW`"));
}
