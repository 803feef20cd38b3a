//! Convex parts and GJK between them; its plugin's README says what it does.

mod parts;

use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Parameter, Parameters, Placed, Refusal,
    Separation,
};
use parry3d_f64::math::{Matrix, Pose, Rotation, Vector};
use parry3d_f64::query::details::distance_support_map_support_map;
pub use parts::{Part, decompose};

/// An object as convex parts.
#[derive(Debug)]
pub struct ConvexParts {
    depth: u32,
    resolution: u32,
    /// Pairs of parts of a query and how far their balls are apart, kept from query to query for its memory.
    pairs: Vec<(f64, [u32; 2])>,
}

const DEPTH: i32 = 5;
const RESOLUTION: i32 = 64;

impl Default for ConvexParts {
    fn default() -> Self {
        Self::with_depth(DEPTH as u32)
    }
}

impl ConvexParts {
    /// With parts that were cut in two so often at most.
    pub fn with_depth(depth: u32) -> Self {
        Self { depth, resolution: RESOLUTION as u32, pairs: Vec::new() }
    }

    /// Is a part of A no further from a part of B than this? The hulls hold the surfaces, so that "no" is never wrong (but
    /// for GJK's own tolerance).
    pub fn within(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, reach: f64, work: &mut impl Count) -> bool {
        self.nearest(a, b, [reach; 2], work) <= reach
    }

    /// The least distance of two parts, 0 when some meet: nearest balls first, nothing that cannot be below `limit`, and no
    /// further than to the first that is `enough`.
    fn nearest(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        [limit, enough]: [f64; 2],
        work: &mut impl Count,
    ) -> f64 {
        let (pose_a, pose_b) = (pose(&a), pose(&b));
        let pose12 = pose_a.inv_mul(&pose_b);
        self.pairs.clear();
        for (j, of_b) in (0..).zip(b.object) {
            let middle = pose12.transform_point(of_b.middle);
            for (i, of_a) in (0..).zip(a.object) {
                let gap = (of_a.middle - middle).length() - of_a.radius - of_b.radius;
                self.pairs.push((gap, [i, j]));
            }
        }
        work.bv_tests(self.pairs.len() as u64);
        self.pairs.retain(|pair| pair.0 <= limit);
        self.pairs.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let mut best = f64::INFINITY;
        for &(gap, [i, j]) in &self.pairs {
            if gap >= best {
                break;
            }
            work.bv_tests(1);
            let (of_a, of_b) = (&a.object[i as usize], &b.object[j as usize]);
            best = best.min(distance_support_map_support_map(&pose12, of_a, of_b));
            if best <= enough {
                break;
            }
        }
        best
    }
}

impl Algorithm for ConvexParts {
    const ABOUT: About = About {
        id: c"convex-parts",
        name: c"Convex parts (V-HACD) and GJK",
        authors: c"S\xc3\xa9bastien Crozet and the parry contributors, after Khaled Mamou; wrapped by the OpenCollBench contributors",
        license: c"Apache-2.0 AND BSD-3-Clause",
        url: c"https://parry.rs",
        paper: c"K. Mamou, F. Ghorbel: A simple and efficient approach for 3D mesh approximate convex decomposition, ICIP 2009",
        capabilities: &[Capability::Solid],
        ..About::new()
    };

    type Object = Vec<Part>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Vec<Part>> {
        Ok(decompose(&mesh, self.depth, self.resolution))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let meet = self.within(a, b, 0.0, work);
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }

    /// Parts are solid, so [`Self::collide`] has asked this already.
    fn inside(&mut self, _: Placed<'_, Self>, _: Placed<'_, Self>, _: &mut impl Count) -> Answer<bool> {
        Ok(false)
    }
}

impl Distance for ConvexParts {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let distance = self.nearest(a, b, [f64::INFINITY, 0.0], work);
        // The nearest points of hulls need not lie on the surfaces, so they are no witnesses.
        Ok(Separation { distance, points: None, triangles: None })
    }
}

impl Parameters for ConvexParts {
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::integer(c"depth", c"How often a part is cut in two at most: 2^depth parts", 2, 8, DEPTH),
        &Parameter::integer(c"resolution", c"Voxels along the longest side, for cutting", 16, 192, RESOLUTION),
    ];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        match name {
            "depth" => self.depth = value as u32,
            "resolution" => self.resolution = value as u32,
            _ => return Err(Refusal::Unsupported),
        }
        Ok(())
    }
}

/// parry keeps rotations as quaternions.
fn pose(placed: &Placed<'_, ConvexParts>) -> Pose {
    let [x, y, z] = placed.pose.rotation().map(Vector::from_array);
    let rotation = Matrix::from_cols(x, y, z).transpose();
    Pose::from_parts(Vector::from_array(placed.pose.translation()), Rotation::from_mat3(&rotation))
}
