//! What a surface is called, and how large its units are.

/// What one model unit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// A millimetre.
    #[default]
    Millimetre,
    /// A metre.
    Metre,
    /// An inch, 25.4 mm.
    Inch,
}

impl Unit {
    /// All of them, in the order of their numbers in files and in C.
    pub const ALL: [Self; 3] = [Self::Millimetre, Self::Metre, Self::Inch];
}

/// What goes with a surface beside its shape, into files and into copies.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Label {
    /// Its name; may be empty.
    pub name: String,
    /// What one model unit is.
    pub unit: Unit,
}
