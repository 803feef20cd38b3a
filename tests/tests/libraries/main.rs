//! The wrapped C++ libraries, in the jail, as everybody meets them: what they pass, what they answer on real input, what
//! they are known to answer wrongly, and that those which nobody may ship can be built against one's own copy. And plugins that
//! lie, as the check finds them out.

mod check;
mod known_wrong;
mod liars;
mod near_contact;
mod own_copies;
mod real_input;
mod scenes;
mod settings;
mod single_pairs;
mod support;
mod units;
