//! What C passes in: pointers, arrays, texts, numbers that stand for choices, and records.

use super::failure::Failure;
use super::planish_status;
use crate::surface::Kind;
use libc::c_char;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::path::Path;

/// An argument is not what it must be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum ArgumentError {
    #[error("{name} is NULL")]
    Null { name: &'static str },
    #[error("{name} is not aligned for its type")]
    Misaligned { name: &'static str },
    #[error("{name} would have {count} rows of {width} elements, which is more than memory can address")]
    Overflow { name: &'static str, count: usize, width: usize },
    #[error("{name} has room for {given}, {needed} are needed")]
    TooSmall { name: &'static str, given: usize, needed: usize },
    #[error("{name} is {given}, it must be 0 or at least {least}")]
    Stride { name: &'static str, given: usize, least: usize },
    #[error("{name} is {given}, the largest choice is {largest}")]
    Choice { name: &'static str, given: u32, largest: u32 },
    #[error("{name} is {given}, the largest is {largest}")]
    Limit { name: &'static str, given: usize, largest: usize },
    #[error("continuity is {given}, it must be 1 or 2")]
    Continuity { given: u32 },
    #[error("cannot tell the format of '{path}', known are .off, .obj, .ply, .stl")]
    NoMeshFormat { path: String },
    #[error("repair is {given}, no choice has the bits beyond {largest}")]
    RepairBits { given: u32, largest: u32 },
    #[error("face {face} has {given} corners, it needs at least three")]
    FaceSize { face: usize, given: u32 },
    #[error("triangle_stride is {given}, with face_sizes it must be 0")]
    StrideOfFaces { given: usize },
    #[error("{name} must be NULL in this call")]
    NotNull { name: &'static str },
    #[error("{name} {index} does not exist, there are {count}")]
    NoSuch { name: &'static str, index: usize, count: usize },
    #[error("there is no field '{name}'")]
    NoField { name: String },
    #[error("the mesh has no parameters")]
    NoParameters,
    #[error("the layout was not made for a mesh, so no nodes have places on it")]
    NoNodeMap,
    #[error("{name} is not UTF-8: byte {byte} is wrong")]
    NotUtf8 { name: &'static str, byte: usize },
    #[error("struct_size of {record} is {size}, it must be sizeof({record})")]
    RecordSize { record: &'static str, size: usize },
    #[error("{record} has {size} bytes, this version knows {known} and the rest is not zero")]
    RecordVersion { record: &'static str, size: usize, known: usize },
    #[error("the header is of version {major}.{minor}, the library of version {}", env!("CARGO_PKG_VERSION"))]
    Version { major: u32, minor: u32 },
    #[error("a reserved field of {record} is {given}, this version knows only 0")]
    Reserved { record: &'static str, given: u32 },
    #[error("the surface is of the family {found:?}, this call needs {needed:?}")]
    WrongKind { found: Kind, needed: Kind },
    #[error("{name} is {found}, this call needs {needed}")]
    OtherKind { name: &'static str, found: &'static str, needed: &'static str },
    #[error("the surface is of the family {found:?}, which has no patches")]
    NoPatches { found: Kind },
    #[error("the surface is of the family {found:?}, which has no control net")]
    NoControlNet { found: Kind },
    #[error("{name} is not used by {call}(): leave it at its default")]
    Unused { name: &'static str, call: &'static str },
    #[error("{name} must be another handle")]
    NotTwo { name: &'static str },
    #[error("no memory for {count} elements of {name}")]
    OutOfMemory { name: &'static str, count: usize },
}

impl ArgumentError {
    pub(super) fn status(&self) -> planish_status {
        match self {
            Self::Null { .. } => planish_status::NullPointer,
            Self::Overflow { .. } => planish_status::TooLarge,
            Self::TooSmall { .. } => planish_status::BufferTooSmall,
            Self::NoSuch { .. } => planish_status::Index,
            Self::RecordVersion { .. } | Self::Reserved { .. } | Self::Version { .. } => {
                planish_status::Version
            }
            Self::WrongKind { .. }
            | Self::OtherKind { .. }
            | Self::NoPatches { .. }
            | Self::NoControlNet { .. } => planish_status::WrongKind,
            Self::OutOfMemory { .. } => planish_status::OutOfMemory,
            _ => planish_status::InvalidArgument,
        }
    }

    pub(super) fn index(&self) -> Option<usize> {
        match *self {
            Self::NoSuch { index, .. } | Self::NotUtf8 { byte: index, .. } => Some(index),
            _ => None,
        }
    }
}

impl From<ArgumentError> for Failure {
    fn from(error: ArgumentError) -> Self {
        Self { status: error.status(), sentence: error.to_string(), index: error.index() }
    }
}

/// An option that a call does not use is at its default.
pub(super) fn unused(is_default: bool, name: &'static str, call: &'static str) -> Argument<()> {
    if is_default { Ok(()) } else { Err(ArgumentError::Unused { name, call }) }
}

type Argument<T> = Result<T, ArgumentError>;

pub(super) fn check<T>(at: *const T, name: &'static str) -> Argument<()> {
    if at.is_null() {
        Err(ArgumentError::Null { name })
    } else if !at.is_aligned() {
        Err(ArgumentError::Misaligned { name })
    } else {
        Ok(())
    }
}

/// A handle or value that is only read.
///
/// # Safety
/// `at` is NULL or points to a `T` that nobody changes for `'a`.
pub(super) unsafe fn deref<'a, T>(at: *const T, name: &'static str) -> Argument<&'a T> {
    check(at, name)?;
    // SAFETY: not NULL, aligned, and the caller's promise.
    Ok(unsafe { &*at })
}

/// A handle that is changed.
///
/// # Safety
/// `at` is NULL or points to a `T` that nobody else uses for `'a`.
pub(super) unsafe fn deref_mut<'a, T>(at: *mut T, name: &'static str) -> Argument<&'a mut T> {
    check(at, name)?;
    // SAFETY: not NULL, aligned, and the caller's promise.
    Ok(unsafe { &mut *at })
}

/// A value that is only written, whatever was there.
///
/// # Safety
/// `at` is NULL or points to room for a `T` that nobody else uses for `'a`.
pub(super) unsafe fn out<'a, T>(at: *mut T, name: &'static str) -> Argument<&'a mut MaybeUninit<T>> {
    // SAFETY: the caller's promise; MaybeUninit has the layout of T and may hold anything.
    unsafe { deref_mut(at.cast::<MaybeUninit<T>>(), name) }
}

/// `count * width`, if an array of so many `T` can exist.
pub(super) fn array_len<T>(count: usize, width: usize, name: &'static str) -> Argument<usize> {
    let len = count.checked_mul(width);
    let len =
        len.filter(|len| len.checked_mul(size_of::<T>()).is_some_and(|size| size <= isize::MAX as usize));
    len.ok_or(ArgumentError::Overflow { name, count, width })
}

/// The length of `count` rows of `width` elements every `stride`.
pub(super) fn strided_len<T>(
    count: usize,
    stride: usize,
    width: usize,
    name: &'static str,
) -> Argument<usize> {
    let Some(last) = count.checked_sub(1) else { return Ok(0) };
    let len = array_len::<T>(last, stride, name)?.checked_add(width);
    array_len::<T>(len.ok_or(ArgumentError::Overflow { name, count, width: stride })?, 1, name)
}

/// The stride that `given` means: 0 is `width`.
pub(super) fn stride(given: usize, width: usize, name: &'static str) -> Argument<usize> {
    match given {
        0 => Ok(width),
        _ if given < width => Err(ArgumentError::Stride { name, given, least: width }),
        _ => Ok(given),
    }
}

/// An array that is only read. NULL is fine if it is empty.
///
/// # Safety
/// `at` is NULL or points to `len` elements that nobody changes for `'a`.
pub(super) unsafe fn slice<'a, T>(at: *const T, len: usize, name: &'static str) -> Argument<&'a [T]> {
    if len == 0 {
        return Ok(&[]);
    }
    check(at, name)?;
    array_len::<T>(len, 1, name)?;
    // SAFETY: checked above, and the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(at, len) })
}

/// The same for an array that the caller may leave out: none if `at` is NULL.
///
/// # Safety
/// As [`slice`].
pub(super) unsafe fn slice_or_none<'a, T>(
    at: *const T,
    len: usize,
    name: &'static str,
) -> Argument<Option<&'a [T]>> {
    // SAFETY: the caller's promise.
    if at.is_null() { Ok(None) } else { unsafe { slice(at, len, name) }.map(Some) }
}

/// An array that is written; what it holds may be read, so `T` must be a number, for which any bits will do.
/// NULL is fine if it is empty.
///
/// `&mut [T]` and not `&mut [MaybeUninit<T>]`, though callers in C need not have written there: the core fills slices of
/// numbers. That is sound because the memory comes in through a C function. The compiler cannot know that nobody wrote
/// there and must take it for some bits, and any bits are a number. It would not be for memory that Rust code allocates
/// and leaves uninitialized, so Rust callers of these functions must fill it first (said below), and no release links the
/// library with optimization across languages.
///
/// # Safety
/// `at` is NULL or points to `len` elements that nobody else uses for `'a`; memory of Rust's has been written.
pub(super) unsafe fn slice_mut<'a, T>(at: *mut T, len: usize, name: &'static str) -> Argument<&'a mut [T]> {
    if len == 0 {
        return Ok(&mut []);
    }
    check(at, name)?;
    array_len::<T>(len, 1, name)?;
    // SAFETY: checked above, and the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts_mut(at, len) })
}

/// The same for an output that the caller may leave out: none if `at` is NULL.
///
/// # Safety
/// As [`slice_mut`].
pub(super) unsafe fn slice_mut_or_none<'a, T>(
    at: *mut T,
    len: usize,
    name: &'static str,
) -> Argument<Option<&'a mut [T]>> {
    // SAFETY: the caller's promise.
    if at.is_null() { Ok(None) } else { unsafe { slice_mut(at, len, name) }.map(Some) }
}

/// The first `needed` rows of `width` elements in an array of the caller that has `given` rows.
///
/// # Safety
/// `at` is NULL or points to `given * width` elements that nobody else uses for `'a`.
pub(super) unsafe fn rows_mut<'a, T>(
    at: *mut T,
    given: usize,
    needed: usize,
    width: usize,
    name: &'static str,
) -> Argument<&'a mut [T]> {
    if given < needed {
        return Err(ArgumentError::TooSmall { name, given, needed });
    }
    // SAFETY: the caller's promise, and no more than `given` rows.
    unsafe { slice_mut(at, array_len::<T>(needed, width, name)?, name) }
}

