// SPDX-License-Identifier: MIT
//! Crowds and characters through the safe interface: they arrive, stay where they may be, repeat themselves bit by bit,
//! and refuse what is wrong by name.

use talus::{
    Agent, AgentSettings, AgentStatus, Character, CharacterMover, CharacterSettings, CharacterStep, Corridor, Crowd,
    CrowdSettings, ErrorKind, Formation, GroupSettings, Navmesh, NavmeshSettings, Point, Soup, Surface, Way,
};

const DT: f32 = 1.0 / 20.0;

// A floor 20 m square, a wall at x = 0 to 0.5 up to z = 6, and a step 0.3 m high from x = 6 on.
fn level() -> (Vec<Point>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    let mut quad = |corners: [Point; 4]| {
        let first = vertices.len() as u32;
        vertices.extend(corners);
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    quad([[-10.0, 0.0, -10.0], [-10.0, 0.0, 10.0], [10.0, 0.0, 10.0], [10.0, 0.0, -10.0]]);
    quad([[0.0, 0.0, -10.0], [0.0, 0.0, 6.0], [0.0, 3.0, 6.0], [0.0, 3.0, -10.0]]);
    quad([[0.5, 0.0, -10.0], [0.5, 3.0, -10.0], [0.5, 3.0, 6.0], [0.5, 0.0, 6.0]]);
    quad([[0.0, 0.0, 6.0], [0.5, 0.0, 6.0], [0.5, 3.0, 6.0], [0.0, 3.0, 6.0]]);
    quad([[0.0, 3.0, -10.0], [0.0, 3.0, 6.0], [0.5, 3.0, 6.0], [0.5, 3.0, -10.0]]);
    quad([[6.0, 0.3, -10.0], [6.0, 0.3, 10.0], [10.0, 0.3, 10.0], [10.0, 0.3, -10.0]]);
    quad([[6.0, 0.0, -10.0], [6.0, 0.0, 10.0], [6.0, 0.3, 10.0], [6.0, 0.3, -10.0]]);
    (vertices, triangles)
}

fn navmesh() -> Navmesh {
    let (vertices, triangles) = level();
    let settings = NavmeshSettings { agent_radius: 0.4, cell_size: 0.2, cell_height: 0.1, ..Default::default() };
    Navmesh::bake(&vertices, &triangles, &settings).unwrap()
}

// Agents left of the wall, on their way to its other side.
fn filled(navmesh: &Navmesh, settings: &CrowdSettings) -> (Crowd, Vec<Agent>) {
    let mut crowd = Crowd::new(navmesh, settings).unwrap();
    let mut agents = Vec::new();
    for i in 0..40 {
        let (row, place) = (i / 8, i % 8);
        let at = [-8.0 + row as f32, 0.0, -8.0 + 1.5 * place as f32];
        let settings = AgentSettings { max_speed: 1.5 + 0.03 * i as f32, ..Default::default() };
        let agent = crowd.add(at, &settings).unwrap().unwrap();
        assert!(crowd.set_goal(agent, [2.0 + row as f32, 0.0, -8.0 + 2.0 * place as f32]).unwrap().is_some());
        agents.push(agent);
    }
    (crowd, agents)
}

#[test]
fn a_crowd_arrives_and_stays_on_the_mesh() {
    let navmesh = navmesh();
    let (mut crowd, agents) = filled(&navmesh, &CrowdSettings::default());
    let query = navmesh.query().unwrap();
    assert_eq!((crowd.len(), crowd.is_empty()), (40, false));
    assert!(crowd.agents().eq(agents.iter().copied()));
    let mut steps = 0;
    while crowd.step(DT).unwrap().arrived < 40 {
        steps += 1;
        assert!(steps < 2000, "they do not arrive");
        for agent in crowd.agents() {
            let at = crowd.agent(agent).unwrap().position;
            let near = query.nearest_point(at).unwrap().unwrap();
            assert!((near[0] - at[0]).abs() + (near[2] - at[2]).abs() < 1e-3, "{at:?} is off the mesh");
            assert!(!((-0.35..0.85).contains(&at[0]) && at[2] < 6.0), "{at:?} is in the wall");
        }
        if steps == 40 {
            assert!(crowd.corners(agents[0]).unwrap().len() >= 2);
        }
    }
    let state = crowd.agent(agents[0]).unwrap();
    assert_eq!(state.status, AgentStatus::Arrived);
    assert!(state.position[0] > 0.5 && state.goal[0] > 0.5);
}

#[test]
fn groups_follow_their_leader_around_the_wall() {
    let mut crowd = Crowd::new(&navmesh(), &CrowdSettings::default()).unwrap();
    let squad: Vec<Agent> = (0..5)
        .map(|i| crowd.add([-8.0, 0.0, -4.0 + 1.5 * i as f32], &AgentSettings::default()).unwrap().unwrap())
        .collect();
    let group = crowd.add_group(&squad, &GroupSettings { formation: Formation::Wedge, ..Default::default() }).unwrap();
    assert!(squad.iter().all(|&agent| crowd.group_of(agent) == Some(group)));
    assert_eq!(crowd.group(group).unwrap().leader, squad[0]);
    let column = GroupSettings { formation: Formation::Column, spacing: 1.0, ..Default::default() };
    crowd.set_formation(group, &column).unwrap();
    assert_eq!(crowd.set_goal(squad[1], [4.0, 0.0, 0.0]).unwrap_err().kind(), ErrorKind::Argument, "it follows");
    assert!(crowd.set_goal(squad[0], [4.0, 0.0, -4.0]).unwrap().is_some());
    let mut steps = 0;
    while crowd.step(DT).unwrap().arrived < 5 {
        steps += 1;
        assert!(steps < 2000, "they do not arrive");
    }
    let state = crowd.group(group).unwrap();
    assert_eq!((state.count, state.in_place), (5, 5));
    let mut members = crowd.members(group).unwrap();
    assert_eq!(members[0], squad[0], "the leader comes first");
    members.sort();
    assert_eq!(members, squad);
    // Behind the leader, each within reach of a column's length.
    for &agent in &squad[1..] {
        let (at, leader) = (crowd.agent(agent).unwrap().position, crowd.agent(squad[0]).unwrap().position);
        assert!((at[0] - leader[0]).hypot(at[2] - leader[2]) < 4.6, "{at:?} is not in the column of {leader:?}");
    }
    let slots =
        |places: &[[f32; 2]]| GroupSettings { formation: Formation::Slots(places.to_vec()), ..Default::default() };
    let error = crowd.set_formation(group, &slots(&[[-1.0, 0.0]])).unwrap_err();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("slots")));
    crowd.set_formation(group, &slots(&[[-1.0, 0.0], [-1.0, 1.0], [-1.0, -1.0], [-2.0, 0.0]])).unwrap();
    assert_eq!(crowd.add_group(&squad[..2], &column).unwrap_err().kind(), ErrorKind::Argument, "in a group already");
    assert_eq!(crowd.add_group(&[], &column).unwrap_err().kind(), ErrorKind::Argument);
    crowd.remove_group(group).unwrap();
    assert_eq!(crowd.group_of(squad[0]), None);
    assert_eq!(crowd.group(group).unwrap_err().kind(), ErrorKind::Stale);
    let error = crowd.add_group(&squad, &GroupSettings { spacing: f32::NAN, ..Default::default() }).unwrap_err();
    assert_eq!((error.kind(), error.field()), (ErrorKind::NotFinite, Some("spacing")));
}

