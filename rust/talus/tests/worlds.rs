// SPDX-License-Identifier: MIT
//! Navmeshes that change while they are read, and worlds larger than memory: readers see all of an edit or nothing of it,
//! and what is not in memory is said not to be.

use std::io;
use std::process::Command;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::Arc;

use talus::{
    AgentSettings, AgentStatus, Crowd, CrowdSettings, ErrorKind, Hull, Interest, Level, Link, NavVersions, Navmesh,
    NavmeshSettings, Obstacle, Obstacles, Point, Pose, World, WorldPoint, WorldSettings, WorldState, WorldStatus,
};

const START: Point = [2.0, 0.0, 15.0];
const GOAL: Point = [28.0, 0.0, 15.0];
const WALL: Obstacle = Obstacle::Box { base: [15.0, 0.0, 15.0], half_extents: [1.0, 10.0], height: 2.0, turned: 0.0 };

fn settings() -> NavmeshSettings {
    NavmeshSettings { cell_size: 0.3, tile_size: 24, ..Default::default() }
}

// A floor `size` metres square, with a corner far away that no triangle uses.
fn floor(size: f32) -> ([Point; 5], [[u32; 3]; 2]) {
    let far = [1e6, 1e6, 1e6];
    ([[0.0; 3], [0.0, 0.0, size], [size, 0.0, size], [size, 0.0, 0.0], far], [[0, 1, 2], [0, 2, 3]])
}

fn length(navmesh: &Navmesh) -> f64 {
    navmesh.query().unwrap().shortest_path(START, GOAL).unwrap().unwrap().length
}

fn with_obstacles() -> (Obstacles, Navmesh) {
    let (vertices, triangles) = floor(30.0);
    Obstacles::bake(&vertices, &triangles, &settings()).unwrap()
}

fn bytes_of(navmesh: &Navmesh) -> Vec<u8> {
    Level { navmesh: Some(navmesh.clone()), ..Level::default() }.to_bytes().unwrap()
}

#[test]
fn edits_are_seen_when_they_are_published() {
    let (mut obstacles, navmesh) = with_obstacles();
    let (vertices, triangles) = floor(30.0);
    assert_eq!(navmesh.polygon_count(), Navmesh::bake(&vertices, &triangles, &settings()).unwrap().polygon_count());
    assert_eq!(obstacles.waiting(), 0);
    let versions = NavVersions::new(&navmesh).unwrap();
    let old = versions.acquire();
    let straight = length(&old);
    assert!((straight - 26.0).abs() < 1e-3 && straight == length(&navmesh));

    let wall = obstacles.add(&WALL).unwrap();
    let mut draft = versions.edit().unwrap();
    assert!(obstacles.waiting() > 2);
    while obstacles.update(&mut draft, 2).unwrap() > 0 {}
    assert_eq!(length(&versions.acquire()), straight); // not yet
    let new = draft.publish();
    assert!(length(&new) > straight + 3.0 && length(&new) == length(&versions.acquire()));
    assert_eq!((length(&old), length(&navmesh)), (straight, straight));
    let state = versions.state();
    assert_eq!((state.version_count, state.newest - state.oldest), (2, 1));
    assert!(state.waiting_bytes > 0);
    drop(old);
    assert_eq!((versions.state().version_count, versions.state().waiting_bytes), (1, 0));

    let moved = Obstacle::Cylinder { base: [15.0, 0.0, 25.0], radius: 1.0, height: 2.0 };
    obstacles.change(wall, &moved).unwrap();
    obstacles.remove(wall).unwrap();
    let mut draft = versions.edit().unwrap();
    while obstacles.update(&mut draft, 100).unwrap() > 0 {}
    assert_eq!(bytes_of(&draft.publish()), bytes_of(&navmesh)); // as if there had been none
    assert_eq!(obstacles.remove(wall).unwrap_err().kind(), ErrorKind::Stale);
    let wrong = Obstacle::Cylinder { base: [0.0; 3], radius: -1.0, height: 2.0 };
    assert_eq!(obstacles.add(&wrong).unwrap_err().field(), Some("radius"));
}

