//! What calls return, and what the thread's last failure was.

use super::arguments::ArgumentError;
use super::guard::{guard, guard_value, last_failure};
use crate::failure::ErrorKind;
use libc::c_char;
use std::ffi::CStr;

/// What a call came to: 0 or positive is success, negative is an error. Test with `status < 0`.
///
/// A positive status is a success with a remark: all outputs are filled. Where several remarks hold the
/// gravest is returned, in the order FOLDED_PARAMETERS, TOLERANCE_NOT_MET, STAGNATED, POINTS_OUTSIDE,
/// NOT_PROVEN, INPUT_REPAIRED; reports have all of them. After an error no output has been touched, and
/// planish_error_message() and planish_error_index() say more. Numbers are never reused; new ones may come.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_status {
    /// All went well.
    Ok = 0,
    /// The surface misses the tolerance; it is the best one found.
    ToleranceNotMet = 1,
    /// The fit ended because refinement no longer lowered the error.
    Stagnated = 2,
    /// Some points lie outside the domain; their values are NaN.
    PointsOutside = 3,
    /// The mesh is not all that was given: nodes were welded, split or passed over, triangles dropped or turned over, or
    /// texture coordinates that are no parameters left out. planish_mesh_repairs counts them.
    InputRepaired = 4,
    /// Some triangles are turned over or flat in the parameter plane: a surface over them may fold.
    FoldedParameters = 5,
    /// A search could not prove that its answers are the nearest places; a flag says for which points.
    NotProven = 6,
    /// An argument that must not be NULL is.
    NullPointer = -1,
    /// An argument or option is out of its range, or contradicts another.
    InvalidArgument = -2,
    /// A number is NaN or infinite.
    NotFinite = -3,
    /// An index is out of range.
    Index = -4,
    /// The mesh is not connected as the call needs it.
    Topology = -5,
    /// The geometry is degenerate: lengths, areas or ranges are zero.
    Degenerate = -6,
    /// A parameter lies outside the domain.
    Outside = -7,
    /// The data do not determine the result.
    Singular = -8,
    /// The call does not apply to this family of surface.
    WrongKind = -9,
    /// The caller's array is too short for the result.
    BufferTooSmall = -10,
    /// A size exceeds a limit, or what memory can address.
    TooLarge = -11,
    /// A file cannot be opened, read or written.
    File = -12,
    /// The content of a file is not what it claims to be.
    Format = -13,
    /// A record has fields that this version of the library does not know, and they are not zero.
    Version = -14,
    /// The progress callback asked to stop.
    Cancelled = -15,
    /// Memory for a copy of the caller's arrays could not be had.
    OutOfMemory = -16,
    /// A bug in the library. Handles stay valid; arrays of results may be partly written.
    Internal = -17,
}

impl From<ErrorKind> for planish_status {
    fn from(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::InvalidArgument => Self::InvalidArgument,
            ErrorKind::NotFinite => Self::NotFinite,
            ErrorKind::Index => Self::Index,
            ErrorKind::Topology => Self::Topology,
            ErrorKind::Degenerate => Self::Degenerate,
            ErrorKind::Outside => Self::Outside,
            ErrorKind::Singular => Self::Singular,
            ErrorKind::WrongKind => Self::WrongKind,
            ErrorKind::BufferTooSmall => Self::BufferTooSmall,
            ErrorKind::TooLarge => Self::TooLarge,
            ErrorKind::File => Self::File,
            ErrorKind::Format => Self::Format,
            ErrorKind::Version => Self::Version,
            ErrorKind::Cancelled => Self::Cancelled,
            ErrorKind::OutOfMemory => Self::OutOfMemory,
        }
    }
}

impl From<()> for planish_status {
    fn from((): ()) -> Self {
        Self::Ok
    }
}

/// The version of the library that is loaded, such as "0.2.0": compare it with PLANISH_VERSION, the version
/// of this header. Never NULL; the text is static.
#[unsafe(no_mangle)]
pub extern "C" fn planish_version() -> *const c_char {
    const TEXT: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    TEXT.as_ptr().cast()
}