#[test]
fn a_corridor_is_walked_around_the_wall() {
    let mut query = navmesh().query().unwrap();
    let (from, to) = ([-5.0, 0.0, -5.0], [4.0, 0.0, -5.0]);
    let path = query.shortest_path(from, to).unwrap().unwrap();
    let mut corridor = Corridor::new(&query, from, 64).unwrap().unwrap();
    assert_eq!((corridor.position(), corridor.reaches()), (corridor.target(), true));
    assert_eq!(corridor.find(&mut query, to).unwrap(), Way::Complete);
    let points: Vec<Point> = corridor.corners(&query, 64).unwrap().iter().map(|corner| corner.point).collect();
    assert_eq!(points.len(), path.points.len());
    let away = |a: Point, b: Point| (a[0] - b[0]).hypot(a[2] - b[2]);
    assert!(points.iter().zip(&path.points).all(|(&a, &b)| away(a, b) < 1e-3));
    let mut length = 0.0;
    for step in 0.. {
        assert!(step < 1000, "it does not arrive");
        let Some(next) = corridor.corners(&query, 2).unwrap().get(1).copied() else { break };
        let here = corridor.position();
        let share = (0.2 / away(here, next.point)).min(1.0);
        let now =
            corridor.step(&mut query, std::array::from_fn(|i| here[i] + share * (next.point[i] - here[i]))).unwrap();
        assert_eq!(now, corridor.position());
        length += f64::from(away(here, now));
        if away(now, corridor.target()) < 1e-3 {
            break;
        }
    }
    assert!(length > path.length - 0.01 && length < 1.01 * path.length, "{length} of {}", path.length);

    // The target walks away, the agent is pushed against the wall, and there is nothing to make shorter.
    assert!(away(corridor.step_target(&mut query, [3.0, 0.0, -2.0]).unwrap(), [3.0, 0.0, -2.0]) < 1e-3);
    assert!(corridor.step(&mut query, [-3.0, 0.0, -5.0]).unwrap()[0] > 0.5);
    assert!(!corridor.shorten(&query, 20.0).unwrap());
    corridor.improve(&mut query, 32, 256).unwrap();
    assert_eq!(corridor.repair(&mut query).unwrap(), Some(Way::Complete));
    assert_eq!(corridor.pass_link(&query).unwrap(), None);
    assert_eq!(corridor.find(&mut query, [99.0, 0.0, 0.0]).unwrap(), Way::NoFloor);
    assert_eq!(corridor.step(&mut query, [f32::NAN, 0.0, 0.0]).unwrap_err().kind(), ErrorKind::NotFinite);
    assert!(Corridor::new(&query, [99.0, 0.0, 0.0], 64).unwrap().is_none());
    assert_eq!(Corridor::new(&query, from, 0).err().unwrap().field(), Some("capacity"));

    // Two polygons lead a part of the way.
    let mut short = Corridor::new(&query, from, 2).unwrap().unwrap();
    short.find(&mut query, to).unwrap();
    assert!(!short.reaches() && short.corners(&query, 64).unwrap().len() >= 2);

    // Another navmesh has none of its polygons: it is repaired.
    query.set_navmesh(navmesh());
    let (position, goal) = (corridor.position(), corridor.goal());
    assert!(corridor.repair(&mut query).unwrap().is_some());
    assert!(away(position, corridor.position()) < 1e-3 && away(goal, corridor.target()) < 1e-3);
}