#[test]
fn obstacles_of_any_shape() {
    let (mut obstacles, navmesh) = with_obstacles();
    let versions = NavVersions::new(&navmesh).unwrap();
    let straight = length(&navmesh);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let on_its_side = Pose { rotation: [half, 0.0, 0.0, half], position: [15.0, 1.0, 15.0] };
    let corners: Vec<Point> =
        (0..8).map(|k| [[-1.0, 1.0][k & 1], [-10.0, 10.0][k >> 1 & 1], [-1.0, 1.0][k >> 2]]).collect();
    let hull = Arc::new(Hull::bake(&corners).unwrap());
    let id = obstacles.add_hull(&hull, &on_its_side).unwrap();
    let around = |obstacles: &mut Obstacles| {
        let mut draft = versions.edit().unwrap();
        while obstacles.update(&mut draft, 100).unwrap() > 0 {}
        length(&draft.publish())
    };
    let by_hull = around(&mut obstacles);
    assert!(by_hull > straight + 1.0);
    obstacles.change(id, &Obstacle::Cuboid { half_extents: [1.0, 10.0, 1.0], pose: on_its_side }).unwrap();
    assert_eq!(Arc::strong_count(&hull), 1);
    assert_eq!(around(&mut obstacles), by_hull);
    let ends = [[15.0, 1.0, 5.0], [15.0, 1.0, 25.0]];
    obstacles.change(id, &Obstacle::Capsule { ends, radius: 1.0 }).unwrap();
    assert!(around(&mut obstacles) > straight + 1.0);
    let far_above = Pose::at([15.0, 40.0, 15.0]);
    obstacles.change_hull(id, &hull, &far_above).unwrap();
    assert_eq!(around(&mut obstacles), straight);
    obstacles.remove(id).unwrap();
    assert_eq!(Arc::strong_count(&hull), 1);
}

#[test]
fn drafts_that_are_dropped_go_on_with_the_next_edit() {
    let (vertices, triangles) = floor(30.0);
    let navmesh = Navmesh::bake(&vertices, &triangles, &settings()).unwrap();
    let versions = NavVersions::new(&navmesh).unwrap();
    let first = versions.state().newest;
    let link = versions.edit().unwrap().add_link(&Link::new(START, GOAL)).unwrap();
    assert_eq!(versions.state().newest, first);
    let free = Link { cost_factor: 0.0, ..Link::new(START, [f32::NAN, 0.0, 0.0]) };
    let mut draft = versions.edit().unwrap();
    assert_eq!(draft.add_link(&free).unwrap_err().kind(), ErrorKind::NotFinite);
    let linked = draft.publish();
    // The link is saved with the navmesh, and read again.
    let again = Level::from_bytes(&bytes_of(&linked)).unwrap().navmesh.unwrap();
    assert_eq!(bytes_of(&again), bytes_of(&linked));
    assert_ne!(bytes_of(&linked), bytes_of(&navmesh));
    let copied = NavVersions::new(&linked).unwrap(); // of a version of others
    let mut draft = versions.edit().unwrap();
    draft.remove_link(link).unwrap();
    assert_eq!(draft.remove_link(link).unwrap_err().kind(), ErrorKind::Stale);
    assert_eq!(bytes_of(&draft.publish()), bytes_of(&navmesh));
    drop(versions);
    assert_eq!(bytes_of(&copied.acquire()), bytes_of(&linked));
}

#[test]
fn threads_read_beside_the_writer() {
    let (mut obstacles, navmesh) = with_obstacles();
    let versions = NavVersions::new(&navmesh).unwrap();
    let straight = length(&navmesh);
    let wall = obstacles.add(&WALL).unwrap();
    let mut draft = versions.edit().unwrap();
    while obstacles.update(&mut draft, 100).unwrap() > 0 {}
    let around = length(&draft.publish());
    obstacles.remove(wall).unwrap();
    let (done, reads) = (AtomicBool::new(false), AtomicU32::new(0));
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut query = versions.acquire().query().unwrap();
                while !done.load(Ordering::Relaxed) {
                    query.set_navmesh(versions.acquire());
                    let found = query.shortest_path(START, GOAL).unwrap().unwrap().length;
                    assert!(found == straight || found == around, "{found}");
                    reads.fetch_add(1, Ordering::Relaxed);
                }
            });
        }
        let mut there = None;
        for step in 0.. {
            match there.take() {
                Some(id) => obstacles.remove(id).unwrap(),
                None => there = Some(obstacles.add(&WALL).unwrap()),
            }
            let mut draft = versions.edit().unwrap();
            while obstacles.update(&mut draft, 100).unwrap() > 0 {}
            draft.publish();
            if step >= 10 && reads.load(Ordering::Relaxed) > 50 {
                break;
            }
        }
        done.store(true, Ordering::Relaxed);
    });
    assert_eq!((versions.state().version_count, versions.state().waiting_bytes), (1, 0));
}

