//! What stands in a mail. Whatever comes from people is a value, never a line of the head.

use std::time::SystemTime;

use lettre::Message;
use lettre::message::header::{HeaderName, HeaderValue};
use lettre::message::{Mailbox, SinglePart};

use super::server::{MailServer, address};
use crate::{EngineError, Result};

/// A mail before it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Letter {
    /// To which address.
    pub to: String,
    /// In one line.
    pub subject: String,
    /// The text, with `\n` between its lines.
    pub text: String,
    /// The link that turns mails off, one for this mail alone.
    pub off: String,
}

impl Letter {
    /// What the account was told; `off` is the secret of the link that turns its mails off.
    pub fn notice(server: &MailServer, account: &str, to: &str, notice: [&str; 3], off: &str) -> Self {
        let (origin, [subject, text, link], off) = (&server.origin, notice, off_link(server, off));
        let text = format!(
            "{text}\n\n{origin}{link}\n\n\
             -- \nThe account {account} at {origin} gets its notices by mail. Unsubscribe without logging in:\n{off}\n\
             Mail settings:\n{origin}/account#mails\n"
        );
        Self { to: to.to_owned(), subject: subject.to_owned(), text, off }
    }

    /// The question whether the address is right.
    pub fn confirmation(server: &MailServer, account: &str, to: &str, secret: &str, off: &str) -> Self {
        let (origin, hours, off) = (&server.origin, server.pace.link.as_secs().div_ceil(3600), off_link(server, off));
        let text = format!(
            "This address was entered for the account {account} at {origin}. To confirm it, log in there and open this link \
             within {hours} h:\n\n{origin}/account#confirm={secret}\n\n\
             If this was not you, ignore this mail: no notices are sent to an unconfirmed address.\n\n\
             -- \nUnsubscribe this account from all mail, without logging in:\n{off}\n"
        );
        Self { to: to.to_owned(), subject: "Confirm your address".to_owned(), text, off }
    }

    /// The mail as it is sent; `id` names it, so that a receiver that gets it twice can tell.
    pub fn written(&self, server: &MailServer, id: &str) -> Result<Message> {
        let wrong = |e: lettre::error::Error| EngineError::fault("Writing a mail failed", e);
        let raw =
            |name: &'static str, value: &str| HeaderValue::new(HeaderName::new_from_ascii_str(name), value.to_owned());
        let mut message = Message::builder()
            .from(Mailbox::new(Some("OpenCollBench".into()), server.from.clone()))
            .to(Mailbox::new(None, address(&self.to)?))
            .subject(format!("[OpenCollBench] {}", one_line(&self.subject)))
            .date(SystemTime::now())
            .message_id(Some(format!("<{id}@{}>", server.from.domain())))
            // Nobody's holiday notice answers.
            .raw_header(raw("Auto-Submitted", "auto-generated"))
            .raw_header(raw("List-Unsubscribe", &format!("<{}>", self.off)));
        // Mail programs then turn mails off by one click (RFC 8058), which is for links with encryption alone.
        if self.off.starts_with("https://") {
            message = message.raw_header(raw("List-Unsubscribe-Post", "List-Unsubscribe=One-Click"));
        }
        message.singlepart(SinglePart::plain(plain(&self.text))).map_err(wrong)
    }
}

/// Opened, it shows a page with a button; mail programs send the click there. Behind `#`, its secret would stay with who opens it.
/// Opening it changes nothing, because programs that scan mails open links. Each mail has a link of its own: the database keeps
/// only the hash of the secret, so that no later mail could repeat it.
fn off_link(server: &MailServer, secret: &str) -> String {
    format!("{}/mails/off/{secret}", server.origin)
}

