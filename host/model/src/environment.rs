//! Where and under which circumstances a run was measured.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Draw, Estimated, Reference};

/// The facts of the machine and of the clock, attached to each run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Environment {
    /// CPU model.
    pub cpu: String,
    /// CPUs.
    pub cpus: u32,
    /// Memory in bytes.
    pub memory_bytes: u64,
    /// Kernel release.
    pub kernel: String,
    /// Hash over what makes times comparable.
    pub hardware_class: String,
    /// `spin` or `futex`.
    pub clock: String,
    /// Relative change of the clock's rate against the kernel's clock from the start of the program to the end of the run; a few
    /// millionths are measurement error. Absent in results of older versions.
    #[serde(default)]
    pub clock_drift: Option<f64>,
    /// Null round trip that is subtracted: median, with p05 and p95 as its interval, nanoseconds.
    pub null_ns: Estimated,
    /// Times that are longer than the plugin took, because the supervisor was kept from looking; they count only where a
    /// question has no other.
    pub disturbed: u64,
    /// Time of a fixed loop on the measuring CPU: median, p05 and p95 over all passes, nanoseconds.
    #[serde(default)]
    pub calibration_ns: Option<Estimated>,
    /// What `ratio` compares with.
    #[serde(default)]
    pub reference: Option<Reference>,
    /// The seed that was used, and how it came about.
    #[serde(default)]
    pub draw: Option<Draw>,
    /// Layers of the jail in force.
    pub jail: Vec<String>,
    /// `production`, or `dev`: foreign plugins then ran with what layers the machine had, and nothing of it is ranked.
    #[serde(default = "production")]
    pub profile: String,
    /// Version of this program.
    pub version: String,
}

impl Environment {
    /// The drift, if it is more than measurement error.
    pub fn notable_drift(&self) -> Option<f64> {
        self.clock_drift.filter(|drift| drift.abs() > 1e-4)
    }
}

/// What results from before there were profiles were measured in.
fn production() -> String {
    "production".into()
}