/// Whether the library that is loaded serves programs that were compiled with a version of this header: that is so with
/// the same major version, and before version 1 the same minor version too, if the header is not newer.
///
/// major: PLANISH_VERSION_MAJOR.
/// minor: PLANISH_VERSION_MINOR.
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn planish_check_version(major: u32, minor: u32) -> planish_status {
    guard(|| {
        let part = |text: &str| text.parse::<u32>().unwrap_or(u32::MAX);
        let (own_major, own_minor) =
            (part(env!("CARGO_PKG_VERSION_MAJOR")), part(env!("CARGO_PKG_VERSION_MINOR")));
        let fits = major == own_major && if major == 0 { minor == own_minor } else { minor <= own_minor };
        if fits { Ok(()) } else { Err(ArgumentError::Version { major, minor }.into()) }
    })
}

/// The name of a status, such as "PLANISH_STATUS_OK"; "unknown status" for a number that is none. Never
/// NULL; the text is static.
#[unsafe(no_mangle)]
pub extern "C" fn planish_status_name(status: i32) -> *const c_char {
    name(status).as_ptr()
}

fn name(status: i32) -> &'static CStr {
    match status {
        0 => c"PLANISH_STATUS_OK",
        1 => c"PLANISH_STATUS_TOLERANCE_NOT_MET",
        2 => c"PLANISH_STATUS_STAGNATED",
        3 => c"PLANISH_STATUS_POINTS_OUTSIDE",
        4 => c"PLANISH_STATUS_INPUT_REPAIRED",
        5 => c"PLANISH_STATUS_FOLDED_PARAMETERS",
        6 => c"PLANISH_STATUS_NOT_PROVEN",
        -1 => c"PLANISH_STATUS_NULL_POINTER",
        -2 => c"PLANISH_STATUS_INVALID_ARGUMENT",
        -3 => c"PLANISH_STATUS_NOT_FINITE",
        -4 => c"PLANISH_STATUS_INDEX",
        -5 => c"PLANISH_STATUS_TOPOLOGY",
        -6 => c"PLANISH_STATUS_DEGENERATE",
        -7 => c"PLANISH_STATUS_OUTSIDE",
        -8 => c"PLANISH_STATUS_SINGULAR",
        -9 => c"PLANISH_STATUS_WRONG_KIND",
        -10 => c"PLANISH_STATUS_BUFFER_TOO_SMALL",
        -11 => c"PLANISH_STATUS_TOO_LARGE",
        -12 => c"PLANISH_STATUS_FILE",
        -13 => c"PLANISH_STATUS_FORMAT",
        -14 => c"PLANISH_STATUS_VERSION",
        -15 => c"PLANISH_STATUS_CANCELLED",
        -16 => c"PLANISH_STATUS_OUT_OF_MEMORY",
        -17 => c"PLANISH_STATUS_INTERNAL",
        _ => c"unknown status",
    }
}

/// The sentence that explains this thread's last failure: the last call on this thread that returned a
/// negative status, or 0 because of a NULL handle. Later successes leave it as it is.
///
/// text: receives the sentence in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
/// size: bytes that text has room for, the NUL included.
/// Arrays: text[size].
/// Returns the length of the whole sentence in bytes without the NUL; 0 if nothing has failed yet.
/// planish_error_message(NULL, 0) asks for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_error_message(text: *mut c_char, size: usize) -> usize {
    last_failure(|sentence, _| {
        // SAFETY: the caller's promise about `text` and `size`.
        unsafe { super::arguments::write_text(sentence, text, size) }
    })
}

/// What this thread's last failure was about: a node, triangle, row, value, knot, line or byte, counted from
/// 0 (the sentence says which); -1 if no single one is to blame or nothing has failed yet.
#[unsafe(no_mangle)]
pub extern "C" fn planish_error_index() -> i64 {
    last_failure(|_, index| index.and_then(|index| i64::try_from(index).ok()).unwrap_or(-1))
}

/// A plain value of a handle: what `body` finds, or `T::default()` after a failure.
pub(super) fn query<T: Default>(body: impl FnOnce() -> Result<T, super::guard::Failure>) -> T {
    guard_value(body).unwrap_or_default()
}