/// One line without control characters.
pub fn one_line(text: &str) -> String {
    let plain: String =
        text.chars().map(|c| if c.is_control() || "\u{2028}\u{2029}".contains(c) { ' ' } else { c }).collect();
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Lines as mails have them, without other control characters.
fn plain(text: &str) -> String {
    let kept: String = text.chars().filter(|c| *c == '\n' || *c == '\t' || !c.is_control()).collect();
    kept.lines().map(|line| format!("{}\r\n", line.trim_end_matches('\r'))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn server() -> MailServer {
        at("https://ocb.example.org")
    }

    fn at(origin: &str) -> MailServer {
        MailServer::new("smtps://u:p@mail.example.org", "ocb@example.org", origin).unwrap()
    }

    /// Head and body of the letter as it goes over the line.
    fn sent(letter: &Letter) -> (Vec<String>, String) {
        let bytes = letter.written(&server(), "1").unwrap().formatted();
        let text = String::from_utf8(bytes).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        (head.split("\r\n").map(str::to_owned).collect(), body.to_owned())
    }

    #[test]
    fn a_notice_has_its_head_its_text_its_link_and_its_end() {
        let letter =
            Letter::notice(&server(), "ada", "ada@example.org", ["It is public", "A curator\nsays so.", "/p/1"], "s1");
        let (head, body) = sent(&letter);
        for line in [
            "From: OpenCollBench <ocb@example.org>",
            "To: ada@example.org",
            "Subject: [OpenCollBench] It is public",
            "Message-ID: <1@example.org>",
            "Auto-Submitted: auto-generated",
            "List-Unsubscribe: <https://ocb.example.org/mails/off/s1>",
            "List-Unsubscribe-Post: List-Unsubscribe=One-Click",
            "Content-Type: text/plain; charset=utf-8",
        ] {
            assert!(head.iter().any(|l| l == line), "{line} is missing: {head:#?}");
        }
        assert!(head.iter().any(|line| line.starts_with("Date: ")), "{head:#?}");
        assert!(body.starts_with("A curator\r\nsays so.\r\n\r\nhttps://ocb.example.org/p/1\r\n"), "{body}");
        assert!(body.contains("account ada") && body.contains("https://ocb.example.org/account#mails"), "{body}");
        assert!(body.contains("\r\nhttps://ocb.example.org/mails/off/s1\r\n"), "{body}");
    }

    #[test]
    fn every_mail_can_be_turned_off_by_one_click_where_the_link_is_encrypted() {
        let secret = "0123456789abcdef".repeat(4);
        for (origin, one_click) in [("https://ocb.example.org", 1), ("http://127.0.0.1:8080", 0)] {
            let server = at(origin);
            for letter in [
                Letter::notice(&server, "ada", "ada@example.org", ["s", "t", "/p/1"], &secret),
                Letter::confirmation(&server, "ada", "ada@example.org", "other", &secret),
            ] {
                let mail = String::from_utf8(letter.written(&server, "1").unwrap().formatted()).unwrap();
                let (head, body) = mail.split_once("\r\n\r\n").unwrap();
                let link = format!("{origin}/mails/off/{secret}");
                assert!(head.contains(&format!("List-Unsubscribe: <{link}>\r\n")), "whole, in one line: {head}");
                assert_eq!(head.matches("List-Unsubscribe-Post").count(), one_click, "{head}");
                // Long lines are broken for the way.
                assert!(body.replace("=\r\n", "").contains(&link), "{body}");
            }
        }
    }

    #[test]
    fn nothing_that_people_write_becomes_a_line_of_the_head() {
        let evil = "x\r\nBcc: eve@example.org\r\n\r\nInstead\n.\r\nDATA\u{85}Bcc: eve@example.org\u{2028}\0";
        let letter = Letter::notice(&server(), evil, "ada@example.org", [evil, evil, evil], "s1");
        let (head, body) = sent(&letter);
        let fields: Vec<&String> = head.iter().filter(|line| !line.starts_with(' ')).collect();
        assert_eq!(fields.len(), 11, "as many fields as without: {head:#?}");
        assert!(!head.iter().any(|line| line.to_lowercase().starts_with("bcc")), "{head:#?}");
        assert!(!body.replace("\r\n", "").contains(['\r', '\n', '\0']), "{body:?}");
        let other = Letter { to: "ada@example.org\r\nBcc: eve@example.org".into(), ..letter };
        assert!(other.written(&server(), "1").is_err());
    }

    #[test]
    fn letters_beyond_ascii_arrive() {
        let letter = Letter {
            to: "ada@example.org".into(),
            subject: "Größe".into(),
            text: "Ein Stück näher".into(),
            off: "o".into(),
        };
        let (head, body) = sent(&letter);
        assert!(head.iter().any(|line| line.starts_with("Subject: [OpenCollBench] =?utf-8?")), "{head:#?}");
        assert!(body.is_ascii() && !body.is_empty(), "{body}");
    }
}
