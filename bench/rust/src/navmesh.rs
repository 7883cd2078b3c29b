// SPDX-License-Identifier: MIT
//! Bakes beside rerecast, and shortest paths beside polyanya, which searches the very same polygons.

use crate::levels::{arena, terrain, Level, Random};
use crate::table::{keep, race, refused, row};
use glam::{UVec3, Vec2, Vec3A};
use polyanya::{Mesh, Trimesh};
use rerecast::{
    AreaType, BuildContoursFlags, ConfigBuilder, DetailNavmesh, HeightfieldBuilder, PolygonNavmesh, TriMesh,
};
use std::ptr::{null, null_mut};
use talus::{Navmesh, NavmeshSettings};
use talus_sys as sys;

const PATHS: usize = 2000;

// Bits of a tile's `wide`: TL_NAV_WIDE_CORNERS and TL_NAV_WIDE_FIRSTS, which are macros.
const WIDE_CORNERS: u32 = 4;
const WIDE_FIRSTS: u32 = 32;

/// The tiles of a bake, one here.
struct Tiles(sys::tl_nav_tiles);

impl Tiles {
    fn bake(level: &Level) -> Tiles {
        // SAFETY: all that the calls point to outlives them; points and triangles have the layout of the C structs.
        unsafe {
            let def = sys::tl_default_nav_def();
            let input = sys::tl_nav_input {
                mesh: sys::tl_mesh_view {
                    vertices: level.vertices.as_ptr().cast(),
                    vertex_count: level.vertices.len() as u32,
                    indices: level.triangles.as_ptr().cast(),
                    triangle_count: level.triangles.len() as u32,
                    materials: null(),
                },
                areas: null(),
                volumes: null(),
                volume_count: 0,
            };
            let mut tiles = std::mem::zeroed();
            assert_eq!(sys::tl_nav_bake(&def, &input, &mut tiles, null_mut()), sys::TL_OK);
            Tiles(tiles)
        }
    }

    fn tile(&self) -> &sys::tl_nav_tile {
        assert_eq!(self.0.tile_count, 1);
        // SAFETY: there is one, and it lives as long as self.
        unsafe { &**self.0.tiles }
    }

    /// Part of the tile.
    fn part<T>(&self, offset: u32, count: u32) -> &[T] {
        let tile: *const sys::tl_nav_tile = self.tile();
        // SAFETY: a tile's offsets count 8 bytes from its beginning, where so many items lie.
        unsafe { std::slice::from_raw_parts(tile.cast::<u8>().add(8 * offset as usize).cast(), count as usize) }
    }

    /// Number `i` of an array of 16 bits each, or of 32 where the tile has the bit `wide`.
    fn number(&self, offset: u32, wide: u32, i: u32) -> u32 {
        if self.tile().wide & wide != 0 {
            self.part::<u32>(offset, i + 1)[i as usize]
        } else {
            u32::from(self.part::<u16>(offset, i + 1)[i as usize])
        }
    }

    /// The polygons as triangles in the plane.
    fn triangles(&self) -> Trimesh {
        let tile = self.tile();
        // Of each polygon its corners, then added ones.
        let points: &[sys::tl_vec3] = self.part(tile.detail_vertices, tile.detail_vertex_count);
        let mut vertices = vec![Vec2::ZERO; tile.vertex_count as usize];
        let mut triangles = Vec::new();
        for p in 0..tile.polygon_count {
            let first = self.number(tile.first_corner, WIDE_FIRSTS, p);
            let end = self.number(tile.first_corner, WIDE_FIRSTS, p + 1);
            let first_point = self.number(tile.detail_first_vertex, WIDE_FIRSTS, p);
            let polygon: Vec<usize> =
                (first..end).map(|corner| self.number(tile.corner_vertices, WIDE_CORNERS, corner) as usize).collect();
            for (&vertex, point) in polygon.iter().zip(&points[first_point as usize..]) {
                vertices[vertex] = Vec2::new(point.x, point.z);
            }
            for pair in polygon[1..].windows(2) {
                // x and z are mirrored to x and y: the winding turns.
                triangles.push([polygon[0], pair[1], pair[0]]);
            }
        }
        Trimesh { vertices, triangles }
    }
}

