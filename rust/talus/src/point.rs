// SPDX-License-Identifier: MIT
use talus_sys as sys;

use crate::Point;

pub(crate) fn vec3(p: Point) -> sys::tl_vec3 {
    sys::tl_vec3 { x: p[0], y: p[1], z: p[2] }
}

pub(crate) fn point_of(v: sys::tl_vec3) -> Point {
    [v.x, v.y, v.z]
}
