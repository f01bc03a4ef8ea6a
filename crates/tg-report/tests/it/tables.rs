//! Every format gives back what was put in.

use tempfile::tempdir;
use tg_report::{Channel, ReportError, Table};

use crate::sample;

#[test]
fn parquet_gives_back_all() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("t.parquet");
    let mut table = sample::table(10_000);
    table.columns[3][7] = f64::NEG_INFINITY;
    table.write_parquet(&path).unwrap();
    assert_eq!(Table::read_parquet(&path).unwrap(), table);
    let empty = sample::table(0);
    empty.write_parquet(&path).unwrap();
    assert_eq!(Table::read_parquet(&path).unwrap(), empty);
}

#[test]
fn csv_gives_back_names_units_and_every_bit() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("t.csv");
    let mut table = sample::table(500);
    table.columns[1][3] = f64::NAN;
    table.columns[1][4] = f64::INFINITY;
    table.columns[1][5] = f64::MIN_POSITIVE;
    table.columns[1][6] = -0.0;
    table.channels.push(Channel::new("odd [name]", "", "point"));
    table.columns.push(vec![0.1 + 0.2; 500]);
    table.write_csv(&path).unwrap();
    let back = Table::read_csv(&path).unwrap();
    let names = |t: &Table| t.channels.iter().map(|c| (c.name.clone(), c.unit.clone())).collect::<Vec<_>>();
    assert_eq!(names(&back), names(&table));
    for (a, b) in back.columns.iter().flatten().zip(table.columns.iter().flatten()) {
        assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()), "{a} {b}");
    }
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("time [s],kinetic [J],total [J],cable 1.tension [N],"), "{text:.200}");
}

#[test]
fn npy_gives_back_columns() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("t.npy");
    let table = sample::table(300);
    table.write_npy(&path).unwrap();
    let back = Table::read_npy(&path).unwrap();
    assert_eq!(back.columns, table.columns);
    assert!(back.channels.iter().zip(&table.channels).all(|(a, b)| a.name == b.name));
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(
        (bytes.len() - 300 * 8 * table.channels.len()) % 64,
        0,
        "data start at a multiple of 64 bytes"
    );
    table.write_npy_plain(&path).unwrap();
    assert_eq!(Table::read_npy(&path).unwrap(), table);
}

#[test]
fn damaged_files_are_named() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("t");
    for bytes in [&b""[..], b"PAR1", b"\x93NUMPY\x01\x00\xff\xff", b"a,b\n1,x\n", b"a,b\n1\n"] {
        std::fs::write(&path, bytes).unwrap();
        assert!(matches!(Table::read_parquet(&path), Err(ReportError::Damaged { .. })));
        assert!(matches!(Table::read_npy(&path), Err(ReportError::Damaged { .. })));
        if bytes.len() > 4 {
            assert!(matches!(Table::read_csv(&path), Err(ReportError::Damaged { .. })), "{bytes:?}");
        }
    }
}

/// Found by fuzzing: a size below zero, for which the reader of Parquet panics.
#[test]
fn a_parquet_file_with_any_wrong_byte_is_read_or_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("t");
    let mut table = Table::new(vec![Channel::time()]);
    table.push(&[1.0]).unwrap();
    table.write_parquet(&path).unwrap();
    let sound = std::fs::read(&path).unwrap();
    let mut outside = 0;
    for at in 0..sound.len() {
        for change in [0x01, 0x40, 0xff] {
            let mut damaged = sound.clone();
            damaged[at] ^= change;
            std::fs::write(&path, damaged).unwrap();
            if let Err(error) = Table::read_parquet(&path) {
                outside += usize::from(error.to_string().contains("is not in the file"));
            }
        }
    }
    assert!(outside > 0);
}

#[test]
fn names_must_differ() {
    let folder = tempdir().unwrap();
    let twice = Table::new(vec![Channel::time(), Channel::time()]);
    for written in [
        twice.write_parquet(&folder.path().join("a")),
        twice.write_csv(&folder.path().join("b")),
        twice.write_npy(&folder.path().join("c")),
    ] {
        assert!(matches!(written, Err(ReportError::Channel { index: 1, .. })));
    }
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}
