// SPDX-License-Identifier: MIT
//! Closest hits beside parry3d's TriMesh.

use crate::levels::{terrain, Level, Random};
use crate::table::{keep, race, row};
use glam::Vec3;
use parry3d::query::{Ray as TheirRay, RayCast};
use parry3d::shape::TriMesh;
use talus::{Ray, Soup};

const COUNT: usize = 400_000;

fn incoherent(level: &Level) -> Vec<Ray> {
    let edge = level.vertices.iter().map(|v| v[0]).fold(0.0, f32::max);
    let mut random = Random(1);
    let place = |random: &mut Random| [random.between(0.0, edge), random.between(-2.5, 5.5), random.between(0.0, edge)];
    (0..COUNT).map(|_| Ray::new(place(&mut random), random.direction())).collect()
}

fn camera(level: &Level) -> Vec<Ray> {
    let edge = level.vertices.iter().map(|v| v[0]).fold(0.0, f32::max);
    let side = (COUNT as f32).sqrt() as u32;
    let at = |i: u32| 1.2 * (i as f32 / side as f32 - 0.5);
    let eye = [edge / 2.0, 10.5, 0.0];
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    pixels.map(|(x, y)| Ray::new(eye, [at(x), -0.5 - 0.6 * at(y), 1.0])).collect()
}

pub fn run(runs: usize) -> bool {
    let mut good = true;
    for side in [40, 300] {
        let level = terrain(side);
        let soup = Soup::bake(&level.vertices, &level.triangles).expect("a terrain can be baked");
        let vertices = level.vertices.iter().map(|&v| Vec3::from(v)).collect();
        let mesh = TriMesh::new(vertices, level.triangles.clone()).expect("parry takes a terrain");
        for (name, rays) in [("camera", camera(&level)), ("incoherent", incoherent(&level))] {
            let rays_of_parry: Vec<_> =
                rays.iter().map(|ray| TheirRay::new(Vec3::from(ray.origin), Vec3::from(ray.direction))).collect();
            let theirs = |ray: &TheirRay| mesh.cast_local_ray_and_get_normal(ray, f32::MAX, true);
            let same = rays.iter().zip(&rays_of_parry).filter(|(a, b)| match (soup.cast_ray(a), theirs(b)) {
                (None, None) => true,
                (Some(a), Some(b)) => (a.t - b.time_of_impact).abs() <= 1e-3 * a.t.max(1.0),
                _ => false,
            });
            let agree = same.count() as f64 / rays.len() as f64;
            let cast_theirs = || rays_of_parry.iter().for_each(|ray| keep(theirs(ray)));
            let single = race(runs, || rays.iter().for_each(|ray| keep(soup.cast_ray(ray))), cast_theirs);
            good &= row(&format!("{name} rays, single"), &level.name, "parry3d", rays.len(), single, agree, 0.999);
            let mut answers = Vec::new();
            let many = race(runs, || soup.cast_rays_into(&rays, &mut answers).expect("few enough"), cast_theirs);
            good &= row(&format!("{name} rays, one call"), &level.name, "parry3d", rays.len(), many, agree, 0.999);
        }
    }
    good
}
