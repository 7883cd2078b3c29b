// SPDX-License-Identifier: MIT
//
// Who owns what C has made. Every call holds a lease, so that nothing is freed while a thread is inside of it: neither by
// Dispose on another thread, nor by the garbage collector.

using System;
using System.Runtime.InteropServices;
using Talus.Interop;

namespace Talus
{
    internal abstract class NativeHandle : SafeHandle
    {
        protected NativeHandle() : base(IntPtr.Zero, true)
        {
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        /// <summary>Holds the object for one call. ObjectDisposedException: it was disposed of.</summary>
        public Lease Hold()
        {
            return new Lease(this);
        }
    }

    internal struct Lease : IDisposable
    {
        private readonly NativeHandle held;

        public Lease(NativeHandle handle)
        {
            bool added = false;
            handle.DangerousAddRef(ref added);
            held = handle;
        }

        public unsafe void* At
        {
            get { return (void*)held.DangerousGetHandle(); }
        }

        public void Dispose()
        {
            held.DangerousRelease();
        }
    }

    /// <summary>A file's bytes, aligned as blobs want it.</summary>
    internal sealed class FileHandle : NativeHandle
    {
        public readonly ulong Size;
        private readonly IntPtr block;

        public unsafe FileHandle(byte[] bytes)
        {
            block = Marshal.AllocHGlobal((IntPtr)(bytes.LongLength + Api.TL_BLOB_ALIGNMENT));
            long mask = Api.TL_BLOB_ALIGNMENT - 1;
            SetHandle((IntPtr)(((long)block + mask) & ~mask));
            Marshal.Copy(bytes, 0, handle, bytes.Length);
            Size = (ulong)bytes.LongLength;
        }

        protected override bool ReleaseHandle()
        {
            Marshal.FreeHGlobal(block);
            return true;
        }
    }

    /// <summary>What keeps a file while something in it is used.</summary>
    internal abstract class InFileHandle : NativeHandle
    {
        private readonly FileHandle file;

        protected InFileHandle(IntPtr at, FileHandle file)
        {
            if (file != null)
            {
                bool added = false;
                file.DangerousAddRef(ref added);
                this.file = file;
            }
            SetHandle(at);
        }

        protected bool IsInFile
        {
            get { return file != null; }
        }

        protected bool ReleaseFile()
        {
            if (file != null)
            {
                file.DangerousRelease();
            }
            return true;
        }
    }

    internal sealed class BlobHandle : InFileHandle
    {
        public unsafe BlobHandle(void* blob, FileHandle file = null) : base((IntPtr)blob, file)
        {
        }

        protected override unsafe bool ReleaseHandle()
        {
            if (!IsInFile)
            {
                Api.tl_blob_free((void*)handle);
            }
            return ReleaseFile();
        }
    }

    internal sealed class NavmeshHandle : InFileHandle
    {
        public unsafe NavmeshHandle(tl_navmesh* navmesh, FileHandle file = null) : base((IntPtr)navmesh, file)
        {
        }

        protected override unsafe bool ReleaseHandle()
        {
            Api.tl_navmesh_destroy((tl_navmesh*)handle);
            return ReleaseFile();
        }
    }

    internal sealed class QueryHandle : NativeHandle
    {
        public unsafe QueryHandle(tl_nav_query* query)
        {
            SetHandle((IntPtr)query);
        }

        protected override unsafe bool ReleaseHandle()
        {
            Api.tl_nav_query_destroy((tl_nav_query*)handle);
            return true;
        }
    }

    internal sealed class CrowdHandle : NativeHandle
    {
        public unsafe CrowdHandle(tl_nav_crowd* crowd)
        {
            SetHandle((IntPtr)crowd);
        }

        protected override unsafe bool ReleaseHandle()
        {
            Api.tl_nav_crowd_destroy((tl_nav_crowd*)handle);
            return true;
        }
    }

    internal sealed class MoverHandle : NativeHandle
    {
        public unsafe MoverHandle(tl_character_mover* mover)
        {
            SetHandle((IntPtr)mover);
        }

        protected override unsafe bool ReleaseHandle()
        {
            Api.tl_character_mover_destroy((tl_character_mover*)handle);
            return true;
        }
    }
}
