// SPDX-License-Identifier: MIT
//
// A level with a wall: layout, rays, shapes, paths, files, errors, threads and garbage through the binding. A program of
// its own, so that no test framework is needed: it ends with 0 when all is as it should be.
//
//   tests FOLDER [COMMAND]      FOLDER for files; COMMAND: the talus command, whose files are read then

using System;
using System.Collections.Generic;
using System.Linq;
using System.Diagnostics;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading;
using Talus;
using Talus.Interop;

static class Test
{
    public static int Checks;

    public static void That(bool holds, string what)
    {
        Checks++;
        if (!holds)
        {
            throw new Exception("not so: " + what);
        }
    }

    public static void Equal(long expected, long found, string what)
    {
        That(expected == found, what + ": " + found + " instead of " + expected);
    }

    public static TalusException Throws(Action action)
    {
        try
        {
            action();
        }
        catch (TalusException exception)
        {
            Checks++;
            return exception;
        }
        throw new Exception("no exception");
    }

    public static void Refused(Action action, string what)
    {
        try
        {
            action();
        }
        catch (ArgumentException)
        {
            Checks++;
            return;
        }
        throw new Exception(what + ": no exception");
    }
}

static class Tests
{
    // A floor 20 m square, and a wall 3 m high with a passage around its end at z = 6.
    private static readonly Vec3[] vertices =
    {
        new Vec3(-10, 0, -10), new Vec3(-10, 0, 10), new Vec3(10, 0, 10), new Vec3(10, 0, -10),
        new Vec3(0, 0, -10), new Vec3(0, 0, 6), new Vec3(0, 3, 6), new Vec3(0, 3, -10),
        new Vec3(0.5f, 0, -10), new Vec3(0.5f, 0, 6), new Vec3(0.5f, 3, 6), new Vec3(0.5f, 3, -10),
    };
    private static readonly int[] triangles =
    {
        0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 11, 10, 8, 10, 9, 5, 9, 10, 5, 10, 6, 7, 6, 10, 7, 10, 11,
    };
    private static readonly Vec3[] cube =
    {
        new Vec3(-1, -1, -1), new Vec3(1, -1, -1), new Vec3(-1, 1, -1), new Vec3(1, 1, -1),
        new Vec3(-1, -1, 1), new Vec3(1, -1, 1), new Vec3(-1, 1, 1), new Vec3(1, 1, 1),
    };
    private static readonly int[] cubeSides =
    {
        0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
    };
    private static string folder, command;

    private static unsafe void StructsAreThoseOfC()
    {
        IntPtr block = Marshal.AllocHGlobal(1 << 16);
        Layout.Check((byte*)block);
        Marshal.FreeHGlobal(block);
        Test.Equal(sizeof(tl_vec3), sizeof(Vec3), "Vec3");
        Test.Equal(sizeof(tl_ray), sizeof(SoupRay), "SoupRay");
    }

    // Nothing is linked before its first call: a name that C does not have would show at a user's.
    private static void EveryFunctionIsThere()
    {
        int count = 0;
        foreach (MethodInfo method in typeof(Api).GetMethods(BindingFlags.Static | BindingFlags.Public))
        {
            if ((method.Attributes & MethodAttributes.PinvokeImpl) != 0)
            {
                Marshal.Prelink(method);
                count++;
            }
        }
        Test.That(count > 300, "functions are found");
    }

