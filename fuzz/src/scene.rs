//! Scenes from any bytes: as TOML and as JSON, read, asked for their run and built. Nothing may panic, hang or take memory
//! without measure; errors must be printable.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use tg_scene::{Language, SceneError, SceneFile};

fn look(text: &str, language: Language) -> Result<(), SceneError> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let file = SceneFile::parse(text, language, "fuzz", folder)?;
    file.parameters(&[])?;
    file.run(&[])?;
    file.build(&[]).map(|_| ())
}

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for language in [Language::Toml, Language::Json] {
        if let Err(SceneError::Mistake(mistake)) = look(text, language) {
            assert!(mistake.line >= 1 && mistake.column >= 1 && !mistake.message.is_empty());
            assert!(!mistake.render(true).is_empty() && !mistake.to_string().is_empty());
        }
    }
});
