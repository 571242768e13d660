use super::*;
use std::sync::atomic::{AtomicBool, Ordering};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("the temporary folder takes one")
}

/// Nothing but these files may be left.
fn check_names(folder: &Path, expected: &[&str]) {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, expected);
}

#[test]
fn files_are_made_and_replaced() {
    let folder = folder();
    let path = folder.path().join("a");
    write(&path, b"one").unwrap();
    write(&path, b"two").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert_eq!(read(&path, 3).unwrap(), b"two");
    assert_eq!(read(&path, 2).unwrap_err().kind(), ErrorKind::TooLarge);
    check_names(folder.path(), &["a"]);
}

#[test]
fn readers_see_one_file_or_the_other_while_two_threads_write() {
    let folder = folder();
    let path = folder.path().join("a");
    let contents = [vec![b'x'; 300_000], vec![b'y'; 200_000]];
    write(&path, &contents[0]).unwrap();
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let writers = contents.each_ref().map(|content| {
            let path = &path;
            scope.spawn(move || (0..30).for_each(|_| write(path, content).unwrap()))
        });
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                let seen = fs::read(&path).unwrap();
                assert!(contents.contains(&seen), "{} bytes, mixed", seen.len());
            }
        });
        writers.into_iter().for_each(|writer| writer.join().unwrap());
        done.store(true, Ordering::Relaxed);
    });
    check_names(folder.path(), &["a"]);
}

/// Names the file for [`a_process_that_writes_until_it_is_killed`].
const PATH_VARIABLE: &str = "PLANISH_TEST_PATH";

/// Content of the file that is written over and over.
fn content(byte: u8) -> Vec<u8> {
    vec![byte; 4 << 20]
}

#[test]
#[ignore = "ends only when it is killed: a_process_that_dies_while_it_writes_leaves_a_whole_file starts and kills it"]
fn a_process_that_writes_until_it_is_killed() {
    let Some(path) = std::env::var_os(PATH_VARIABLE) else { return };
    for byte in (b'a'..=b'z').cycle() {
        write(Path::new(&path), &content(byte)).unwrap();
    }
}

#[test]
fn a_process_that_dies_while_it_writes_leaves_a_whole_file() {
    let folder = folder();
    let path = folder.path().join("a");
    write(&path, &content(b'!')).unwrap();
    for delay in [40, 55, 70, 85] {
        let name = "file::tests::a_process_that_writes_until_it_is_killed";
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args([name, "--exact", "--ignored", "--quiet"])
            .env(PATH_VARIABLE, &path)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(delay));
        child.kill().unwrap();
        child.wait().unwrap();
        let left = fs::read(&path).unwrap();
        assert!(left == content(left[0]), "{} bytes, mixed", left.len());
    }
}

#[test]
fn long_names_have_room() {
    let folder = folder();
    let name = "n".repeat(254);
    write(&folder.path().join(&name), b"long").unwrap();
    check_names(folder.path(), &[&name]);
}

#[test]
fn folders_are_refused_and_left() {
    let folder = folder();
    for error in [write(folder.path(), b"x").unwrap_err(), read(folder.path(), 10).unwrap_err()] {
        assert_eq!(error.kind(), ErrorKind::File, "{error}");
    }
    let missing = folder.path().join("no/such/file");
    let error = write(&missing, b"x").unwrap_err();
    assert!(error.to_string().contains("no/such/file"), "{error}");
    check_names(folder.path(), &[]);
}

