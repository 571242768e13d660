//! How much memory there is to be had, and what happens where it cannot be had.
//!
//! Rust's own vectors end the process when the system has no memory left. The vectors made here end the call instead:
//! they ask first, and a refusal unwinds with [`OutOfMemory`] to [`catch`], in which a program runs its calls; every entry point
//! of the C ABI has a guard that does the same.
//! It unwinds, as allocation errors of std will (`-Z oom=panic`), because any function that makes an array would have to
//! return a `Result` otherwise, and because it passes through rayon's threads as panics do. No panic hook is told.
//!
//! A library below that asks for much at once and cannot be refused, such as a factorization, is preceded by
//! [`ensure`], which takes the predicted size and gives it back.

use crate::failure::{Classify, ErrorKind};
use rayon::iter::IndexedParallelIterator;
use std::any::Any;
use std::collections::{BinaryHeap, HashMap};
use std::hash::{BuildHasher, Hash};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::sync::OnceLock;

/// Memory could not be had.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("there is no memory for {bytes} bytes more")]
pub struct OutOfMemory {
    /// What was asked for.
    pub bytes: usize,
}

impl Classify for OutOfMemory {
    fn kind(&self) -> ErrorKind {
        ErrorKind::OutOfMemory
    }
}

impl OutOfMemory {
    /// What a panic says about memory, if it is about memory.
    pub fn of_panic(payload: &(dyn Any + Send)) -> Option<Self> {
        payload.downcast_ref().copied()
    }
}

/// Runs a call that may run out of memory.
pub fn catch<R>(call: impl FnOnce() -> R) -> Result<R, OutOfMemory> {
    catch_unwind(AssertUnwindSafe(call))
        .map_err(|payload| OutOfMemory::of_panic(&*payload).unwrap_or_else(|| resume_unwind(payload)))
}

/// Ends the call: so many bytes could not be had.
pub fn give_up(bytes: usize) -> ! {
    resume_unwind(Box::new(OutOfMemory { bytes }))
}

/// Room for `more` further items.
#[inline(never)]
fn try_reserve<T>(items: &mut Vec<T>, more: usize) -> Result<(), OutOfMemory> {
    let bytes = more.saturating_mul(size_of::<T>());
    // the system may promise what it does not have
    if bytes as u64 > limit(0) {
        return Err(OutOfMemory { bytes });
    }
    items.try_reserve_exact(more).map_err(|_| OutOfMemory { bytes })
}

/// Room for `more` further items; without it the call ends.
pub fn reserve<T>(items: &mut Vec<T>, more: usize) {
    if more > items.capacity() - items.len() {
        try_reserve(items, more).unwrap_or_else(|error| give_up(error.bytes));
    }
}

/// An empty vector with room for `count` items.
pub fn with_capacity<T>(count: usize) -> Vec<T> {
    let mut items = Vec::new();
    reserve(&mut items, count);
    items
}

/// `count` times the same.
pub fn filled<T: Clone>(value: T, count: usize) -> Vec<T> {
    let mut items = with_capacity(count);
    items.resize(count, value);
    items
}

/// A copy.
pub fn copied<T: Clone>(items: &[T]) -> Vec<T> {
    let mut copy = with_capacity(items.len());
    copy.extend_from_slice(items);
    copy
}

/// Appends an item; room grows twofold.
pub fn push<T>(items: &mut Vec<T>, item: T) {
    if items.len() == items.capacity() {
        reserve(items, items.len().max(LEAST_GROWTH));
    }
    items.push(item);
}

/// Appends what an iterator yields.
pub fn extend<T>(items: &mut Vec<T>, more: impl IntoIterator<Item = T>) {
    let more = more.into_iter();
    match more.size_hint() {
        (least, Some(most)) if least == most => {
            if least > items.capacity() - items.len() {
                // twofold at least, so that many small appendices take linear time
                reserve(items, least.max(items.len()));
            }
            items.extend(more);
        }
        _ => more.for_each(|item| push(items, item)),
    }
}

/// A tree of what an iterator yields, which is put in one by one: to collect it would sort all in an array of its own.
pub fn tree_of<Tree: Default + Extend<T>, T>(items: impl IntoIterator<Item = T>) -> Tree {
    let mut tree = Tree::default();
    tree.extend(items);
    tree
}

