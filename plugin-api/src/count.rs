//! Counting work: one piece of query code, compiled twice.

/// Takes the work of a query. Query code is generic over it, so that the timed copy counts nothing and costs nothing.
pub trait Count {
    /// So many tests between two bounding volumes.
    fn bv_tests(&mut self, tests: u64);
    /// One test between triangle `a` of A and triangle `b` of B.
    fn primitive_test(&mut self, a: u32, b: u32);
    /// Who listens, if anybody does. For query code that is compiled apart from its plugin, which cannot be generic.
    fn listener(&mut self) -> Option<&mut dyn Count>;
    /// Whether anybody listens. For algorithms around a library that cannot count: they call the library when nobody
    /// does, and a written-out copy of what it does otherwise.
    #[inline(always)]
    fn is_counting(&mut self) -> bool {
        self.listener().is_some()
    }
}

impl Count for &mut dyn Count {
    fn bv_tests(&mut self, tests: u64) {
        (**self).bv_tests(tests);
    }

    fn primitive_test(&mut self, a: u32, b: u32) {
        (**self).primitive_test(a, b);
    }

    fn listener(&mut self) -> Option<&mut dyn Count> {
        (**self).listener()
    }
}

/// Counts nothing; for timed queries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Uncounted;

impl Count for Uncounted {
    #[inline(always)]
    fn bv_tests(&mut self, _tests: u64) {}
    #[inline(always)]
    fn primitive_test(&mut self, _a: u32, _b: u32) {}
    #[inline(always)]
    fn listener(&mut self) -> Option<&mut dyn Count> {
        None
    }
}

/// Counts; for queries that are not timed.
#[derive(Debug, Default)]
pub struct Counts<'a> {
    /// Tests between bounding volumes.
    pub bv_tests: u64,
    /// Tests between primitives.
    pub primitive_tests: u64,
    /// In how many primitive tests each triangle of A took part; empty when nobody wants to know.
    pub tests_a: &'a mut [u32],
    /// The same for B.
    pub tests_b: &'a mut [u32],
}

impl Count for Counts<'_> {
    fn bv_tests(&mut self, tests: u64) {
        self.bv_tests += tests;
    }

    fn primitive_test(&mut self, a: u32, b: u32) {
        self.primitive_tests += 1;
        for (tests, triangle) in [(&mut *self.tests_a, a), (&mut *self.tests_b, b)] {
            if let Some(count) = tests.get_mut(triangle as usize) {
                *count = count.saturating_add(1);
            }
        }
    }

    fn listener(&mut self) -> Option<&mut dyn Count> {
        Some(self)
    }
}
