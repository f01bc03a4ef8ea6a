//! PNG files of 8-bit RGB.

use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::checksum::crc32;
use crate::error::ReportError;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Bytes of a pixel.
const DEPTH: usize = 3;

/// The content of a file; rows of pixels from the top.
pub(super) fn encode(width: usize, height: usize, rgb: &[u8]) -> Result<Vec<u8>, ReportError> {
    let too_large = || ReportError::Drawing {
        what: "PNG".into(),
        reason: format!("{width} times {height} pixels are too many"),
    };
    let [w, h] = [u32::try_from(width).ok(), u32::try_from(height).ok()];
    let (w, h) = w.zip(h).ok_or_else(too_large)?;
    let mut header = [w.to_be_bytes(), h.to_be_bytes()].concat();
    header.extend([8, 2, 0, 0, 0]); // bits, RGB, deflate, filters, not interlaced
    let mut rows = Vec::with_capacity(rgb.len() + height);
    let mut above = vec![0; DEPTH * width];
    for row in rgb.chunks_exact(DEPTH * width) {
        rows.push(2); // the difference to the row above: mostly zeros
        rows.extend(row.iter().zip(&above).map(|(x, up)| x.wrapping_sub(*up)));
        above.copy_from_slice(row);
    }
    let mut file = SIGNATURE.to_vec();
    chunk(&mut file, b"IHDR", &header).ok_or_else(too_large)?;
    chunk(&mut file, b"IDAT", &compress_to_vec_zlib(&rows, 6)).ok_or_else(too_large)?;
    chunk(&mut file, b"IEND", &[]).ok_or_else(too_large)?;
    Ok(file)
}

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) -> Option<()> {
    file.extend(u32::try_from(data.len()).ok()?.to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let check = crc32(&file[start..]);
    file.extend(check.to_be_bytes());
    Some(())
}
