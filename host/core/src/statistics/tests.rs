use super::*;

#[test]
fn quantiles_are_of_type_seven() {
    let values = [1.0, 2.0, 4.0, 8.0];
    assert_eq!(quantile(&values, 0.0), 1.0);
    assert_eq!(quantile(&values, 0.25), 1.75);
    assert_eq!(quantile(&values, 0.5), 3.0);
    assert_eq!(quantile(&values, 1.0), 8.0);
}
