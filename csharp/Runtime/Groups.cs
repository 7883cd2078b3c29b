// SPDX-License-Identifier: MIT

using System;
using Talus.Interop;

namespace Talus
{
    /// <summary>How the others stand about their leader.</summary>
    public enum Formation
    {
        /// <summary>Wherever they are, but near to it.</summary>
        Loose,
        /// <summary>Abreast, the leader in the middle.</summary>
        Line,
        /// <summary>One behind the other, on the leader's trail.</summary>
        Column,
        /// <summary>The leader in front, behind it two rows at 45 degrees.</summary>
        Wedge,
        /// <summary>On a circle, the leader in its middle.</summary>
        Ring,
        /// <summary>As GroupSettings.Slots says.</summary>
        Slots,
    }

    /// <summary>A place in the plan of a formation, metres from the leader.</summary>
    public struct FormationSlot
    {
        public float Forward, Left;

        public FormationSlot(float forward, float left)
        {
            Forward = forward;
            Left = left;
        }
    }

    /// <summary>How a group walks. A new one has the library's defaults.</summary>
    public sealed unsafe class GroupSettings
    {
        public Formation Formation = Formation.Loose;
        /// <summary>Metres between neighbours, also in a column: above 0, at most 1000.</summary>
        public float Spacing;
        /// <summary>Metres, above 0: the leader stands while somebody is so far from its slot, and slows down from a quarter of
        /// it on.</summary>
        public float WaitDistance;
        /// <summary>Metres, above 0: who is farther from its slot is not waited for, nor who is held up for ten seconds.</summary>
        public float LostDistance;
        /// <summary>For Formation.Slots: one for each agent but the leader. Otherwise ignored.</summary>
        public FormationSlot[] Slots;
        /// <summary>Agent k of the list takes slot k; otherwise slots are dealt so that the ways there are short.</summary>
        public bool KeepOrder;

        public GroupSettings()
        {
            tl_nav_group_def def = Api.tl_default_nav_group_def();
            Spacing = def.spacing;
            WaitDistance = def.wait_distance;
            LostDistance = def.lost_distance;
        }

        // Without the slots, which the caller pins. C reads one for each follower, so another number must not get there.
        internal tl_nav_group_def RawFor(int followers)
        {
            if (Formation == Formation.Slots && (Slots == null || Slots.Length != followers))
            {
                throw new ArgumentException("one for each agent but the leader is needed", "Slots");
            }
            tl_nav_group_def def = Api.tl_default_nav_group_def();
            def.formation = (tl_nav_formation)Formation;
            def.spacing = Spacing;
            def.wait_distance = WaitDistance;
            def.lost_distance = LostDistance;
            def.keep_order = (byte)(KeepOrder ? 1 : 0);
            return def;
        }
    }

    /// <summary>A group as it is after the last step.</summary>
    public struct GroupState
    {
        public ulong Leader;
        /// <summary>Agents, the leader included.</summary>
        public int Count;
        /// <summary>Those no farther than half the spacing from their slots; the leader is.</summary>
        public int InPlace;
        /// <summary>Those whose slots are on the leader's trail, as in a doorway.</summary>
        public int OnTrail;
        /// <summary>Metres: of those who are waited for, the largest distance to a slot.</summary>
        public float Lag;
        /// <summary>Metres a second: what the leader may walk.</summary>
        public float Speed;
        /// <summary>Unit, in the plane: where the formation faces.</summary>
        public Vec3 Heading;
    }

    // Groups: agents that follow a leader, which walks a path of its own or is fixed: a player.
    public sealed unsafe partial class Crowd
    {
        /// <summary>Makes a group of agents, of which the first leads, and returns its name; the others lose their goals.
        /// TalusException: a setting that is wrong; "agents": one that is in a group already, or is fixed and does not lead;
        /// TL_ERR_STALE: an agent that is none; TL_ERR_LIMIT: MaxGroups or MaxMembers.</summary>
        public ulong AddGroup(ulong[] agents, GroupSettings settings = null)
        {
            if (agents == null)
            {
                throw new ArgumentNullException("agents");
            }
            GroupSettings given = settings ?? new GroupSettings();
            tl_nav_group_def def = given.RawFor(Math.Max(agents.Length - 1, 0));
            ulong group;
            using (Lease crowd = handle.Hold())
            fixed (ulong* names = agents)
            fixed (FormationSlot* slots = given.Slots)
            {
                def.slots = (tl_nav_formation_slot*)slots;
                tl_report report;
                tl_result result =
                    Api.tl_nav_crowd_add_group((tl_nav_crowd*)crowd.At, &def, names, (uint)agents.Length, &group, &report);
                TalusException.Check(result, &report);
            }
            return group;
        }

        /// <summary>Changes how a group walks; its agents and their leader remain. TalusException as of AddGroup; then nothing
        /// is changed.</summary>
        public void SetFormation(ulong group, GroupSettings settings)
        {
            if (settings == null)
            {
                throw new ArgumentNullException("settings");
            }
            tl_nav_group_def def = settings.RawFor(Group(group).Count - 1);
            using (Lease crowd = handle.Hold())
            fixed (FormationSlot* slots = settings.Slots)
            {
                def.slots = (tl_nav_formation_slot*)slots;
                tl_report report;
                TalusException.Check(Api.tl_nav_crowd_set_formation((tl_nav_crowd*)crowd.At, group, &def, &report), &report);
            }
        }

        /// <summary>Lets the agents of a group go: the leader keeps its goal, the others stop. TalusException TL_ERR_STALE: it
        /// is not in the crowd; so of all that take a group.</summary>
        public void RemoveGroup(ulong group)
        {
            using (Lease crowd = handle.Hold())
            {
                TalusException.Check(Api.tl_nav_crowd_remove_group((tl_nav_crowd*)crowd.At, group));
            }
        }

        /// <summary>A group as it is after the last step.</summary>
        public GroupState Group(ulong group)
        {
            using (Lease crowd = handle.Hold())
            {
                tl_nav_group_state state;
                TalusException.Check(Api.tl_nav_crowd_group((tl_nav_crowd*)crowd.At, group, &state));
                return new GroupState
                {
                    Leader = state.leader, Count = (int)state.count, InPlace = (int)state.in_place, OnTrail = (int)state.on_trail,
                    Lag = state.lag, Speed = state.speed, Heading = state.heading,
                };
            }
        }

        /// <summary>The agents of a group by their slots, the leader first.</summary>
        public ulong[] Members(ulong group)
        {
            var agents = new ulong[Group(group).Count];
            using (Lease crowd = handle.Hold())
            fixed (ulong* names = agents)
            {
                uint count;
                TalusException.Check(
                    Api.tl_nav_crowd_members((tl_nav_crowd*)crowd.At, group, names, (uint)agents.Length, &count));
            }
            return agents;
        }

        /// <summary>The group that an agent is in; 0: in none, or it is not in the crowd.</summary>
        public ulong GroupOf(ulong agent)
        {
            using (Lease crowd = handle.Hold())
            {
                return Api.tl_nav_crowd_group_of((tl_nav_crowd*)crowd.At, agent);
            }
        }
    }
}
