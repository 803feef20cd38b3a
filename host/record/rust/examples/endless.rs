//! Records queries of two threads into the folder that it is given, until it is killed. Prints a line after each query.

use std::time::Duration;

use opencollbench_record::{IDENTITY, Kind, Query, Recording, Shape};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).ok_or("usage: endless FOLDER")?;
    let recording = Recording::create(folder, "endless", "some library", "1.2")?;
    let record = |thread: u64| -> Result<(), opencollbench_record::Error> {
        for step in 0_u32.. {
            // A new object now and then, so that objects and queries are written beside each other.
            let ball = recording.object("ball", Shape::Sphere { radius: 1.0 })?;
            let other = recording.object("ball", Shape::Sphere { radius: f64::from(1 + step / 100) })?;
            let mut pose = IDENTITY;
            pose[3] = f64::from(step);
            let distance = Some((f64::from(step) - 1.0 - f64::from(1 + step / 100)).max(0.0));
            let query = Query::new(Kind::Distance, [ball, other], [IDENTITY, pose]);
            recording.query(&Query { distance, time: Some(Duration::from_micros(1)), group: thread, ..query })?;
            println!("{thread} {step}");
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| record(1));
        record(0)?;
        other.join().map_err(|_| "a thread panicked")?.map_err(Into::into)
    })
}
