//! How mesh files are read: what all commands that take one have in common.

use crate::{Failure, Given};
use clap::{Args, ValueEnum};
use planish::mesh::{Components, Mesh, MeshOptions, MeshRepairs, Repair, read};
use std::path::Path;

#[derive(Debug, Args)]
pub(crate) struct MeshInput {
    /// Join nodes closer than this.
    #[arg(long, default_value_t = 0.0, value_name = "DISTANCE", allow_negative_numbers = true)]
    weld: f64,
    /// Mend these faults too: sheets, beside all that need no guess; with --no-repair any.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "KINDS")]
    repair: Vec<RepairName>,
    /// Refuse all faults but those that --repair names.
    #[arg(long)]
    no_repair: bool,
    /// Turn triangles over until neighbours agree although --no-repair is given.
    #[arg(long)]
    orient: bool,
    /// Take one of several parts that hang together: the largest, or one by its number, counted from 0.
    #[arg(long, value_name = "largest|N", value_parser = component)]
    component: Option<Components>,
    /// Most bytes of a file that are read; 0 for three quarters of the memory.
    #[arg(long, default_value_t = 0, value_name = "BYTES")]
    pub max_memory: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RepairName {
    /// Pass over nodes that no triangle needs.
    Unused,
    /// Leave out triangles with a corner twice, and faces of less than three corners.
    Corners,
    /// Leave out triangles with the nodes of an earlier one.
    Copies,
    /// Make a node of its own for each part that touches others in a node only.
    Touching,
    /// Turn triangles over until neighbours agree.
    Orientation,
    /// Part edges of three and more triangles.
    Sheets,
}

impl RepairName {
    fn kind(self) -> Repair {
        match self {
            Self::Unused => Repair::UNUSED_NODES,
            Self::Corners => Repair::REPEATED_CORNERS,
            Self::Copies => Repair::DUPLICATE_TRIANGLES,
            Self::Touching => Repair::TOUCHING_NODES,
            Self::Orientation => Repair::ORIENTATION,
            Self::Sheets => Repair::SHEETS,
        }
    }
}

fn component(text: &str) -> Result<Components, String> {
    match text {
        "largest" => Ok(Components::Largest),
        _ => text.parse().map(Components::One).map_err(|_| "it is 'largest' or a number".to_owned()),
    }
}

impl MeshInput {
    /// The names of its options.
    const OPTIONS: [&str; 6] = ["weld", "repair", "no-repair", "orient", "component", "max-memory"];

    /// Refuses them where no mesh is read.
    pub(crate) fn refuse(given: &Given) -> Result<(), Failure> {
        Self::OPTIONS
            .iter()
            .try_for_each(|option| given.refuse(option, false, "is not used: the file is no mesh"))
    }

    pub(crate) fn options(&self) -> MeshOptions {
        let base = if self.no_repair { Repair::NONE } else { Repair::SAFE };
        let orient = if self.orient { Repair::ORIENTATION } else { Repair::NONE };
        let named = self.repair.iter().fold(base.with(orient), |repair, name| repair.with(name.kind()));
        MeshOptions {
            weld_distance: self.weld,
            repair: named,
            components: self.component.unwrap_or_default(),
            max_memory: self.max_memory,
            ..MeshOptions::default()
        }
    }

    pub(crate) fn read(&self, path: &Path) -> Result<(Mesh, MeshRepairs), Failure> {
        self.check_repairs()?;
        Ok(read(path, &self.options())?)
    }

    /// Refuses what is mended anyway.
    fn check_repairs(&self) -> Result<(), Failure> {
        let is_safe = |name: &&RepairName| Repair::SAFE.has(name.kind());
        let given = match self.repair.iter().find(is_safe) {
            _ if self.no_repair => return Ok(()),
            Some(name) => {
                let name = name.to_possible_value().map(|value| value.get_name().to_owned());
                format!("--repair {}", name.unwrap_or_default())
            }
            None if self.orient => "--orient".to_owned(),
            None => return Ok(()),
        };
        Err(Failure::new(format!("{given} does nothing: that is mended anyway without --no-repair")))
    }
}

/// An angle between two triangles.
pub(crate) fn degrees(text: &str) -> Result<f64, String> {
    let angle = text.parse().ok().filter(|angle| (0.0..=180.0).contains(angle));
    angle.ok_or_else(|| "it is a number of degrees from 0 to 180".to_owned())
}

/// A number of threads.
pub(crate) fn threads(text: &str) -> Result<usize, String> {
    const MOST: usize = 1024;
    match text.parse() {
        Ok(count) if count <= MOST => Ok(count),
        Ok(_) | Err(_) => Err(format!("it is a number from 0 to {MOST}")),
    }
}
