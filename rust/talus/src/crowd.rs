// SPDX-License-Identifier: MIT
use std::ptr::{null, null_mut};

use talus_sys as sys;

use crate::point::{point_of, vec3};
use crate::tasks::Tasks;
use crate::{Error, Navmesh, Point};

/// How large a crowd is, and how far it looks ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrowdSettings {
    /// 1 to 2^20; their memory is taken at once.
    pub max_agents: u32,
    /// Polygons of its path that an agent keeps, 4 to 1024; it asks for more in time.
    pub max_path: u32,
    /// Agents that an agent avoids, the nearest ones, 1 to 32.
    pub max_neighbors: u32,
    /// Searches of one step, 1 or more; the others wait.
    pub paths_per_step: u32,
    /// Nodes of one search, 1 MB for 4096, for each thread. Agents that would need more give up.
    pub max_nodes: u32,
    /// Metres, > 0: agents whose rims are farther apart do not see one another.
    pub neighbor_distance: f32,
    /// Seconds, > 0: collisions with agents are avoided so far ahead.
    pub agent_horizon: f32,
    /// Seconds, > 0: walls are approached so that they are not reached sooner.
    pub wall_horizon: f32,
    /// Goals whose paths are found by one search for all that walk there, 0 to 8. 0: each agent searches its own path.
    pub max_shared_goals: u32,
    /// Groups at a time, 0 to 2^20.
    pub max_groups: u32,
    /// Agents of all groups together, 0 to 2^20.
    pub max_members: u32,
    /// Threads of a step; 0 and 1 are the caller's alone, enough for some hundreds of agents. Answers do not depend on
    /// it.
    pub threads: u32,
}

impl Default for CrowdSettings {
    fn default() -> CrowdSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_nav_crowd_def() };
        CrowdSettings {
            max_agents: def.max_agents,
            max_path: def.max_path,
            max_neighbors: def.max_neighbors,
            paths_per_step: def.paths_per_step,
            max_nodes: def.max_nodes,
            neighbor_distance: def.neighbor_distance,
            agent_horizon: def.agent_horizon,
            wall_horizon: def.wall_horizon,
            max_shared_goals: def.max_shared_goals,
            max_groups: def.max_groups,
            max_members: def.max_members,
            threads: 1,
        }
    }
}

/// What an agent is: an upright cylinder that stands on the navmesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgentSettings {
    /// Metres, > 0, at most 1000. One above the navmesh's own keeps the difference from walls.
    pub radius: f32,
    /// Metres, > 0, at most 1000: agents whose heights do not overlap ignore one another.
    pub height: f32,
    /// Metres a second, 0 to 1000.
    pub max_speed: f32,
    /// Metres a second squared, > 0; to avoid others an agent may exceed it.
    pub max_acceleration: f32,
    /// Metres in the plane, >= 0: so near to its goal an agent has arrived.
    pub arrive_distance: f32,
    /// 0 to 1: of two agents the one with more evades less.
    pub priority: f32,
    /// Metres, >= 0: half the edge of the box in which the floor is sought when it is added.
    pub reach: f32,
    /// Its motion is the caller's ([`Crowd::set_motion`]): a player, a vehicle. The others evade it, it evades nobody,
    /// and it need not stand on the navmesh.
    pub fixed: bool,
}

impl Default for AgentSettings {
    fn default() -> AgentSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_nav_agent_def() };
        AgentSettings {
            radius: def.radius,
            height: def.height,
            max_speed: def.max_speed,
            max_acceleration: def.max_acceleration,
            arrive_distance: def.arrive_distance,
            priority: def.priority,
            reach: def.reach,
            fixed: def.is_fixed,
        }
    }
}

/// An agent's name. It is not used again before 2^32 other agents had its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Agent(pub(crate) sys::tl_nav_agent);

/// What an agent is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum AgentStatus {
    /// It has no goal, and makes way for others.
    Idle,
    /// For its path to be searched.
    Waiting,
    /// To its goal.
    Walking,
    /// As near as its `arrive_distance`, or as those that stand there already let it come.
    Arrived,
    /// No path leads to the goal: it stands as near as a path leads.
    Unreachable,
    /// At an off-mesh link that another one takes just now.
    Queued,
    /// On its way along an off-mesh link.
    OnLink,
    /// The navmesh under it was removed.
    OffMesh,
    /// `max_nodes` are too few to find the rest of its path: it stands where the path ends.
    GaveUp,
    /// Its motion is the caller's.
    Fixed,
}

