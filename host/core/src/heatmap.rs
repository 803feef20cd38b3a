//! Measured values on the vertices of an object [OpenCollBench 2020, 3.2].
