// SPDX-License-Identifier: MIT

using System;
using Talus.Interop;

namespace Talus
{
    /// <summary>How large a crowd is, and how far it looks ahead. A new one has the library's defaults.</summary>
    public sealed unsafe class CrowdSettings
    {
        /// <summary>1 to 2^20; their memory is taken at once.</summary>
        public int MaxAgents;
        /// <summary>That an agent avoids, the nearest ones, 1 to 32.</summary>
        public int MaxNeighbors;
        /// <summary>Searches of one step, from 1 up; the others wait.</summary>
        public int PathsPerStep;
        /// <summary>Of one search: 1 MB for 4096. An agent whose search needs more gives up.</summary>
        public int MaxNodes;
        /// <summary>Metres, above 0: agents whose rims are farther apart ignore one another.</summary>
        public float NeighborDistance;
        /// <summary>Seconds, above 0: so far ahead collisions with agents are avoided.</summary>
        public float AgentHorizon;
        /// <summary>Seconds, above 0: walls are approached so that they are not reached sooner.</summary>
        public float WallHorizon;
        /// <summary>At a time, 0 to 2^20.</summary>
        public int MaxGroups;
        /// <summary>Agents of all groups together, 0 to 2^20.</summary>
        public int MaxMembers;

        public CrowdSettings()
        {
            tl_nav_crowd_def def = Api.tl_default_nav_crowd_def();
            MaxAgents = (int)def.max_agents;
            MaxNeighbors = (int)def.max_neighbors;
            PathsPerStep = (int)def.paths_per_step;
            MaxNodes = (int)def.max_nodes;
            NeighborDistance = def.neighbor_distance;
            AgentHorizon = def.agent_horizon;
            WallHorizon = def.wall_horizon;
            MaxGroups = (int)def.max_groups;
            MaxMembers = (int)def.max_members;
        }

        internal tl_nav_crowd_def Raw
        {
            get
            {
                tl_nav_crowd_def def = Api.tl_default_nav_crowd_def();
                def.max_agents = (uint)MaxAgents;
                def.max_neighbors = (uint)MaxNeighbors;
                def.paths_per_step = (uint)PathsPerStep;
                def.max_nodes = (uint)MaxNodes;
                def.neighbor_distance = NeighborDistance;
                def.agent_horizon = AgentHorizon;
                def.wall_horizon = WallHorizon;
                def.max_groups = (uint)MaxGroups;
                def.max_members = (uint)MaxMembers;
                return def;
            }
        }
    }

    /// <summary>What an agent is: an upright cylinder. A new one has the library's defaults.</summary>
    public sealed unsafe class AgentSettings
    {
        /// <summary>Metres, above 0. One above the navmesh's own keeps the difference from walls.</summary>
        public float Radius;
        /// <summary>Metres: agents whose heights do not overlap ignore one another.</summary>
        public float Height;
        /// <summary>Metres a second.</summary>
        public float MaxSpeed;
        /// <summary>Metres a second squared; to avoid others an agent may exceed it.</summary>
        public float MaxAcceleration;
        /// <summary>Metres in the plane: so near to its goal an agent has arrived.</summary>
        public float ArriveDistance;
        /// <summary>0 to 1: of two agents the one with more evades less.</summary>
        public float Priority;
        /// <summary>Metres: half the edge of the box in which the floor under its place is sought.</summary>
        public float Reach;
        /// <summary>Its motion is the caller's (Crowd.SetMotion): a player, a vehicle. The others evade it.</summary>
        public bool IsFixed;

        public AgentSettings()
        {
            tl_nav_agent_def def = Api.tl_default_nav_agent_def();
            Radius = def.radius;
            Height = def.height;
            MaxSpeed = def.max_speed;
            MaxAcceleration = def.max_acceleration;
            ArriveDistance = def.arrive_distance;
            Priority = def.priority;
            Reach = def.reach;
        }

        internal tl_nav_agent_def At(Vec3 position)
        {
            tl_nav_agent_def def = Api.tl_default_nav_agent_def();
            def.position = position;
            def.radius = Radius;
            def.height = Height;
            def.max_speed = MaxSpeed;
            def.max_acceleration = MaxAcceleration;
            def.arrive_distance = ArriveDistance;
            def.priority = Priority;
            def.reach = Reach;
            def.is_fixed = (byte)(IsFixed ? 1 : 0);
            return def;
        }
    }