impl AgentStatus {
    fn of(status: sys::tl_nav_agent_status) -> AgentStatus {
        match status {
            sys::TL_NAV_AGENT_WAITING => AgentStatus::Waiting,
            sys::TL_NAV_AGENT_WALKING => AgentStatus::Walking,
            sys::TL_NAV_AGENT_ARRIVED => AgentStatus::Arrived,
            sys::TL_NAV_AGENT_UNREACHABLE => AgentStatus::Unreachable,
            sys::TL_NAV_AGENT_QUEUED => AgentStatus::Queued,
            sys::TL_NAV_AGENT_ON_LINK => AgentStatus::OnLink,
            sys::TL_NAV_AGENT_OFF_MESH => AgentStatus::OffMesh,
            sys::TL_NAV_AGENT_GAVE_UP => AgentStatus::GaveUp,
            sys::TL_NAV_AGENT_FIXED => AgentStatus::Fixed,
            _ => AgentStatus::Idle,
        }
    }
}

/// An agent as it is after the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgentState {
    /// What it does.
    pub status: AgentStatus,
    /// Metres, on the surface.
    pub position: Point,
    /// Metres a second, as it moved in the last step.
    pub velocity: Point,
    /// Metres a second: what it would do if it were alone.
    pub wanted: Point,
    /// Metres; its position where it has no goal.
    pub goal: Point,
    /// Metres.
    pub radius: f32,
    /// Metres.
    pub height: f32,
}

/// What a step did: agents by their status after it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CrowdReport {
    /// Paths that were searched, and trees of paths to shared goals.
    pub searched: u32,
    /// Paths that were taken from the search of a shared goal.
    pub shared: u32,
    /// Paths that are still to be searched.
    pub waiting: u32,
    /// Agents under way.
    pub walking: u32,
    /// Agents at their goals.
    pub arrived: u32,
    /// Agents to whose goals no path leads.
    pub unreachable: u32,
    /// Agents on off-mesh links, those that queue not counted.
    pub on_link: u32,
    /// Agents under whom there is no navmesh.
    pub off_mesh: u32,
}

/// Agents that walk a navmesh to their goals, avoid one another and its walls, and never leave it.
///
/// The same calls give the same bytes ([`Crowd::save`]) on every machine and for any number of threads.
///
/// ```
/// use talus::{AgentSettings, AgentStatus, Crowd, CrowdSettings, Navmesh, NavmeshSettings};
///
/// let vertices = [[-10.0, 0.0, -10.0], [-10.0, 0.0, 10.0], [10.0, 0.0, 10.0], [10.0, 0.0, -10.0]];
/// let navmesh = Navmesh::bake(&vertices, &[[0, 1, 2], [0, 2, 3]], &NavmeshSettings::default())?;
/// let mut crowd = Crowd::new(&navmesh, &CrowdSettings::default())?;
/// let walker = crowd.add([-8.0, 0.0, 0.0], &AgentSettings::default())?.expect("there is floor");
/// let other = crowd.add([8.0, 0.0, 0.0], &AgentSettings { radius: 0.5, ..AgentSettings::default() })?.unwrap();
/// crowd.set_goal(walker, [8.0, 0.0, 0.0])?;
/// crowd.set_goal(other, [-8.0, 0.0, 0.0])?;
/// while crowd.step(1.0 / 20.0)?.arrived < 2 {}
/// assert_eq!(crowd.agent(walker)?.status, AgentStatus::Arrived);
/// # Ok::<(), talus::Error>(())
/// ```
pub struct Crowd {
    at: *mut sys::tl_nav_crowd,
    navmesh: Navmesh,
    _tasks: Tasks,
    /// Half extents of the box in which goals look for a polygon, metres.
    pub search_extents: Point,
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared, since the pointer is not Sync.
unsafe impl Send for Crowd {}

impl Drop for Crowd {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_crowd_create, destroyed once, before the tasks it knows.
        unsafe { sys::tl_nav_crowd_destroy(self.at) }
    }
}

