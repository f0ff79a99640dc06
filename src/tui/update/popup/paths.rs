//! Completing paths, folder by folder.

use crate::assets;
use crate::report::printable;

/// The files and folders whose paths begin like this. What begins with a dot has to be asked for with it.
pub(super) fn beginning(text: &str) -> Result<Vec<String>, String> {
    let (folder, name) = text.rsplit_once('/').map_or((None, text), |(folder, name)| (Some(folder), name));
    let (before, looked) = match folder {
        None => (String::new(), "."),
        Some("") => ("/".into(), "/"),
        Some(folder) => (format!("{folder}/"), folder),
    };
    let entries = assets::list_folder(looked.as_ref()).map_err(|error| error.to_string())?;
    let named = entries.iter().filter_map(|(path, is_folder)| {
        let own = path.file_name()?.to_str()?;
        let begins = own.starts_with(name) && (name.starts_with('.') || !own.starts_with('.'));
        // What cannot be typed cannot be completed to.
        let typed = begins && printable(own) == own && !own.contains('\n');
        typed.then(|| format!("{before}{own}{}", if *is_folder { "/" } else { "" }))
    });
    Ok(named.collect())
}

/// What all of them begin with.
pub(super) fn common(choices: &[String]) -> String {
    let Some((first, others)) = choices.split_first() else { return String::new() };
    let shared = |other: &String| {
        let same = first.chars().zip(other.chars()).take_while(|(a, b)| a == b);
        same.map(|(a, _)| a.len_utf8()).sum::<usize>()
    };
    let len = others.iter().map(shared).min().unwrap_or(first.len());
    first[..len].to_owned()
}
