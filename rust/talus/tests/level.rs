// SPDX-License-Identifier: MIT
//! A level with a wall: rays, shapes, paths, files, errors and threads through the safe interface.

use talus::{
    cast, decompose, distance, penetration, Cull, DecomposeSettings, ErrorKind, Hull, HullSettings, Level, Navmesh,
    NavmeshSettings, Pose, Ray, Shape, Side, Soup,
};

// A floor 20 m square, and a wall 3 m high with a passage around its end at z = 6.
const VERTICES: [[f32; 3]; 12] = [
    [-10.0, 0.0, -10.0],
    [-10.0, 0.0, 10.0],
    [10.0, 0.0, 10.0],
    [10.0, 0.0, -10.0],
    [0.0, 0.0, -10.0],
    [0.0, 0.0, 6.0],
    [0.0, 3.0, 6.0],
    [0.0, 3.0, -10.0],
    [0.5, 0.0, -10.0],
    [0.5, 0.0, 6.0],
    [0.5, 3.0, 6.0],
    [0.5, 3.0, -10.0],
];
const TRIANGLES: [[u32; 3]; 10] = [
    [0, 1, 2],
    [0, 2, 3],
    [4, 5, 6],
    [4, 6, 7],
    [8, 11, 10],
    [8, 10, 9],
    [5, 9, 10],
    [5, 10, 6],
    [7, 6, 10],
    [7, 10, 11],
];
const CUBE: [[f32; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
const CUBE_SIDES: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

fn navmesh() -> Navmesh {
    let settings = NavmeshSettings { agent_radius: 0.4, ..NavmeshSettings::default() };
    Navmesh::bake(&VERTICES, &TRIANGLES, &settings).unwrap()
}

#[test]
fn rays_hit_what_they_should() {
    let soup = Soup::bake(&VERTICES, &TRIANGLES).unwrap();
    let ray = Ray::new([-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
    let hit = soup.cast_ray(&ray).unwrap();
    assert_eq!((hit.t, hit.back), (5.0, false));
    assert_eq!(hit.normal, [-1.0, 0.0, 0.0]);
    assert!(soup.is_occluded(&ray));
    assert!(soup.cast_ray(&Ray { max_t: 4.0, ..ray }).is_none());
    assert!(!soup.line_of_sight([-5.0, 1.0, 0.0], [5.0, 1.0, 0.0]));
    assert!(soup.line_of_sight([-5.0, 1.0, 8.0], [5.0, 1.0, 8.0]));
    let up = Ray::new([5.0, -1.0, 5.0], [0.0, 1.0, 0.0]);
    assert!(soup.cast_ray(&up).unwrap().back);
    assert!(soup.cast_ray_culled(&up, Cull::Back).is_none());
    assert!(soup.cast_ray_culled(&up, Cull::Front).is_some());
    let many = soup.cast_rays(&[ray, Ray::new([0.0, 9.0, 0.0], [0.0, 1.0, 0.0])]).unwrap();
    assert_eq!(many, [Some(hit), None]);
    let nearest = soup.nearest([-2.0, 1.0, -3.0], 5.0).unwrap().unwrap();
    assert_eq!((nearest.distance, nearest.point), (1.0, [-2.0, 0.0, -3.0]));
    assert_eq!(soup.nearest([0.0, 50.0, 0.0], 5.0).unwrap(), None);
    let ball = Shape::sphere([0.0; 3], 1.0);
    assert!(soup.overlaps(&ball, &Pose::at([-0.5, 1.5, 0.0])).unwrap());
    assert!(!soup.overlaps(&ball, &Pose::at([-5.0, 1.5, 0.0])).unwrap());
    assert_eq!(ray.at(hit.t), [0.0, 1.0, 0.0]);
}

#[test]
fn batches_are_single_rays() {
    let soup = Soup::bake(&VERTICES, &TRIANGLES).unwrap();
    let slant = |i: usize| {
        let down = if i % 7 == 0 { 1.0 } else { -1.0 }; // or up, where nothing is
        Ray::new([-9.0 + 0.01 * i as f32, 3.5, -4.0], [0.2, down, 0.004 * (i % 500) as f32 - 1.0])
    };
    let mut answers = vec![None; 3];
    for count in [0, 1, 511, 512, 513, 1800] {
        let rays: Vec<Ray> = (0..count).map(slant).collect();
        soup.cast_rays_into(&rays, &mut answers).unwrap();
        let single: Vec<_> = rays.iter().map(|ray| soup.cast_ray(ray)).collect();
        assert_eq!(answers, single);
        assert_eq!(soup.cast_rays(&rays).unwrap(), single);
        assert!(count < 1800 || (single.iter().any(Option::is_none) && single.iter().any(Option::is_some)));
    }
}

#[test]
fn moving_shapes_meet_what_they_should() {
    let soup = Soup::bake(&VERTICES, &TRIANGLES).unwrap();
    let ball = Shape::sphere([0.0; 3], 1.0);
    let start = Pose::at([-5.0, 1.5, 0.0]);
    let hit = soup.cast_shape(&ball, &start, [8.0, 0.0, 0.0]).unwrap().unwrap();
    assert!((hit.t - 0.5).abs() < 1e-6 && hit.converged && !hit.initial_overlap && !hit.back);
    assert_eq!((hit.normal, hit.point[0]), ([-1.0, 0.0, 0.0], 0.0));
    assert_eq!(soup.cast_shape(&ball, &start, [-3.0, 0.0, 0.0]).unwrap(), None);
    let inside = soup.cast_shape(&ball, &Pose::at([-0.5, 1.5, 0.0]), [1.0, 0.0, 0.0]).unwrap().unwrap();
    assert!(inside.initial_overlap && inside.t == 0.0 && (inside.depth - 0.5).abs() < 1e-6);
    assert_eq!(soup.cast_shape(&ball, &start, [f32::NAN; 3]).unwrap_err().kind(), ErrorKind::NotFinite);

    let wall = Shape::cuboid([0.0; 3], [0.5, 4.0, 4.0], 0.0);
    let at = |x| Pose::at([x, 0.0, 0.0]);
    let hit = cast(&wall, &Pose::default(), &ball, &at(5.5), [-8.0, 0.0, 0.0]).unwrap().unwrap();
    assert!((hit.t - 0.5).abs() < 1e-6 && hit.converged && !hit.initial_overlap);
    assert_eq!(hit.normal, [1.0, 0.0, 0.0]);
    assert_eq!(cast(&wall, &Pose::default(), &ball, &at(5.5), [-3.9, 0.0, 0.0]).unwrap(), None);
    assert!(cast(&wall, &Pose::default(), &ball, &at(1.0), [-8.0, 0.0, 0.0]).unwrap().unwrap().initial_overlap);
    let error = cast(&wall, &Pose::default(), &ball, &at(f32::NAN), [1.0, 0.0, 0.0]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFinite);
}

#[test]
fn points_are_inside_or_outside() {
    let cube = Soup::bake(&CUBE, &CUBE_SIDES).unwrap();
    assert_eq!(cube.locate([0.3, 0.2, -0.1]).unwrap(), Side::Inside);
    assert_eq!(cube.locate([1.3, 0.2, -0.1]).unwrap(), Side::Outside);
    assert_eq!(cube.locate([1.0, 0.2, -0.1]).unwrap(), Side::OnSurface);
    assert_eq!(cube.locate([f32::NAN, 0.0, 0.0]).unwrap_err().kind(), ErrorKind::NotFinite);
}

// Two cubes whose middles are 6 m apart.
fn two_cubes() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let far = CUBE.map(|[x, y, z]| [x + 6.0, y, z]);
    let far_sides = CUBE_SIDES.map(|side| side.map(|corner| corner + 8));
    ([CUBE, far].concat(), [CUBE_SIDES, far_sides].concat())
}

#[test]
fn meshes_become_convex_parts() {
    let (vertices, triangles) = two_cubes();
    let parts = decompose(&vertices, &triangles, &DecomposeSettings::default()).unwrap();
    assert_eq!(parts.len(), 2);
    for part in &parts {
        assert!(part.concavity <= 0.025 * 8.0 && part.max_outside < 1e-5);
        assert!((part.hull.volume() - 8.0).abs() < 1e-6 && part.hull.vertices().len() == 8);
        assert_eq!(part.hull.triangles().len(), 12);
    }
    let middles = parts.iter().filter(|part| part.hull.contains([6.0, 0.0, 0.0])).count();
    assert_eq!(middles, 1);
    let settings = DecomposeSettings { max_parts: 1, threads: 2, ..DecomposeSettings::default() };
    let one = decompose(&vertices, &triangles, &settings).unwrap();
    assert!(one.len() == 1 && one[0].concavity > 1.0 && one[0].hull.contains([3.0, 0.0, 0.0]));
    let error = decompose(&CUBE, &CUBE_SIDES, &DecomposeSettings { max_vertices: 3, ..settings }).err().unwrap();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("max_vertices")));
}

#[test]
fn triangles_of_a_hull_enclose_its_volume() {
    let points: Vec<[f32; 3]> = (0..200)
        .map(|i| (i as f32 * 0.7, i as f32 * 1.3))
        .map(|(a, b)| [a.sin() * b.cos(), a.cos(), a.sin() * b.sin()])
        .collect();
    let hull = Hull::bake(&points).unwrap();
    let corner = |index: u32| hull.vertices()[index as usize].map(f64::from);
    let sixfold: f64 = hull
        .triangles()
        .iter()
        .map(|&[a, b, c]| {
            let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (corner(a), corner(b), corner(c));
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        })
        .sum();
    assert!((sixfold / 6.0 - hull.volume()).abs() < 1e-6 && hull.volume() > 3.0);
}

#[test]
fn hulls_keep_their_distance() {
    let mut points = CUBE.to_vec();
    points.push([0.2, 0.1, 0.0]);
    let hull = Hull::bake(&points).unwrap();
    assert_eq!(hull.vertex_count(), 8);
    assert!(hull.contains([0.9, 0.9, 0.9]) && !hull.contains([1.1, 0.0, 0.0]));
    let cube = Shape::hull(&hull, 0.0);
    let apart = distance(&cube, &Pose::default(), &cube, &Pose::at([5.0, 0.5, 0.0])).unwrap();
    assert!((apart.distance - 3.0).abs() < 1e-6 && apart.lower_bound <= apart.distance);
    assert!(penetration(&cube, &Pose::default(), &cube, &Pose::at([5.0, 0.0, 0.0])).unwrap().is_none());
    let deep = penetration(&cube, &Pose::default(), &cube, &Pose::at([1.5, 0.0, 0.0])).unwrap().unwrap();
    let nowhere = Pose::at([f32::NAN, 0.0, 0.0]);
    assert_eq!(distance(&cube, &nowhere, &cube, &Pose::default()).unwrap_err().kind(), ErrorKind::NotFinite);
    assert_eq!(penetration(&cube, &nowhere, &cube, &Pose::default()).unwrap_err().kind(), ErrorKind::NotFinite);
    assert!((deep.depth - 0.5).abs() < 1e-6 && deep.bounds[0] <= deep.depth && deep.depth <= deep.bounds[1]);
    let mut uneven = CUBE.to_vec();
    uneven.extend((1..9).zip(&CUBE).map(|(i, p)| [p[0] + 1e-4 * i as f32, p[1] - 1e-4 * i as f32, p[2]]));
    let settings = HullSettings { weld_distance: 1e-2, merge_distance: 1e-2, ..Default::default() };
    let (hull, outside) = Hull::bake_with(&uneven, &settings).unwrap();
    assert!(Hull::bake(&uneven).unwrap().vertex_count() > 8);
    assert_eq!(hull.vertex_count(), 8);
    assert!(outside > 0.0 && outside <= 2e-2);
    assert_eq!(Hull::bake_with(&CUBE, &HullSettings { max_vertices: 4, ..settings }).unwrap().0.vertex_count(), 4);
    let (rough, outside) = Hull::bake_with(&uneven, &HullSettings { tolerance: 1e-2, ..Default::default() }).unwrap();
    assert!(rough.vertex_count() == 8 && outside > 0.0 && outside <= 1e-2);
    let error = Hull::bake_with(&CUBE, &HullSettings { max_vertices: 3, ..settings }).err().unwrap();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("max_vertices")));
    assert_eq!(Hull::bake(&[[f32::INFINITY; 3]; 4]).err().unwrap().kind(), ErrorKind::NotFinite);
}