impl Crowd {
    /// An empty crowd on a navmesh, of which it keeps a handle; all memory that steps use is taken now.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) names a setting; `Memory`.
    pub fn new(navmesh: &Navmesh, settings: &CrowdSettings) -> Result<Crowd, Error> {
        let tasks = Tasks::new(settings.threads);
        let mut at = null_mut();
        // SAFETY: the def is a plain struct; its tasks outlive the crowd; outputs are valid.
        unsafe {
            let mut def = sys::tl_default_nav_crowd_def();
            def.max_agents = settings.max_agents;
            def.max_path = settings.max_path;
            def.max_neighbors = settings.max_neighbors;
            def.paths_per_step = settings.paths_per_step;
            def.max_nodes = settings.max_nodes;
            def.neighbor_distance = settings.neighbor_distance;
            def.agent_horizon = settings.agent_horizon;
            def.wall_horizon = settings.wall_horizon;
            def.max_shared_goals = settings.max_shared_goals;
            def.max_groups = settings.max_groups;
            def.max_members = settings.max_members;
            def.host.tasks = if settings.threads > 1 { tasks.raw() } else { null() };
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_nav_crowd_create(&def, &mut at, &mut report), Some(&report))?;
        }
        Ok(Crowd { at, navmesh: navmesh.clone(), _tasks: tasks, search_extents: [2.0, 4.0, 2.0] })
    }

    pub(crate) fn raw(&self) -> *mut sys::tl_nav_crowd {
        self.at
    }

    /// The navmesh that they walk.
    pub fn navmesh(&self) -> &Navmesh {
        &self.navmesh
    }

    /// Goes on to a newer version of the navmesh ([`NavVersions`](crate::NavVersions)); agents notice what has changed.
    pub fn set_navmesh(&mut self, navmesh: Navmesh) {
        self.navmesh = navmesh;
    }

    /// Adds an agent without a goal, on the navmesh's point nearest to `position`; `None`: no floor is within its reach.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` name a setting; `Limit`: there are `max_agents`.
    pub fn add(&mut self, position: Point, settings: &AgentSettings) -> Result<Option<Agent>, Error> {
        let mut agent = 0;
        // SAFETY: crowd and navmesh are whole, the def is a plain struct, outputs are valid.
        unsafe {
            let mut def = sys::tl_default_nav_agent_def();
            def.position = vec3(position);
            def.radius = settings.radius;
            def.height = settings.height;
            def.max_speed = settings.max_speed;
            def.max_acceleration = settings.max_acceleration;
            def.arrive_distance = settings.arrive_distance;
            def.priority = settings.priority;
            def.reach = settings.reach;
            def.is_fixed = settings.fixed;
            let mut report = std::mem::zeroed();
            match sys::tl_nav_crowd_add(self.at, self.navmesh.raw(), &def, &mut agent, &mut report) {
                sys::TL_NOT_FOUND => Ok(None),
                result => Error::check(result, Some(&report)).map(|()| Some(Agent(agent))),
            }
        }
    }

    /// Removes an agent.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind): it is not in the crowd; so for all functions that take one.
    pub fn remove(&mut self, agent: Agent) -> Result<(), Error> {
        // SAFETY: the crowd is whole.
        Error::check(unsafe { sys::tl_nav_crowd_remove(self.at, agent.0) }, None)
    }

    /// Sends an agent to the floor's point nearest to `goal`, which is returned; `None`: there is none within
    /// `search_extents`, and the agent keeps the goal that it had.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind); `NotFinite`; `Argument`: the agent is fixed.
    pub fn set_goal(&mut self, agent: Agent, goal: Point) -> Result<Option<Point>, Error> {
        let Some(location) = self.navmesh.locate(goal, self.search_extents)? else {
            return Ok(None);
        };
        // SAFETY: the crowd is whole.
        Error::check(unsafe { sys::tl_nav_crowd_set_goal(self.at, agent.0, &location) }, None)?;
        Ok(Some(point_of(location.point)))
    }

    /// Lets an agent stop where it is, without a goal.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind); `Argument`: the agent is fixed.
    pub fn stop(&mut self, agent: Agent) -> Result<(), Error> {
        // SAFETY: the crowd is whole; NULL is no goal.
        Error::check(unsafe { sys::tl_nav_crowd_set_goal(self.at, agent.0, null()) }, None)
    }

    /// Where a fixed agent is now, metres, and how fast it moves, metres a second: before each step in which it moves.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind); `Argument`: it is not fixed; `NotFinite`; `Range`: above 1e9.
    pub fn set_motion(&mut self, agent: Agent, position: Point, velocity: Point) -> Result<(), Error> {
        // SAFETY: the crowd is whole.
        Error::check(unsafe { sys::tl_nav_crowd_set_motion(self.at, agent.0, vec3(position), vec3(velocity)) }, None)
    }

    /// Moves all agents by `dt` seconds, above 0 and at most 1.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` for such a `dt`; then nothing is changed.
    pub fn step(&mut self, dt: f32) -> Result<CrowdReport, Error> {
        // SAFETY: crowd and navmesh are whole, the output is valid.
        unsafe {
            let mut report: sys::tl_nav_crowd_step_report = std::mem::zeroed();
            Error::check(sys::tl_nav_crowd_step(self.at, self.navmesh.raw(), dt, &mut report), None)?;
            Ok(CrowdReport {
                searched: report.searched,
                shared: report.shared,
                waiting: report.waiting,
                walking: report.walking,
                arrived: report.arrived,
                unreachable: report.unreachable,
                on_link: report.on_link,
                off_mesh: report.off_mesh,
            })
        }
    }

    /// An agent as it is after the last step.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind).
    pub fn agent(&self, agent: Agent) -> Result<AgentState, Error> {
        // SAFETY: the crowd is whole, the output valid.
        unsafe {
            let mut state: sys::tl_nav_agent_state = std::mem::zeroed();
            Error::check(sys::tl_nav_crowd_agent(self.at, agent.0, &mut state), None)?;
            Ok(AgentState {
                status: AgentStatus::of(state.status),
                position: point_of(state.position),
                velocity: point_of(state.velocity),
                wanted: point_of(state.wanted),
                goal: point_of(state.goal),
                radius: state.radius,
                height: state.height,
            })
        }
    }

    /// The corners of an agent's path from its position on, as far as it keeps it; none: it has no path.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind).
    pub fn corners(&self, agent: Agent) -> Result<Vec<Point>, Error> {
        let mut corners: Vec<sys::tl_nav_corner> = Vec::with_capacity(32);
        loop {
            let mut count = 0;
            // SAFETY: the buffer has room for its capacity; so many of its entries are filled as the count says.
            let result = unsafe {
                let (at, room) = (corners.as_mut_ptr(), corners.capacity() as u32);
                sys::tl_nav_crowd_corners(self.at, self.navmesh.raw(), agent.0, at, room, &mut count)
            };
            match result {
                sys::TL_NOT_FOUND => return Ok(Vec::new()),
                sys::TL_INCOMPLETE => corners.reserve(count as usize),
                result => {
                    Error::check(result, None)?;
                    // SAFETY: TL_OK: all of them were written.
                    unsafe { corners.set_len(count as usize) };
                    return Ok(corners.iter().map(|corner| point_of(corner.point)).collect());
                }
            }
        }
    }

    /// All agents, fixed ones too, in an order that adding and removing others does not change.
    pub fn agents(&self) -> impl Iterator<Item = Agent> + '_ {
        let mut cursor = 0;
        std::iter::from_fn(move || {
            let mut agent = 0;
            // SAFETY: the crowd is whole, and does not change while it is borrowed; outputs are valid.
            unsafe { sys::tl_nav_crowd_next(self.at, &mut cursor, &mut agent) }.then_some(Agent(agent))
        })
    }

    /// Agents in the crowd, fixed ones included.
    pub fn len(&self) -> usize {
        // SAFETY: the crowd is whole.
        unsafe { sys::tl_nav_crowd_count(self.at) as usize }
    }

    /// Whether there is no agent.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The state as bytes: the same for the same state on every machine.
    pub fn save(&self) -> Vec<u8> {
        // SAFETY: the crowd is whole; the vector has as many bytes as it says.
        unsafe {
            let mut bytes = vec![0; sys::tl_nav_crowd_state_size(self.at)];
            let result = sys::tl_nav_crowd_save(self.at, bytes.as_mut_ptr().cast(), bytes.len());
            assert_eq!(result, sys::TL_OK, "the vector is large enough");
            bytes
        }
    }

    /// Goes back to a state that was saved, by this crowd or one with the same `max_agents` and `max_path`.
    ///
    /// # Errors
    /// [`ErrorKind::Format`](crate::ErrorKind), `Argument` and `NotFinite` for bytes that are no such state, whatever
    /// they are; then the crowd is as it was.
    pub fn restore(&mut self, state: &[u8]) -> Result<(), Error> {
        let mut aligned = vec![0u64; state.len().div_ceil(8)];
        // SAFETY: the copy has room for the slice, and lies at a multiple of 8 bytes; restoring is safe on any bytes.
        unsafe {
            std::ptr::copy_nonoverlapping(state.as_ptr(), aligned.as_mut_ptr().cast(), state.len());
            let mut report = std::mem::zeroed();
            let result = sys::tl_nav_crowd_restore(self.at, aligned.as_ptr().cast(), state.len(), &mut report);
            Error::check(result, Some(&report))
        }
    }

    /// A hash of what [`Crowd::save`] gives, to be compared between machines.
    pub fn state_hash(&self) -> u64 {
        // SAFETY: the crowd is whole.
        unsafe { sys::tl_nav_crowd_hash(self.at) }
    }
}
