//! The script of a job.

use crate::Error;

/// A script that becomes this command. Its words are quoted, so the shell changes nothing of them.
pub fn script(command: &[String]) -> Result<String, Error> {
    let program = command.first().is_some_and(|program| !program.is_empty());
    // sbatch refuses scripts with some of them, and reads options from lines of their own.
    if !program || command.iter().any(|word| word.contains(char::is_control)) {
        return Err(Error::Command(command.to_vec()));
    }
    let words: Vec<String> = command.iter().map(|word| format!("'{}'", word.replace('\'', r"'\''"))).collect();
    Ok(format!("#!/bin/sh\nexec {}\n", words.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shell_changes_nothing_of_a_command() {
        let words = ["printf", "%s|", "a b", "it's", "$HOME `id` \\", "", "*", "#SBATCH --x", "-n", "é\"'"];
        let text = script(&words.map(str::to_owned)).unwrap();
        #[expect(clippy::disallowed_methods, reason = "the test plays a node of Slurm")]
        let said = std::process::Command::new("sh").args(["-c", &text]).output().unwrap();
        assert_eq!(String::from_utf8(said.stdout).unwrap(), "a b|it's|$HOME `id` \\||*|#SBATCH --x|-n|é\"'|");
    }

    #[test]
    fn what_is_no_command_is_refused() {
        for words in [&[] as &[&str], &[""], &["ocb", "a\nb"], &["ocb\0"], &["ocb", "a\r"]] {
            let words: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
            assert!(matches!(script(&words), Err(Error::Command(_))), "{words:?}");
        }
    }
}