#[test]
fn paths_lead_around_the_wall() {
    let navmesh = navmesh();
    let mut query = navmesh.query().unwrap();
    let path = query.shortest_path([-5.0, 0.0, -5.0], [5.0, 0.0, -5.0]).unwrap().unwrap();
    assert!(path.points.len() >= 4 && path.length > 24.4 && path.length < 27.0);
    assert!((path.length - path.lower_bound).abs() < 1e-4); // corners are floats
    assert_eq!(query.shortest_path([-5.0, 0.0, -5.0], [50.0, 0.0, 0.0]).unwrap(), None);
    assert!(query.nearest_point([-5.0, 1.0, -5.0]).unwrap().is_some());
    assert_eq!(query.shortest_path([f32::NAN, 0.0, 0.0], [0.0; 3]).unwrap_err().kind(), ErrorKind::NotFinite);
}

#[test]
fn files_hold_all_of_it() {
    let level = Level {
        soup: Some(Soup::bake(&VERTICES, &TRIANGLES).unwrap()),
        hull: Some(Hull::bake(&CUBE).unwrap()),
        navmesh: Some(navmesh()),
    };
    let bytes = level.to_bytes().unwrap();
    let read = Level::from_bytes(&bytes).unwrap();
    assert_eq!(read.to_bytes().unwrap(), bytes);
    let path = |level: &Level| {
        let navmesh = level.navmesh.as_ref().unwrap();
        navmesh.query().unwrap().shortest_path([-5.0, 0.0, -5.0], [5.0, 0.0, -5.0]).unwrap().unwrap()
    };
    assert_eq!(path(&read), path(&level));
    // What was taken out of a level keeps the bytes alive.
    let soup = read.soup.unwrap();
    drop(bytes);
    assert!(soup.is_occluded(&Ray::new([-5.0, 1.0, 0.0], [1.0, 0.0, 0.0])));
}