#[cfg(unix)]
mod on_unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::process::Command;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    /// Whether a tool of the system made what was asked for; it may be missing, or need the superuser.
    fn made_by(command: &str, arguments: &[&str]) -> bool {
        let is_made =
            Command::new(command).args(arguments).output().is_ok_and(|output| output.status.success());
        if !is_made {
            eprintln!("SKIPPED: {command} {arguments:?} does not work here");
        }
        is_made
    }

    #[test]
    fn the_mode_stays() {
        let folder = folder();
        let path = folder.path().join("a");
        fs::write(&path, b"old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
        write(&path, b"new").unwrap();
        assert_eq!((mode(&path), fs::read(&path).unwrap()), (0o600, b"new".to_vec()));
        // a new file has the mode of any other
        let (new, other) = (folder.path().join("b"), folder.path().join("c"));
        write(&new, b"").unwrap();
        fs::write(&other, b"").unwrap();
        assert_eq!(mode(&new), mode(&other));
    }

    #[test]
    fn links_are_followed() {
        let folder = folder();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        symlink("target", &link).unwrap();
        for content in [b"first", b"later"] {
            // at first the link leads to nothing
            write(&link, content).unwrap();
            assert_eq!(fs::read(&target).unwrap(), content);
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        }
        let ring = folder.path().join("ring");
        symlink("ring", &ring).unwrap();
        assert_eq!(write(&ring, b"x").unwrap_err().kind(), ErrorKind::File);
        check_names(folder.path(), &["link", "ring", "target"]);
    }

    #[test]
    fn pipes_are_written_to_and_stay() {
        let folder = folder();
        let path = folder.path().join("fifo");
        if !made_by("mkfifo", &[path.to_str().unwrap()]) {
            return;
        }
        std::thread::scope(|scope| {
            let reader = scope.spawn(|| read(&path, 100).unwrap());
            write(&path, b"through").unwrap();
            assert_eq!(reader.join().unwrap(), b"through");
        });
        assert!(!fs::metadata(&path).unwrap().is_file());
        check_names(folder.path(), &["fifo"]);
    }

    #[test]
    fn devices_are_written_to_and_never_read() {
        let folder = folder();
        for (name, minor) in [("null", "3"), ("full", "7"), ("zero", "5")] {
            let path = folder.path().join(name);
            if !made_by("mknod", &[path.to_str().unwrap(), "c", "1", minor]) {
                return;
            }
            let error = read(&path, 10).unwrap_err();
            assert!(error.to_string().contains("device"), "{error}");
            let written = write(&path, b"content");
            match name {
                "full" => assert!(written.unwrap_err().to_string().contains("space")),
                _ => written.unwrap(),
            }
            assert!(!fs::metadata(&path).unwrap().is_file());
        }
        check_names(folder.path(), &["full", "null", "zero"]);
    }

    #[test]
    fn a_full_disk_leaves_the_old_file() {
        let folder = folder();
        let disk = folder.path().join("disk");
        fs::create_dir(&disk).unwrap();
        let name = disk.to_str().unwrap();
        if !made_by("mount", &["-t", "tmpfs", "-o", "size=64k", "tmpfs", name]) {
            return;
        }
        let path = disk.join("a");
        let (first, second) = (write(&path, b"old"), write(&path, &vec![b'x'; 100_000]));
        let (left, names) = (fs::read(&path), fs::read_dir(&disk).map(Iterator::count));
        assert!(made_by("umount", &[name]));
        first.unwrap();
        assert!(second.unwrap_err().to_string().contains("space"));
        assert_eq!((left.unwrap(), names.unwrap()), (b"old".to_vec(), 1));
    }

    #[test]
    fn what_must_not_be_written_is_not_replaced() {
        let folder = folder();
        let path = folder.path().join("a");
        fs::write(&path, b"old").unwrap();
        for (locked, bits, open) in [(&path, 0o444, 0o644), (&folder.path().to_owned(), 0o555, 0o755)] {
            fs::set_permissions(locked, fs::Permissions::from_mode(bits)).unwrap();
            let is_free = OpenOptions::new().append(true).open(&path).is_ok()
                && tempfile::NamedTempFile::new_in(folder.path()).is_ok();
            let written = write(&path, b"new");
            fs::set_permissions(locked, fs::Permissions::from_mode(open)).unwrap();
            if is_free {
                eprintln!("SKIPPED: nothing is locked to the superuser");
                return;
            }
            let error = written.unwrap_err();
            assert!(error.to_string().contains("denied"), "{error}");
            assert_eq!(fs::read(&path).unwrap(), b"old");
            check_names(folder.path(), &["a"]);
        }
    }
}
