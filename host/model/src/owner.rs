//! Whose something is.

use std::fmt;

use uuid::Uuid;

/// Who owns runs, objects and advice. As text, which is what the store keeps: `account:ID`; a guest's id, which is a UUID; or any
/// other name, which is that of whoever works at the machine itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner<'a> {
    /// An account, by its id.
    Account(&'a str),
    /// A visitor without an account.
    Guest(&'a str),
    /// The command line, or the service itself.
    Operator(&'a str),
}

const ACCOUNT: &str = "account:";

impl<'a> Owner<'a> {
    /// Who this text stands for.
    pub fn of(text: &'a str) -> Self {
        match text.strip_prefix(ACCOUNT) {
            Some(id) => Self::Account(id),
            None if Uuid::try_parse(text).is_ok() => Self::Guest(text),
            None => Self::Operator(text),
        }
    }

    /// The account's id, if it is one.
    pub fn account(self) -> Option<&'a str> {
        match self {
            Self::Account(id) => Some(id),
            Self::Guest(_) | Self::Operator(_) => None,
        }
    }
}

impl fmt::Display for Owner<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Account(id) => write!(f, "{ACCOUNT}{id}"),
            Self::Guest(name) | Self::Operator(name) => f.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_owner_is_the_same_as_text_and_back() {
        let guest = "0192c3a4-0000-7000-8000-000000000001";
        let all = [Owner::Account("7"), Owner::Account(guest), Owner::Guest(guest), Owner::Operator("command line")];
        for owner in all {
            assert_eq!(Owner::of(&owner.to_string()), owner);
        }
        assert_eq!(all.map(Owner::account), [Some("7"), Some(guest), None, None]);
    }
}
