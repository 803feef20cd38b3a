//! Opening the engine as the command line says.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

use ocb_service::advising::PROGRAM;
use ocb_service::{Ceilings, Engine, EngineConfig, MailServer, Profile, SlurmJobs, given};

use crate::args::{CeilingArgs, MailArgs, ServeArgs, Store};
use crate::choice::Switch;
use crate::failure::{Failure, Result};

/// Owner of what the command line makes.
pub const OWNER: &str = "cli";

/// Bytes of a file with certificates; all that a machine trusts have a quarter of it.
const MAX_AUTHORITIES: usize = 1 << 20;

/// What the command needs the engine for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Only to look.
    Look,
    /// To measure one run.
    Measure,
    /// To serve.
    Serve,
}

/// Opens the engine on the data folder.
pub async fn open(store: &Store, purpose: Purpose) -> Result<Engine> {
    Ok(Engine::open(config(store, data(store)?, purpose)).await?)
}

/// Opens the engine to serve at this URL; what guests make stays so many days.
pub async fn open_to_serve(store: &Store, args: &ServeArgs, url: &str) -> Result<Engine> {
    let mail = mail_server(&args.mail, url)?;
    let config = config(store, data(store)?, Purpose::Serve);
    let ceilings = ceilings(&args.ceilings);
    Ok(Engine::open(EngineConfig {
        guest_days: args.guest_days,
        idle: args.idle == Switch::On,
        featured: args.idle == Switch::On,
        elsewhere: args.internal.is_some(),
        most_drift: args.most_drift / 100.0,
        slurm: slurm(args),
        ceilings,
        mail,
        ..config
    })
    .await?)
}

fn slurm(args: &ServeArgs) -> Option<SlurmJobs> {
    let program = args.slurm_job.clone().filter(|_| !args.slurm.is_empty())?;
    Some(SlurmJobs { partitions: args.slurm.clone(), program })
}

fn ceilings(args: &CeilingArgs) -> Ceilings {
    let minutes = |n: u32| Duration::from_secs(60 * u64::from(n));
    Ceilings {
        guest_run: minutes(args.guest_run_minutes),
        guest: minutes(args.guest_minutes),
        account: minutes(args.account_minutes),
        address: minutes(args.address_minutes),
    }
}

/// Who takes the mails of a service at this URL, if anybody does.
fn mail_server(args: &MailArgs, url: &str) -> Result<Option<MailServer>> {
    let MailArgs { smtp_url, smtp_ca, mail_from, public_url } = args;
    let (Some(server), Some(from)) = (smtp_url, mail_from) else { return Ok(None) };
    let server = MailServer::new(server, from, public_url.as_deref().unwrap_or(url))?;
    match smtp_ca {
        Some(file) => Ok(Some(server.trusting(&read_bounded(file, MAX_AUTHORITIES)?)?)),
        None => Ok(Some(server)),
    }
}

/// The data folder.
pub fn data(store: &Store) -> Result<PathBuf> {
    match &store.data {
        Some(folder) => Ok(folder.clone()),
        None => default_data(|name| std::env::var_os(name).map(PathBuf::from)),
    }
}

/// Opens the engine on a folder of its own that goes away, for commands that ask about plugins only: those must work
/// while a service holds the data folder, and leave nothing behind.
pub async fn open_aside(store: &Store) -> Result<(Engine, tempfile::TempDir)> {
    let folder = tempfile::Builder::new()
        .prefix("ocb-")
        .tempdir()
        .map_err(|e| Failure::Fault(format!("cannot create a temporary folder: {e}.")))?;
    let mut config = config(store, folder.path().to_path_buf(), Purpose::Look);
    config.database_url = None;
    config.blob_url = None;
    Ok((Engine::open(config).await?, folder))
}

/// The runner that the command line names, or the one beside this program.
pub fn runner(store: &Store) -> PathBuf {
    store.runner.clone().unwrap_or_else(|| EngineConfig::beside_executable("").runner)
}

/// The plugins that the command line names, or those beside this program.
pub fn plugins(store: &Store) -> Vec<PathBuf> {
    if store.plugins.is_empty() { EngineConfig::beside_executable("").plugins } else { store.plugins.clone() }
}

/// The advisor's program, beside the runner.
pub fn advisor(store: &Store) -> PathBuf {
    runner(store).with_file_name(PROGRAM)
}

fn config(store: &Store, data: PathBuf, purpose: Purpose) -> EngineConfig {
    let mut config = EngineConfig::beside_executable(data);
    config.database_url.clone_from(&store.database);
    config.blob_url.clone_from(&store.blobs);
    config.runner = runner(store);
    config.advisor = advisor(store);
    config.profile = store.profile();
    if config.profile == Profile::Dev && purpose != Purpose::Look {
        eprintln!(
            "ocb: WARNING: Under the profile 'dev', third-party plugins run with the layers that this machine has, and results \
             are marked unranked."
        );
    }
    config.plugins = plugins(store);
    config.stock_dir = store.stock_dir.clone().or_else(beside_us);
    config.suite.clone_from(&store.suite_file);
    config.machine_note.clone_from(&store.machine_note);
    config.dispatch = purpose != Purpose::Look;
    config.catch_up = purpose == Purpose::Serve;
    config
}

/// `stock` beside this program when installed, above it in a build folder.
fn beside_us() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?;
    program.ancestors().skip(1).take(2).map(|folder| folder.join("stock")).find(|folder| folder.is_dir())
}

fn default_data(variable: impl Fn(&str) -> Option<PathBuf>) -> Result<PathBuf> {
    // The XDG rules: a relative path there is to be ignored.
    let xdg = variable("XDG_DATA_HOME").filter(|folder| folder.is_absolute());
    let home =
        || variable("HOME").filter(|folder| !folder.as_os_str().is_empty()).map(|home| home.join(".local/share"));
    xdg.or_else(home).map(|folder| folder.join("opencollbench")).ok_or_else(|| {
        Failure::Input("There is no home folder for the data; name a folder with --data DIR or OCB_DATA.".to_owned())
    })
}

/// Reads a regular file that is given to us, of at most `most` bytes.
pub fn read_bounded(path: &Path, most: usize) -> Result<Vec<u8>> {
    given::read(path, most as u64).map_err(|e| match e.kind() {
        ErrorKind::FileTooLarge => {
            Failure::Input(format!("{} is larger than {}, the limit for this file.", path.display(), size(most)))
        }
        _ => Failure::file("read", path, &e),
    })
}

fn size(bytes: usize) -> String {
    if bytes < 1 << 20 { format!("{} KiB", bytes >> 10) } else { format!("{} MiB", bytes >> 20) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_goes_where_xdg_says() {
        let set = |pairs: &'static [(&str, &str)]| {
            move |name: &str| pairs.iter().find(|(key, _)| *key == name).map(|(_, value)| PathBuf::from(value))
        };
        let ok = |pairs| default_data(set(pairs)).expect("a folder");
        assert_eq!(ok(&[("XDG_DATA_HOME", "/x"), ("HOME", "/h")]), Path::new("/x/opencollbench"));
        assert_eq!(ok(&[("XDG_DATA_HOME", "x"), ("HOME", "/h")]), Path::new("/h/.local/share/opencollbench"));
        assert!(default_data(set(&[])).is_err());
    }
}