#[test]
fn a_crowd_goes_from_version_to_version() {
    let (mut obstacles, navmesh) = with_obstacles();
    let versions = NavVersions::new(&navmesh).unwrap();
    let mut crowd = Crowd::new(&versions.acquire(), &CrowdSettings::default()).unwrap();
    let walker = crowd.add(START, &AgentSettings { max_speed: 3.0, ..Default::default() }).unwrap().unwrap();
    crowd.set_goal(walker, GOAL).unwrap();
    for _ in 0..40 {
        crowd.step(0.05).unwrap();
    }
    obstacles.add(&WALL).unwrap();
    let mut draft = versions.edit().unwrap();
    while obstacles.update(&mut draft, 100).unwrap() > 0 {}
    crowd.set_navmesh(draft.publish());
    let mut aside = 0.0_f32;
    while crowd.step(0.05).unwrap().arrived == 0 {
        let [x, _, z] = crowd.agent(walker).unwrap().position;
        assert!(!((x - 15.0).abs() < 1.2 && (z - 15.0).abs() < 10.2));
        aside = aside.max((z - 15.0).abs());
    }
    assert!(aside > 10.0 && crowd.agent(walker).unwrap().status == AgentStatus::Arrived);
}

// A floor in tiles of 7.2 m as a file's bytes, and in memory.
fn land() -> (Arc<Vec<u8>>, Navmesh) {
    let (vertices, triangles) = floor(90.0);
    let navmesh = Navmesh::bake(&vertices, &triangles, &settings()).unwrap();
    (Arc::new(bytes_of(&navmesh)), navmesh)
}

