// SPDX-License-Identifier: MIT
use std::ptr::null;

use talus_sys as sys;

use crate::point::point_of;
use crate::{Agent, Crowd, Error, Point};

/// How the others stand about their leader.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Formation {
    /// Wherever they are, but near to it.
    #[default]
    Loose,
    /// Abreast, the leader in the middle.
    Line,
    /// One behind the other, on the leader's trail.
    Column,
    /// The leader in front, behind it two rows at 45 degrees.
    Wedge,
    /// On a circle, the leader in its middle.
    Ring,
    /// A place for each agent but the leader: metres from it, forward and left.
    Slots(Vec<[f32; 2]>),
}

/// How a group walks.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupSettings {
    /// How they stand about the leader.
    pub formation: Formation,
    /// Metres between neighbours, also in a column: above 0, at most 1000.
    pub spacing: f32,
    /// Metres, > 0: the leader stands while somebody is so far from its slot, and slows down from a quarter of it on.
    pub wait_distance: f32,
    /// Metres, > 0: who is farther from its slot is not waited for, nor who is held up for ten seconds.
    pub lost_distance: f32,
    /// Agent k of the list takes slot k. `false`: slots are dealt so that the ways there are short and do not cross.
    pub keep_order: bool,
}

impl Default for GroupSettings {
    fn default() -> GroupSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_nav_group_def() };
        GroupSettings {
            formation: Formation::Loose,
            spacing: def.spacing,
            wait_distance: def.wait_distance,
            lost_distance: def.lost_distance,
            keep_order: def.keep_order,
        }
    }
}

impl GroupSettings {
    // Calls `use_def` with the library's form of them, which lasts as long as the call.
    fn with_def<T>(&self, use_def: impl FnOnce(&sys::tl_nav_group_def) -> T) -> T {
        let mut slots = Vec::new();
        let formation = match &self.formation {
            Formation::Loose => sys::TL_NAV_FORMATION_LOOSE,
            Formation::Line => sys::TL_NAV_FORMATION_LINE,
            Formation::Column => sys::TL_NAV_FORMATION_COLUMN,
            Formation::Wedge => sys::TL_NAV_FORMATION_WEDGE,
            Formation::Ring => sys::TL_NAV_FORMATION_RING,
            Formation::Slots(places) => {
                slots.extend(places.iter().map(|&[forward, left]| sys::tl_nav_formation_slot { forward, left }));
                sys::TL_NAV_FORMATION_SLOTS
            }
        };
        // SAFETY: gives a plain struct.
        let mut def = unsafe { sys::tl_default_nav_group_def() };
        def.formation = formation;
        def.spacing = self.spacing;
        def.wait_distance = self.wait_distance;
        def.lost_distance = self.lost_distance;
        def.slots = if slots.is_empty() { null() } else { slots.as_ptr() };
        def.keep_order = self.keep_order;
        use_def(&def)
    }

    // C reads a slot for each follower: a list of another length must not get there.
    fn check_slots(&self, followers: usize) -> Result<(), Error> {
        match &self.formation {
            Formation::Slots(places) if places.len() != followers => Err(Error::argument("slots")),
            _ => Ok(()),
        }
    }
}

/// A group's name. It is not used again before 2^32 other groups had its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Group(sys::tl_nav_group);

/// A group as it is after the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupState {
    /// Its leader.
    pub leader: Agent,
    /// Agents, the leader included.
    pub count: u32,
    /// Those no farther than half the spacing from their slots; the leader is.
    pub in_place: u32,
    /// Those whose slots are on the leader's trail, as in a doorway.
    pub on_trail: u32,
    /// Metres: of those who are waited for, the largest distance to a slot.
    pub lag: f32,
    /// Metres a second: what the leader may walk.
    pub speed: f32,
    /// Unit, in the plane: where the formation faces.
    pub heading: Point,
}

