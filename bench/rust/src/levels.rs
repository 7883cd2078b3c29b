// SPDX-License-Identifier: MIT
//! What is measured on: generated levels and random numbers that are the same everywhere.

/// Vertices in metres, and triangles, counter-clockwise seen from the front.
pub struct Level {
    pub name: String,
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Numbers of SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From `low` to `high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.next() >> 40) as f32 / (1u64 << 24) as f32)
    }

    /// On the unit sphere, evenly.
    pub fn direction(&mut self) -> [f32; 3] {
        loop {
            let v = [self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0)];
            let square: f32 = v.iter().map(|x| x * x).sum();
            if square > 1e-4 && square <= 1.0 {
                return v.map(|x| x / square.sqrt());
            }
        }
    }
}

/// Hills of side * side vertices, a metre apart.
pub fn terrain(side: u32) -> Level {
    let mut vertices = Vec::new();
    for x in 0..side {
        for z in 0..side {
            let (x, z) = (x as f32, z as f32);
            vertices.push([x, 2.0 * (x * 0.31).sin() * (z * 0.23).cos() + 0.5 * (x * 1.7 + z).sin(), z]);
        }
    }
    let mut triangles = Vec::new();
    for x in 0..side - 1 {
        for z in 0..side - 1 {
            let at = x * side + z;
            triangles.push([at, at + 1, at + side + 1]);
            triangles.push([at, at + side + 1, at + side]);
        }
    }
    Level { name: format!("terrain, {} triangles", triangles.len()), vertices, triangles }
}

/// A floor of `size` metres with one box in each place of 5 m, wide or narrow, 3 m high.
pub fn arena(size: u32, seed: u64) -> Level {
    let mut level = Level { name: format!("arena, {size} m"), vertices: Vec::new(), triangles: Vec::new() };
    let edge = size as f32;
    let floor = [[0.0, 0.0, 0.0], [0.0, 0.0, edge], [edge, 0.0, edge], [edge, 0.0, 0.0]];
    level.vertices.extend(floor);
    level.triangles.extend([[0, 1, 2], [0, 2, 3]]);
    let mut random = Random(seed);
    for x in 0..size / 5 {
        for z in 0..size / 5 {
            let middle = [5.0 * x as f32 + 2.5, 5.0 * z as f32 + 2.5];
            let half = [random.between(0.2, 1.9), random.between(0.2, 1.9)];
            add_box(&mut level, middle, half);
        }
    }
    level
}

fn add_box(level: &mut Level, middle: [f32; 2], half: [f32; 2]) {
    let first = level.vertices.len() as u32;
    for corner in 0..8 {
        let side = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let y = if corner >> 1 & 1 == 1 { 3.0 } else { 0.0 };
        level.vertices.push([middle[0] + side(2) * half[0], y, middle[1] + side(0) * half[1]]);
    }
    // As in x * 4 + y * 2 + z: outwards.
    for [a, b, c, d] in [[0, 1, 3, 2], [4, 6, 7, 5], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]] {
        level.triangles.push([first + a, first + b, first + c]);
        level.triangles.push([first + a, first + c, first + d]);
    }
}
