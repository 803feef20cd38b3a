use std::os::unix::fs::symlink;
use std::time::{Duration, Instant};

use super::*;

const BALL: &str = "<collision><geometry><sphere radius='1'/></geometry></collision>";

/// A robot with this between its tags.
fn robot(inside: &str) -> String {
    format!("<robot name='r'>\n{inside}</robot>")
}

fn link(name: &str) -> String {
    format!("<link name='{name}'>{BALL}</link>\n")
}

fn joint(name: &str, parent: &str, child: &str) -> String {
    format!("<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>\n")
}

fn with_geometry(geometry: &str) -> String {
    robot(&format!("<link name='a'><collision><geometry>{geometry}</geometry></collision></link>"))
}

/// Refused with these words, and soon.
#[track_caller]
fn soon(text: &str, words: &str) {
    let start = Instant::now();
    let why = refused(text);
    assert!(why.contains(words), "{why}");
    assert!(start.elapsed() < Duration::from_secs(20), "it took {:?}", start.elapsed());
}

#[test]
fn joints_that_are_no_tree_are_refused() {
    let two = [link("a"), link("b")].concat();
    soon(&robot(&two), "the links \"a\" and \"b\" are both no joint's child");
    soon(
        &robot(&[two.clone(), joint("j", "a", "b"), joint("k", "b", "a")].concat()),
        "form a cycle through the link \"a\"",
    );
    let three = [two.clone(), link("c"), joint("j", "a", "b"), joint("k", "b", "a")].concat();
    soon(&robot(&three), "form a cycle through the link \"a\"");
    soon(
        &robot(&[two.clone(), joint("j", "a", "b"), joint("k", "a", "b")].concat()),
        "the link \"b\" is the child of two joints, \"j\" and \"k\"",
    );
    soon(
        &robot(&[two.clone(), joint("j", "a", "c")].concat()),
        "line 4: joint \"j\" names the link \"c\", which is not there",
    );
    soon(&robot(&[link("a"), link("a")].concat()), "line 3: two links are named \"a\"");
    let same = [two, link("c"), joint("j", "a", "b"), joint("j", "a", "c")].concat();
    soon(&robot(&same), "two joints are named \"j\"");
}

#[test]
fn what_is_missing_or_no_number_is_named_with_its_line() {
    soon(&with_geometry("<box size='1 2'/>"), "link \"a\": line 2: size needs 3 number(s) and has 2");
    soon(&with_geometry("<box size='1 nan 2'/>"), "\"nan\" in size is not a number up to 1e18");
    soon(&with_geometry("<sphere radius='1e300'/>"), "\"1e300\" in radius is not a number");
    soon(&with_geometry("<sphere radius='-1'/>"), "the radius of object 0 is -1e0");
    soon(&with_geometry("<sphere/>"), "<sphere> has no radius");
    soon(&with_geometry("<heightmap/>"), "its geometry is \"heightmap\", and only mesh, box, sphere");
    soon(
        &with_geometry("<mesh filename='t.obj' scale='1 0 1'/>"),
        "the scale of \"t.obj\" in y is 0, which flattens it",
    );
    soon(&with_geometry("<mesh filename='no.obj'/>"), "link \"a\": the file \"no.obj\" does not exist");
    soon(
        &with_geometry("<mesh filename='a.urdf'/>"),
        "the mesh \"a.urdf\" cannot be read (the content is in no format",
    );
    soon(&robot("<link name='a'/>"), "it has no collision geometry");
    soon(&robot(""), "it has 0 links");
    soon("<robot xmlns:xacro='x'><xacro:property name='x' value='1'/></robot>", "line 1: this is a xacro file");
    soon("<svg/>", "its root element is \"svg\"");
    soon("<robot name='r'>", "the file ends inside an element");
}

