//! Pages of `docs`: tables between markers are generated, the rest is written by hand.

use std::fmt::Write as _;
use std::fs;

use crate::{TaskError, root};

/// Replaces what stands between the markers of `part` on a page.
pub(crate) fn insert(page: &str, part: &str, text: &str) -> Result<(), TaskError> {
    let path = root().join(page);
    let page = fs::read_to_string(&path)?;
    let (start, end) = (format!("<!-- {part}: generated -->\n"), format!("<!-- {part}: end -->"));
    let (Some(from), Some(to)) = (page.find(&start), page.find(&end)) else {
        return Err(format!("{} has no markers for {part}", path.display()).into());
    };
    let (before, after) = (&page[..from + start.len()], &page[to..]);
    fs::write(&path, format!("{before}\n{}\n\n{after}", text.trim()))?;
    Ok(())
}

/// A table in Markdown, the first column to the left.
pub(crate) fn table(header: &[String], rows: &[Vec<String>]) -> String {
    let mut text =
        format!("| {} |\n|---|{}\n", header.join(" | "), "---:|".repeat(header.len().saturating_sub(1)));
    for row in rows {
        // A string takes every write.
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// Three digits, an exponent where a number is small or large.
pub(crate) fn digits(x: f64) -> String {
    if !x.is_finite() {
        "–".into()
    } else if x == 0.0 {
        "0".into()
    } else if !(1e-3..1e5).contains(&x.abs()) {
        format!("{x:.1e}")
    } else {
        let decimals = (2 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 5);
        format!("{x:.0$}", decimals as usize)
    }
}
