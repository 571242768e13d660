//! Many short lists of numbers in two arrays.
//!
//! A counting sort (H. H. Seward, 1954; D. E. Knuth, "The Art of Computer Programming" 3 (1998), 5.2): the lengths are
//! counted, summed to where lists start, and each number goes to the next free place of its list. Linear time, and the
//! order within a list is that in which numbers come.

use crate::memory;
use std::ops::Range;

/// Lists of numbers, one after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lists {
    /// List k is `items[starts[k]..starts[k + 1]]`.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// `count` lists of (list, number) as they come; the iterator is run twice.
    pub fn new(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut starts = memory::filled(0_u32, count + 1);
        pairs.clone().for_each(|(list, _)| starts[list as usize + 1] += 1);
        for list in 0..count {
            starts[list + 1] += starts[list];
        }
        let mut next = memory::copied(&starts);
        let mut items = memory::filled(0, starts[count] as usize);
        for (list, item) in pairs {
            let place = &mut next[list as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { starts, items }
    }

    /// Which indices have each key, ascending.
    pub fn by_key(count: usize, keys: &[u32]) -> Self {
        Self::new(count, keys.iter().copied().zip(0..))
    }

    /// The numbers of a list.
    pub fn of(&self, list: usize) -> &[u32] {
        &self.items[self.range(list)]
    }

    /// The same, to be sorted or replaced.
    pub fn of_mut(&mut self, list: usize) -> &mut [u32] {
        let range = self.range(list);
        &mut self.items[range]
    }

    /// Where a list lies among [`Lists::items`].
    pub fn range(&self, list: usize) -> Range<usize> {
        self.starts[list] as usize..self.starts[list + 1] as usize
    }

    /// Where each list starts, with the end of the last one, and the numbers.
    pub fn into_parts(self) -> (Vec<u32>, Vec<u32>) {
        (self.starts, self.items)
    }

    /// How many lists there are.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The numbers of all lists.
    pub fn items(&self) -> &[u32] {
        &self.items
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_the_order_and_may_be_empty() {
        let keys = [2, 0, 2, 2, 4, 0];
        let mut lists = Lists::by_key(6, &keys);
        let all: Vec<&[u32]> = (0..lists.count()).map(|list| lists.of(list)).collect();
        assert_eq!(all, [&[1, 5][..], &[], &[0, 2, 3], &[], &[4], &[]]);
        assert_eq!((lists.range(2), lists.items().len()), (2..5, 6));
        lists.of_mut(2).reverse();
        assert_eq!(lists.of(2), [3, 2, 0]);
        assert_eq!(Lists::by_key(0, &[]).count(), 0);
        let pairs = [(1, 7), (0, 3), (1, 5)];
        assert_eq!(Lists::new(2, pairs.into_iter()).of(1), [7, 5]);
    }
}