#[test]
fn files_outside_of_the_folders_are_not_opened() {
    soon(&with_geometry("<mesh filename='../../../../etc/passwd'/>"), "leads out of the folder");
    soon(
        &with_geometry("<mesh filename='/etc/passwd'/>"),
        "\"/etc/passwd\" leads out of the folder of the robot or package",
    );
    soon(&with_geometry("<mesh filename='file:///etc/passwd'/>"), "leads out of the folder");
    soon(&with_geometry("<mesh filename='package://etc/passwd'/>"), "names a package that is not found");
    soon(&with_geometry("<mesh filename='package://../etc/passwd'/>"), "names a package that is not found");
    soon(&with_geometry("<mesh filename='http://example.org/a.stl'/>"), "is not a file on this machine");

    let text = |address: &str| with_geometry(&format!("<mesh filename='{address}'/>"));
    let folder = Folder::with(&[
        ("up.urdf", &text("../t.obj")),
        ("link.urdf", &text("link.obj")),
        ("package.urdf", &text("package://p/../../t.obj")),
        ("linked.urdf", &text("package://q/t.obj")),
        ("whole.urdf", ""),
        ("p/in.obj", TRIANGLE),
    ]);
    std::fs::write(folder.path("../t.obj"), TRIANGLE).unwrap();
    symlink("../t.obj", folder.path("link.obj")).unwrap();
    std::fs::create_dir(folder.path("../else")).unwrap();
    std::fs::write(folder.path("../else/t.obj"), TRIANGLE).unwrap();
    symlink("../else", folder.path("q")).unwrap();
    for name in ["up.urdf", "link.urdf", "package.urdf"] {
        let why = folder.refused(name, &Wanted::default());
        assert!(why.contains("leads out of the folder"), "{name}: {why}");
    }
    let why = folder.refused("linked.urdf", &Wanted::default());
    assert!(why.contains("names a package that is not found"), "{why}");
    // Who gives a folder by name means it.
    folder.import("linked.urdf", &package("q", &folder.path("q")));
    let whole = folder.whole.path().canonicalize().unwrap();
    std::fs::write(folder.path("whole.urdf"), text(&format!("file://{}/robot/p/in.obj", whole.display()))).unwrap();
    folder.import("whole.urdf", &Wanted::default());
}

#[test]
fn pipes_and_devices_are_no_files() {
    let folder = Folder::with(&[("a.urdf", &with_geometry("<mesh filename='pipe'/>"))]);
    nix::unistd::mkfifo(&folder.path("pipe"), nix::sys::stat::Mode::S_IRWXU).unwrap();
    assert!(folder.refused("a.urdf", &Wanted::default()).contains("it is not a regular file"));
    let why = import(Path::new("/dev/zero"), &Wanted::default()).unwrap_err().to_string();
    assert_eq!(why, "\"zero\" cannot be imported: it is not a regular file.");
}

#[test]
fn a_million_links_are_refused() {
    soon(&robot(&"<link name='a'/>".repeat(1_000_000)), "it has 1000000 links, and 1 to 100000 are read");
}

#[test]
fn a_long_chain_of_joints_is_placed() {
    let count = 50_000;
    let mut text: String = (0..count).map(|i| format!("<link name='{i}'/>")).collect();
    for i in 1..count {
        text.push_str(&format!(
            "<joint name='{i}' type='fixed'><parent link='{}'/><child link='{i}'/><origin xyz='1 0 0' rpy='0.1 0.2 0.3'/></joint>",
            i - 1
        ));
    }
    text.push_str(&joint("last", &(count - 1).to_string(), "end"));
    text.push_str(&link("end"));
    let it = imported(&robot(&text));
    assert!(object(&it, "end_0").pose.off_rotation() < 1e-12);
}

#[test]
fn too_many_objects_pairs_and_elements_are_refused() {
    let many = |count: usize| robot(&format!("<link name='a'>{}</link>", BALL.repeat(count)));
    soon(&many(100_001), "it has more than 100000 objects");
    soon(&many(4_000), "more than 5000000 pairs of objects would be disabled");
    soon(&robot(&"<b/>".repeat(2_000_001)), "it has more than 2000000 elements");
    let attributes: String = (0..101).map(|i| format!(" a{i}=''")).collect();
    soon(&format!("<robot{attributes}/>"), "line 1: more than 100 attributes here");
}

#[test]
fn deep_nesting_is_refused() {
    soon(
        &robot(&["<a>".repeat(1_000_000), "</a>".repeat(1_000_000)].concat()),
        "elements are nested more than 256 deep",
    );
}

#[test]
fn entities_are_refused() {
    let mut laughs = "<!DOCTYPE r [<!ENTITY a0 'ha'>".to_owned();
    for i in 1..30 {
        laughs.push_str(&format!("<!ENTITY a{i} '{}'>", format!("&a{};", i - 1).repeat(10)));
    }
    soon(&format!("{laughs}]><robot name='&a29;'/>"), "it has a DTD, which is not read");
    soon("<!DOCTYPE r [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><robot name='&x;'/>", "it has a DTD");
}