#[test]
fn crowds_repeat_themselves() {
    let navmesh = navmesh();
    let (mut one, agents) = filled(&navmesh, &CrowdSettings::default());
    let (mut three, _) = filled(&navmesh, &CrowdSettings { threads: 3, ..Default::default() });
    for _ in 0..60 {
        assert_eq!(one.step(DT).unwrap(), three.step(DT).unwrap());
    }
    assert_eq!(one.save(), three.save());
    let saved = one.save();
    one.remove(agents[3]).unwrap();
    one.step(DT).unwrap();
    assert_ne!(one.state_hash(), three.state_hash());
    one.restore(&saved).unwrap();
    assert_eq!(one.state_hash(), three.state_hash());
    for length in [0, 1, 63, saved.len() / 2, saved.len() - 1] {
        assert!(one.restore(&saved[..length]).is_err());
    }
    for at in (0..saved.len().min(4096)).step_by(13) {
        let mut altered = saved.clone();
        altered[at] ^= 0x55;
        if one.restore(&altered).is_ok() {
            one.step(DT).unwrap(); // whatever it was: no more than another state
            one.restore(&saved).unwrap();
        }
    }
    assert_eq!(one.save(), three.save());
    // A crowd is at home on any thread, and needs nobody to keep the navmesh.
    drop(navmesh);
    let hash = std::thread::spawn(move || {
        one.step(DT).unwrap();
        one.state_hash()
    });
    three.step(DT).unwrap();
    assert_eq!(hash.join().unwrap(), three.state_hash());
}

