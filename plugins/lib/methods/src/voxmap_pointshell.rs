//! One object as voxels, the other as points; the plugin's README says what they do.

mod voxels;

use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, dot, rotate, sub};
use opencollbench_plugin::{About, Algorithm, Answer, Collision, Count, Mesh, Parameter, Parameters, Placed, Refusal};
use voxels::Voxels;

/// Voxels of the object that has the larger ones against the points of the other.
#[derive(Debug)]
pub struct VoxmapPointshell {
    voxel: f64,
    clearance: f64,
}

/// Eleven thousand points for the bunny, and a query of a hundred microseconds at most.
const VOXEL: f64 = 0.01;

impl Default for VoxmapPointshell {
    fn default() -> Self {
        Self::with_voxel(VOXEL)
    }
}

impl VoxmapPointshell {
    /// With voxels of this share of an object's diagonal.
    pub fn with_voxel(voxel: f64) -> Self {
        Self { voxel, clearance: 0.0 }
    }

    /// With a map that calls a collision what is no further apart than this, in units of length: a layer of voxels more
    /// for each one that the clearance is long.
    pub fn beyond(self, clearance: f64) -> Self {
        Self { clearance, ..self }
    }
}

impl Algorithm for VoxmapPointshell {
    const ABOUT: About = About {
        id: c"voxmap-pointshell",
        name: c"Voxmap and pointshell",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"W. A. McNeely, K. D. Puterbaugh, J. J. Troy: Six Degree-of-Freedom Haptic Rendering Using Voxel Sampling, SIGGRAPH 1999",
        ..About::new()
    };

    type Object = Voxels;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Voxels> {
        Voxels::new(&mesh, self.voxel, self.clearance).map_err(Refusal::Error)
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        // Points may be off by half a diagonal of their voxel, and the map allows for one of its own voxels.
        let (map, shell) = if a.object.size >= b.object.size { (a, b) } else { (b, a) };
        let meet = meet(map, shell, work);
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }
}

/// Does a point of the shell lie in a voxel of the map, or beside one?
fn meet(map: Placed<'_, VoxmapPointshell>, shell: Placed<'_, VoxmapPointshell>, work: &mut impl Count) -> bool {
    let (map_pose, shell_pose) = (map.pose, shell.pose);
    let frame =
        Frame::new(map_pose.rotation(), map_pose.translation(), shell_pose.rotation(), shell_pose.translation());
    let (map, shell) = (map.object, shell.object);
    // From the shell's frame to the map's, in voxels of the map.
    let columns = |m: [Vector; 3]| [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]]);
    let (to_map, of_shell) = (columns(frame.rotation_a), columns(frame.rotation_b));
    let scale = 1.0 / map.size;
    let rotation = to_map.map(|row| of_shell.map(|column| dot(row, column) * scale));
    let offset = sub(rotate(&to_map, frame.offset), map.origin).map(|x| x * scale);
    work.bv_tests(1);
    let middle = add(rotate(&rotation, shell.middle), offset);
    if map.outside(middle, shell.radius * scale) {
        return false;
    }
    for &point in &shell.points {
        work.bv_tests(1);
        if map.has(add(rotate(&rotation, point), offset)) {
            return true;
        }
    }
    false
}

impl Parameters for VoxmapPointshell {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::real(c"voxel", c"Side of a voxel as a share of the object's diagonal", 0.002, 0.2, VOXEL)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "voxel" {
            return Err(Refusal::Unsupported);
        }
        self.voxel = value;
        Ok(())
    }
}
