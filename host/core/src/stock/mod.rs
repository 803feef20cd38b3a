//! Stock objects, made here.