    /// <summary>What an agent is doing.</summary>
    public enum AgentStatus
    {
        /// <summary>It has no goal, and makes way for others.</summary>
        Idle,
        /// <summary>For its path to be searched.</summary>
        Waiting,
        Walking,
        /// <summary>Or as near as those that stand there already let it come.</summary>
        Arrived,
        /// <summary>No path leads to the goal: it stands as near as a path leads.</summary>
        Unreachable,
        /// <summary>At an off-mesh link that another one takes just now.</summary>
        Queued,
        OnLink,
        /// <summary>The navmesh under it was removed.</summary>
        OffMesh,
        /// <summary>MaxNodes are too few to find the rest of its path.</summary>
        GaveUp,
        Fixed,
    }

    /// <summary>An agent as it is after the last step.</summary>
    public struct AgentState
    {
        public AgentStatus Status;
        /// <summary>Metres, on the surface.</summary>
        public Vec3 Position;
        /// <summary>Metres a second, as it moved in the last step.</summary>
        public Vec3 Velocity;
        /// <summary>Metres; its position when it has no goal.</summary>
        public Vec3 Goal;
    }

    /// <summary>Agents that walk a navmesh to their goals, avoid one another, and never leave it. The same calls give the same
    /// bytes on every machine. One thread at a time uses a crowd. Agents are named by numbers, of which 0 is none.</summary>
    public sealed unsafe partial class Crowd : IDisposable
    {
        private readonly CrowdHandle handle;
        private readonly Navmesh navmesh;

        /// <summary>Half extents of the box in which goals look for a polygon, metres.</summary>
        public Vec3 SearchExtents = new Vec3(1, 2, 1);

        /// <summary>An empty crowd; all memory that steps use is taken now. TalusException names the setting that is wrong.</summary>
        public Crowd(Navmesh navmesh, CrowdSettings settings = null)
        {
            if (navmesh == null)
            {
                throw new ArgumentNullException("navmesh");
            }
            this.navmesh = navmesh;
            tl_nav_crowd_def def = (settings ?? new CrowdSettings()).Raw;
            tl_nav_crowd* crowd = null;
            tl_report report;
            TalusException.Check(Api.tl_nav_crowd_create(&def, &crowd, &report), &report);
            handle = new CrowdHandle(crowd);
        }

        /// <summary>Adds an agent without a goal at the floor's nearest point; 0: no floor is within its reach.
        /// TalusException: a setting that is wrong; TL_ERR_LIMIT: there are MaxAgents.</summary>
        public ulong Add(Vec3 position, AgentSettings settings = null)
        {
            using (Lease crowd = handle.Hold())
            using (Lease mesh = navmesh.Handle.Hold())
            {
                tl_nav_agent_def def = (settings ?? new AgentSettings()).At(position);
                ulong agent;
                tl_report report;
                tl_result result = Api.tl_nav_crowd_add((tl_nav_crowd*)crowd.At, (tl_navmesh*)mesh.At, &def, &agent, &report);
                if (result == tl_result.TL_NOT_FOUND)
                {
                    return 0;
                }
                TalusException.Check(result, &report);
                return agent;
            }
        }

        /// <summary>Removes an agent. TalusException TL_ERR_STALE: it is not in the crowd; so of all that take an agent.</summary>
        public void Remove(ulong agent)
        {
            using (Lease crowd = handle.Hold())
            {
                TalusException.Check(Api.tl_nav_crowd_remove((tl_nav_crowd*)crowd.At, agent));
            }
        }

        /// <summary>Sends an agent to the floor's point nearest to a goal; false: there is none within SearchExtents, and it
        /// keeps the goal that it had.</summary>
        public bool SetGoal(ulong agent, Vec3 goal)
        {
            using (Lease crowd = handle.Hold())
            using (Lease mesh = navmesh.Handle.Hold())
            {
                tl_nav_location location;
                tl_result result = Api.tl_navmesh_find_nearest((tl_navmesh*)mesh.At, null, goal, SearchExtents, &location);
                if (result == tl_result.TL_NOT_FOUND)
                {
                    return false;
                }
                TalusException.Check(result);
                TalusException.Check(Api.tl_nav_crowd_set_goal((tl_nav_crowd*)crowd.At, agent, &location));
                return true;
            }
        }