/// What the command baked is read here, and written again with the same bytes per chunk. Only where TALUS_COMMAND names it.
#[test]
fn the_commands_files_are_read() {
    let Ok(command) = std::env::var("TALUS_COMMAND") else {
        return eprintln!("TALUS_COMMAND is not set: the command's files are not read");
    };
    let folder = std::env::temp_dir().join(format!("talus-rust-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let run = |line: &str| {
        let status = std::process::Command::new(&command).args(line.split(' ')).current_dir(&folder).status();
        assert!(status.unwrap().success(), "talus {line}");
    };
    run("sample courtyard -o level.obj");
    run("bake level.obj -o level.talus");
    let bytes = std::fs::read(folder.join("level.talus")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let level = Level::from_bytes(&bytes).unwrap();
    let navmesh = level.navmesh.as_ref().unwrap();
    let path = navmesh.query().unwrap().shortest_path([2.0, 0.0, 20.0], [20.0, 5.0, 20.0]).unwrap().unwrap();
    assert!(path.points.len() > 2 && path.length > 18.0);
    assert_eq!(
        Level::from_bytes(&level.to_bytes().unwrap()).unwrap().navmesh.unwrap().polygon_count(),
        navmesh.polygon_count()
    );
}

#[test]
fn altered_files_are_refused() {
    let bytes = Level { navmesh: Some(navmesh()), ..Level::default() }.to_bytes().unwrap();
    for length in [0, 1, 63, 64, bytes.len() / 2, bytes.len() - 1] {
        assert_eq!(Level::from_bytes(&bytes[..length]).err().unwrap().kind(), ErrorKind::Format, "{length} bytes");
    }
    for at in (0..bytes.len()).step_by(97) {
        let mut altered = bytes.clone();
        altered[at] ^= 1;
        assert!(Level::from_bytes(&altered).is_err(), "byte {at}");
    }
}

#[test]
fn errors_name_the_culprit() {
    let mut vertices = VERTICES;
    vertices[7][1] = f32::NAN;
    let error = Soup::bake(&vertices, &TRIANGLES).err().unwrap();
    assert_eq!((error.kind(), error.element()), (ErrorKind::NotFinite, Some(("vertex", Some(7)))));
    let error = Soup::bake(&VERTICES, &[[0, 1, 99]]).err().unwrap();
    assert_eq!(error.kind(), ErrorKind::Index);
    let settings = NavmeshSettings { cell_size: -1.0, ..NavmeshSettings::default() };
    let error = Navmesh::bake(&VERTICES, &TRIANGLES, &settings).err().unwrap();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("cell_size")));
    assert!(error.to_string().contains("cell_size") && error.advice().is_some());
}

