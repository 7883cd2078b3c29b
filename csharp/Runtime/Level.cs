// SPDX-License-Identifier: MIT

using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using Talus.Interop;

namespace Talus
{
    /// <summary>All that one .talus file holds: what the command writes, and what it reads. What is not there is
    /// null. The parts of a file that was opened are used in place, in one copy of its bytes.</summary>
    public sealed unsafe class Level
    {
        public Soup Soup { get; set; }
        public Hull Hull { get; set; }
        public Navmesh Navmesh { get; set; }

        private static readonly uint soupType = Api.PackType("SOUP"), hullType = Api.PackType("HULL");
        private static readonly uint navmType = Api.PackType("NAVM"), navtType = Api.PackType("NAVT");
        private static readonly tl_write_fn append = Append;

        private delegate tl_result Check(void* bytes, ulong size, tl_report* report);

        /// <summary>Opens a file. TalusException: it is none of talus, of another version, cut off or altered.</summary>
        public static Level Load(string path)
        {
            return FromBytes(File.ReadAllBytes(path));
        }

        /// <summary>The same, of bytes: a TextAsset's, for one. All of them are checked first.</summary>
        public static Level FromBytes(byte[] bytes)
        {
            if (bytes == null)
            {
                throw new ArgumentNullException("bytes");
            }
            using (var file = new FileHandle(bytes)) // what lies in it keeps it
            using (Lease held = file.Hold())
            {
                tl_report report;
                TalusException.Check(Api.tl_pack_to_host_order(held.At, file.Size, &report), &report);
                tl_pack pack;
                TalusException.Check(Api.tl_pack_open(held.At, file.Size, &pack, &report), &report);
                var level = new Level();
                void* at = Find(&pack, soupType, Api.tl_soup_check);
                level.Soup = at != null ? new Soup(new BlobHandle(at, file)) : null;
                at = Find(&pack, hullType, Api.tl_hull_check);
                level.Hull = at != null ? new Hull(new BlobHandle(at, file)) : null;
                at = Find(&pack, navmType, Api.tl_pack_navmesh_check);
                if (at != null)
                {
                    tl_navmesh* navmesh = null;
                    TalusException.Check(Api.tl_pack_load_navmesh(&pack, null, &navmesh, &report), &report);
                    var head = (tl_pack_navmesh*)at;
                    level.Navmesh = new Navmesh(new NavmeshHandle(navmesh, file), Api.tl_pack_navmesh_def(head), head->tiles_x, head->tiles_z);
                }
                return level;
            }
        }

        // A chunk that is there, checked; else null.
        private static void* Find(tl_pack* pack, uint type, Check check)
        {
            tl_pack_chunk chunk;
            tl_result result = Api.tl_pack_find(pack, type, 0, &chunk);
            if (result == tl_result.TL_NOT_FOUND)
            {
                return null;
            }
            TalusException.Check(result);
            tl_report report;
            TalusException.Check(check(chunk.bytes, chunk.size, &report), &report);
            return chunk.bytes;
        }

        /// <summary>Writes a file: the same bytes on every machine.</summary>
        public void Save(string path)
        {
            File.WriteAllBytes(path, ToBytes());
        }

        public byte[] ToBytes()
        {
            var items = new List<tl_pack_item>();
            tl_pack_navmesh* head = null;
            using (Lease soup = Held(Soup != null ? Soup.Blob : null))
            using (Lease hull = Held(Hull != null ? Hull.Blob : null))
            using (Lease navmesh = Held(Navmesh != null ? Navmesh.Handle : null))
            {
                try
                {
                    if (Soup != null)
                    {
                        items.Add(Item(soupType, 0, soup.At));
                    }
                    if (Hull != null)
                    {
                        items.Add(Item(hullType, 0, hull.At));
                    }
                    if (Navmesh != null)
                    {
                        List<IntPtr> tiles = Navmesh.TilesOf((tl_navmesh*)navmesh.At);
                        tl_nav_def def = Navmesh.Def;
                        tl_report report;
                        tl_result result = Api.tl_pack_navmesh_encode(&def, Navmesh.TilesX, Navmesh.TilesZ, (uint)tiles.Count, null, &head, &report);
                        TalusException.Check(result, &report);
                        items.Add(Item(navmType, 0, head));
                        for (int i = 0; i < tiles.Count; i++)
                        {
                            items.Add(Item(navtType, (uint)i, (void*)tiles[i]));
                        }
                    }
                    return Write(items.ToArray());
                }
                finally
                {
                    Api.tl_blob_free(head);
                }
            }
        }

        private static readonly FileHandle nothing = new FileHandle(new byte[0]);

        private static Lease Held(NativeHandle handle)
        {
            return (handle ?? nothing).Hold();
        }

        private static tl_pack_item Item(uint type, uint id, void* blob)
        {
            return new tl_pack_item { type = type, id = id, bytes = blob, size = ((tl_blob*)blob)->size };
        }

        private static byte[] Write(tl_pack_item[] items)
        {
            var stream = new MemoryStream();
            GCHandle user = GCHandle.Alloc(stream);
            try
            {
                fixed (tl_pack_item* at = items)
                {
                    tl_report report;
                    IntPtr write = Marshal.GetFunctionPointerForDelegate(append);
                    tl_result result = Api.tl_pack_write(at, (uint)items.Length, null, write, (void*)GCHandle.ToIntPtr(user), &report);
                    TalusException.Check(result, &report);
                }
                return stream.ToArray();
            }
            finally
            {
                user.Free();
            }
        }

        [MonoPInvokeCallback(typeof(tl_write_fn))]
        private static tl_result Append(void* bytes, UIntPtr size, void* user)
        {
            try
            {
                var stream = (MemoryStream)GCHandle.FromIntPtr((IntPtr)user).Target;
                var part = new byte[65536];
                for (ulong done = 0; done < (ulong)size;)
                {
                    int count = (int)Math.Min((ulong)part.Length, (ulong)size - done);
                    Marshal.Copy((IntPtr)((byte*)bytes + done), part, 0, count);
                    stream.Write(part, 0, count);
                    done += (ulong)count;
                }
                return tl_result.TL_OK;
            }
            catch (Exception) // memory is out: no exception passes through C
            {
                return tl_result.TL_ERR_MEMORY;
            }
        }
    }
}