impl Drop for Tiles {
    fn drop(&mut self) {
        // SAFETY: baked above, freed once.
        unsafe { sys::tl_nav_tiles_free(&mut self.0) }
    }
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// rerecast's pipeline with the settings of tl_default_nav_def, as its own test runs it.
fn bake_rerecast(level: &Level) -> Result<(PolygonNavmesh, DetailNavmesh), String> {
    let mut mesh = TriMesh {
        vertices: level.vertices.iter().map(|&v| Vec3A::from(v)).collect(),
        indices: level.triangles.iter().map(|&t| UVec3::from(t)).collect(),
        area_types: vec![AreaType::NOT_WALKABLE; level.triangles.len()],
    };
    let aabb = mesh.compute_aabb().expect("there are vertices");
    let config = ConfigBuilder {
        cell_size_fraction: 2.0,   // cells of 0.3 m
        cell_height_fraction: 3.0, // 0.2 m
        agent_height: 2.0,
        agent_radius: 0.6,
        walkable_climb: 0.9,
        edge_max_len_factor: 20, // 12 m
        contour_flags: BuildContoursFlags::TESSELLATE_SOLID_WALL_EDGES,
        aabb,
        ..ConfigBuilder::default()
    }
    .build();
    mesh.mark_walkable_triangles(config.walkable_slope_angle);
    let mut field = HeightfieldBuilder { aabb, cell_size: config.cell_size, cell_height: config.cell_height }
        .build()
        .map_err(text)?;
    field.rasterize_triangles(&mesh, config.walkable_climb).map_err(text)?;
    field.filter_low_hanging_walkable_obstacles(config.walkable_climb);
    field.filter_ledge_spans(config.walkable_height, config.walkable_climb);
    field.filter_walkable_low_height_spans(config.walkable_height);
    let mut compact = field.into_compact(config.walkable_height, config.walkable_climb).map_err(text)?;
    compact.erode_walkable_area(config.walkable_radius);
    compact.build_distance_field();
    compact.build_regions(0, config.min_region_area, config.merge_region_area).map_err(text)?;
    let contours = compact.build_contours(config.max_simplification_error, config.max_edge_len, config.contour_flags);
    let polygons = contours.into_polygon_mesh(config.max_vertices_per_polygon).map_err(text)?;
    let detail = DetailNavmesh::new(&polygons, &compact, config.detail_sample_dist, config.detail_sample_max_error)
        .map_err(text)?;
    Ok((polygons, detail))
}

/// Square metres in the plane.
fn area_of(mesh: &PolygonNavmesh) -> f64 {
    let doubled: f64 = mesh
        .polygons()
        .map(|polygon| {
            let at: Vec<_> = polygon.map(|i| mesh.vertices[i as usize]).collect();
            let next = at.iter().cycle().skip(1);
            let cross: f64 = at
                .iter()
                .zip(next)
                .map(|(a, b)| f64::from(a.x) * f64::from(b.z) - f64::from(b.x) * f64::from(a.z))
                .sum();
            cross.abs()
        })
        .sum();
    0.5 * doubled * f64::from(mesh.cell_size) * f64::from(mesh.cell_size)
}

fn bakes(runs: usize) -> bool {
    let mut good = true;
    for level in [arena(20, 1), arena(100, 1), terrain(40), terrain(60), terrain(100)] {
        let ours = Tiles::bake(&level).tile().area;
        let theirs = match bake_rerecast(&level) {
            Ok((polygons, _)) => area_of(&polygons),
            Err(error) => {
                refused("bake (area in m2)", &level.name, "rerecast", &error);
                continue;
            }
        };
        let agree = 1.0 - (ours - theirs).abs() / theirs.max(1.0);
        let seconds = race(runs, || keep(Tiles::bake(&level)), || keep(bake_rerecast(&level)));
        good &= row("bake (area in m2)", &level.name, "rerecast", 1, seconds, agree, 0.98);
    }
    good
}

fn paths(runs: usize) -> bool {
    let mut good = true;
    for level in [arena(100, 1), arena(250, 2)] {
        let navmesh = Navmesh::bake(&level.vertices, &level.triangles, &NavmeshSettings::default()).expect("it bakes");
        let mut query = navmesh.query().expect("there is memory");
        let mut mesh: Mesh = Tiles::bake(&level).triangles().try_into().expect("polyanya takes the triangles");
        while mesh.merge_polygons() {}
        mesh.bake();
        let edge = level.vertices[2][0];
        let mut random = Random(9);
        let mut inside = || loop {
            // On the floor, and not on the rim of a polygon's edge, so that both find it.
            let point = [random.between(0.0, edge), 0.2, random.between(0.0, edge)];
            let near = query.nearest_point(point).expect("finite");
            let same = near.is_some_and(|p| p[0] == point[0] && p[2] == point[2] && p[1] < 1.0);
            if same && mesh.point_in_mesh(Vec2::new(point[0], point[2])) {
                return point;
            }
        };
        let pairs: Vec<_> = (0..PATHS).map(|_| (inside(), inside())).collect();
        let mut ours = |(a, b): &([f32; 3], [f32; 3])| query.shortest_path(*a, *b).expect("the search ends");
        let theirs =
            |(a, b): &([f32; 3], [f32; 3])| mesh.path(Vec2::new(a[0], a[2]), Vec2::new(b[0], b[2])).map(|p| p.length);
        let mut same = 0;
        for pair in &pairs {
            same += usize::from(match (ours(pair).map(|path| path.length), theirs(pair)) {
                (Some(a), Some(b)) => (a - f64::from(b)).abs() <= 1e-3 * a.max(1.0),
                (None, None) => true,
                _ => false,
            });
        }
        let seconds = race(
            runs,
            || pairs.iter().for_each(|pair| keep(ours(pair))),
            || pairs.iter().for_each(|pair| keep(theirs(pair))),
        );
        good &= row("shortest path", &level.name, "polyanya", PATHS, seconds, same as f64 / PATHS as f64, 0.99);
    }
    good
}

pub fn run(runs: usize) -> bool {
    bakes(runs) & paths(runs)
}