/// Groups: agents that follow a leader, which walks a path of its own or is fixed: a player.
///
/// ```
/// use talus::{AgentSettings, Crowd, CrowdSettings, Formation, GroupSettings, Navmesh, NavmeshSettings};
///
/// let vertices = [[-20.0, 0.0, -20.0], [-20.0, 0.0, 20.0], [20.0, 0.0, 20.0], [20.0, 0.0, -20.0]];
/// let navmesh = Navmesh::bake(&vertices, &[[0, 1, 2], [0, 2, 3]], &NavmeshSettings::default())?;
/// let mut crowd = Crowd::new(&navmesh, &CrowdSettings::default())?;
/// let mut squad = Vec::new();
/// for i in 0..5 {
///     squad.push(crowd.add([-15.0, 0.0, 1.5 * i as f32], &AgentSettings::default())?.expect("there is floor"));
/// }
/// let wedge = GroupSettings { formation: Formation::Wedge, ..Default::default() };
/// let group = crowd.add_group(&squad, &wedge)?;
/// crowd.set_goal(squad[0], [15.0, 0.0, 0.0])?; // the others follow
/// while crowd.step(1.0 / 20.0)?.arrived < 5 {}
/// assert_eq!(crowd.group(group)?.in_place, 5);
/// # Ok::<(), talus::Error>(())
/// ```
impl Crowd {
    /// Makes a group of agents, of which the first leads; the others lose their goals.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`](crate::ErrorKind): `max_groups` or `max_members`; `Stale`: an agent that is none;
    /// `Argument`, `NotFinite`: the setting's name, or "agents": one that is in a group already, or is fixed and does
    /// not lead.
    pub fn add_group(&mut self, agents: &[Agent], settings: &GroupSettings) -> Result<Group, Error> {
        let names: Vec<sys::tl_nav_agent> = agents.iter().map(|agent| agent.0).collect();
        let count = u32::try_from(names.len()).map_err(|_| Error::too_many("agents"))?;
        settings.check_slots(names.len().saturating_sub(1))?;
        settings.with_def(|def| {
            let mut group = 0;
            // SAFETY: the crowd is whole; as many names and slots are there as the counts say; outputs are valid.
            unsafe {
                let mut report = std::mem::zeroed();
                let result =
                    sys::tl_nav_crowd_add_group(self.raw(), def, names.as_ptr(), count, &mut group, &mut report);
                Error::check(result, Some(&report))?;
            }
            Ok(Group(group))
        })
    }

    /// Changes how a group walks; its agents and their leader remain.
    ///
    /// # Errors
    /// As those of [`Crowd::add_group`]; then nothing is changed.
    pub fn set_formation(&mut self, group: Group, settings: &GroupSettings) -> Result<(), Error> {
        settings.check_slots(self.group(group)?.count as usize - 1)?;
        settings.with_def(|def| {
            // SAFETY: the crowd is whole; there are as many slots as followers; the output is valid.
            unsafe {
                let mut report = std::mem::zeroed();
                let result = sys::tl_nav_crowd_set_formation(self.raw(), group.0, def, &mut report);
                Error::check(result, Some(&report))
            }
        })
    }

    /// Lets the agents of a group go: the leader keeps its goal, the others stop.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind): it is not in the crowd; so for all functions that take a group.
    pub fn remove_group(&mut self, group: Group) -> Result<(), Error> {
        // SAFETY: the crowd is whole.
        Error::check(unsafe { sys::tl_nav_crowd_remove_group(self.raw(), group.0) }, None)
    }

    /// A group as it is after the last step.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind).
    pub fn group(&self, group: Group) -> Result<GroupState, Error> {
        // SAFETY: the crowd is whole, the output valid.
        unsafe {
            let mut state: sys::tl_nav_group_state = std::mem::zeroed();
            Error::check(sys::tl_nav_crowd_group(self.raw(), group.0, &mut state), None)?;
            Ok(GroupState {
                leader: Agent(state.leader),
                count: state.count,
                in_place: state.in_place,
                on_trail: state.on_trail,
                lag: state.lag,
                speed: state.speed,
                heading: point_of(state.heading),
            })
        }
    }

    /// The agents of a group by their slots, the leader first.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind).
    pub fn members(&self, group: Group) -> Result<Vec<Agent>, Error> {
        let mut names: Vec<sys::tl_nav_agent> = vec![0; self.group(group)?.count as usize];
        let mut count = 0;
        // SAFETY: the crowd is whole; the buffer has as many entries as it says.
        let result = unsafe {
            let (at, room) = (names.as_mut_ptr(), names.len() as u32);
            sys::tl_nav_crowd_members(self.raw(), group.0, at, room, &mut count)
        };
        Error::check(result, None)?;
        Ok(names.into_iter().map(Agent).collect())
    }

    /// The group that an agent is in; `None` also for an agent that is not in the crowd.
    pub fn group_of(&self, agent: Agent) -> Option<Group> {
        // SAFETY: the crowd is whole.
        let group = unsafe { sys::tl_nav_crowd_group_of(self.raw(), agent.0) };
        (group != 0).then_some(Group(group)) // TL_NAV_NO_GROUP
    }
}
