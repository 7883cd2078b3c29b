// SPDX-License-Identifier: MIT
use std::ptr::{null, null_mut};

use talus_sys as sys;

use crate::point::{point_of, vec3};
use crate::{Error, Point, Soup};

/// The shape of characters and what they can do. Lengths are metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CharacterSettings {
    /// Of the capsule, > 0.
    pub radius: f32,
    /// From the feet to the top, >= 2 radius.
    pub height: f32,
    /// The highest step that it climbs, and follows down, >= 0.
    pub step_height: f32,
    /// Degrees, 0 to 85: steeper ground is a wall when it walks, and it slides off.
    pub max_slope: f32,
    /// Kept free around the capsule, > 0, at most a quarter of the radius.
    pub gap: f32,
    /// Triangles near a character at one time, >= 16; each takes 340 bytes.
    pub max_triangles: u32,
}

impl Default for CharacterSettings {
    fn default() -> CharacterSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_character_def() };
        CharacterSettings {
            radius: def.radius,
            height: def.height,
            step_height: def.step_height,
            max_slope: def.max_slope,
            gap: def.gap,
            max_triangles: def.max_triangles,
        }
    }
}

/// A character's state: plain data, to be copied, stored and put back. The same state, level and step give the same
/// bits on every machine.
#[repr(C)] // as tl_character
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Character {
    /// Metres, of its feet: the lowest point of the capsule.
    pub position: Point,
    /// Metres a second: the part of the last wish that the contacts at its end allow.
    pub velocity: Point,
    /// Of the face that it stands on, of length 1; zero in the air.
    pub ground_normal: Point,
    /// Where it stands.
    pub ground_point: Point,
    grounded: u32,
    ground_triangle: u32,
    ground_instance: u32,
    ground_rotation: [f32; 4],
    ground_position: Point,
}

const _: () = {
    use std::mem::{align_of, offset_of, size_of};
    assert!(size_of::<Character>() == size_of::<sys::tl_character>());
    assert!(align_of::<Character>() == align_of::<sys::tl_character>());
    assert!(offset_of!(Character, ground_point) == offset_of!(sys::tl_character, ground_point));
    assert!(offset_of!(Character, grounded) == offset_of!(sys::tl_character, grounded));
    assert!(offset_of!(Character, ground_rotation) == offset_of!(sys::tl_character, ground_pose));
};

impl Character {
    /// A character at rest in the air, its feet at `position`; the first move finds its ground.
    pub fn at(position: Point) -> Character {
        Character {
            position,
            velocity: [0.0; 3],
            ground_normal: [0.0; 3],
            ground_point: [0.0; 3],
            grounded: 0,
            ground_triangle: 0,
            ground_instance: 0,
            ground_rotation: [0.0; 4],
            ground_position: [0.0; 3],
        }
    }

    /// Whether it stands on something that can be walked on.
    pub fn is_grounded(&self) -> bool {
        self.grounded != 0
    }

    /// The triangle that it stands on, as an index in the soup.
    pub fn ground_triangle(&self) -> Option<u32> {
        (self.is_grounded() && self.ground_triangle != sys::TL_NO_TRIANGLE).then_some(self.ground_triangle)
    }
}

/// What a character is to do in one step of the game.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CharacterStep {
    /// Metres a second. On the ground x and z alone count, and the ground is followed; with `jump`, and in the air, y
    /// counts too: gravity and jumps are the caller's.
    pub velocity: Point,
    /// How long the step is, >= 0.
    pub seconds: f32,
    /// It leaves the ground, which does not hold it in this step.
    pub jump: bool,
}

/// What a character meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Surface {
    /// Can be walked on.
    Ground,
    /// Faces up, too steep.
    Slope,
    /// Upright.
    Wall,
    /// Faces down.
    Ceiling,
}

/// Something that a character touched or ran into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CharacterHit {
    /// Metres.
    pub point: Point,
    /// Towards the character, of length 1.
    pub normal: Point,
    /// Index of the triangle in the source.
    pub triangle: u32,
    /// The triangle's material, or 0.
    pub material: u16,
    /// What it is to the character.
    pub surface: Surface,
}

/// What a move did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CharacterReport {
    /// It came from the air to the ground.
    pub landed: bool,
    /// The other way: a jump, a ledge, a slope too steep.
    pub left_ground: bool,
    /// A wall or steep slope took a part of the motion.
    pub blocked: bool,
    /// Something above stopped it.
    pub hit_ceiling: bool,
    /// It overlaps the level at its end, and no small motion parts them.
    pub stuck: bool,
    /// Metres climbed over steps.
    pub stepped_up: f32,
    /// Metres that it was pushed out of what it overlapped at its start.
    pub pushed: f32,
    /// How many triangles it met, those beyond [`CharacterReport::hits`] too.
    pub hit_count: u32,
    kept: [CharacterHit; sys::TL_MAX_CHARACTER_HITS],
}

