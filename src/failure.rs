//! What a failure is, to every module: a sentence, a class, and the offender.
//!
//! Each module has an error of its own, whose sentence names the offender and whose fields carry the numbers a
//! caller needs next. [`Classify`] sorts them into the few classes that a program can act upon.

/// The class of an error: what a program can act upon without reading the sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// An argument is out of its range, or contradicts another.
    InvalidArgument,
    /// A number is NaN or infinite.
    NotFinite,
    /// An index is out of range.
    Index,
    /// The mesh is not connected as the call needs it.
    Topology,
    /// The geometry is degenerate: zero lengths, areas or ranges.
    Degenerate,
    /// A parameter lies outside the domain.
    Outside,
    /// The data do not determine the result.
    Singular,
    /// The call does not apply to this family of surface.
    WrongKind,
    /// The caller's array is too short.
    BufferTooSmall,
    /// The result would exceed a limit.
    TooLarge,
    /// A file cannot be opened, read or written.
    File,
    /// The content of a file or buffer is not what it claims to be.
    Format,
    /// A record or buffer was made by a newer version.
    Version,
    /// The progress callback asked to stop.
    Cancelled,
    /// Memory could not be had.
    OutOfMemory,
}

/// An error that says what kind of failure it is, and what it is about.
pub trait Classify: std::error::Error {
    /// The class of the error.
    fn kind(&self) -> ErrorKind;

    /// The offending node, triangle, row, value or byte, counted from 0, if there is one.
    fn index(&self) -> Option<usize> {
        None
    }
}