/// Room for a further entry; room grows twofold.
pub fn reserve_entry<K: Eq + Hash, V, S: BuildHasher>(map: &mut HashMap<K, V, S>) {
    if map.len() == map.capacity() {
        let more = map.len().max(LEAST_GROWTH);
        map.try_reserve(more).unwrap_or_else(|_| give_up(more.saturating_mul(size_of::<(K, V)>())));
    }
}

/// Room for a further item of a queue; room grows twofold.
pub fn reserve_item<T: Ord>(queue: &mut BinaryHeap<T>) {
    if queue.len() == queue.capacity() {
        let more = queue.len().max(LEAST_GROWTH);
        queue.try_reserve(more).unwrap_or_else(|_| give_up(more.saturating_mul(size_of::<T>())));
    }
}

/// Room for `more` further bytes of a text that grows; room grows twofold.
pub fn reserve_text(text: &mut String, more: usize) {
    if more > text.capacity() - text.len() {
        let bytes = more.max(text.len());
        text.try_reserve_exact(bytes).unwrap_or_else(|_| give_up(bytes));
    }
}

/// Items that the first growth of a vector makes room for.
const LEAST_GROWTH: usize = 8;

/// Vectors of what iterators yield.
pub trait CollectVec: Iterator + Sized {
    /// All items; without memory for them the call ends.
    fn collect_vec(self) -> Vec<Self::Item> {
        let mut items = with_capacity(self.size_hint().0);
        extend(&mut items, self);
        items
    }

    /// All items, or the first error.
    fn try_collect_vec<T, E>(mut self) -> Result<Vec<T>, E>
    where
        Self: Iterator<Item = Result<T, E>>,
    {
        let mut items = Vec::new();
        self.try_for_each(|item| item.map(|item| push(&mut items, item))).map(|()| items)
    }
}

impl<I: Iterator> CollectVec for I {}

/// The same for iterators that run on several threads.
pub trait ParallelCollectVec: IndexedParallelIterator {
    /// All items in their order; without memory for them the call ends.
    fn collect_vec(self) -> Vec<Self::Item> {
        let mut items = with_capacity(self.len());
        self.collect_into_vec(&mut items);
        items
    }
}

impl<I: IndexedParallelIterator> ParallelCollectVec for I {}

/// Ends the call unless so many bytes can be had: asked before a library that cannot be refused asks for about as much.
pub fn ensure(bytes: usize) {
    drop(with_capacity::<u8>(bytes));
}

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
    fn what_cannot_be_had_ends_the_call() {
        let too_many = usize::MAX / 4;
        assert_eq!(catch(|| filled(0_u64, too_many)), Err(OutOfMemory { bytes: usize::MAX }));
        assert_eq!(catch(|| ensure(too_many)), Err(OutOfMemory { bytes: too_many }));
        let endless = std::iter::repeat_n(0_u8, too_many);
        assert_eq!(catch(|| endless.collect_vec()), Err(OutOfMemory { bytes: too_many }));
        // as on the threads of a pool
        let there = crate::control::Pool::new(2);
        assert!(catch(|| there.run(|| rayon::join(|| (), || ensure(too_many)))).is_err());
        assert!(std::panic::catch_unwind(|| catch(|| panic!("of another kind"))).is_err());
    }

    #[test]
    fn vectors_are_those_of_the_iterators() {
        let all: Vec<usize> = (0..1000).collect();
        let odd: Vec<usize> = (0..1000).filter(|k| k % 2 == 1).collect();
        assert_eq!((0..1000).collect_vec(), all);
        assert_eq!((0..1000).filter(|k| k % 2 == 1).collect_vec(), odd);
        assert_eq!((0..1000).map(Ok::<_, ()>).try_collect_vec(), Ok(all.clone()));
        assert_eq!((0..3).map(|k| if k == 1 { Err(k) } else { Ok(k) }).try_collect_vec(), Err(1));
        let mut twice = copied(&all);
        extend(&mut twice, all.iter().copied());
        assert_eq!(twice, [&all[..], &all[..]].concat());
        assert_eq!(filled(7, 3), [7; 3]);
    }

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
