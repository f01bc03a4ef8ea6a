//! JSON objects whose last entry, `crc32`, is the checksum of all before it: what was damaged is not taken for what was
//! written. Other programs read them as they are.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::error::Error;

use crate::checksum::crc32;
use crate::folder::files::CHANGED;

const KEY: &[u8] = b"\"crc32\":";

/// An object on one line.
pub(crate) fn seal(value: &(impl Serialize + ?Sized)) -> Result<Vec<u8>, Error> {
    Ok(close(serde_json::to_vec(value)?, ""))
}

/// An object on lines of its own, indented.
pub(crate) fn seal_indented(value: &(impl Serialize + ?Sized)) -> Result<Vec<u8>, Error> {
    Ok(close(serde_json::to_vec_pretty(value)?, "\n  "))
}

/// Reads an object whose checksum fits.
pub(crate) fn open<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    if fits(bytes) != Some(true) {
        return Err(CHANGED.into());
    }
    serde_json::from_slice(bytes).map_err(|error| error.to_string())
}

/// Whether the checksum fits; nothing where there is none.
pub(crate) fn fits(bytes: &[u8]) -> Option<bool> {
    let at = bytes.windows(KEY.len()).rposition(|window| window == KEY)?;
    let number = bytes[at + KEY.len()..].trim_ascii().strip_suffix(b"}")?;
    let number: u32 = std::str::from_utf8(number).ok()?.trim().parse().ok()?;
    Some(number == crc32(&bytes[..at]))
}

/// Puts the checksum before the last brace.
fn close(mut bytes: Vec<u8>, space: &str) -> Vec<u8> {
    bytes.pop();
    bytes.truncate(bytes.trim_ascii_end().len());
    bytes.push(b',');
    bytes.extend(space.bytes());
    let check = crc32(&bytes);
    bytes.extend_from_slice(KEY);
    let end = if space.is_empty() { "" } else { "\n" };
    bytes.extend(format!("{check}{end}}}\n").bytes());
    bytes
}
