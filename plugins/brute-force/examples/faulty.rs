//! A method with one fault, chosen by a parameter; 0 is none. What finds faults has to find each of these.
//!
//! Every pair of triangles is looked at, so that nothing but the fault can be wrong. Never offered to anybody: an example is
//! not built beside the programs.
#![forbid(unsafe_code)]

use std::time::{Duration, Instant};

use ocb_triangles::vector::{Vector, add, cross, dot, rotate, sub};
use ocb_triangles::{Closest, Frame, Triangle, distance, meet};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Pose, Refusal, Separation,
};

/// The method.
#[derive(Default)]
pub struct Faulty {
    fault: u32,
    queries: u32,
    /// Pose of B and the answer of the query before.
    before: Option<(Vector, f64)>,
}

/// Triangles, with the numbers of their corners.
type Object = Vec<(Triangle, [u32; 3])>;

opencollbench_plugin::export!(Faulty: distance contacts parameters);

const LAST: i32 = 20;

impl Algorithm for Faulty {
    const ABOUT: About = About {
        id: c"faulty",
        name: c"A method with one fault",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        ..About::new()
    };

    type Object = Object;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Object> {
        let mut all: Object = (0..mesh.triangles.len()).map(|i| (mesh.corners(i), mesh.triangles[i])).collect();
        match self.fault {
            // Drops the last triangle.
            6 if all.len() > 1 => drop(all.pop()),
            // Ends the process at a triangle without area.
            13 if all.iter().any(|(t, _)| norm(normal(t)) == 0.0) => std::process::abort(),
            // Looks at every edge once, and takes the numbers of its ends for their order.
            20 if all.len() > 1 => all.retain(|(_, [i, j, k])| !(i > j && j > k)),
            _ => {}
        }
        Ok(all)
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _: &mut impl Count) -> Answer<Collision> {
        self.queries += 1;
        let scene = self.scene(&a, &b);
        // Every 25th answer is another one's.
        if self.fault == 19 && self.queries.is_multiple_of(25) {
            return Ok(if scene.first().is_some() { Collision::Apart } else { Collision::Somewhere });
        }
        if self.fault == 14 && a.object.len() >= 512 && a.pose.0 == b.pose.0 {
            loop {
                std::hint::spin_loop();
            }
        }
        if self.fault == 17 && scene.deep() {
            let begun = Instant::now();
            // Any other answer looks at each pair once at most: this one is very long on this machine, however busy it is.
            std::hint::black_box(scene.contacts().count());
            let long = Duration::from_millis(60).max(60 * begun.elapsed());
            while begun.elapsed() < long {}
        }
        let found = scene.first().map_or(Collision::Apart, |[i, j]| Collision::Pair(i, j));
        Ok(match self.fault {
            // An absolute length decides.
            1 if scene.near(1e-6) => Collision::Somewhere,
            // What is in the box of the other object counts as inside.
            16 if scene.enclosed() => Collision::Somewhere,
            _ => found,
        })
    }
}

impl Contacts for Faulty {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        _: &mut impl Count,
    ) -> Answer<()> {
        self.queries += 1;
        let scene = self.scene(&a, &b);
        // A buffer that is too small.
        let most = if self.fault == 12 { 64 } else { usize::MAX };
        scene.contacts().take(most).for_each(|[i, j]| found.push(i, j));
        Ok(())
    }
}

impl Distance for Faulty {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _: &mut impl Count) -> Answer<Separation> {
        self.queries += 1;
        let scene = self.scene(&a, &b);
        let Some((closest, triangles)) = scene.nearest() else { return Err(Refusal::GaveUp) };
        let mut found = closest.squared.sqrt();
        match self.fault {
            // Not a number where a triangle is long and thin.
            5 if a.object.iter().chain(b.object).any(|(t, _)| thin(t)) => found = f64::NAN,
            // The answer before, as long as B hardly moves.
            7 => {
                let here = b.pose.translation();
                match self.before {
                    Some((there, answer)) if norm(sub(here, there)) < 1e-3 => found = answer,
                    _ => self.before = Some((here, found)),
                }
            }
            _ => {}
        }
        let points = [scene.frame.to_world(closest.a), scene.frame.to_world(closest.b)];
        Ok(Separation { distance: found, points: Some(points), triangles: Some(triangles) })
    }
}

impl Parameters for Faulty {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"fault", c"Which fault; 0 is none", 0, LAST, 0)];

    fn set(&mut self, _: &str, value: f64) -> Answer<()> {
        self.fault = value as u32;
        Ok(())
    }
}

/// Both objects in one frame.
struct Scene {
    fault: u32,
    frame: Frame,
    a: Vec<Triangle>,
    b: Vec<Triangle>,
}

impl Faulty {
    fn scene(&self, a: &Placed<'_, Self>, b: &Placed<'_, Self>) -> Scene {
        let turned = |pose: &Pose, which: u32| {
            let r = pose.rotation();
            // Rows for columns.
            if self.fault == which { std::array::from_fn(|i| std::array::from_fn(|j| r[j][i])) } else { r }
        };
        // A stands where its file says.
        let pose_a = if self.fault == 9 { &Pose::IDENTITY } else { a.pose };
        let mut frame =
            Frame::new(turned(pose_a, u32::MAX), pose_a.translation(), turned(b.pose, 10), b.pose.translation());
        // World coordinates in single precision where they are large.
        let far = |v: Vector| v.iter().any(|x| x.abs() > 1000.0);
        if self.fault == 18 && (far(a.pose.translation()) || far(b.pose.translation())) {
            frame.offset = frame
                .offset
                .map(|x| x + f64::from((x + a.pose.translation()[0]) as f32) - (x + a.pose.translation()[0]));
        }
        let single = |t: Triangle| {
            // Single precision, which nobody was told.
            if self.fault == 8 { t.map(|p| p.map(|x| f64::from(x as f32))) } else { t }
        };
        let all = |object: &Object, place: &dyn Fn(&Triangle) -> Triangle| -> Vec<Triangle> {
            object.iter().map(|(t, _)| single(place(t))).collect()
        };
        Scene {
            fault: self.fault,
            a: all(a.object, &|t| frame.place_a(t)),
            b: all(b.object, &|t| frame.place_b(t)),
            frame,
        }
    }
}