/// The same for an output that the caller may leave out: none if `at` is NULL.
///
/// # Safety
/// As [`rows_mut`].
pub(super) unsafe fn rows_or_none<'a, T>(
    at: *mut T,
    given: usize,
    needed: usize,
    width: usize,
    name: &'static str,
) -> Argument<Option<&'a mut [T]>> {
    // SAFETY: the caller's promise.
    if at.is_null() { Ok(None) } else { unsafe { rows_mut(at, given, needed, width, name) }.map(Some) }
}

/// A copy of `count` rows of `N` elements every `stride`. Memory is asked for before an element is read.
///
/// # Safety
/// `at` is NULL or points to `count` such rows that nobody changes meanwhile.
pub(super) unsafe fn copy_rows<T: Copy, const N: usize, R>(
    at: *const T,
    count: usize,
    stride: usize,
    name: &'static str,
    row: impl Fn([T; N]) -> R,
) -> Argument<Vec<R>> {
    let len = strided_len::<T>(count, stride, N, name)?;
    let mut rows = Vec::new();
    if len > 0 {
        check(at, name)?;
    }
    rows.try_reserve_exact(count).map_err(|_| ArgumentError::OutOfMemory { name, count })?;
    // SAFETY: the caller's promise.
    let elements = unsafe { slice(at, len, name) }?;
    rows.extend(elements.chunks(stride).filter_map(|chunk| chunk.first_chunk().map(|first| row(*first))));
    Ok(rows)
}

