//! Times the oracle and the sphere method on one core: `oracle_speed FILE.obj [COUNT] [RELATIVE_DISTANCE]`.

use std::sync::Arc;
use std::time::Instant;

use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::mesh::obj;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::sampling::Plan;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let bytes = std::fs::read(&arguments[1]).expect("a readable OBJ file");
    let count: u32 = arguments.get(2).map_or(1000, |x| x.parse().expect("a count"));
    let distance: f64 = arguments.get(3).map_or(0.0, |x| x.parse().expect("a relative distance"));
    let mesh = Arc::new(obj::read(&bytes).expect("a valid mesh").mesh);
    let clock = Instant::now();
    let shape = Shape::new(mesh);
    println!("build {:.3} s", clock.elapsed().as_secs_f64());
    let method = Method::Sphere { sampling: Sampling::Count { count }, seed: 0 };
    let plan = Plan::new(&shape, &shape, &method, Separation::Relative { distance }).expect("a plan");
    let clock = Instant::now();
    let placed: Vec<_> = (0..plan.units()).flat_map(|i| plan.place(i).placed).collect();
    let seconds = clock.elapsed().as_secs_f64();
    let exact = placed.iter().filter(|p| p.truth.exact_used).count();
    println!(
        "sphere {} of {count} placed in {seconds:.3} s, {:.1} us each, {exact} with exact arithmetic",
        placed.len(),
        1e6 * seconds / f64::from(count)
    );
    let pair = Pair::new(&shape, &shape);
    let clock = Instant::now();
    let hits = placed.iter().filter(|p| pair.hit(&p.configuration)).count();
    println!("boolean {:.1} us each, {hits} hits", 1e6 * clock.elapsed().as_secs_f64() / placed.len() as f64);
    let clock = Instant::now();
    let clear = placed.iter().filter(|p| pair.truth(&p.configuration).distance_lo > 0.0).count();
    println!("truth {:.1} us each, {clear} clear", 1e6 * clock.elapsed().as_secs_f64() / placed.len() as f64);
}
