//! The few things that were used last.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Keeps the values used last, up to a total weight of `capacity`. Values are shared: dropping one from the cache does not affect its
/// users.
pub struct Cache<T> {
    capacity: usize,
    weigh: fn(&T) -> usize,
    entries: Mutex<VecDeque<(String, Arc<T>)>>,
}

impl<T> Cache<T> {
    /// An empty cache for so many values.
    pub fn new(capacity: usize) -> Self {
        Self::weighing(capacity, |_| 1)
    }

    /// An empty cache for values of different weights.
    pub fn weighing(capacity: usize, weigh: fn(&T) -> usize) -> Self {
        Self { capacity, weigh, entries: Mutex::new(VecDeque::new()) }
    }

    /// The value under this key.
    pub fn get(&self, key: &str) -> Option<Arc<T>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let found = entries.iter().position(|(k, _)| k == key)?;
        let entry = entries.remove(found)?;
        let value = entry.1.clone();
        entries.push_front(entry);
        Some(value)
    }

    /// Keeps a value and gives it back shared.
    pub fn put(&self, key: &str, value: T) -> Arc<T> {
        let value = Arc::new(value);
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|(k, _)| k != key);
        entries.push_front((key.to_owned(), value.clone()));
        let mut weight = 0;
        entries.retain(|(_, value)| {
            weight += (self.weigh)(value);
            weight <= self.capacity
        });
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_used_longest_goes_first() {
        let cache = Cache::new(2);
        cache.put("a", 1);
        cache.put("b", 2);
        assert_eq!(cache.get("a").as_deref(), Some(&1));
        cache.put("c", 3);
        assert_eq!(cache.get("b"), None);
        assert_eq!(cache.get("a").as_deref(), Some(&1));
    }

    #[test]
    fn a_heavy_value_replaces_many() {
        let cache = Cache::weighing(10, |n: &usize| *n);
        for n in [3, 4, 5] {
            cache.put(&n.to_string(), n);
        }
        assert_eq!(["3", "4", "5"].map(|key| cache.get(key).is_some()), [false, true, true]);
        assert_eq!(*cache.put("11", 11), 11, "it is given, and not kept");
        assert_eq!(["4", "5", "11"].map(|key| cache.get(key).is_some()), [false; 3]);
    }
}
