//! The system call list read a second time, without the filter's compiler: what it should do to a call.

use std::str::FromStr;

use ocb_sandbox::seccomp;
use serde_json::Value;
use syscalls::Sysno;

/// What the list says about a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is made.
    Allow,
    /// It fails with this error, or answers 0.
    Quiet(i32),
    /// The supervisor is asked, which ends the plugin.
    Ask,
}

/// One condition on one argument.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// Which argument.
    pub argument: usize,
    /// Bits that are looked at.
    pub mask: u64,
    /// Smallest value of these bits.
    pub low: u64,
    /// Largest.
    pub high: u64,
}

/// The list.
pub struct List {
    /// Number, and alternatives of conditions.
    pub allow: Vec<(i64, Vec<Vec<Condition>>)>,
    quiet: Vec<(i64, i32)>,
}

fn number(entry: &Value) -> i64 {
    i64::from(Sysno::from_str(entry["call"].as_str().unwrap()).unwrap().id())
}

impl List {
    /// For a process of this id, in the single- or in the multi-threaded track.
    pub fn read(own_pid: i32, threads: bool) -> Self {
        let list: Value = serde_json::from_str(seccomp::LIST).unwrap();
        let condition = |(text, value): (&String, &Value)| {
            let value = value.as_u64().unwrap_or(own_pid as u64);
            let words: Vec<&str> = text.split(' ').collect();
            let argument = words[0].strip_prefix("arg").unwrap().parse().unwrap();
            match words[1..] {
                ["=="] => Condition { argument, mask: u64::MAX, low: value, high: value },
                ["<="] => Condition { argument, mask: u64::MAX, low: 0, high: value },
                ["&", mask] => {
                    let mask = u64::from_str_radix(&mask[2..], 16).unwrap();
                    Condition { argument, mask, low: value, high: value }
                }
                _ => panic!("{text}"),
            }
        };
        let alternatives = |entry: &Value| -> Vec<Vec<Condition>> {
            let when = entry["when"].as_array().into_iter().flatten();
            when.map(|all| all.as_object().unwrap().iter().map(condition).collect()).collect()
        };
        let holds = |entry: &&Value| match entry["track"].as_str() {
            None => true,
            Some("threads") => threads,
            Some("one_thread") => !threads,
            Some(other) => panic!("{other}"),
        };
        let entries = |name: &str| list[name].as_array().unwrap().iter().filter(holds).cloned().collect::<Vec<_>>();
        let errno = |name: &str| match name {
            "0" => 0,
            "EPERM" => libc::EPERM,
            "ENOENT" => libc::ENOENT,
            "ENOSYS" => libc::ENOSYS,
            "ENOTTY" => libc::ENOTTY,
            other => panic!("{other}"),
        };
        List {
            allow: entries("allow").iter().map(|e| (number(e), alternatives(e))).collect(),
            quiet: entries("quiet").iter().map(|e| (number(e), errno(e["errno"].as_str().unwrap()))).collect(),
        }
    }

    /// What must happen to a call.
    pub fn verdict(&self, nr: i64, arguments: &[u64; 6]) -> Verdict {
        if let Some((_, errno)) = self.quiet.iter().find(|(quiet, _)| *quiet == nr) {
            return Verdict::Quiet(*errno);
        }
        let holds = |c: &Condition| (c.low..=c.high).contains(&(arguments[c.argument] & c.mask));
        let allowed =
            self.allow.iter().filter(|(allowed, _)| *allowed == nr).any(|(_, alternatives)| {
                alternatives.is_empty() || alternatives.iter().any(|all| all.iter().all(holds))
            });
        if allowed { Verdict::Allow } else { Verdict::Ask }
    }
}