    private static void RaysHitWhatTheyShould()
    {
        using (Soup soup = Soup.Bake(vertices, triangles))
        {
            SoupHit hit = soup.CastRay(new Vec3(-5, 1, 0), new Vec3(1, 0, 0)).Value;
            Test.That(hit.T == 5 && !hit.Back && hit.Normal.Equals(new Vec3(-1, 0, 0)), "the wall is hit");
            Test.That(soup.IsOccluded(new Vec3(-5, 1, 0), new Vec3(1, 0, 0)), "occluded");
            Test.That(soup.CastRay(new Vec3(-5, 1, 0), new Vec3(1, 0, 0), 4) == null, "too far");
            Test.That(!soup.LineOfSight(new Vec3(-5, 1, 0), new Vec3(5, 1, 0)), "the wall is between");
            Test.That(soup.LineOfSight(new Vec3(-5, 1, 8), new Vec3(5, 1, 8)), "the passage is free");
            Test.That(soup.CastRay(new Vec3(5, -1, 5), new Vec3(0, 1, 0)).Value.Back, "from below");
            Test.That(soup.CastRay(new Vec3(5, -1, 5), new Vec3(0, 1, 0), 9, Cull.Back) == null, "culled");
            Test.That(soup.CastRay(new Vec3(5, -1, 5), new Vec3(0, 1, 0), 9, Cull.Front) != null, "not culled");
            SoupNearest nearest = soup.Nearest(new Vec3(-2, 1, -3), 5).Value;
            Test.That(nearest.Distance == 1 && nearest.Point.Equals(new Vec3(-2, 0, -3)), "nearest");
            Test.That(soup.Nearest(new Vec3(0, 50, 0), 5) == null, "nothing near");
            ConvexShape ball = ConvexShape.Sphere(new Vec3(), 1);
            Test.That(soup.Overlaps(ball, RigidPose.At(new Vec3(-0.5f, 1.5f, 0))), "overlaps");
            Test.That(!soup.Overlaps(ball, RigidPose.At(new Vec3(-5, 1.5f, 0))), "does not overlap");
            SweepHit swept = soup.Sweep(ball, RigidPose.At(new Vec3(-5, 1.5f, 0)), new Vec3(8, 0, 0)).Value;
            Test.That(Math.Abs(swept.T - 0.5f) < 1e-5f && swept.Normal.X < -0.99f, "swept to the wall");
            Test.That(soup.Sweep(ball, RigidPose.At(new Vec3(-5, 1.5f, 0)), new Vec3(0, 3, 0)) == null, "free way");
        }
    }

    private static void BatchesAreTheirRays()
    {
        using (Soup soup = Soup.Bake(vertices, triangles))
        {
            var rays = new SoupRay[20000];
            for (int i = 0; i < rays.Length; i++)
            {
                rays[i] = new SoupRay(new Vec3(i % 400 * 0.06f - 12, 9, i / 400 * 0.5f - 12), new Vec3(0.3f, -1, 0.1f));
            }
            foreach (int threads in new[] { 0, 1, 3 })
            {
                SoupHit?[] hits = soup.CastRays(rays, threads);
                int met = 0;
                for (int i = 0; i < rays.Length; i++)
                {
                    SoupHit? alone = soup.CastRay(rays[i].Origin, rays[i].Direction);
                    Test.That(alone.HasValue == hits[i].HasValue, "hit or not, ray " + i);
                    Test.That(!alone.HasValue || alone.Value.Equals(hits[i].Value), "ray " + i);
                    met += alone.HasValue ? 1 : 0;
                }
                Test.That(met > 5000 && met < 19000, "some hit, some do not: " + met);
            }
        }
    }

    private static void HullsKeepTheirDistance()
    {
        using (Hull hull = Hull.Bake(cube))
        using (Soup soup = Soup.Bake(cube, cubeSides))
        {
            Test.That(hull.VertexCount == 8 && Math.Abs(hull.Volume - 8) < 1e-9, "a cube");
            Test.That(hull.Contains(new Vec3(0.9f, 0.9f, 0.9f)) && !hull.Contains(new Vec3(1.1f, 0, 0)), "contains");
            Test.That(soup.Contains(new Vec3(0.3f, 0.2f, -0.1f)) && !soup.Contains(new Vec3(1.3f, 0, 0)), "the soup contains");
            ConvexShape shape = ConvexShape.Of(hull);
            RigidPose here = RigidPose.At(new Vec3());
            Separation apart = ConvexShape.Distance(shape, here, shape, RigidPose.At(new Vec3(5, 0.5f, 0)));
            Test.That(Math.Abs(apart.Distance - 3) < 1e-6 && apart.LowerBound <= apart.Distance, "apart");
            Test.That(ConvexShape.Penetrate(shape, here, shape, RigidPose.At(new Vec3(5, 0, 0))) == null, "not in one another");
            Penetration deep = ConvexShape.Penetrate(shape, here, shape, RigidPose.At(new Vec3(1.5f, 0, 0))).Value;
            Test.That(Math.Abs(deep.Depth - 0.5f) < 1e-6 && deep.LowerBound <= deep.Depth, "deep");
            TalusException error = Test.Throws(() => ConvexShape.Distance(shape, here, shape, RigidPose.At(new Vec3(float.NaN, 0, 0))));
            Test.That(error.Result == tl_result.TL_ERR_NOT_FINITE, "NaN is told");
        }
        var uneven = new Vec3[2 * cube.Length];
        for (int i = 0; i < cube.Length; i++)
        {
            uneven[i] = cube[i];
            uneven[cube.Length + i] = new Vec3(cube[i].X + 1e-4f * (i + 1), cube[i].Y - 1e-4f * (i + 1), cube[i].Z);
        }
        using (Hull exact = Hull.Bake(uneven))
        using (Hull merged = Hull.Bake(uneven, new HullSettings { WeldDistance = 0.01f, MergeDistance = 0.01f }))
        using (Hull rough = Hull.Bake(uneven, new HullSettings { Tolerance = 0.01f }))
        using (Hull four = Hull.Bake(uneven, new HullSettings { MaxVertices = 4 }))
        {
            Test.That(exact.VertexCount > 8, "each point counts");
            Test.Equal(8, merged.VertexCount, "corners that are nearly one");
            Test.Equal(8, rough.VertexCount, "corners within a tolerance");
            Test.Equal(4, four.VertexCount, "the farthest four");
        }
        Test.That(Test.Throws(() => Hull.Bake(cube, new HullSettings { MaxVertices = 3 })).Field == "max_vertices", "three corners");
        TalusException flat = Test.Throws(() => Hull.Bake(new[] { new Vec3(0, 0, 0), new Vec3(1, 0, 0), new Vec3(0, 1, 0), new Vec3(1, 1, 0) }));
        Test.That(flat.Result == tl_result.TL_ERR_COPLANAR, "a plane is no hull");
    }

