// SPDX-License-Identifier: MIT

using System;
using System.Runtime.InteropServices;
using Talus.Interop;

namespace Talus
{
    /// <summary>A point in metres, y up, or a direction. Arrays of it are handed to C as they are.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vec3 : IEquatable<Vec3>
    {
        public float X, Y, Z;

        public Vec3(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public static Vec3 operator +(Vec3 a, Vec3 b)
        {
            return new Vec3(a.X + b.X, a.Y + b.Y, a.Z + b.Z);
        }

        public static Vec3 operator -(Vec3 a, Vec3 b)
        {
            return new Vec3(a.X - b.X, a.Y - b.Y, a.Z - b.Z);
        }

        public static Vec3 operator *(Vec3 a, float factor)
        {
            return new Vec3(a.X * factor, a.Y * factor, a.Z * factor);
        }

        public float Length
        {
            get { return (float)Math.Sqrt((double)X * X + (double)Y * Y + (double)Z * Z); }
        }

        public bool Equals(Vec3 other)
        {
            return X == other.X && Y == other.Y && Z == other.Z;
        }

        public override bool Equals(object other)
        {
            return other is Vec3 && Equals((Vec3)other);
        }

        public override int GetHashCode()
        {
            return (X.GetHashCode() * 31 + Y.GetHashCode()) * 31 + Z.GetHashCode();
        }

        public override string ToString()
        {
            return string.Format(System.Globalization.CultureInfo.InvariantCulture, "({0}, {1}, {2})", X, Y, Z);
        }

        public static implicit operator tl_vec3(Vec3 v)
        {
            return new tl_vec3 { x = v.X, y = v.Y, z = v.Z };
        }

        public static implicit operator Vec3(tl_vec3 v)
        {
            return new Vec3(v.x, v.y, v.z);
        }

#if UNITY_5_3_OR_NEWER
        public static implicit operator UnityEngine.Vector3(Vec3 v)
        {
            return new UnityEngine.Vector3(v.X, v.Y, v.Z);
        }

        public static implicit operator Vec3(UnityEngine.Vector3 v)
        {
            return new Vec3(v.x, v.y, v.z);
        }
#endif
    }

    /// <summary>Where a shape stands: turned first, then moved. All zero is the origin, not turned.</summary>
    public struct RigidPose
    {
        /// <summary>The unit quaternion X i + Y j + Z k + W.</summary>
        public float X, Y, Z, W;
        /// <summary>Metres.</summary>
        public Vec3 Position;

        /// <summary>Moved, and not turned.</summary>
        public static RigidPose At(Vec3 position)
        {
            return new RigidPose { W = 1, Position = position };
        }

        internal tl_transform Raw
        {
            get
            {
                return new tl_transform { rotation = new tl_quat { x = X, y = Y, z = Z, w = W }, position = Position };
            }
        }
    }
}