/// A copy of an array.
///
/// # Safety
/// As [`slice`].
pub(super) unsafe fn copy<T: Copy>(at: *const T, len: usize, name: &'static str) -> Argument<Vec<T>> {
    // SAFETY: the caller's promise.
    unsafe { copy_rows(at, len, 1, name, |[element]| element) }
}

/// A text of the caller.
///
/// # Safety
/// `at` is NULL or points to bytes that end with a NUL and that nobody changes for `'a`.
pub(super) unsafe fn text<'a>(at: *const c_char, name: &'static str) -> Argument<&'a str> {
    check(at, name)?;
    // SAFETY: not NULL, and the caller's promise.
    let text = unsafe { CStr::from_ptr(at) };
    text.to_str().map_err(|error| ArgumentError::NotUtf8 { name, byte: error.valid_up_to() })
}

/// A path of the caller: on Unix any bytes, elsewhere UTF-8.
///
/// # Safety
/// As [`text`].
pub(super) unsafe fn path<'a>(at: *const c_char, name: &'static str) -> Argument<&'a Path> {
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        check(at, name)?;
        // SAFETY: not NULL, and the caller's promise.
        let bytes = unsafe { CStr::from_ptr(at) }.to_bytes();
        Ok(Path::new(std::ffi::OsStr::from_bytes(bytes)))
    }
    #[cfg(not(unix))]
    {
        // SAFETY: the caller's promise.
        unsafe { text(at, name) }.map(Path::new)
    }
}