    private static void MeshesBecomeConvexParts()
    {
        var both = new Vec3[2 * cube.Length];
        var sides = new int[2 * cubeSides.Length];
        for (int i = 0; i < cube.Length; i++)
        {
            both[i] = cube[i];
            both[cube.Length + i] = new Vec3(cube[i].X + 6, cube[i].Y, cube[i].Z);
        }
        for (int i = 0; i < cubeSides.Length; i++)
        {
            sides[i] = cubeSides[i];
            sides[cubeSides.Length + i] = cubeSides[i] + cube.Length;
        }
        var stages = new List<string>();
        BakeProgress note = (stage, done, total) =>
        {
            stages.Add(stage);
            return true;
        };
        using (Decomposition two = Decomposition.Bake(both, sides, null, note))
        using (Decomposition one = Decomposition.Bake(both, sides, new DecomposeSettings { MaxParts = 1, Threads = 2 }))
        {
            Test.Equal(2, two.Parts.Count, "two cubes");
            Test.That(two.Concavity <= 0.2 && two.MaxOutside < 1e-5 && stages.Contains("proof"), "close to the cubes");
            foreach (ConvexPart part in two.Parts)
            {
                Hull hull = part.Hull;
                Test.That(Math.Abs(hull.Volume - 8) < 1e-6 && part.Concavity <= two.Concavity, "a cube's volume");
                Test.That(hull.Vertices().Length == 8 && Math.Abs(VolumeOf(hull) - 8) < 1e-6, "its triangles enclose it");
            }
            Test.That(one.Parts.Count == 1 && one.Concavity > 1 && one.Parts[0].Hull.Contains(new Vec3(3, 0, 0)), "one for both");
        }
        TalusException error = Test.Throws(() => Decomposition.Bake(cube, cubeSides, new DecomposeSettings { MaxVertices = 3 }));
        Test.That(error.Field == "max_vertices", "three corners");
    }

    private static double VolumeOf(Hull hull)
    {
        Vec3[] points = hull.Vertices();
        int[] corners = hull.Triangles();
        double sixfold = 0;
        for (int i = 0; i < corners.Length; i += 3)
        {
            Vec3 a = points[corners[i]], b = points[corners[i + 1]], c = points[corners[i + 2]];
            sixfold += a.X * (b.Y * c.Z - b.Z * c.Y) + a.Y * (b.Z * c.X - b.X * c.Z) + a.Z * (b.X * c.Y - b.Y * c.X);
        }
        return sixfold / 6;
    }

