//! PNG files of 8-bit RGB.

use miniz_oxide::deflate::compress_to_vec_zlib;

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
    let check = crc(&file[start..]);
    file.extend(check.to_be_bytes());
    Some(())
}

/// The format's cyclic redundancy check, polynomial 0xedb88320.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
    let table: [u32; 256] = std::array::from_fn(|n| (0..8).fold(n as u32, |crc, _| step(crc)));
    !bytes.iter().fold(!0, |crc, &byte| table[((crc ^ u32::from(byte)) & 0xff) as usize] ^ (crc >> 8))
}
