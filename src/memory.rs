//! How much memory there is to be had.

use std::path::Path;
use std::sync::OnceLock;

/// The limit in bytes that `max_memory` stands for: 0 is three quarters of what the machine, or the control group of
/// this process, has. Where the system does not say how much that is, there is no limit.
pub fn limit(max_memory: u64) -> u64 {
    static AVAILABLE: OnceLock<u64> = OnceLock::new();
    match max_memory {
        0 => *AVAILABLE.get_or_init(available) / 4 * 3,
        given => given,
    }
}

/// Bytes of the machine, or of the control group if that has less.
fn available() -> u64 {
    let text = |path: &Path| std::fs::read_to_string(path).ok();
    let machine = text(Path::new("/proc/meminfo")).and_then(|text| total_of(&text));
    let groups = text(Path::new("/proc/self/cgroup")).unwrap_or_default();
    let limits =
        groups.lines().flat_map(limit_files).filter_map(|path| text(Path::new(&path))?.trim().parse().ok());
    limits.chain(machine).min().unwrap_or(u64::MAX)
}

/// The line `MemTotal:  16330104 kB`.
fn total_of(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024)
}

/// Where the limit of a control group may stand, given its line `number:controllers:/path`: in the group itself, in
/// those that it lies in, and, as a container sees it, at the top.
fn limit_files(line: &str) -> Vec<String> {
    let mut parts = line.splitn(3, ':').skip(1);
    let (Some(controllers), Some(path)) = (parts.next(), parts.next()) else { return Vec::new() };
    let (root, name) = match controllers {
        "" => ("/sys/fs/cgroup", "memory.max"),
        _ if controllers.split(',').any(|name| name == "memory") => {
            ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
        }
        _ => return Vec::new(),
    };
    let groups = Path::new(path.trim_start_matches('/')).ancestors();
    groups.map(|group| format!("{root}/{}/{name}", group.display())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_three_quarters_of_something() {
        assert_eq!(limit(7), 7);
        assert!(limit(0) > 1 << 20);
        assert_eq!(total_of("MemFree: 1 kB\nMemTotal:       16 kB\n"), Some(16 * 1024));
        assert_eq!(total_of("nothing"), None);
    }

    #[test]
    fn groups_are_looked_for_from_the_inside_out() {
        let files =
            ["/sys/fs/cgroup/a/b/memory.max", "/sys/fs/cgroup/a/memory.max", "/sys/fs/cgroup//memory.max"];
        assert_eq!(limit_files("0::/a/b"), files);
        assert_eq!(limit_files("5:cpu,memory:/")[0], "/sys/fs/cgroup/memory//memory.limit_in_bytes");
        assert!(limit_files("5:cpu:/a").is_empty() && limit_files("x").is_empty());
    }
}
