//! Files as a whole: read within a limit, written so that what was there survives every failure.
//!
//! A new content is written beside its target under a random name that is opened exclusively, synced to the disk,
//! and renamed on to the target: readers see the old file or the new one, never a part, also after a power cut.
//! Owner and mode of the old file are kept, and a symbolic link is followed, not replaced. Only regular files are
//! replaced; a device or a FIFO is written to.

use crate::failure::{Classify, ErrorKind};
use crate::memory;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// A file cannot be read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FileError {
    /// The file cannot be opened or read.
    #[error("cannot read '{path}': {reason}")]
    Read {
        /// The path as given.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// The file has more bytes than may be read.
    #[error(
        "'{path}' has more than the {limit} bytes that may be read: raise the limit on memory if it is right"
    )]
    TooLarge {
        /// The path as given.
        path: String,
        /// Most bytes.
        limit: u64,
    },
    /// The file cannot be written.
    #[error("cannot write '{path}': {reason}")]
    Write {
        /// The path as given.
        path: String,
        /// What the system says.
        reason: String,
    },
}

impl Classify for FileError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::Read { .. } | Self::Write { .. } => ErrorKind::File,
        }
    }
}

/// The whole content of a file of at most `limit` bytes. Devices, which have no end, are refused; pipes are read.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    let name = || path.display().to_string();
    let fail = |reason: io::Error| FileError::Read { path: name(), reason: reason.to_string() };
    let refuse = |reason: &str| FileError::Read { path: name(), reason: reason.to_owned() };
    let metadata = fs::metadata(path).map_err(fail)?;
    if metadata.is_dir() {
        return Err(refuse("it is a folder"));
    }
    if is_device(&metadata) {
        return Err(refuse("it is a device, not a file"));
    }
    if metadata.len() > limit {
        return Err(FileError::TooLarge { path: name(), limit });
    }
    let file = File::open(path).map_err(fail)?;
    let mut bytes = Vec::new();
    // a file may grow while it is read, and a pipe does not know its size
    let size = usize::try_from(metadata.len()).unwrap_or(usize::MAX).saturating_add(1);
    memory::reserve(&mut bytes, size);
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(fail)?;
    if bytes.len() as u64 > limit {
        return Err(FileError::TooLarge { path: name(), limit });
    }
    Ok(bytes)
}

#[cfg(unix)]
fn is_device(metadata: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: &Metadata) -> bool {
    false
}

/// Writes a whole file. An existing one is replaced at once or stays as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let fail =
        |error: io::Error| FileError::Write { path: path.display().to_string(), reason: error.to_string() };
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => {
            replace(&fs::canonicalize(path).map_err(fail)?, Some(&metadata), bytes)
        }
        Ok(_) => write_in_place(path, bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            link_end(path).and_then(|target| replace(&target, None, bytes))
        }
        Err(error) => Err(error),
    }
    .map_err(fail)
}

/// Where a symbolic link that leads to no file ends; the path itself if it is none.
fn link_end(path: &Path) -> io::Result<PathBuf> {
    /// As many links as Linux follows.
    const MOST_LINKS: usize = 40;
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&end) {
            Ok(next) => end = end.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(end),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// For what is no regular file: a device, a FIFO. Folders refuse to be opened.
fn write_in_place(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    file.write_all(bytes)?;
    file.flush()
}

/// Replaces the regular file at `target`, of which `old` is known, or makes it.
fn replace(target: &Path, old: Option<&Metadata>, bytes: &[u8]) -> io::Result<()> {
    if old.is_some() {
        // a file that must not be written must not be replaced either
        OpenOptions::new().write(true).open(target)?;
    }
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut beside = new_beside(folder)?;
    beside.write_all(bytes)?;
    if let Some(old) = old {
        keep_owner(beside.as_file(), old);
        beside.as_file().set_permissions(old.permissions())?;
    }
    beside.as_file().sync_all()?;
    // what stands there now may be another thing than before
    if fs::symlink_metadata(target).is_ok_and(|now| !now.is_file()) {
        return Err(io::Error::other("it is no regular file any more"));
    }
    beside.persist(target).map_err(|error| error.error)?;
    sync_folder(folder);
    Ok(())
}

/// An empty file of a random name, removed again unless it is renamed.
fn new_beside(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".planish-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666)); // less the process's mask, as any new file
    }
    let fail = |error: io::Error| {
        let reason = format!("no file can be made beside it, which then takes its place: {}", reason(&error));
        io::Error::new(error.kind(), reason)
    };
    builder.tempfile_in(folder).map_err(fail)
}

/// What the system says, without the path that tempfile adds.
fn reason(error: &io::Error) -> String {
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code).to_string(),
        None => error.kind().to_string(),
    }
}

/// Gives the file to whom the old one belongs, if this process may.
#[cfg(unix)]
fn keep_owner(file: &File, old: &Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let is_same = file.metadata().is_ok_and(|new| (new.uid(), new.gid()) == (old.uid(), old.gid()));
    if !is_same {
        // only the superuser may: others become the owner, as of any file that they replace
        let _ = fchown(file, Some(old.uid()), Some(old.gid()));
    }
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) {}

/// Makes the rename last. Some file systems cannot; the content is safe all the same.
fn sync_folder(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

#[cfg(test)]
mod tests;
