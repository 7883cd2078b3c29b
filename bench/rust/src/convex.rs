// SPDX-License-Identifier: MIT
//! Support points and distances of convex hulls beside parry3d.

use crate::levels::Random;
use crate::table::{keep, race, row};
use glam::{Quat, Vec3};
use parry3d::math::Pose as TheirPose;
use parry3d::shape::{ConvexPolyhedron, SupportMap};
use talus::{Hull, Pose, Shape};
use talus_sys as sys;

const COUNT: usize = 100_000;

fn cloud(random: &mut Random, count: usize) -> Vec<[f32; 3]> {
    (0..count).map(|_| random.direction()).collect()
}

fn support(points: &[[f32; 3]], runs: usize, theirs: &ConvexPolyhedron) -> bool {
    let mut random = Random(2);
    let directions: Vec<[f32; 3]> = (0..COUNT).map(|_| random.direction()).collect();
    let raw: Vec<_> = points.iter().map(|p| sys::tl_vec3 { x: p[0], y: p[1], z: p[2] }).collect();
    let mut hull = std::ptr::null_mut();
    // SAFETY: the points outlive the call; NULL def and report are allowed.
    let result =
        unsafe { sys::tl_hull_bake(raw.as_ptr(), raw.len() as u32, std::ptr::null(), &mut hull, std::ptr::null_mut()) };
    assert_eq!(result, sys::TL_OK);
    // SAFETY: the hull lives until its end below, and the vertex is one of its own.
    let vertices = unsafe { hull.cast::<u8>().add((*hull).vertices as usize).cast::<sys::tl_vec3>() };
    let ours = |d: &[f32; 3]| unsafe {
        let vertex =
            sys::tl_hull_support(hull, sys::tl_vec3 { x: d[0], y: d[1], z: d[2] }, u32::MAX /* no hint */);
        *vertices.add(vertex as usize)
    };
    let same = directions.iter().filter(|&d| {
        let (a, b, d) = (ours(d), theirs.local_support_point(Vec3::from(*d)), Vec3::from(*d));
        (Vec3::new(a.x, a.y, a.z).dot(d) - b.dot(d)).abs() <= 1e-6
    });
    let agree = same.count() as f64 / directions.len() as f64;
    let seconds = race(
        runs,
        || directions.iter().for_each(|d| keep(ours(d))),
        || directions.iter().for_each(|d| keep(theirs.local_support_point(Vec3::from(*d)))),
    );
    // SAFETY: baked above, freed once.
    unsafe { sys::tl_blob_free(hull.cast()) };
    row("support", &format!("hull of {} points", points.len()), "parry3d", COUNT, seconds, agree, 0.999)
}

fn distance(points: &[[f32; 3]], runs: usize, theirs: &ConvexPolyhedron) -> bool {
    let hull = Hull::bake(points).expect("a cloud has a hull");
    let shape = Shape::hull(&hull, 0.0);
    let mut random = Random(3);
    let poses: Vec<(Pose, TheirPose)> = (0..COUNT)
        .map(|_| {
            let (axis, away) = (random.direction(), random.direction());
            let turn = Quat::from_axis_angle(Vec3::from(axis), random.between(0.0, 6.0));
            let at = Vec3::from(away) * random.between(2.1, 6.0); // apart: each is in the unit sphere
            (Pose { rotation: turn.to_array(), position: at.to_array() }, TheirPose::from_parts(at, turn))
        })
        .collect();
    let still = Pose::default();
    let ours = |pose: &Pose| talus::distance(&shape, &still, &shape, pose).expect("poses are finite").distance;
    let of_parry = |pose: &TheirPose| {
        parry3d::query::distance(&TheirPose::IDENTITY, theirs, pose, theirs).expect("parry has hulls").distance
    };
    // parry stops when a bound falls below a tolerance: up to 4 mm above the least distance here, never below it.
    let same = poses.iter().filter(|(a, b)| (-1e-5..=0.01).contains(&(of_parry(b) - ours(a))));
    let agree = same.count() as f64 / poses.len() as f64;
    let seconds = race(
        runs,
        || poses.iter().for_each(|(pose, _)| keep(ours(pose))),
        || poses.iter().for_each(|(_, pose)| keep(of_parry(pose))),
    );
    row("distance", &format!("hulls of {} points", points.len()), "parry3d", COUNT, seconds, agree, 0.999)
}

pub fn run(runs: usize) -> bool {
    let mut good = true;
    for count in [8, 32, 256] {
        let points = cloud(&mut Random(4), count);
        let vertices: Vec<Vec3> = points.iter().map(|&p| Vec3::from(p)).collect();
        let theirs = ConvexPolyhedron::from_convex_hull(&vertices).expect("a cloud has a hull");
        good &= support(&points, runs, &theirs);
        good &= distance(&points, runs, &theirs);
    }
    good
}