fn open(bytes: &Arc<Vec<u8>>, settings: &WorldSettings) -> World {
    let bytes = Arc::clone(bytes);
    let read = move |offset: u64, into: &mut [u8]| {
        let from = bytes.get(offset as usize..).and_then(|rest| rest.get(..into.len()));
        into.copy_from_slice(from.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    };
    World::new(read, settings).unwrap()
}

fn around(point: WorldPoint, radius: f64) -> [Interest; 1] {
    [Interest { point, radius }]
}

#[test]
fn a_whole_world_answers_as_its_navmesh() {
    let (bytes, navmesh) = land();
    let mut world = open(&bytes, &WorldSettings::default());
    assert_eq!(world.state().loaded, 0);
    let state = world.stream(&around([45.0, 0.0, 45.0], 500.0)).unwrap();
    assert!(state.loaded == state.places && state.places > 100 && state.bytes <= WorldSettings::default().budget);
    assert_eq!((state.missing, state.failed, state.loading, state.ready), (0, 0, 0, 0));
    let (mut query, mut exact) = (world.query().unwrap(), navmesh.query().unwrap());
    for i in 0..40 {
        let at = |k: i32| 2.0 + f64::from((i * k + k) % 86);
        let (start, goal) = ([at(7), 0.0, at(31)], [at(13), 0.0, at(53)]);
        let single = |p: WorldPoint| p.map(|x| x as f32);
        let expected = exact.shortest_path(single(start), single(goal)).unwrap().unwrap();
        let path = world.shortest_path(&mut query, start, goal).unwrap();
        assert!(path.status == WorldStatus::Complete && path.proven);
        assert!((path.length - expected.length).abs() < 1e-3 && path.points.len() == expected.points.len());
        let ray = world.cast_ray(start, goal).unwrap().unwrap();
        assert!(!ray.hit && ray.loaded && ray.t == 1.0);
    }
    let place = world.nearest_point([45.0, 1.0, 45.0]).unwrap();
    assert!(place.loaded && (place.point.unwrap()[1]).abs() < 0.5);
    assert!(world.covers([45.0, 0.0, 45.0], 40.0).unwrap());
    assert!(world.router().unwrap().is_none());
}

#[test]
fn what_is_not_in_memory_is_said() {
    let (bytes, _) = land();
    let mut world = open(&bytes, &WorldSettings::default());
    let mut query = world.query().unwrap();
    let (here, near, far, off) = ([5.0, 0.0, 45.0], [9.0, 0.0, 45.0], [85.0, 0.0, 45.0], [5.0, 0.0, 900.0]);
    let mut status = |world: &World, goal| world.shortest_path(&mut query, here, goal).unwrap().status;
    assert_eq!(status(&world, near), WorldStatus::NotLoaded);
    assert!(!world.nearest_point(here).unwrap().loaded && world.cast_ray(here, far).unwrap().is_none());
    let state = world.stream(&around(here, 12.0)).unwrap();
    assert!(state.loaded > 0 && state.loaded < state.places / 2);
    assert_eq!(status(&world, near), WorldStatus::Complete);
    assert_eq!(status(&world, far), WorldStatus::NotLoaded);
    assert_eq!(status(&world, off), WorldStatus::NoGoal);
    assert!(world.covers(here, 5.0).unwrap() && !world.covers(here, 50.0).unwrap());
    let ray = world.cast_ray(here, far).unwrap().unwrap();
    assert!(!ray.hit && !ray.loaded && ray.t > 0.0 && ray.t < 1.0 && ray.point[0] > here[0]);
    assert_eq!(world.update(&around(here, -1.0), 1).unwrap_err().kind(), ErrorKind::Argument);
    assert_eq!(world.update(&around([f64::NAN; 3], 1.0), 1).unwrap_err().kind(), ErrorKind::NotFinite);
}

#[test]
fn tiles_come_and_go_beside_readers() {
    let (bytes, navmesh) = land();
    let settings = WorldSettings { budget: 128 << 10, ..Default::default() };
    let mut world = open(&bytes, &settings);
    let mut exact = navmesh.query().unwrap();
    let mut proven = 0;
    for step in 0..80 {
        let here = [2.0 + f64::from(step), 0.0, 45.0];
        world.update(&around(here, 9.0), 2).unwrap();
        let loads: Vec<_> = std::iter::from_fn(|| world.begin_load().unwrap()).take(3).collect();
        std::thread::scope(|scope| {
            for (i, load) in loads.into_iter().enumerate() {
                if (i + step as usize) % 7 != 0 {
                    scope.spawn(move || load.run().unwrap()); // else it is dropped, and wanted still
                }
            }
            let there = [here[0] + 4.0, 0.0, 46.0];
            let path = world.shortest_path(&mut world.query().unwrap(), here, there).unwrap();
            if path.proven {
                let single = |p: WorldPoint| p.map(|x| x as f32);
                let expected = exact.shortest_path(single(here), single(there)).unwrap().unwrap();
                assert!((path.length - expected.length).abs() < 1e-3);
                proven += 1;
            }
        });
        let WorldState { bytes, peak_bytes, .. } = world.state();
        assert!(bytes <= peak_bytes && peak_bytes <= settings.budget);
    }
    assert!(proven > 40, "{proven}");
    // Loads outlive their world.
    world.stream(&around([2.0, 0.0, 2.0], 9.0)).unwrap();
    let load = (0..20).find_map(|_| {
        world.update(&around([80.0, 0.0, 80.0], 9.0), 1).unwrap(); // until the budget has room
        world.begin_load().unwrap()
    });
    drop(world);
    load.unwrap().run().unwrap();
}

#[test]
fn files_that_are_no_world_are_refused() {
    let (bytes, _) = land();
    let settings = WorldSettings::default();
    // Tiles that cannot be read any more.
    let (gone, source) = (Arc::new(AtomicBool::new(false)), Arc::clone(&bytes));
    let is_gone = Arc::clone(&gone);
    let read = move |offset: u64, into: &mut [u8]| {
        into.copy_from_slice(&source[offset as usize..offset as usize + into.len()]);
        if is_gone.load(Ordering::Relaxed) {
            Err(io::ErrorKind::UnexpectedEof.into())
        } else {
            Ok(())
        }
    };
    let mut cut = World::new(read, &settings).unwrap();
    gone.store(true, Ordering::Relaxed);
    assert_eq!(cut.stream(&around([45.0, 0.0, 45.0], 500.0)).unwrap_err().kind(), ErrorKind::Format);
    cut.update(&[], 1).unwrap();
    assert_eq!(cut.state().loaded, 0);
    let half = Arc::new(bytes[..bytes.len() / 2].to_vec());
    let read = move |offset: u64, into: &mut [u8]| {
        let from = half.get(offset as usize..).and_then(|rest| rest.get(..into.len()));
        into.copy_from_slice(from.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    };
    assert_eq!(World::new(read, &settings).err().unwrap().kind(), ErrorKind::Format);
    let kind = |read: fn(u64, &mut [u8]) -> io::Result<()>| World::new(read, &settings).err().unwrap().kind();
    assert_eq!(kind(|_, _| Ok(())), ErrorKind::Format); // zeros
    assert_eq!(kind(|_, _| Err(io::ErrorKind::PermissionDenied.into())), ErrorKind::Io);
    assert_eq!(kind(|_, _| panic!("a callback's own")), ErrorKind::Io);
    let none = Level::default().to_bytes().unwrap();
    let read = move |offset: u64, into: &mut [u8]| {
        into.copy_from_slice(&none[offset as usize..offset as usize + into.len()]);
        Ok(())
    };
    assert_eq!(World::new(read, &settings).err().unwrap().kind(), ErrorKind::Empty);
    assert_eq!(World::open("/no/such/file", &settings).err().unwrap().kind(), ErrorKind::Io);
    let few = WorldSettings { budget: 1, ..settings };
    let small = World::new(|_, _| Ok(()), &few).err().unwrap();
    assert_eq!((small.kind(), small.field()), (ErrorKind::Argument, Some("budget")));
}

/// The routes are baked by the command. Only where TALUS_COMMAND names it.
#[test]
fn routes_lead_over_what_is_not_in_memory() {
    let Ok(talus) = std::env::var("TALUS_COMMAND") else {
        return eprintln!("TALUS_COMMAND is not set: no routes are baked");
    };
    let (bytes, navmesh) = land();
    let path = std::env::temp_dir().join(format!("talus-routes-{}.talus", std::process::id()));
    std::fs::write(&path, bytes.as_slice()).unwrap();
    assert!(Command::new(talus).args(["world", "routes"]).arg(&path).output().unwrap().status.success());
    let mut world = World::open(&path, &WorldSettings::default()).unwrap();
    let mut router = world.router().unwrap().unwrap();
    let (start, goal) = ([5.0, 0.0, 5.0], [85.0, 0.0, 80.0]);
    assert_eq!(world.route(&mut router, start, goal).unwrap().status, WorldStatus::NotLoaded);
    let ends = [Interest { point: start, radius: 8.0 }, Interest { point: goal, radius: 8.0 }];
    let state = world.stream(&ends).unwrap();
    assert!(state.loaded < state.places / 4);
    let route = world.route(&mut router, start, goal).unwrap();
    let exact = navmesh.query().unwrap().shortest_path([5.0, 0.0, 5.0], [85.0, 0.0, 80.0]).unwrap().unwrap().length;
    assert!(route.status == WorldStatus::Complete && route.points.len() > 10);
    assert!(route.lower_bound <= exact + 1e-3 && exact <= route.length + 1e-3 && route.length < 1.2 * exact);
    assert!((route.points[0].point[0] - 5.0).abs() < 0.1);
    assert_eq!(world.route(&mut router, start, [5.0, 0.0, 900.0]).unwrap().status, WorldStatus::NoGoal);
    let other = World::open(&path, &WorldSettings::default()).unwrap();
    let wrong = other.route(&mut router, start, goal).unwrap_err();
    assert_eq!((wrong.kind(), wrong.field()), (ErrorKind::Argument, Some("router")));
    std::fs::remove_file(&path).unwrap();
}