impl CharacterReport {
    /// What it met, each triangle once; of many the first eight.
    pub fn hits(&self) -> &[CharacterHit] {
        &self.kept[..self.kept.len().min(self.hit_count as usize)]
    }
}

/// Moves characters of one shape, upright capsules, over a level's triangles: they slide along walls, follow steps and
/// slopes, and stop at what is too steep. No wall is tunnelled through, however fast the motion or thin the wall.
///
/// It holds scratch memory: one serves any number of characters, and each thread has its own.
///
/// ```
/// use talus::{Character, CharacterMover, CharacterSettings, CharacterStep, Soup};
///
/// let vertices = [[-10.0, 0.0, -10.0], [-10.0, 0.0, 10.0], [10.0, 0.0, 10.0], [10.0, 0.0, -10.0]];
/// let soup = Soup::bake(&vertices, &[[0, 1, 2], [0, 2, 3]])?;
/// let mut mover = CharacterMover::new(&CharacterSettings::default())?;
/// let mut hero = Character::at([0.0, 0.5, 0.0]);
/// for _ in 0..60 {
///     let fall = if hero.is_grounded() { 0.0 } else { hero.velocity[1] - 9.81 / 30.0 };
///     let step = CharacterStep { velocity: [1.5, fall, 0.0], seconds: 1.0 / 30.0, ..Default::default() };
///     mover.advance(&soup, &step, &mut hero)?;
/// }
/// assert!(hero.is_grounded() && (hero.position[0] - 3.0).abs() < 0.01);
/// # Ok::<(), talus::Error>(())
/// ```
pub struct CharacterMover {
    at: *mut sys::tl_character_mover,
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared (`&mut self`).
unsafe impl Send for CharacterMover {}

impl Drop for CharacterMover {
    fn drop(&mut self) {
        // SAFETY: made by tl_character_mover_create, destroyed once.
        unsafe { sys::tl_character_mover_destroy(self.at) }
    }
}

impl CharacterMover {
    /// A mover for characters of this shape; all memory is taken now.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) names a setting; `Memory`.
    pub fn new(settings: &CharacterSettings) -> Result<CharacterMover, Error> {
        let mut at = null_mut();
        // SAFETY: the def is a plain struct; outputs are valid.
        unsafe {
            let mut def = sys::tl_default_character_def();
            def.radius = settings.radius;
            def.height = settings.height;
            def.step_height = settings.step_height;
            def.max_slope = settings.max_slope;
            def.gap = settings.gap;
            def.max_triangles = settings.max_triangles;
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_character_mover_create(&def, &mut at, &mut report), Some(&report))?;
        }
        Ok(CharacterMover { at })
    }

    /// Moves a character for one step: it is pushed out of what it overlaps, then moves, sliding.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind), `NotFinite` and `Range` (a motion of more than 1 km, a position beyond
    /// 2^18 radii) name what is wrong in step or character; `Limit`: more than `max_triangles` are near. The character
    /// is unchanged then.
    pub fn advance(
        &mut self,
        soup: &Soup,
        step: &CharacterStep,
        character: &mut Character,
    ) -> Result<CharacterReport, Error> {
        let raw =
            sys::tl_character_step { velocity: vec3(step.velocity), seconds: step.seconds, leave_ground: step.jump };
        let level = sys::tl_character_level {
            soup: soup.blob.get(),
            soup_filter: null(),
            scene: null(),
            instances: null(),
            scene_filter: null(),
        };
        // SAFETY: mover and soup are whole; Character has the layout of tl_character (asserted above), any bits of which
        // are allowed; the report is valid.
        unsafe {
            let mut report: sys::tl_character_report = std::mem::zeroed();
            let at = (character as *mut Character).cast();
            let result = sys::tl_character_move(self.at, &level, &raw, at, &mut report);
            Error::check(result, Some(&report.base))?;
            Ok(CharacterReport {
                landed: report.landed,
                left_ground: report.left_ground,
                blocked: report.blocked,
                hit_ceiling: report.hit_ceiling,
                stuck: report.stuck,
                stepped_up: report.stepped_up,
                pushed: report.pushed,
                hit_count: report.hit_count,
                kept: report.hits.map(hit),
            })
        }
    }
}

fn hit(raw: sys::tl_character_hit) -> CharacterHit {
    CharacterHit {
        point: point_of(raw.point),
        normal: point_of(raw.normal),
        triangle: raw.triangle,
        material: raw.material,
        surface: match raw.surface {
            sys::TL_CHARACTER_GROUND => Surface::Ground,
            sys::TL_CHARACTER_SLOPE => Surface::Slope,
            sys::TL_CHARACTER_WALL => Surface::Wall,
            _ => Surface::Ceiling,
        },
    }
}