#[test]
fn bakes_tell_their_progress_and_stop() {
    let settings = NavmeshSettings::default();
    let mut stages = Vec::new();
    Navmesh::bake_with_progress(&VERTICES, &TRIANGLES, &settings, |stage, done, total| {
        assert!(done <= total);
        stages.push(stage.to_owned());
        true
    })
    .unwrap();
    assert!(!stages.is_empty());
    let error = Navmesh::bake_with_progress(&VERTICES, &TRIANGLES, &settings, |_, _, _| false).err().unwrap();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    let panic = std::panic::catch_unwind(|| {
        let _ = Navmesh::bake_with_progress(&VERTICES, &TRIANGLES, &settings, |_, _, _| panic!("from the callback"));
    });
    assert_eq!(panic.unwrap_err().downcast_ref::<&str>(), Some(&"from the callback"));
}

#[test]
fn threads_share_a_navmesh() {
    let navmesh = navmesh();
    let soup = Soup::bake(&VERTICES, &TRIANGLES).unwrap();
    let expected = navmesh.query().unwrap().shortest_path([-5.0, 0.0, -5.0], [5.0, 0.0, -5.0]).unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let mut query = navmesh.query().unwrap();
                for _ in 0..50 {
                    assert_eq!(query.shortest_path([-5.0, 0.0, -5.0], [5.0, 0.0, -5.0]).unwrap(), expected);
                    assert!(soup.is_occluded(&Ray::new([-5.0, 1.0, 0.0], [1.0, 0.0, 0.0])));
                }
            });
        }
    });
}
