//! `tg schema`, `tg completions`, `tg man`: what is generated from the types.

use clap::CommandFactory;
use serde_json::json;
use tg_report::write_file;

use crate::answer::{Answer, Failure};
use crate::args::{Arguments, Completions, Man, Schema};

pub(crate) fn schema(arguments: &Schema) -> Result<Answer, Failure> {
    let schema = tg_scene::schema();
    let document = schema.to_value();
    let text = if arguments.markdown { tg_scene::reference() } else { crate::answer::pretty(&document) };
    Ok(Answer::new(document, text))
}

pub(crate) fn completions(arguments: &Completions) -> Answer {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "tg", &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    Answer::new(json!({ "completions": script }), script)
}

pub(crate) fn man(arguments: &Man) -> Result<Answer, Failure> {
    let wrong = |error: std::io::Error| Failure::Usage(format!("the manual page cannot be written: {error}"));
    let Some(folder) = &arguments.output else {
        let mut page = Vec::new();
        clap_mangen::Man::new(Arguments::command()).render(&mut page).map_err(wrong)?;
        let page = String::from_utf8_lossy(&page).into_owned();
        return Ok(Answer::new(json!({ "page": page }), page));
    };
    std::fs::create_dir_all(folder).map_err(wrong)?;
    let mut program = Arguments::command();
    program.build();
    let mut names = Vec::new();
    let pages = std::iter::once(program.clone()).chain(program.get_subcommands().cloned());
    for command in pages {
        let man = clap_mangen::Man::new(command);
        let name = man.get_filename();
        let mut page = Vec::new();
        man.render(&mut page).map_err(wrong)?;
        write_file(&folder.join(&name), &page)?;
        names.push(name);
    }
    let text = format!("{} pages in {}\n", names.len(), folder.display());
    Ok(Answer::new(json!({ "pages": names }), text))
}
