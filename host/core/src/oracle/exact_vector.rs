//! Vectors of integers without bound.

use dashu_int::IBig;

pub(super) type Vector = [IBig; 3];

pub(super) fn sub(x: &Vector, y: &Vector) -> Vector {
    std::array::from_fn(|i| &x[i] - &y[i])
}

pub(super) fn dot(x: &Vector, y: &Vector) -> IBig {
    &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2]
}

pub(super) fn cross(x: &Vector, y: &Vector) -> Vector {
    [&x[1] * &y[2] - &x[2] * &y[1], &x[2] * &y[0] - &x[0] * &y[2], &x[0] * &y[1] - &x[1] * &y[0]]
}

pub(super) fn norm2(x: &Vector) -> IBig {
    dot(x, x)
}

pub(super) fn is_zero(x: &Vector) -> bool {
    x.iter().all(|c| *c == IBig::ZERO)
}