        /// <summary>Lets an agent stop where it is.</summary>
        public void Stop(ulong agent)
        {
            using (Lease crowd = handle.Hold())
            {
                TalusException.Check(Api.tl_nav_crowd_set_goal((tl_nav_crowd*)crowd.At, agent, null));
            }
        }

        /// <summary>Where a fixed agent is now, metres, and how fast it moves, metres a second.</summary>
        public void SetMotion(ulong agent, Vec3 position, Vec3 velocity)
        {
            using (Lease crowd = handle.Hold())
            {
                TalusException.Check(Api.tl_nav_crowd_set_motion((tl_nav_crowd*)crowd.At, agent, position, velocity));
            }
        }

        /// <summary>Moves all agents by so many seconds, above 0 and at most 1. No managed memory is taken.</summary>
        public void Step(float seconds)
        {
            using (Lease crowd = handle.Hold())
            using (Lease mesh = navmesh.Handle.Hold())
            {
                TalusException.Check(Api.tl_nav_crowd_step((tl_nav_crowd*)crowd.At, (tl_navmesh*)mesh.At, seconds, null));
            }
        }

        public AgentState this[ulong agent]
        {
            get
            {
                using (Lease crowd = handle.Hold())
                {
                    tl_nav_agent_state state;
                    TalusException.Check(Api.tl_nav_crowd_agent((tl_nav_crowd*)crowd.At, agent, &state));
                    return new AgentState
                    {
                        Status = (AgentStatus)state.status, Position = state.position, Velocity = state.velocity, Goal = state.goal,
                    };
                }
            }
        }

        public int Count
        {
            get
            {
                using (Lease crowd = handle.Hold())
                {
                    return (int)Api.tl_nav_crowd_count((tl_nav_crowd*)crowd.At);
                }
            }
        }

        /// <summary>All agents, in an order that adding and removing others does not change.</summary>
        public ulong[] Agents()
        {
            using (Lease crowd = handle.Hold())
            {
                var agents = new ulong[Api.tl_nav_crowd_count((tl_nav_crowd*)crowd.At)];
                uint cursor = 0;
                ulong agent;
                for (int i = 0; Api.tl_nav_crowd_next((tl_nav_crowd*)crowd.At, &cursor, &agent) != 0; i++)
                {
                    agents[i] = agent;
                }
                return agents;
            }
        }

        /// <summary>The state as bytes, the same on every machine: to go back to, to compare, to send.</summary>
        public byte[] Save()
        {
            using (Lease crowd = handle.Hold())
            {
                var bytes = new byte[(long)Api.tl_nav_crowd_state_size((tl_nav_crowd*)crowd.At)];
                fixed (byte* at = bytes)
                {
                    TalusException.Check(Api.tl_nav_crowd_save((tl_nav_crowd*)crowd.At, at, (UIntPtr)bytes.Length));
                }
                return bytes;
            }
        }

        /// <summary>Goes back to a state that was saved, by this crowd or one with the same MaxAgents. TalusException: bytes that
        /// are none; the crowd is as it was.</summary>
        public void Restore(byte[] state)
        {
            if (state == null)
            {
                throw new ArgumentNullException("state");
            }
            using (Lease crowd = handle.Hold())
            {
                // In words, since C wants the bytes at a multiple of 8; and one at least, since fixed gives null for none.
                var words = new ulong[state.Length / 8 + 1];
                Buffer.BlockCopy(state, 0, words, 0, state.Length);
                fixed (ulong* at = words)
                {
                    tl_report report;
                    tl_result result = Api.tl_nav_crowd_restore((tl_nav_crowd*)crowd.At, at, (UIntPtr)state.Length, &report);
                    TalusException.Check(result, &report);
                }
            }
        }

        /// <summary>A hash of what Save gives, to be compared between machines.</summary>
        public ulong Hash()
        {
            using (Lease crowd = handle.Hold())
            {
                return Api.tl_nav_crowd_hash((tl_nav_crowd*)crowd.At);
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