#[test]
fn crowds_refuse_what_is_wrong() {
    let navmesh = navmesh();
    let error = Crowd::new(&navmesh, &CrowdSettings { max_neighbors: 99, ..Default::default() }).err().unwrap();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("max_neighbors")));
    let mut crowd = Crowd::new(&navmesh, &CrowdSettings { max_agents: 2, ..Default::default() }).unwrap();
    assert_eq!(crowd.add([500.0, 0.0, 0.0], &AgentSettings::default()).unwrap(), None);
    let error = crowd.add([-5.0, 0.0, 0.0], &AgentSettings { radius: -1.0, ..Default::default() }).unwrap_err();
    assert_eq!((error.kind(), error.field()), (ErrorKind::Argument, Some("radius")));
    let walker = crowd.add([-5.0, 0.0, 0.0], &AgentSettings::default()).unwrap().unwrap();
    let car = crowd.add([-5.0, 0.0, 3.0], &AgentSettings { fixed: true, ..Default::default() }).unwrap().unwrap();
    assert_eq!(crowd.add([-5.0, 0.0, 5.0], &AgentSettings::default()).unwrap_err().kind(), ErrorKind::Limit);
    assert_eq!(crowd.set_goal(walker, [500.0, 0.0, 0.0]).unwrap(), None);
    assert_eq!(crowd.set_goal(walker, [f32::NAN, 0.0, 0.0]).unwrap_err().kind(), ErrorKind::NotFinite);
    assert_eq!(crowd.set_goal(car, [-5.0, 0.0, 0.0]).unwrap_err().kind(), ErrorKind::Argument);
    assert_eq!(crowd.set_motion(walker, [0.0; 3], [0.0; 3]).unwrap_err().kind(), ErrorKind::Argument);
    crowd.set_motion(car, [-5.0, 0.0, 2.0], [0.0, 0.0, -1.0]).unwrap();
    crowd.set_goal(walker, [-5.0, 0.0, 8.0]).unwrap().unwrap();
    crowd.step(DT).unwrap();
    assert_eq!(crowd.agent(walker).unwrap().status, AgentStatus::Walking);
    assert_eq!(crowd.agent(car).unwrap().position, [-5.0, 0.0, 2.0]);
    crowd.stop(walker).unwrap();
    crowd.step(DT).unwrap();
    assert_eq!(crowd.agent(walker).unwrap().status, AgentStatus::Idle);
    for dt in [0.0, -1.0, 2.0, f32::NAN] {
        assert!(crowd.step(dt).is_err());
    }
    crowd.remove(walker).unwrap();
    assert_eq!(crowd.remove(walker).unwrap_err().kind(), ErrorKind::Stale);
    assert_eq!(crowd.agent(walker).unwrap_err().kind(), ErrorKind::Stale);
    assert_eq!(crowd.corners(walker).unwrap_err().kind(), ErrorKind::Stale);
}