/// Writes as much of `text` as fits, always terminated, and returns its whole length.
///
/// # Safety
/// `at` is NULL or points to `size` writable bytes.
pub(super) unsafe fn write_text(text: &str, at: *mut c_char, size: usize) -> usize {
    if !at.is_null() && size > 0 {
        let fits = text.len().min(size - 1);
        let len = (0..=fits).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        // SAFETY: len < size, and the caller's promise.
        unsafe {
            std::ptr::copy_nonoverlapping(text.as_ptr(), at.cast(), len);
            at.cast::<u8>().add(len).write(0);
        }
    }
    text.len()
}

/// The choice that a number stands for: `choices[given]`.
pub(super) fn choice<T: Copy>(given: u32, choices: &[T], name: &'static str) -> Argument<T> {
    let largest = choices.len() as u32 - 1;
    choices.get(given as usize).copied().ok_or(ArgumentError::Choice { name, given, largest })
}

/// 0 or 1.
pub(super) fn flag(given: u32, name: &'static str) -> Argument<bool> {
    choice(given, &[false, true], name)
}

/// A plain record of the ABI. It begins with its size, so its end can grow: a caller's record may be shorter
/// (older) or longer (newer) than ours.
///
/// # Safety
/// The type is `repr(C)`, has no padding, begins with `struct_size: usize`, and its other fields are numbers
/// and pointers.
pub(super) unsafe trait Record: Copy + Default {
    const NAME: &'static str;
}

