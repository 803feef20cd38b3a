//! `ocb admin`: what only whoever has the data folder may do.

use std::io::{BufRead, IsTerminal};
use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::{
    InvitationInfo, InvitationRequest, InvitationState, MachineFacts, MachineInfo, OwnedCounts, Page, Role,
};

use crate::args::{AdminCommand, Store};
use crate::data::agreed;
use crate::failure::{Failure, Result};
use crate::open::{self, Purpose};
use crate::output;

/// Makes an account of any role or deletes one, invites developers, or looks whether the audit log is whole.
pub async fn admin(store: &Store, command: &AdminCommand, json: bool) -> Result<ExitCode> {
    let engine = open::open(store, Purpose::Look).await?;
    let done = match command {
        AdminCommand::Create { name, role } => create(&engine, name, role, json).await,
        AdminCommand::Delete { name, yes } => delete(&engine, name, *yes, json).await,
        AdminCommand::Invite { recipient, days, server } => invite(&engine, recipient, *days, server, json).await,
        AdminCommand::Invitations => invitations(&engine, json).await,
        AdminCommand::Revoke { id } => revoke(&engine, id, json).await,
        AdminCommand::Machine { name } => machine(&engine, name, json).await,
        AdminCommand::Machines => machines(&engine, json).await,
        AdminCommand::RevokeMachine { name } => revoke_machine(&engine, name, json).await,
        AdminCommand::Audit => audit(&engine, json).await,
    };
    engine.shutdown().await;
    done.map(|()| ExitCode::SUCCESS)
}

async fn create(engine: &Engine, name: &str, role: &str, json: bool) -> Result<()> {
    let role = Role::named(role).ok_or_else(|| Failure::Input(unknown_role(role)))?;
    let account = engine.add_account(name, &password()?, role).await?;
    if json {
        return output::print_json(&account);
    }
    output::print(&format!("{} is now {}.", account.name, role.name()))
}

fn unknown_role(role: &str) -> String {
    format!("Unknown role {role:?}; use user, developer, curator or administrator.")
}

async fn delete(engine: &Engine, name: &str, yes: bool, json: bool) -> Result<()> {
    if !yes {
        let told = engine.deletion_preview(&engine.account_named(name).await?).await?;
        eprintln!("{}\n{}", said("will be deleted:", &told.goes), said("will be kept:   ", &told.stays));
        if !agreed()? {
            return Err(Failure::Input("Nothing was deleted; add --yes to delete it.".to_owned()));
        }
    }
    let told = engine.delete_account_named(name).await?;
    if json {
        return output::print_json(&told);
    }
    output::print(&format!(
        "The account {} is deleted.\n{}\n{}",
        name.trim(),
        said("deleted:", &told.goes),
        said("kept:   ", &told.stays)
    ))
}

fn said(what: &str, counts: &OwnedCounts) -> String {
    let OwnedCounts { runs, objects, configurations, advice, stability, workloads, plugins } = counts;
    format!(
        "{what} runs: {runs}, objects: {objects}, saved configurations: {configurations}, pieces of advice: {advice}, \
         stability runs: {stability}, workloads: {workloads}, plugins: {plugins}"
    )
}

async fn invite(engine: &Engine, recipient: &str, days: u32, server: &str, json: bool) -> Result<()> {
    let asked = InvitationRequest { recipient: recipient.to_owned(), days };
    let made = engine.invite(None, asked, server.trim_end_matches('/'), None).await?;
    if json { output::print_json(&made) } else { output::print(&made.link) }
}

async fn invitations(engine: &Engine, json: bool) -> Result<()> {
    let (mut all, mut page) = (Vec::new(), Page::default());
    loop {
        let part = engine.invitations(&page).await?;
        all.extend(part.entries);
        let Some(next) = part.next else { break };
        page = page.behind(&next);
    }
    if json {
        return output::print_json(&all);
    }
    if all.is_empty() {
        return output::print("No invitations yet; `ocb admin invite RECIPIENT` creates one.");
    }
    let row = |one: &InvitationInfo| {
        let by = one.invited_by.clone().unwrap_or_else(|| "the operator".to_owned());
        let accepted = one.accepted_by.clone().unwrap_or_default();
        vec![one.id.clone(), state(one.state).to_owned(), one.recipient.clone(), by, accepted]
    };
    let headings = ["invitation", "state", "for", "invited by", "accepted by"];
    output::print(&output::table(&headings, all.iter().map(row).collect(), &[]))
}

async fn revoke(engine: &Engine, id: &str, json: bool) -> Result<()> {
    let invitation = engine.revoke_invitation(None, id).await?;
    if json {
        return output::print_json(&invitation);
    }
    output::print(&format!("The invitation for {} is withdrawn.", invitation.recipient))
}

async fn machine(engine: &Engine, name: &str, json: bool) -> Result<()> {
    let token = engine.add_machine(name).await?;
    if json { output::print_json(&serde_json::json!({ "token": token })) } else { output::print(&token) }
}

async fn machines(engine: &Engine, json: bool) -> Result<()> {
    let all = engine.machines().await?;
    if json {
        return output::print_json(&all);
    }
    let row = |it: &MachineInfo| {
        let state = match (it.revoked_us, it.seen_us) {
            (Some(_), _) => "revoked".to_owned(),
            (None, None) => "never seen".to_owned(),
            (None, Some(_)) => match (&it.run, &it.trouble) {
                (Some(run), _) => format!("measures {run}"),
                (None, Some(trouble)) => format!("gets no run: {trouble}"),
                (None, None) => "waits".to_owned(),
            },
        };
        let facts = it.facts.as_ref();
        let told = |of: fn(&MachineFacts) -> &String| facts.map_or(String::new(), |facts| of(facts).clone());
        let drift = it.drift.map_or(String::new(), |ratio| format!("{:+.1} %", 100.0 * (ratio - 1.0)));
        vec![it.name.clone(), state, drift, told(|facts| &facts.hardware_class), told(|facts| &facts.cpu)]
    };
    let headings = ["machine", "state", "drift", "hardware class", "CPU"];
    output::print(&output::table(&headings, all.iter().map(row).collect(), &[]))
}

async fn revoke_machine(engine: &Engine, name: &str, json: bool) -> Result<()> {
    engine.revoke_machine(name).await?;
    if json {
        output::print_json(&serde_json::json!({ "revoked": name }))
    } else {
        output::print(&format!("The token of {name} is revoked."))
    }
}

fn state(state: InvitationState) -> &'static str {
    match state {
        InvitationState::Open => "open",
        InvitationState::Accepted => "accepted",
        InvitationState::Revoked => "withdrawn",
        InvitationState::Expired => "expired",
    }
}

/// From the environment, or the first line of the input: on the command line everybody on the machine would see it.
fn password() -> Result<String> {
    if let Ok(password) = std::env::var("OCB_PASSWORD") {
        return Ok(password);
    }
    if std::io::stdin().is_terminal() {
        eprintln!("Password (visible while you type; use OCB_PASSWORD or a pipe to hide it):");
    }
    let mut line = String::new();
    std::io::stdin().lock().read_line(&mut line).map_err(|e| Failure::Input(format!("Cannot read password: {e}.")))?;
    Ok(line.trim_end_matches(['\r', '\n']).to_owned())
}

async fn audit(engine: &Engine, json: bool) -> Result<()> {
    match engine.broken_audit().await? {
        Some(seq) => Err(Failure::Fault(format!("entry {seq} of the audit log was altered."))),
        None if json => output::print_json(&serde_json::json!({ "whole": true })),
        None => output::print("The audit log is intact."),
    }
}