fn walk(mover: &mut CharacterMover, soup: &Soup, hero: &mut Character, velocity: Point, steps: u32) -> Vec<Surface> {
    let mut met = Vec::new();
    for _ in 0..steps {
        let fall = if hero.is_grounded() { 0.0 } else { hero.velocity[1] - 9.81 / 30.0 };
        let step = CharacterStep { velocity: [velocity[0], fall, velocity[2]], seconds: 1.0 / 30.0, jump: false };
        let report = mover.advance(soup, &step, hero).unwrap();
        assert!(!report.stuck && report.hits().len() == report.hit_count.min(8) as usize);
        met.extend(report.hits().iter().map(|hit| hit.surface));
    }
    met
}

#[test]
fn characters_walk_slide_and_climb() {
    let (vertices, triangles) = level();
    let soup = Soup::bake(&vertices, &triangles).unwrap();
    let mut mover = CharacterMover::new(&CharacterSettings::default()).unwrap();
    let mut hero = Character::at([-4.0, 1.0, 0.0]);
    assert!(!hero.is_grounded() && hero.ground_triangle().is_none());
    assert!(walk(&mut mover, &soup, &mut hero, [0.0; 3], 30).contains(&Surface::Ground), "it falls on the floor");
    assert!(hero.is_grounded() && hero.ground_triangle().unwrap() < 2 && hero.position[1].abs() < 0.01);
    let met = walk(&mut mover, &soup, &mut hero, [3.0, 0.0, 1.0], 60);
    assert!(met.contains(&Surface::Wall), "{met:?}");
    assert!((hero.position[0] + 0.3).abs() < 0.01 && (hero.position[2] - 2.0).abs() < 0.05, "it slid along the wall");
    let mut hero = Character::at([4.0, 0.01, 0.0]);
    walk(&mut mover, &soup, &mut hero, [3.0, 0.0, 0.0], 40);
    assert!(hero.is_grounded() && (hero.position[1] - 0.3).abs() < 0.01 && hero.position[0] > 7.0, "up the step");
    let jump = CharacterStep { velocity: [0.0, 3.0, 0.0], seconds: 1.0 / 30.0, jump: true };
    let report = mover.advance(&soup, &jump, &mut hero).unwrap();
    assert!(report.left_ground && !hero.is_grounded() && hero.velocity[1] > 0.0);
    // The same state and steps give the same bits, with another mover too.
    let (mut a, mut b) = (Character::at([-4.0, 0.01, 3.0]), Character::at([-4.0, 0.01, 3.0]));
    walk(&mut mover, &soup, &mut a, [2.0, 0.0, 0.7], 50);
    let mut other = CharacterMover::new(&CharacterSettings::default()).unwrap();
    walk(&mut other, &soup, &mut b, [2.0, 0.0, 0.7], 50);
    assert_eq!(a, b);
}

#[test]
fn characters_refuse_what_is_wrong() {
    let (vertices, triangles) = level();
    let soup = Soup::bake(&vertices, &triangles).unwrap();
    let settings = CharacterSettings { height: 0.1, ..Default::default() };
    assert_eq!(CharacterMover::new(&settings).err().unwrap().field(), Some("height"));
    let mut mover = CharacterMover::new(&CharacterSettings::default()).unwrap();
    let place = [-4.0, 0.01, 0.0];
    let step = CharacterStep { velocity: [1.0, 0.0, 0.0], seconds: 0.1, jump: false };
    for (step, place, kind, field) in [
        (CharacterStep { seconds: -1.0, ..step }, place, ErrorKind::Argument, "seconds"),
        (CharacterStep { velocity: [f32::NAN; 3], ..step }, place, ErrorKind::NotFinite, "velocity"),
        (CharacterStep { velocity: [1e6, 0.0, 0.0], ..step }, place, ErrorKind::Range, "velocity"),
        (step, [f32::INFINITY, 0.0, 0.0], ErrorKind::NotFinite, "position"),
        (step, [1e6, 0.0, 0.0], ErrorKind::Range, "position"),
    ] {
        let before = Character::at(place);
        let mut after = before;
        let error = mover.advance(&soup, &step, &mut after).unwrap_err();
        assert_eq!((error.kind(), error.field()), (kind, Some(field)));
        assert_eq!(after, before);
    }
}
