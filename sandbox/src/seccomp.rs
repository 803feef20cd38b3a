//! The system call filter: `syscalls.json` compiled, with "ask the supervisor" as the answer to everything else.

use std::collections::BTreeMap;
use std::io;
use std::str::FromStr;

use nix::errno::Errno;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter, SeccompRule, TargetArch,
};
use serde::Deserialize;
use serde_json::Value;
use syscalls::Sysno;

/// The list, as it stands in the repository.
pub const LIST: &str = include_str!("syscalls.json");

/// seccompiler cannot emit "notify": the filter is compiled with this trace action, and the word is replaced after.
const PLACEHOLDER: u16 = 0x7e5;

/// So many filters are put in force once the plugin has been loaded.
pub const TIGHTER: usize = 2;

const RETURN: u16 = (libc::BPF_RET | libc::BPF_K) as u16;
const JUMP_EQUAL: u16 = (libc::BPF_JMP | libc::BPF_JEQ | libc::BPF_K) as u16;
const LOAD_WORD: u16 = (libc::BPF_LD | libc::BPF_W | libc::BPF_ABS) as u16;

/// Why the list cannot be compiled.
#[derive(Debug, thiserror::Error)]
pub enum FilterError {
    /// No JSON of the expected shape.
    #[error("syscalls.json: {0}")]
    Json(#[from] serde_json::Error),
    /// A name that this machine's kernel interface does not have.
    #[error("syscalls.json: there is no system call '{0}'")]
    UnknownCall(String),
    /// A condition that is not understood.
    #[error("syscalls.json: condition '{0}' of '{1}' is not understood")]
    Condition(String, String),
    /// An error name that is not understood.
    #[error("syscalls.json: there is no error '{0}'")]
    UnknownErrno(String),
    /// The compiler refused.
    #[error("the system call list does not compile: {0}")]
    Compile(String),
}

#[derive(Deserialize)]
struct List {
    allow: Vec<Allowed>,
    quiet: Vec<Quiet>,
    /// What fails once the plugin has been loaded.
    after_loading: Vec<Refused>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Allowed {
    call: String,
    #[serde(default)]
    when: Vec<BTreeMap<String, Value>>,
    track: Option<Track>,
    #[serde(rename = "because")]
    _because: String,
}

/// Where alone a line holds.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Track {
    /// In the multi-threaded track.
    Threads,
    /// In the single-threaded track.
    OneThread,
}

impl Track {
    fn holds(track: Option<&Track>, threads: bool) -> bool {
        track.is_none_or(|track| matches!(track, Track::Threads) == threads)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Quiet {
    call: String,
    track: Option<Track>,
    errno: String,
    #[serde(rename = "because")]
    _because: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Refused {
    call: String,
    #[serde(default)]
    when: Vec<BTreeMap<String, Value>>,
    errno: String,
    #[serde(rename = "because")]
    _because: String,
}

/// Compiles the list for a process that calls itself `own_pid`, in the single- or in the multi-threaded track.
pub fn compile(own_pid: i32, threads: bool) -> Result<BpfProgram, FilterError> {
    let list: List = serde_json::from_str(LIST)?;
    let mut rules: BTreeMap<i64, Vec<SeccompRule>> = BTreeMap::new();
    for allowed in list.allow.iter().filter(|allowed| Track::holds(allowed.track.as_ref(), threads)) {
        // A call may have a second line for one of the tracks.
        let alternatives = rules.entry(i64::from(number(&allowed.call)?)).or_default();
        alternatives.extend(alternatives_of(&allowed.call, &allowed.when, own_pid)?);
    }
    let filter =
        SeccompFilter::new(rules, SeccompAction::Trace(PLACEHOLDER.into()), SeccompAction::Allow, TargetArch::x86_64);
    let compiled: Result<BpfProgram, _> = filter.and_then(BpfProgram::try_from);
    let mut program = compiled.map_err(|e| FilterError::Compile(e.to_string()))?;
    notify_instead_of_trace(&mut program)?;
    insert_quiet(&mut program, list.quiet.iter().filter(|quiet| Track::holds(quiet.track.as_ref(), threads)))?;
    Ok(program)
}

/// One rule for each entry.
fn alternatives_of(
    call: &str,
    when: &[BTreeMap<String, Value>],
    own_pid: i32,
) -> Result<Vec<SeccompRule>, FilterError> {
    let rule = |when: &BTreeMap<String, Value>| {
        let conditions = when.iter().map(|(text, value)| condition(text, value, own_pid, call));
        SeccompRule::new(conditions.collect::<Result<Vec<_>, _>>()?).map_err(|e| FilterError::Compile(e.to_string()))
    };
    when.iter().map(rule).collect()
}

/// Compiles the filters for after the plugin has been loaded, one for each error that they give, in the order in which they
/// are to be installed: the last one forbids installing any.
pub fn compile_tighter() -> Result<Vec<BpfProgram>, FilterError> {
    let list: List = serde_json::from_str(LIST)?;
    let mut programs: Vec<(i32, BTreeMap<i64, Vec<SeccompRule>>)> = Vec::new();
    for refused in &list.after_loading {
        let errno = errno(&refused.errno).ok_or_else(|| FilterError::UnknownErrno(refused.errno.clone()))?;
        let rules = alternatives_of(&refused.call, &refused.when, 0)?;
        let number = i64::from(number(&refused.call)?);
        match programs.iter_mut().find(|(known, _)| *known == errno) {
            Some((_, program)) => drop(program.insert(number, rules)),
            None => programs.push((errno, BTreeMap::from([(number, rules)]))),
        }
    }
    let compile = |(errno, rules): (i32, _)| {
        let refused = SeccompAction::Errno(errno as u32);
        let filter = SeccompFilter::new(rules, SeccompAction::Allow, refused, TargetArch::x86_64);
        filter.and_then(BpfProgram::try_from).map_err(|e| FilterError::Compile(e.to_string()))
    };
    programs.into_iter().map(compile).collect()
}

fn notify_instead_of_trace(program: &mut BpfProgram) -> Result<(), FilterError> {
    let trace = libc::SECCOMP_RET_TRACE | u32::from(PLACEHOLDER);
    let mut found = 0;
    for instruction in program.iter_mut().filter(|i| i.code == RETURN && i.k == trace) {
        instruction.k = libc::SECCOMP_RET_USER_NOTIF;
        found += 1;
    }
    if found == 0 {
        return Err(FilterError::Compile("no default action found in the compiled filter".into()));
    }
    Ok(())
}

/// Puts the quiet calls in front of the rules: behind the architecture check and the load of the call's number.
fn insert_quiet<'a>(program: &mut BpfProgram, quiet: impl Iterator<Item = &'a Quiet>) -> Result<(), FilterError> {
    let number_loaded = program.iter().position(|i| i.code == LOAD_WORD && i.k == 0);
    let at = 1 + number_loaded.ok_or_else(|| FilterError::Compile("the filter never loads the number".into()))?;
    let mut front = Vec::new();
    for call in quiet {
        let errno = match call.errno.as_str() {
            "0" => 0,
            name => errno(name).ok_or_else(|| FilterError::UnknownErrno(name.to_string()))?,
        };
        front.push(seccompiler::sock_filter { code: JUMP_EQUAL, jt: 0, jf: 1, k: number(&call.call)? as u32 });
        front.push(seccompiler::sock_filter { code: RETURN, jt: 0, jf: 0, k: libc::SECCOMP_RET_ERRNO | errno as u32 });
    }
    program.splice(at..at, front);
    Ok(())
}

fn errno(name: &str) -> Option<i32> {
    [Errno::ENOSYS, Errno::ENOTTY, Errno::ENOENT, Errno::EPERM]
        .into_iter()
        .find(|known| format!("{known:?}") == name)
        .map(|known| known as i32)
}

/// `arg2 & 0x4` (masked equality), `arg0 ==`, `arg0 <=`; the value is a number or `own process`.
fn condition(text: &str, value: &Value, own_pid: i32, call: &str) -> Result<SeccompCondition, FilterError> {
    let not_understood = || FilterError::Condition(text.to_string(), call.to_string());
    let value = match value {
        Value::String(own) if own == "own process" => own_pid as u64,
        number => number.as_u64().ok_or_else(not_understood)?,
    };
    let mut words = text.split_whitespace();
    let argument = words.next().and_then(|w| w.strip_prefix("arg")).and_then(|w| w.parse().ok());
    let operator = match (words.next(), words.next()) {
        (Some("=="), None) => SeccompCmpOp::Eq,
        (Some("<="), None) => SeccompCmpOp::Le,
        (Some("&"), Some(mask)) => {
            let digits = mask.strip_prefix("0x").ok_or_else(not_understood)?;
            SeccompCmpOp::MaskedEq(u64::from_str_radix(digits, 16).map_err(|_| not_understood())?)
        }
        _ => return Err(not_understood()),
    };
    SeccompCondition::new(argument.ok_or_else(not_understood)?, SeccompCmpArgLen::Qword, operator, value)
        .map_err(|e| FilterError::Compile(e.to_string()))
}

fn number(name: &str) -> Result<i32, FilterError> {
    Sysno::from_str(name).map(|call| call.id()).map_err(|_| FilterError::UnknownCall(name.to_string()))
}

/// The name of a system call; `?` when this kernel interface has none of that number.
pub fn name_of(nr: i64) -> String {
    usize::try_from(nr).ok().and_then(Sysno::new).map_or_else(|| "?".to_string(), |call| call.name().to_string())
}

/// Puts the filter in force for this process, for good. Returns the listener's descriptor.
pub fn install(program: &BpfProgram) -> io::Result<i32> {
    set(program, libc::SECCOMP_FILTER_FLAG_NEW_LISTENER)
}

/// Puts the tighter filters in force beside the first: nothing is opened, and no file and no code mapped, any more.
pub fn tighten(programs: &[BpfProgram]) -> io::Result<()> {
    programs.iter().try_for_each(|program| set(program, 0).map(drop))
}

fn set(program: &BpfProgram, flags: libc::c_ulong) -> io::Result<i32> {
    let prog =
        libc::sock_fprog { len: program.len() as u16, filter: program.as_ptr().cast_mut().cast::<libc::sock_filter>() };
    // SAFETY: the program outlives the call, which copies it; seccompiler's instruction has the kernel's layout.
    let done = unsafe { libc::syscall(libc::SYS_seccomp, libc::SECCOMP_SET_MODE_FILTER, flags, &raw const prog) };
    if done < 0 { Err(io::Error::last_os_error()) } else { Ok(done as i32) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_compiles_and_asks_by_default() {
        let program = compile(2, false).unwrap();
        assert!(program.iter().any(|i| i.code == RETURN && i.k == libc::SECCOMP_RET_USER_NOTIF));
        assert!(!program.iter().any(|i| i.code == RETURN && i.k & 0xffff_0000 == libc::SECCOMP_RET_TRACE));
        assert!(program.len() < usize::from(u16::MAX));
    }

    #[test]
    fn the_tighter_list_compiles_and_only_refuses() {
        let programs = compile_tighter().unwrap();
        let returns = |program: &BpfProgram, value| program.iter().any(|i| i.code == RETURN && i.k == value);
        for (program, errno) in programs.iter().zip([libc::ENOENT, libc::EPERM]) {
            assert!(returns(program, libc::SECCOMP_RET_ERRNO | errno as u32), "{program:?}");
            assert!(returns(program, libc::SECCOMP_RET_ALLOW) && !returns(program, libc::SECCOMP_RET_USER_NOTIF));
        }
        assert_eq!(programs.len(), TIGHTER);
        let installs = |program: &BpfProgram| program.iter().any(|i| i.k == libc::SYS_seccomp as u32);
        assert_eq!(programs.iter().map(installs).collect::<Vec<_>>(), [false, true], "the last forbids another");
    }

    #[test]
    fn a_foreign_architecture_is_killed() {
        let program = compile(2, false).unwrap();
        assert!(program.iter().take(4).any(|i| i.code == RETURN && i.k == libc::SECCOMP_RET_KILL_PROCESS));
    }

    #[test]
    fn every_line_has_a_reason() {
        let list: List = serde_json::from_str(LIST).unwrap();
        let reasons = list.allow.iter().map(|a| &a._because).chain(list.quiet.iter().map(|q| &q._because));
        assert!(reasons.chain(list.after_loading.iter().map(|r| &r._because)).all(|reason| reason.len() > 4));
    }

    #[test]
    fn calls_are_named() {
        assert_eq!(name_of(41), "socket");
        assert_eq!(name_of(9999), "?");
        assert_eq!(name_of(-1), "?");
    }

    #[test]
    fn an_unknown_condition_is_refused() {
        for text in ["arg0", "arg0 >", "arg2 & 4", "argx ==", ""] {
            assert!(condition(text, &Value::from(1), 2, "read").is_err(), "{text}");
        }
    }
}