    private static void PathsLeadAroundTheWall()
    {
        using (Navmesh navmesh = Navmesh.Bake(vertices, triangles, new NavmeshSettings { AgentRadius = 0.4f }))
        using (var query = new NavQuery(navmesh))
        {
            NavPath path = query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5));
            Test.That(path.Points.Length >= 4 && path.Length > 24.4 && path.Length < 27, "around the wall");
            Test.That(Math.Abs(path.Length - path.LowerBound) < 1e-4, "proven");
            Test.That(query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(50, 0, 0)) == null, "no floor there");
            Test.That(query.NearestPoint(new Vec3(-5, 1, -5)) != null, "floor below");
            NavRayHit hit = query.CastRay(new Vec3(-5, 0, 0), new Vec3(5, 0, 0)).Value;
            Test.That(hit.Hit && hit.Point.X < 0 && hit.Point.X > -1 && hit.Normal.X < -0.9f, "the wall stops");
            Vec3 slid = query.MoveAlongSurface(new Vec3(-5, 0, 0), new Vec3(5, 0, 2)).Value;
            Test.That(slid.X < 0 && Math.Abs(slid.Z - 2) < 0.5f, "slides along the wall");
            TalusException error = Test.Throws(() => query.ShortestPath(new Vec3(float.NaN, 0, 0), new Vec3()));
            Test.That(error.Result == tl_result.TL_ERR_NOT_FINITE, "NaN");
        }
    }

    private static void ThreadsGiveTheSameBytes()
    {
        byte[] one = null;
        foreach (int threads in new[] { 1, 2, 5 })
        {
            using (Navmesh navmesh = Navmesh.Bake(vertices, triangles, new NavmeshSettings { TileSize = 16, Threads = threads }))
            using (Soup soup = Soup.Bake(vertices, triangles, null, threads))
            {
                byte[] bytes = new Level { Soup = soup, Navmesh = navmesh }.ToBytes();
                one = one ?? bytes;
                Test.That(Same(bytes, one), threads + " threads");
            }
        }
        using (Navmesh navmesh = Navmesh.Bake(vertices, triangles))
        {
            Exception failed = null;
            var threads = new Thread[4];
            for (int i = 0; i < threads.Length; i++)
            {
                threads[i] = new Thread(() =>
                {
                    try
                    {
                        using (var query = new NavQuery(navmesh))
                        {
                            double first = query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5)).Length;
                            for (int j = 0; j < 100; j++)
                            {
                                if (query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5)).Length != first)
                                {
                                    throw new Exception("another length");
                                }
                            }
                        }
                    }
                    catch (Exception exception)
                    {
                        failed = exception;
                    }
                });
                threads[i].Start();
            }
            Array.ForEach(threads, thread => thread.Join());
            Test.That(failed == null, "threads share a navmesh: " + failed);
        }
    }

    private static void FilesHoldAllOfIt()
    {
        byte[] bytes;
        double length;
        using (Soup soup = Soup.Bake(vertices, triangles))
        using (Hull hull = Hull.Bake(cube))
        using (Navmesh navmesh = Navmesh.Bake(vertices, triangles))
        using (var query = new NavQuery(navmesh))
        {
            bytes = new Level { Soup = soup, Hull = hull, Navmesh = navmesh }.ToBytes();
            length = query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5)).Length;
        }
        Level level = Level.FromBytes(bytes);
        Test.That(Same(level.ToBytes(), bytes), "the same bytes again");
        string path = System.IO.Path.Combine(folder, "written.talus");
        level.Save(path);
        level = Level.Load(path);
        // What is taken out of a level keeps the bytes, whatever order the rest goes in.
        Navmesh kept = level.Navmesh;
        level.Soup.Dispose();
        level.Hull.Dispose();
        level = null;
        Collect();
        using (var query = new NavQuery(kept))
        {
            Test.That(query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5)).Length == length, "the same path");
        }
        for (int at = 0; at < bytes.Length; at += 97)
        {
            var altered = (byte[])bytes.Clone();
            altered[at] ^= 1;
            Test.Throws(() => Level.FromBytes(altered));
        }
        foreach (int size in new[] { 0, 1, 63, 64, bytes.Length / 2, bytes.Length - 1 })
        {
            var cut = new byte[size];
            Array.Copy(bytes, cut, size);
            Test.Throws(() => Level.FromBytes(cut));
        }
    }

    private static void TheCommandsFilesAreRead()
    {
        if (command == null)
        {
            Console.WriteLine("no command was named: its files are not read");
            return;
        }
        foreach (string line in new[] { "sample courtyard -o level.obj", "bake level.obj -o level.talus" })
        {
            var start = new ProcessStartInfo(command, line) { WorkingDirectory = folder, UseShellExecute = false, RedirectStandardOutput = true };
            using (Process process = Process.Start(start))
            {
                process.StandardOutput.ReadToEnd();
                process.WaitForExit();
                Test.Equal(0, process.ExitCode, "talus " + line);
            }
        }
        Level level = Level.Load(System.IO.Path.Combine(folder, "level.talus"));
        using (var query = new NavQuery(level.Navmesh))
        {
            NavPath path = query.ShortestPath(new Vec3(2, 0, 20), new Vec3(20, 5, 20));
            Test.That(path.Points.Length > 2 && path.Length > 18, "up the stairs");
        }
    }

    private static void ErrorsNameTheCulprit()
    {
        var wrong = (Vec3[])vertices.Clone();
        wrong[7].Y = float.NaN;
        TalusException error = Test.Throws(() => Soup.Bake(wrong, triangles));
        Test.That(error.Result == tl_result.TL_ERR_NOT_FINITE && error.Element == "vertex" && error.ElementIndex == 7, "vertex 7");
        error = Test.Throws(() => Soup.Bake(vertices, new[] { 0, 1, 99 }));
        Test.That(error.Result == tl_result.TL_ERR_INDEX && error.ElementIndex == 0, "index 99");
        error = Test.Throws(() => Soup.Bake(vertices, new[] { 0, 1, -1 }));
        Test.That(error.Result == tl_result.TL_ERR_INDEX, "index -1");
        error = Test.Throws(() => Soup.Bake(new Vec3[0], new int[0]));
        Test.That(error.Result == tl_result.TL_ERR_EMPTY, "nothing: " + error.Message);
        error = Test.Throws(() => Navmesh.Bake(vertices, triangles, new NavmeshSettings { CellSize = -1 }));
        Test.That(error.Field == "cell_size" && error.Advice != null && error.Message.Contains("cell_size"), "cell_size");
        using (Soup soup = Soup.Bake(vertices, triangles))
        {
            error = Test.Throws(() => new CharacterMover(soup, -1));
            Test.That(error.Field == "radius", "radius");
        }
    }

    private static void BakesTellTheirProgress()
    {
        int calls = 0;
        using (Navmesh.Bake(vertices, triangles, null, (stage, done, total) =>
        {
            Test.That(stage.Length > 0 && done <= total, "progress");
            calls++;
            return true;
        }))
        {
            Test.That(calls > 3, "called");
        }
        TalusException error = Test.Throws(() => Navmesh.Bake(vertices, triangles, null, (stage, done, total) => false));
        Test.That(error.Result == tl_result.TL_ERR_CANCELLED, "cancelled");
        try
        {
            Navmesh.Bake(vertices, triangles, null, (stage, done, total) => { throw new InvalidOperationException("mine"); });
            Test.That(false, "the callback's exception comes out");
        }
        catch (InvalidOperationException exception)
        {
            Test.That(exception.Message == "mine", "the callback's own exception");
        }
    }

    private static void CharactersWalk()
    {
        using (Soup soup = Soup.Bake(vertices, triangles))
        using (var mover = new CharacterMover(soup))
        {
            CharacterState character = CharacterState.At(new Vec3(-5, 0.5f, 0));
            for (int i = 0; i < 60; i++)
            {
                mover.Move(ref character, new Vec3(0, -3, 0), 1f / 60);
            }
            Test.That(character.Grounded && Math.Abs(character.Position.Y) < 0.01f, "falls to the floor");
            for (int i = 0; i < 240; i++)
            {
                mover.Move(ref character, new Vec3(3, 0, 1), 1f / 60);
            }
            Test.That(character.Position.X < 0 && character.Position.X > -0.5f && character.Position.Z > 3, "slides along the wall");
            CharacterState before = character;
            TalusException error = Test.Throws(() => mover.Move(ref character, new Vec3(float.NaN, 0, 0), 1));
            Test.That(error.Field == "velocity" && character.Position.Equals(before.Position), "NaN changes nothing");
        }
    }

    private static void CrowdsArriveWithoutLeavingTheFloor()
    {
        using (Navmesh navmesh = Navmesh.Bake(vertices, triangles, new NavmeshSettings { AgentRadius = 0.4f, CellSize = 0.2f }))
        using (var query = new NavQuery(navmesh))
        using (var crowd = new Crowd(navmesh, new CrowdSettings { MaxAgents = 8 }))
        {
            for (int i = 0; i < 6; i++)
            {
                ulong agent = crowd.Add(new Vec3(-8, 0, -8 + 2 * i), new AgentSettings { MaxSpeed = 2 + 0.1f * i });
                Test.That(agent != 0 && crowd.SetGoal(agent, new Vec3(8, 0, 8 - 2 * i)), "a place and a goal");
            }
            Test.Equal(0, (long)crowd.Add(new Vec3(500, 0, 0)), "no floor there");
            Test.Equal(6, crowd.Count, "agents");
            ulong[] agents = crowd.Agents();
            Test.That(!crowd.SetGoal(agents[0], new Vec3(500, 0, 0)), "no goal there");
            byte[] start = crowd.Save();
            int steps = WalkToTheGoals(crowd, query, agents);
            ulong end = crowd.Hash();
            crowd.Restore(start);
            Test.That(crowd.Hash() != end, "the beginning is not the end");
            Test.Equal(steps, WalkToTheGoals(crowd, query, agents), "steps again");
            Test.That(crowd.Hash() == end, "the same calls, the same bytes");

            start[0] ^= 1;
            Test.That(Test.Throws(() => crowd.Restore(start)).Result == tl_result.TL_ERR_MAGIC, "no state");
            Test.That(Test.Throws(() => crowd.Restore(new byte[3])).Result == tl_result.TL_ERR_TRUNCATED, "three bytes");
            Test.That(crowd.Hash() == end, "and the crowd is as it was");
            crowd.Remove(agents[2]);
            Test.That(Test.Throws(() => crowd.Stop(agents[2])).Result == tl_result.TL_ERR_STALE, "a removed agent");
            Test.Equal(5, crowd.Agents().Length, "agents left");
            Test.That(Test.Throws(() => crowd.Add(new Vec3(0, 0, 8), new AgentSettings { Radius = -1 })).Field == "radius", "a radius");
            Test.That(Test.Throws(() => crowd.SetMotion(agents[0], new Vec3(0, 0, 0), new Vec3(0, 0, 0))).Result == tl_result.TL_ERR_ARGUMENT,
                "an agent that is not fixed");
            Test.That(Test.Throws(() => crowd.Step(0)).Result == tl_result.TL_ERR_ARGUMENT, "a step of no time");
            Test.That(Test.Throws(() => new Crowd(navmesh, new CrowdSettings { MaxNeighbors = 99 })).Field == "max_neighbors", "neighbours");
        }
    }

    private static void GroupsFollowTheirLeader()
    {
        using (Navmesh navmesh = Navmesh.Bake(vertices, triangles, new NavmeshSettings { AgentRadius = 0.4f, CellSize = 0.2f }))
        using (var query = new NavQuery(navmesh))
        using (var crowd = new Crowd(navmesh, new CrowdSettings { MaxAgents = 8 }))
        {
            var squad = new ulong[4];
            for (int i = 0; i < squad.Length; i++)
            {
                squad[i] = crowd.Add(new Vec3(-8, 0, -8 + 2 * i));
            }
            ulong group = crowd.AddGroup(squad, new GroupSettings { Formation = Formation.Wedge });
            Test.That(crowd.Group(group).Leader == squad[0] && crowd.GroupOf(squad[3]) == group, "the first leads");
            crowd.SetFormation(group, new GroupSettings { Formation = Formation.Column, Spacing = 1 });
            Test.That(Test.Throws(() => crowd.SetGoal(squad[1], new Vec3(8, 0, 8))).Result == tl_result.TL_ERR_ARGUMENT, "a follower's goal");
            Test.That(crowd.SetGoal(squad[0], new Vec3(8, 0, 8)), "a goal");
            WalkToTheGoals(crowd, query, squad);
            GroupState state = crowd.Group(group);
            Test.That(state.Count == 4 && state.InPlace == 4, "all in their slots");
            ulong[] members = crowd.Members(group);
            Test.That(members[0] == squad[0], "the leader comes first");
            Array.Sort(members);
            Test.That(members.SequenceEqual(squad), "each is a member");
            var slots = new GroupSettings { Formation = Formation.Slots, Slots = new[] { new FormationSlot(-1, 0) } };
            Test.Refused(() => crowd.SetFormation(group, slots), "slots for all");
            Test.Refused(() => crowd.SetFormation(group, new GroupSettings { Formation = Formation.Slots }), "slots");
            slots.Slots = new[] { new FormationSlot(-1, 0), new FormationSlot(-1, 1), new FormationSlot(-1, -1) };
            crowd.SetFormation(group, slots);
            Test.That(Test.Throws(() => crowd.AddGroup(squad)).Result == tl_result.TL_ERR_ARGUMENT, "in a group already");
            Test.That(Test.Throws(() => crowd.AddGroup(new ulong[0])).Result == tl_result.TL_ERR_ARGUMENT, "a group of none");
            crowd.RemoveGroup(group);
            Test.That(crowd.GroupOf(squad[0]) == 0, "let go");
            Test.That(Test.Throws(() => crowd.Group(group)).Result == tl_result.TL_ERR_STALE, "a group that was");
            Test.That(Test.Throws(() => crowd.AddGroup(squad, new GroupSettings { Spacing = -1 })).Field == "spacing", "a spacing");
        }
    }

    private static int WalkToTheGoals(Crowd crowd, NavQuery query, ulong[] agents)
    {
        for (int steps = 1; steps < 1000; steps++)
        {
            crowd.Step(1f / 20);
            int arrived = 0;
            foreach (ulong agent in agents)
            {
                AgentState state = crowd[agent];
                Vec3 at = state.Position, floor = query.NearestPoint(at).Value;
                Test.That(Math.Abs(at.X - floor.X) < 1e-3f && Math.Abs(at.Z - floor.Z) < 1e-3f, "on the navmesh");
                // The wall reaches from 0 to 0.5 along x, and to 6 along z; the navmesh keeps 0.4 m from it.
                Test.That(at.X < -0.1f || at.X > 0.6f || at.Z > 6.1f, "not in the wall");
                arrived += state.Status == AgentStatus.Arrived ? 1 : 0;
            }
            if (arrived == agents.Length)
            {
                return steps;
            }
        }
        throw new Exception("they do not arrive");
    }

    private static void NothingIsUsedAfterItsEnd()
    {
        Soup soup = Soup.Bake(vertices, triangles);
        soup.Dispose();
        soup.Dispose();
        try
        {
            soup.IsOccluded(new Vec3(), new Vec3(1, 0, 0));
            Test.That(false, "a disposed soup is refused");
        }
        catch (ObjectDisposedException)
        {
            Test.Checks++;
        }
        // Left to the collector while calls are under way.
        var query = new NavQuery(Navmesh.Bake(vertices, triangles));
        ConvexShape shape = ConvexShape.Of(Hull.Bake(cube));
        using (Soup level = Soup.Bake(vertices, triangles))
        {
            for (int i = 0; i < 50; i++)
            {
                Collect();
                Test.That(query.ShortestPath(new Vec3(-5, 0, -5), new Vec3(5, 0, -5)) != null, "the query keeps its navmesh");
                Test.That(level.Overlaps(shape, RigidPose.At(new Vec3())), "the shape keeps its hull");
            }
        }
    }

    private static void Collect()
    {
        GC.Collect();
        GC.WaitForPendingFinalizers();
    }

    private static bool Same(byte[] a, byte[] b)
    {
        if (a.Length != b.Length)
        {
            return false;
        }
        for (int i = 0; i < a.Length; i++)
        {
            if (a[i] != b[i])
            {
                return false;
            }
        }
        return true;
    }

    private static int Main(string[] arguments)
    {
        folder = arguments[0];
        command = arguments.Length > 1 ? arguments[1] : null;
        Action[] all =
        {
            StructsAreThoseOfC, EveryFunctionIsThere, RaysHitWhatTheyShould, BatchesAreTheirRays, HullsKeepTheirDistance, MeshesBecomeConvexParts, PathsLeadAroundTheWall,
            ThreadsGiveTheSameBytes, FilesHoldAllOfIt, TheCommandsFilesAreRead, ErrorsNameTheCulprit, BakesTellTheirProgress, CharactersWalk,
            CrowdsArriveWithoutLeavingTheFloor, GroupsFollowTheirLeader, NothingIsUsedAfterItsEnd,
        };
        int failed = 0;
        foreach (Action test in all)
        {
            try
            {
                test();
            }
            catch (Exception exception)
            {
                failed++;
                Console.WriteLine(test.Method.Name + ": " + exception);
            }
        }
        Console.WriteLine(Test.Checks + " checks in " + all.Length + " tests of C#");
        Console.WriteLine(all.Length - failed + " passed, " + failed + " failed");
        return failed == 0 ? 0 : 1;
    }
}
