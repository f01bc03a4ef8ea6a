//! No damage to a scene makes its reader panic; what is refused says where.

use std::fs;
use std::path::Path;

use tg_scene::{Language, SceneError, SceneFile};

/// Damaged copies of each scene.
const COPIES: usize = 150;

/// Random numbers (xorshift), the same in each run.
fn below(state: &mut u64, limit: usize) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state % limit.max(1) as u64) as usize
}

/// A copy with a wrong bit, a wrong byte, cut off, without a piece, or with a piece said twice.
fn damaged(text: &str, random: &mut u64) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let [a, b] = [below(random, bytes.len()), below(random, bytes.len())];
    let piece = a.min(b)..a.max(b);
    match below(random, 5) {
        0 => bytes[a] ^= 1 << below(random, 7),
        1 => bytes[a] = below(random, 128) as u8,
        2 => bytes.truncate(a),
        3 => bytes.splice(piece, []).for_each(drop),
        _ => {
            let again = bytes[piece].to_vec();
            bytes.splice(a..a, again).for_each(drop);
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn of_each_scene() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut random = 1;
    let mut counts = [0, 0];
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let language = match path.extension().and_then(|extension| extension.to_str()) {
            Some("toml") => Language::Toml,
            Some("json") => Language::Json,
            _ => continue,
        };
        let text = fs::read_to_string(&path).unwrap();
        for _ in 0..COPIES {
            let copy = damaged(&text, &mut random);
            let read = SceneFile::parse(&copy, language, "copy", folder.clone())
                .and_then(|file| file.run(&[]).and_then(|_| file.build(&[])));
            match read {
                Ok(_) => counts[0] += 1,
                Err(SceneError::Mistake(mistake)) => {
                    assert!(
                        mistake.line >= 1 && mistake.column >= 1 && !mistake.message.is_empty(),
                        "{copy}"
                    );
                    counts[1] += 1;
                }
                Err(error) => panic!("{error}\nof {copy}"),
            }
        }
    }
    assert!(counts[0] > 50 && counts[1] > 500, "{counts:?}");
}
