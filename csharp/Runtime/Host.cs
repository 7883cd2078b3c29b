// SPDX-License-Identifier: MIT
//
// What a bake asks of .NET: threads, and whether to go on. Exceptions must not pass through C: one that a callback throws
// ends the bake, and is thrown again when that has returned.

using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;
using System.Threading.Tasks;
using Talus.Interop;

namespace Talus
{
    /// <summary>Called during a bake with the stage's name, what is done and the total; false cancels.</summary>
    public delegate bool BakeProgress(string stage, ulong done, ulong total);

    /// <summary>What IL2CPP looks for on functions that C calls.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type)
        {
        }
    }

    internal sealed unsafe class Host : IDisposable
    {
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate byte UpdateFn(byte* stage, ulong done, ulong total, void* user);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void RunFn(IntPtr task, uint count, void* taskUser, void* user);

        // C keeps pointers to them, so they stay.
        private static readonly UpdateFn update = Update;
        private static readonly RunFn run = Run;

        private struct Hooks
        {
            public tl_tasks Tasks;
            public tl_progress Progress;
        }

        private readonly BakeProgress progress;
        private readonly GCHandle self;
        private readonly Hooks* hooks;
        private ExceptionDispatchInfo failure;

        /// <summary>threads: 1 is the calling one alone, 0 all cores.</summary>
        public Host(int threads, BakeProgress progress)
        {
            if (threads < 0)
            {
                throw new ArgumentOutOfRangeException("threads");
            }
            this.progress = progress;
            self = GCHandle.Alloc(this);
            hooks = (Hooks*)Marshal.AllocHGlobal(sizeof(Hooks));
            void* user = (void*)GCHandle.ToIntPtr(self);
            hooks->Tasks = new tl_tasks
            {
                run = Marshal.GetFunctionPointerForDelegate(run),
                worker_count = (uint)(threads > 0 ? threads : Environment.ProcessorCount),
                user = user,
            };
            hooks->Progress = new tl_progress { update = Marshal.GetFunctionPointerForDelegate(update), user = user };
        }

        public tl_host Raw
        {
            get
            {
                return new tl_host
                {
                    tasks = hooks->Tasks.worker_count > 1 ? &hooks->Tasks : null,
                    progress = progress != null ? &hooks->Progress : null,
                };
            }
        }

        /// <summary>Throws what a callback has thrown, else what the result says.</summary>
        public void Check(tl_result result, tl_report* report)
        {
            if (failure != null)
            {
                failure.Throw();
            }
            TalusException.Check(result, report);
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal((IntPtr)hooks);
            self.Free();
        }

        private static Host Of(void* user)
        {
            return (Host)GCHandle.FromIntPtr((IntPtr)user).Target;
        }

        [MonoPInvokeCallback(typeof(UpdateFn))]
        private static byte Update(byte* stage, ulong done, ulong total, void* user)
        {
            Host host = Of(user);
            try
            {
                return (byte)(host.progress(TalusException.Text(stage), done, total) ? 1 : 0);
            }
            catch (Exception exception)
            {
                host.failure = ExceptionDispatchInfo.Capture(exception);
                return 0;
            }
        }

        // Each worker takes the next item until none is left. What runs is C alone, which throws nothing.
        [MonoPInvokeCallback(typeof(RunFn))]
        private static void Run(IntPtr task, uint count, void* taskUser, void* user)
        {
            var call = (tl_task_fn)Marshal.GetDelegateForFunctionPointer(task, typeof(tl_task_fn));
            long next = -1;
            var workers = (int)Math.Min(Of(user).hooks->Tasks.worker_count, count);
            Parallel.For(0, workers, worker =>
            {
                for (long item = Interlocked.Increment(ref next); item < count; item = Interlocked.Increment(ref next))
                {
                    call((uint)item, (uint)worker, taskUser);
                }
            });
        }
    }

    internal static class Arrays
    {
        /// <summary>A view of arrays that are pinned; triangles are counted by threes.</summary>
        public static unsafe tl_mesh_view View(tl_vec3* vertices, int vertexCount, int* indices, int indexCount, ushort* materials)
        {
            return new tl_mesh_view
            {
                vertices = vertices, vertex_count = (uint)vertexCount,
                indices = (uint*)indices, triangle_count = (uint)(indexCount / 3), materials = materials,
            };
        }

        /// <summary>Three indices a triangle; a negative one is too large for C, which names its triangle.</summary>
        public static void CheckMesh(Vec3[] vertices, int[] triangles, ushort[] materials)
        {
            if (vertices == null)
            {
                throw new ArgumentNullException("vertices");
            }
            if (triangles == null)
            {
                throw new ArgumentNullException("triangles");
            }
            if (triangles.Length % 3 != 0)
            {
                throw new ArgumentException("three indices a triangle are needed", "triangles");
            }
            if (materials != null && materials.Length != triangles.Length / 3)
            {
                throw new ArgumentException("one a triangle is needed", "materials");
            }
        }
    }
}
