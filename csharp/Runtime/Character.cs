// SPDX-License-Identifier: MIT

using System;
using Talus.Interop;

namespace Talus
{
    /// <summary>A character's state: where it stands, and on what. Copy it to keep it, set it to go back.</summary>
    public struct CharacterState
    {
        internal tl_character Raw;

        /// <summary>Metres, of its feet.</summary>
        public Vec3 Position { get { return Raw.position; } set { Raw.position = value; } }
        /// <summary>Metres a second: what its contacts left of the last wish.</summary>
        public Vec3 Velocity { get { return Raw.velocity; } }
        /// <summary>Whether it stands on something that can be walked on.</summary>
        public bool Grounded { get { return Raw.grounded != 0; } }
        /// <summary>Of length 1; zero in the air.</summary>
        public Vec3 GroundNormal { get { return Raw.ground_normal; } }

        public static CharacterState At(Vec3 position)
        {
            return new CharacterState { Position = position };
        }
    }

    /// <summary>Moves upright capsules over a soup: they slide along walls and follow steps and slopes. One thread at a time
    /// uses a mover, for any number of characters.</summary>
    public sealed unsafe class CharacterMover : IDisposable
    {
        private readonly MoverHandle handle;
        private readonly Soup level;

        /// <summary>Lengths in metres, the slope in degrees. TalusException names the one that is wrong.</summary>
        public CharacterMover(Soup level, float radius = 0.3f, float height = 1.8f, float stepHeight = 0.4f, float maxSlope = 45)
        {
            if (level == null)
            {
                throw new ArgumentNullException("level");
            }
            this.level = level;
            tl_character_def def = Api.tl_default_character_def();
            def.radius = radius;
            def.height = height;
            def.step_height = stepHeight;
            def.max_slope = maxSlope;
            tl_character_mover* mover = null;
            tl_report report;
            TalusException.Check(Api.tl_character_mover_create(&def, &mover, &report), &report);
            handle = new MoverHandle(mover);
        }

        /// <summary>Moves a character for so many seconds by a velocity in metres a second. On the ground its y does not
        /// count, unless leaveGround is set: a jump.</summary>
        public void Move(ref CharacterState character, Vec3 velocity, float seconds, bool leaveGround = false)
        {
            using (Lease mover = handle.Hold())
            using (Lease soup = level.Blob.Hold())
            {
                var place = new tl_character_level { soup = (tl_soup*)soup.At };
                var step = new tl_character_step { velocity = velocity, seconds = seconds, leave_ground = (byte)(leaveGround ? 1 : 0) };
                tl_character state = character.Raw;
                tl_character_report report;
                tl_result result = Api.tl_character_move((tl_character_mover*)mover.At, &place, &step, &state, &report);
                TalusException.Check(result, &report.@base);
                character.Raw = state;
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