/// Declares a record: its fields with their defaults, 0 and NULL where none stands, behind its size; and, for options,
/// the function that fills it. `tools/header` reads this form too.
/// ```text
/// record! {
///     /// How a mesh is coarsened.
///     pub struct planish_decimate_options (planish_decimate_options_init; core: DecimateOptions) {
///         /// Nodes that are to be left. Default 1000.
///         pub target_count: usize = core.target_count,
///     }
/// }
/// ```
macro_rules! record {
    (
        $(#[$told:meta])*
        pub struct $record:ident $(($init:ident $(; $($core:ident: $options:ty),+)?))? {
            $($(#[$field_told:meta])* pub $field:ident: $type:ty $(= $default:expr)?,)*
        }
    ) => {
        $(#[$told])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy)]
        pub struct $record {
            /// Bytes of the record as the caller sees it.
            pub struct_size: usize,
            $($(#[$field_told])* pub $field: $type,)*
        }

        // SAFETY: the assertion below: no gap between fields, which are numbers and pointers.
        unsafe impl $crate::ffi::arguments::Record for $record {
            const NAME: &'static str = stringify!($record);
        }

        impl Default for $record {
            #[allow(clippy::needless_update, reason = "a record may have a default for each field")]
            fn default() -> Self {
                $($($(let $core = <$options>::default();)+)?)?
                Self { struct_size: size_of::<Self>(), $($($field: $default,)?)* ..$crate::ffi::arguments::zero() }
            }
        }

        const _: () = {
            let fields = size_of::<usize>() $(+ size_of::<$type>())*;
            assert!(size_of::<$record>() == fields, "padding");
        };

        $(
            #[cfg(test)]
            mod $init {
                #[test]
                fn fills_in_what_the_header_tells() {
                    $crate::ffi::tests::records::defaults_are_told::<super::$record>();
                }
            }

            /// Fills options with the defaults.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $init(
                options: *mut $record,
                struct_size: usize,
            ) -> $crate::ffi::planish_status {
                // SAFETY: the caller's promise.
                $crate::ffi::guard::guard(|| unsafe { $crate::ffi::arguments::init_options(options, struct_size) })
            }
        )?
    };
}

/// A record of zeros: 0, NULL and no callback.
pub(super) fn zero<T: Record>() -> T {
    // SAFETY: a record's fields are numbers and pointers.
    unsafe { std::mem::zeroed() }
}

/// No record grows beyond this many bytes: a larger size is a value that was never set.
const LARGEST_RECORD: usize = 4096;

/// The size that a caller gave a record.
///
/// # Safety
/// `at` points to a record of the caller.
unsafe fn record_size<T: Record>(at: *const T) -> Argument<usize> {
    // SAFETY: every record begins with its size.
    check_size::<T>(unsafe { at.cast::<usize>().read() })
}

fn check_size<T: Record>(size: usize) -> Argument<usize> {
    match size {
        0 | LARGEST_RECORD.. => Err(ArgumentError::RecordSize { record: T::NAME, size }),
        _ if !size.is_multiple_of(size_of::<usize>()) => {
            Err(ArgumentError::RecordSize { record: T::NAME, size })
        }
        _ => Ok(size),
    }
}

/// The caller's options: defaults for NULL and for the fields that an older caller does not have.
///
/// # Safety
/// `at` is NULL or points to a record whose first field is its size in bytes.
pub(super) unsafe fn options<T: Record>(at: *const T) -> Argument<T> {
    let mut ours = T::default();
    if at.is_null() {
        return Ok(ours);
    }
    check(at, T::NAME)?;
    let known = size_of::<T>();
    // SAFETY: the caller's promise; only bytes of the two records are touched.
    unsafe {
        let size = record_size(at)?;
        if size > known {
            let rest = std::slice::from_raw_parts(at.cast::<u8>().add(known), size - known);
            if rest.iter().any(|&byte| byte != 0) {
                return Err(ArgumentError::RecordVersion { record: T::NAME, size, known });
            }
        }
        let ours = (&raw mut ours).cast::<u8>();
        std::ptr::copy_nonoverlapping(at.cast::<u8>(), ours, size.min(known));
        ours.cast::<usize>().write(known);
    }
    Ok(ours)
}

/// Fills a caller's options with the defaults, zeros where the caller's version has fields that ours has not.
///
/// # Safety
/// `at` is NULL or points to `size` writable bytes.
pub(super) unsafe fn init_options<T: Record>(at: *mut T, size: usize) -> Result<(), Failure> {
    check(at, "options")?;
    // SAFETY: the caller's promise.
    unsafe { write_record(T::default(), at, check_size::<T>(size)?) };
    Ok(())
}

/// A caller's report, to be filled when the call has succeeded; none for NULL.
pub(super) struct ReportOut<T> {
    to: Option<(*mut T, usize)>,
}

impl<T: Record> ReportOut<T> {
    /// # Safety
    /// `at` is NULL or points to a record whose first field is its size in bytes, which nobody else uses
    /// until it is filled.
    pub(super) unsafe fn new(at: *mut T) -> Argument<Self> {
        if at.is_null() {
            return Ok(Self { to: None });
        }
        check(at, T::NAME)?;
        // SAFETY: the caller's promise.
        Ok(Self { to: Some((at, unsafe { record_size(at) }?)) })
    }

    /// Fills the report as far as the caller's size goes.
    pub(super) fn store(self, report: T) {
        if let Some((at, size)) = self.to {
            // SAFETY: the promise made to `new`.
            unsafe { write_record(report, at, size) }
        }
    }
}

/// # Safety
/// `at` points to `size` writable bytes, at least those of a `usize`.
unsafe fn write_record<T: Record>(record: T, at: *mut T, size: usize) {
    let known = size.min(size_of::<T>());
    // SAFETY: the caller's promise, and `known` bytes of ours.
    unsafe {
        let bytes = at.cast::<u8>();
        std::ptr::copy_nonoverlapping((&raw const record).cast::<u8>(), bytes, known);
        std::ptr::write_bytes(bytes.add(known), 0, size - known);
        at.cast::<usize>().write(size);
    }
}