impl Scene {
    /// Pairs that meet, as this method sees it.
    fn contacts(&self) -> impl Iterator<Item = [u32; 2]> {
        let pairs = (0..self.a.len()).flat_map(|i| (0..self.b.len()).map(move |j| [i, j]));
        pairs.filter(|&[i, j]| self.meets(&self.a[i], &self.b[j])).map(|pair| pair.map(|i| i as u32))
    }

    fn first(&self) -> Option<[u32; 2]> {
        self.contacts().next()
    }

    fn meets(&self, a: &Triangle, b: &Triangle) -> bool {
        match self.fault {
            // Squared normals below a number of its own are no triangles.
            2 if dot(normal(a), normal(a)) < 1e-15 || dot(normal(b), normal(b)) < 1e-15 => false,
            // Edges and corners do not belong to a triangle.
            3 => meet(a, &shrunk(b)) && meet(&shrunk(a), b),
            // Only the edges of B are put through A.
            4 => (0..3).any(|k| meet(a, &[b[k], b[(k + 1) % 3], b[k]])),
            // One-sided: what faces away is not there.
            11 if dot(normal(a), sub(b[0], a[0])) < 0.0 && dot(normal(a), sub(b[1], a[0])) < 0.0 => false,
            _ => meet(a, b),
        }
    }

    fn nearest(&self) -> Option<(Closest, [u32; 2])> {
        let pairs = (0..self.a.len()).flat_map(|i| (0..self.b.len()).map(move |j| (i, j)));
        let all = pairs.filter_map(|(i, j)| {
            let (a, b) = (&self.a[i], &self.b[j]);
            let closest = match self.fault {
                2 if dot(normal(a), normal(a)) < 1e-15 || dot(normal(b), normal(b)) < 1e-15 => return None,
                // Corners against faces alone.
                15 if !meet(a, b) => corners(a, b),
                _ => distance(a, b),
            };
            Some((closest, [i as u32, j as u32]))
        });
        all.min_by(|(one, _), (other, _)| one.squared.total_cmp(&other.squared))
    }

    /// No further apart than this. Only pairs whose boxes are so near are looked at: the search for failures asks hundreds of times.
    fn near(&self, limit: f64) -> bool {
        let boxes = |all: &[Triangle]| all.iter().map(bounds).collect::<Vec<_>>();
        let (boxes_a, boxes_b) = (boxes(&self.a), boxes(&self.b));
        let apart = |[low, high]: &[Vector; 2], [other_low, other_high]: &[Vector; 2]| {
            (0..3).any(|k| low[k] - limit > other_high[k] || other_low[k] - limit > high[k])
        };
        let near = |i: usize, j: usize| distance(&self.a[i], &self.b[j]).squared.sqrt() <= limit;
        (0..self.a.len()).any(|i| (0..self.b.len()).any(|j| !apart(&boxes_a[i], &boxes_b[j]) && near(i, j)))
    }

    /// The centres of both are hardly apart.
    fn deep(&self) -> bool {
        self.a.len() > 100 && norm(self.frame.offset) < 0.02
    }

    /// All of B within the box of A.
    fn enclosed(&self) -> bool {
        let span = |all: &[Triangle], k: usize| {
            let values = all.iter().flatten().map(|p| p[k]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        (0..3).all(|k| {
            let ((low_a, high_a), (low_b, high_b)) = (span(&self.a, k), span(&self.b, k));
            low_a < low_b && high_b < high_a
        })
    }
}

/// The nearest of all corners to the other triangle.
fn corners(a: &Triangle, b: &Triangle) -> Closest {
    let of_a = a.iter().map(|&p| distance(&[p, p, p], b));
    let of_b = b.iter().map(|&p| distance(a, &[p, p, p]));
    of_a.chain(of_b).min_by(|one, other| one.squared.total_cmp(&other.squared)).expect("six corners")
}

fn normal(t: &Triangle) -> Vector {
    cross(sub(t[1], t[0]), sub(t[2], t[0]))
}

fn norm(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

/// Lowest and highest coordinates.
fn bounds(t: &Triangle) -> [Vector; 2] {
    [f64::min, f64::max].map(|of| std::array::from_fn(|k| of(of(t[0][k], t[1][k]), t[2][k])))
}

/// Longer than wide by more than this.
fn thin(t: &Triangle) -> bool {
    let longest = (0..3).map(|k| norm(sub(t[(k + 1) % 3], t[k]))).fold(0.0, f64::max);
    norm(normal(t)) < 1e-5 * longest * longest
}

/// A little smaller, about its middle.
fn shrunk(t: &Triangle) -> Triangle {
    let sum = add(add(t[0], t[1]), t[2]);
    let middle = sum.map(|x| x / 3.0);
    let by = [[1.0 - 1e-6, 0.0, 0.0], [0.0, 1.0 - 1e-6, 0.0], [0.0, 0.0, 1.0 - 1e-6]];
    t.map(|p| add(middle, rotate(&by, sub(p, middle))))
}
