// SPDX-License-Identifier: MIT
//
// Where the C library is found, and the constants that C has as macros. The rest of Api is in Interop.cs.

namespace Talus.Interop
{
    /// <summary>The C interface, whole: every function with its name and contract there. The classes of the namespace
    /// Talus wrap the common part, safely.</summary>
    public static unsafe partial class Api
    {
#if UNITY_IOS && !UNITY_EDITOR
        public const string Library = "__Internal";
#else
        public const string Library = "talus";
#endif
        /// <summary>A report's element_index where no element is to blame.</summary>
        public const ulong TL_NO_ELEMENT = ulong.MaxValue;
        /// <summary>The triangle of a ray in a batch that hits nothing.</summary>
        public const uint TL_NO_TRIANGLE = uint.MaxValue;
        /// <summary>Blobs and baked files begin at multiples of this, bytes.</summary>
        public const int TL_BLOB_ALIGNMENT = 64;

        /// <summary>A chunk's type out of its four letters.</summary>
        public static uint PackType(string letters)
        {
            return letters[0] | (uint)letters[1] << 8 | (uint)letters[2] << 16 | (uint)letters[3] << 24;
        }
    }
}
